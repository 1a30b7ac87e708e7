"""The base model: a rigid smooth wheel on soil, Wong and Reece 1967 (J. Terramechanics 4(1), 81-98; 4(2), 7-25).

All values in SI, angles in rad, every quantity an array over runs (rows). Stresses are held on 2*NODES angles a run: the
rear part [theta_2, theta_m] and the front part [theta_m, theta_1], each by Gauss-Legendre in u with theta's distance from
the stress-free end proportional to u^3, which takes the singularity of (cos theta - cos theta_1)^n at n < 1 away.

An effect (families/) may act at these joints, in this order: soil, exit, outline, pressure, modulus, mobilised, limit,
added, sunk, report, sensor. See families/__init__.py for their arguments.
"""
from functools import lru_cache
from types import SimpleNamespace

import numpy as np

SOIL_KEYS = ("exponent", "k_c", "k_phi", "cohesion", "friction_angle", "shear_modulus", "stress_angle_c1", "stress_angle_c2")
CHANNELS = ("drawbar_pull", "torque", "sinkage", "lateral_force")
NODES = 20
THETA_MAX = 1.5  # rad: beyond, the axle is all but at the surface


@lru_cache(maxsize=None)
def _nodes(count):
    """Nodes u^3 in (0, 1) and weights (3 u^2 w) of a Gauss-Legendre rule in u [-]."""
    x, w = np.polynomial.legendre.leggauss(count)
    u = 0.5 * (x + 1.0)
    return u ** 3, 1.5 * u ** 2 * w


def state(wheel, soil, rows, slip_by="wheel_plane_speed", scale=None):
    """Per-run state from a wheel (m, Pa), a soil (SI, angle in rad) and rows (SI, rad): what the joints may change."""
    count = len(rows["load"])
    full = lambda value: np.full(count, float(value))
    p = SimpleNamespace(count=count, scale=scale or {})
    p.W, p.s, p.v = rows["load"].copy(), rows["slip"].copy(), rows["speed"].copy()
    p.npass, p.x, p.m, p.run = rows["pass"], rows["position"], rows["moisture"], rows["run"]
    p.al, p.be, p.psi = rows["longitudinal"], rows["transverse"], rows["yaw"]
    p.n, p.kc, p.kphi = full(soil["exponent"]), full(soil["k_c"]), full(soil["k_phi"])
    p.c, p.tan, p.K = full(soil["cohesion"]), full(np.tan(soil["friction_angle"])), full(soil["shear_modulus"])
    p.c1, p.c2, p.rho = full(soil["stress_angle_c1"]), full(soil["stress_angle_c2"]), soil["density"]
    p.r, p.b = full(wheel["radius"]), wheel["width"]
    p.r0, p.rs, p.arm = wheel["radius"], p.r.copy(), p.r.copy()
    p.h, p.lugs, p.inflation = wheel["lug_height"], wheel["lug_count"], wheel["inflation"]
    p.gain = np.ones(count)  # on k: stiffness against its undisturbed value
    if slip_by == "travel_speed":
        p.s = slip_from_ratio(ratio_from_slip(p.s) * np.cos(p.psi))
    return p


def ratio_from_slip(s):
    """v/(r w) [-] from slip: 1 - s driven, 1/(1 + s) braked (held finite at a locked wheel)."""
    return np.where(s >= 0, 1.0 - s, 1.0 / np.maximum(1.0 + np.minimum(s, 0.0), 1e-9))


def slip_from_ratio(q):
    """Slip [-] from v/(r w): the inverse of ratio_from_slip."""
    return np.where(q <= 1.0, 1.0 - q, 1.0 / np.maximum(q, 1.0) - 1.0)


def patch(p, th1, fx, count=NODES):
    """Angles [rad], quadrature weights [rad] and the depth [m] that sets the stress, each (runs, 2 count)."""
    u, du = _nodes(count)
    th2 = np.zeros_like(th1)
    for e in fx:
        th2 = e.exit(p, th1, th2)
    thm = np.minimum(p.c1 + p.c2 * np.abs(p.s), 0.98) * th1
    th2 = np.where(th2 == 0.0, 0.0, np.clip(th2, -0.98 * th1, 0.9 * np.maximum(thm, 0.0)))
    rear, front = (thm - th2)[:, None], (th1 - thm)[:, None]
    ahead = th1[:, None] - front * u
    theta = np.concatenate([th2[:, None] + rear * u, ahead], axis=1)
    weight = np.concatenate([rear * du, front * du], axis=1)
    # cos a - cos b without cancellation; the rear's equivalent angle theta_e meets the same nodes as the front
    depth = 2 * p.r[:, None] * np.sin(0.5 * (th1[:, None] + ahead)) * np.sin(0.5 * front * u)
    depth = np.concatenate([depth, depth], axis=1)
    for e in fx:
        depth = e.outline(p, depth, th1)
    return theta, weight, np.maximum(depth, 0.0)


def integrate(p, th1, fx, kappa=1.0, count=NODES):
    """Soil's force on the wheel at entry angle th1 [rad]: V, Fx, Fy [N], M [N m] (in the wheel's plane), per run."""
    theta, weight, depth = patch(p, th1, fx, count)
    k = (p.kc / p.b + p.kphi) * p.gain * kappa
    sigma = k[:, None] * depth ** p.n[:, None]
    for e in fx:
        sigma = e.pressure(p, sigma, depth, theta)
    q = ratio_from_slip(p.s)[:, None]
    arc = th1[:, None] - theta
    jx = p.rs[:, None] * arc - q * p.r[:, None] * (np.sin(th1)[:, None] - np.sin(theta))
    jy = p.r[:, None] * arc * q * np.tan(p.psi)[:, None]
    j = np.hypot(jx, jy)
    modulus = np.broadcast_to(p.K[:, None], sigma.shape)
    for e in fx:
        modulus = e.modulus(p, modulus, sigma)
    x = j / modulus
    part = -np.expm1(-x)
    for e in fx:
        part = e.mobilised(p, part, x)
    tau = (p.c[:, None] + sigma * p.tan[:, None]) * part
    for e in fx:
        tau = e.limit(p, tau, sigma)
    tau = weight * tau / np.maximum(j, 1e-300)
    tx, ty, sigma = tau * jx, tau * jy, sigma * weight
    cos, sin = np.cos(theta), np.sin(theta)
    out = {"V": p.b * (p.r * (sigma * cos).sum(1) + p.rs * (tx * sin).sum(1)),
           "Fx": p.b * (p.rs * (tx * cos).sum(1) - p.r * (sigma * sin).sum(1)),
           "Fy": p.b * p.rs * ty.sum(1), "M": p.b * p.rs * p.arm * tx.sum(1)}
    z = sinkage(p, th1)
    for e in fx:
        for key, value in e.added(p, z, th1).items():
            out[key] = out[key] + value
    return out


def sinkage(p, th1):
    """Depth of the lowest point [m] at entry angle th1 [rad]."""
    return 2 * p.r * np.sin(0.5 * th1) ** 2


def _secant(f, guess, steps=9):
    """Vectorised secant from a near guess [rad]; returns the root and whether each run has converged."""
    a, b = guess, guess * 1.002 + 1e-7
    fa, fb = f(a), f(b)
    for _ in range(steps):
        slope = (fb - fa) / np.where(b == a, 1.0, b - a)
        step = np.where((slope == 0) | ~np.isfinite(slope), 0.0, fb / np.where(slope == 0, 1.0, slope))
        step = np.where(np.abs(fb) < 1e-13, 0.0, step)
        a, fa, b = b, fb, np.clip(b - step, 1e-6, THETA_MAX)
        fb = np.where(step == 0.0, fb, f(b))
        if np.all(np.abs(fb) < 1e-11):
            break
    return b, np.abs(fb) < 1e-9


def _bracketed(f, count, steps=60):
    """Lowest root [rad] of f (rising) for every run: a scan, then Chandrupatla's method; false where it is buried."""
    grid = np.geomspace(2e-4, THETA_MAX, 20)
    a, fa = np.full(count, grid[0]), f(np.full(count, grid[0]))
    b, fb, found = a.copy(), fa.copy(), fa > 0
    for angle in grid[1:]:
        value = f(np.full(count, angle))
        a, fa = np.where(found, a, b), np.where(found, fa, fb)
        b, fb = np.where(found, b, angle), np.where(found, fb, value)
        found = found | (value > 0)
        if found.all():
            break
    c, fc, t = a, fa, np.full(count, 0.5)
    for _ in range(steps):
        x = a + t * (b - a)
        fx = f(x)
        same = np.sign(fx) == np.sign(fa)
        c, fc = np.where(same, a, b), np.where(same, fa, fb)
        b, fb = np.where(same, b, a), np.where(same, fb, fa)
        a, fa = x, fx
        if np.all((np.abs(fa) < 1e-12) | (np.abs(b - a) < 1e-13) | ~found):
            break
        with np.errstate(all="ignore"):
            xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
            inverse = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
            good = (phi ** 2 < xi) & ((1 - phi) ** 2 < 1 - xi) & np.isfinite(inverse)
        t = np.clip(np.where(good, inverse, 0.5), 1e-6, 1 - 1e-6)
    return a, found


def balance(p, fx=(), guess=None, count=NODES):
    """Entry angle [rad] at which the soil carries W cos(alpha) cos(beta); false where no such angle exists."""
    load = p.W * np.cos(p.al) * np.cos(p.be)
    f = lambda th1: integrate(p, th1, fx, count=count)["V"] / load - 1.0
    if guess is not None:
        th1, ok = _secant(f, guess)
        if ok.all():
            return th1, ok
    return _bracketed(f, p.count)


def sink_further(p, th1, fx):
    """Deeper contact under the same load: th1 [rad] raised by the joints' extra depth, stiffness scaled to balance."""
    extra = sum((e.sunk(p, sinkage(p, th1)) for e in fx), np.zeros(p.count))
    if not np.any(extra):
        return th1, np.ones(p.count)
    z = np.clip(sinkage(p, th1) + extra, 0.1 * sinkage(p, th1), 0.9 * p.r)
    deeper = np.arccos(1.0 - z / p.r)
    load = p.W * np.cos(p.al) * np.cos(p.be)
    f = lambda kappa: integrate(p, deeper, fx, kappa)["V"] / load - 1.0
    a, b = np.full(p.count, 0.8), np.ones(p.count)
    fa, fb = f(a), f(b)
    for _ in range(12):
        step = np.where(np.abs(fb) < 1e-12, 0.0, fb * (b - a) / np.where(fb == fa, 1.0, fb - fa))
        a, fa, b = b, fb, np.clip(b - step, 1e-4, 3.0)
        fb = f(b)
        if np.all(np.abs(fb) < 1e-10):
            break
    return deeper, b


def evaluate(p, fx=(), frame="travel", guess=None, count=NODES):
    """Channels of every run: drawbar_pull, lateral_force [N], torque [N m], sinkage [m]; entry angle [rad]; ok."""
    for e in fx:
        e.soil(p)
    th1, ok = balance(p, fx, guess, count)
    base = th1
    th1, kappa = sink_further(p, th1, fx)
    force = integrate(p, th1, fx, kappa, count)
    cos, sin = np.cos(p.psi), np.sin(p.psi)
    out = {"drawbar_pull": force["Fx"] * cos - force["Fy"] * sin - p.W * np.sin(p.al), "torque": force["M"],
           "sinkage": sinkage(p, th1),
           "lateral_force": force["Fx"] * sin + force["Fy"] * cos - p.W * np.cos(p.al) * np.sin(p.be)}
    p.th1 = th1
    for e in fx:
        e.report(p, out)
    if frame == "wheel":
        along, left = out["drawbar_pull"], out["lateral_force"]
        out["drawbar_pull"], out["lateral_force"] = along * cos + left * sin, left * cos - along * sin
    for e in fx:
        e.sensor(p, out)
    out["entry"], out["ok"] = base, ok & np.isfinite(out["torque"]) & (sinkage(p, th1) < 0.8 * p.r)
    return out
