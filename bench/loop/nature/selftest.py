"""Checks of nature against closed forms, against points on which two other codes agree, and against its own promises."""
import math
import tempfile
from pathlib import Path

import numpy as np

from . import campaign, design, sensitivity, sets
from . import wheel as base
from .families import catalogue, unknown

# r, b [m], k_c, k_phi [SI], n, c [Pa], phi [deg], K [m], c1, c2, W [N], s, lambda: z [m], F_DP [N], M [N m] (and digits)
# Source: points on which two independent codes agree (bekker_wong/agreed_points.cpp, docs/lab/verification.md).
PSI, INCH, POUND = 6894.757293168, 0.0254, 4.4482216152605
POINTS = (
    ("r = b = .1", (.1, .1, 1.4e3, 8.2e5, 1, 170, 46, .018, .4, .2, 40, .6, 0), (.017789, 11.7861, 2.3489)),
    ("Ishigami .9", (.09, .11, 1370, 8.14e5, 1, 800, 37.2, .036, .4, .15, 64.68, .2, .9), (.0155711, 10.05743, 1.471679)),
    ("Ishigami 0", (.09, .11, 1370, 8.14e5, 1, 800, 37.2, .036, .4, .15, 64.68, .2, 0), (.0237341, -9.11318, 1.275805)),
    ("Azimi", (.15, .1, 0, 4.1e5, .8, 234, 30, .013, .18, .32, 165, .2, 0), (.0317033, 15.6228, 9.42284)),
    ("Wong-Reece", (24.7 * INCH, 6 * INCH, 0, (20 + 2.5 * 6) * PSI / (6 * INCH) ** .47, .47, .1 * PSI, 33.3, 1.5 * INCH,
                    .43, .32, 2006 * POUND, .221, 0), (.123318, 1292.51, 2553.46)),
)


class _Lambda:
    """theta_2 = -acos(1 - lambda z/r), for the comparison only."""

    def __init__(self, value):
        from .families import Form
        self.form = Form(0, {})
        self.form.exit = lambda p, th1, th2: -np.arccos(1 - value * base.sinkage(p, th1) / p.r)


def one(r, b, kc, kphi, n, c, phi, shear, c1, c2, load, s):
    """State of one run [SI, phi in deg]."""
    rows = {k: np.zeros(1) for k in ("position", "moisture", "run", "longitudinal", "transverse", "yaw")}
    rows.update(load=np.full(1, float(load)), slip=np.full(1, float(s)), speed=np.ones(1))
    rows["pass"] = np.ones(1)
    soil = {"exponent": n, "k_c": kc, "k_phi": kphi, "cohesion": c, "friction_angle": math.radians(phi),
            "shear_modulus": shear, "stress_angle_c1": c1, "stress_angle_c2": c2, "density": 1600.0}
    return base.state({"radius": r, "width": b, "lug_height": 0.0, "lug_count": 0, "inflation": 0.0}, soil, rows)


class Checks:
    """Counts and prints what was checked."""

    def __init__(self):
        self.failed = 0

    def near(self, what, got, want, tolerance):
        """Relative difference."""
        off = abs(got - want) / max(abs(want), 1e-300)
        self.true(f"{what}: {got:.9g}, wanted {want:.9g} (off {off:.1e})", off <= tolerance)

    def true(self, what, good):
        """A statement."""
        self.failed += not good
        print(("ok    " if good else "FAILED ") + what)

    def status(self):
        """Prints the sum of it; 0 where all holds."""
        print("self-test: " + ("all good" if not self.failed else f"{self.failed} FAILED"))
        return int(self.failed > 0)


def closed_forms(check):
    """Closed forms of the reference."""
    for n in (0.5, 1.0, 1.3):
        p = one(.25, .2, 0, 1.5e6, n, 0, 0, .02, 0, 0, 1, .2)
        th1 = np.full(1, .5)
        z = float(base.sinkage(p, th1)[0])
        got, want = -float(base.integrate(p, th1, ())["Fx"][0]), .2 * 1.5e6 * z ** (n + 1) / (n + 1)
        check.near(f"resistance b k z^(n+1)/(n+1), n {n}", got, want, 1e-9)
    p = one(.25, .2, 0, 1.5e6, 1, 0, 0, .02, 0, 0, 1, .2)
    force = base.integrate(p, np.full(1, math.radians(30)), ())
    check.near("W at 30 deg [N]", float(force["V"][0]), 849.244441, 1e-8)
    check.near("resistance at 30 deg [N]", -float(force["Fx"][0]), 168.273679, 1e-8)
    p = one(.25, .2, 0, 1.5e6, 1, 2000, 0, 1e-7, .3, 0, 1, .3)
    th1 = np.full(1, .5)
    check.near("M = r^2 b c theta_1 at K -> 0", float(base.integrate(p, th1, (), count=400)["M"][0]), .25 ** 2 * .2 * 2000 * .5, 1e-4)
    p = one(.25, .2, 0, 1.5e6, 1, 2000, 0, .03, .3, 0, 1, 1.0)
    want = .25 ** 2 * .2 * 2000 * (.5 - .03 / .25 * -math.expm1(-.25 * .5 / .03))
    check.near("M at s = 1, phi = 0", float(base.integrate(p, th1, ())["M"][0]), want, 1e-7)


def points(check):
    """The points on which two independent codes agree."""
    for name, (r, b, kc, kphi, n, c, phi, shear, c1, c2, load, s, lam), want in POINTS:
        p = one(r, b, kc, kphi, n, c, phi, shear, c1, c2, load, s)
        out = base.evaluate(p, [_Lambda(lam).form] if lam else [])
        for channel, value in zip(("sinkage", "drawbar_pull", "torque"), want):
            check.near(f"{name} {channel}", float(out[channel][0]), value, 3e-5)  # the reference's digits


def invariants(check):
    """Vertical force rises with depth, M >= r F_DP, power out <= power in, more nodes change nothing, symmetry in yaw."""
    rng = np.random.default_rng([7])
    rise = bound = power = fine = mirror = True
    worst = 0.0
    for _ in range(40):
        world = campaign.draw_world(rng, {"yaw", "transverse"}, False)
        if world is None:
            continue
        p = lambda: base.state(world.wheel, world.soil, design.radians(world.rows), world.plan["slip_by"], world.scale)
        out, more = world.truth(), base.evaluate(p(), (), world.plan["force_frame"], count=60)
        scale = {c: np.max(np.abs(out[c])) for c in base.CHANNELS}
        worst = max(worst, max(float(np.max(np.abs(out[c] - more[c])) / scale[c]) for c in base.CHANNELS))
        state = p()
        force = base.integrate(state, out["entry"], ())
        rise &= bool(np.all(base.integrate(state, out["entry"] * 1.02, ())["V"] > force["V"]))
        bound &= bool(np.all((force["M"] >= world.wheel["radius"] * force["Fx"]) | (state.s < 0)))
        pulled = force["Fx"] * base.ratio_from_slip(state.s) * world.wheel["radius"]
        power &= bool(np.all((pulled <= force["M"] + 1e-9) | (state.s < 0)))
        state.psi = -state.psi
        turned = base.integrate(state, out["entry"], ())
        mirror &= bool(np.allclose(turned["Fy"], -force["Fy"]) and np.allclose(turned["Fx"], force["Fx"]))
    check.true("vertical force rises with depth", rise)
    check.true("M >= r F_x where driven", bound)
    check.true("power out <= power in", power)
    check.true(f"60 nodes instead of 20 change the channels by {worst:.1e} of their range (< 1e-4)", worst < 1e-4)
    check.true("yaw mirrors the side force", mirror)


def forms(check):
    """Every form: no effect at a = 0 (or as a -> 0), a finite one at its typical size; two forms or more an id."""
    listed = catalogue()
    check.true(f"20 ids, each with two forms or more ({sum(map(len, listed.values()))} in all, {len(unknown())} unknown)",
               len(listed) == 20 and min(map(len, listed.values())) >= 2)
    rng = np.random.default_rng([11])
    everything = set(design.FACTORS) | {"inflation", "lugs", "loads", "run", "torque", "sinkage", "lateral_force", "channels"}
    world = None
    while world is None:
        world = campaign.draw_world(rng, everything, True)
    for kind in [k for kinds in listed.values() for k in kinds] + unknown():
        shape = kind.draw(rng, world.scale)
        none, some = (sensitivity.change(world, [kind(a, shape)]) for a in (1e-9, 0.5 * kind.TYPICAL))
        good = none is not None and some is not None and np.isfinite(some).all()
        good = good and sensitivity.ratio(none) < 1e-2 and sensitivity.ratio(some) > 1e-3
        if not good:
            check.true(f"{kind.ID} {kind.NAME}: ratio at 0 {sensitivity.ratio(none)}, at half typical {sensitivity.ratio(some)}", False)
    check.true("every form is nothing at a = 0 and something at half its typical size", True)


def nulls(check):
    """Whitened residual of null campaigns at the true soil: chi^2/N about 1; the same bytes for the same seed; more runs."""
    total = cells = 0.0
    for index in range(1, 41):
        record, truth = sets.draw("check", 5, index, "null_rich" if index % 2 else "null_poor", [])
        world = campaign.restore(record)
        base_truth = world.truth()
        present = np.array([[c in record["read"] and record["read"][c][i] is not None for c in base.CHANNELS]
                            for i in range(len(base_truth["torque"]))])
        white = sensitivity.noise.whitener(record["noise"], base_truth, present)
        readings = {c: record["read"].get(c, [None] * len(present)) for c in base.CHANNELS}
        gap = np.stack([[0.0 if v is None else v - f for v, f in zip(readings[c], base_truth[c])]
                        for c in base.CHANNELS], axis=1)
        e = np.einsum("rij,rj->ri", white, gap)
        total, cells = total + float((e ** 2).sum()), cells + present.sum()
    limit = 4 * math.sqrt(2 / cells)
    check.true(f"null campaigns: chi2/N {total / cells:.4f} over {int(cells)} cells (within {limit:.3f} of 1)", abs(total / cells - 1) < limit)
    with tempfile.TemporaryDirectory() as folder:
        texts = []
        for part in ("a", "b"):
            sets.generate("check", 9, 4, Path(folder) / part)
            campaign.more(Path(folder) / part / "c002", {"slip": 0.3}, 2)
            files = [f for f in sorted((Path(folder) / part).rglob("*")) if f.is_file()]
            texts.append({str(f.relative_to(Path(folder) / part)): f.read_bytes() for f in files})
        check.true(f"same seed, same bytes ({len(texts[0])} files)", texts[0] == texts[1])


def refits(check):
    """Derivatives of a refit never ask for what physics forbids: at a bound they are one-sided."""
    low, high = np.array([0.0, -5.0]), np.array([9.0, 5.0])
    curve = lambda u: np.array([u[0] ** 1.5 + 3 * u[1], np.sqrt(u[0] + 1e-9)])  # no number at u[0] < 0
    middle, edge = (sensitivity.slopes(curve, np.array([u0, 1.0]), low, high) for u0 in (4.0, 0.0))
    check.near("slope of u^1.5 at 4", middle[0, 0], 3.0, 1e-4)
    check.true("slopes at a bound are numbers", bool(np.isfinite(edge).all()) and abs(edge[0, 1] - 3) < 1e-9)


def run():
    """All checks; 0 where all hold."""
    check = Checks()
    for part in (closed_forms, points, invariants, forms, refits, nulls):
        part(check)
    return check.status()
