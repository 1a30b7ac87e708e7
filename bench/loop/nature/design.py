"""Wheels, soils, what is known beforehand, and the plan of the runs (SI, angles in rad, unless a name says otherwise)."""
import numpy as np

from . import wheel as base

FACTORS = ("speed", "pass", "position", "moisture", "longitudinal", "transverse", "yaw")
# name: n, k_c kN/m^(n+1), k_phi kN/m^(n+2), c kPa, phi deg, K m. Rows 1, 2, 4, 5, 9 stand in Wong's table
# (cases/soils); the others are soils of that kind, from memory, not citable.
# Every one is changed at random before use, so none is the nature of a campaign as it stands.
SOILS = (
    ("dry sand", 1.1, 0.99, 1528.43, 1.04, 28.0, 0.020),
    ("sandy loam", 0.7, 5.27, 1515.04, 1.72, 29.0, 0.020),
    ("strong sandy loam", 0.9, 40.0, 1130.0, 4.8, 21.0, 0.015),
    ("clayey soil", 0.5, 13.19, 692.15, 4.14, 13.0, 0.008),
    ("upland sandy loam", 1.10, 74.6, 2080.0, 3.3, 33.7, 0.025),
    ("light loam", 0.66, 7.0, 750.0, 3.7, 29.8, 0.022),
    ("clayey loam", 0.73, 40.0, 2400.0, 6.0, 26.6, 0.014),
    ("regolith", 1.0, 1.4, 820.0, 0.3, 36.0, 0.018),
    ("snow", 1.6, 4.37, 196.72, 1.03, 19.7, 0.025),
    ("loose river sand", 0.8, 0.6, 900.0, 0.6, 31.0, 0.028),
    ("wet silt", 0.4, 10.0, 500.0, 6.5, 16.0, 0.010),
)
SIZES = {"rover": (0.06, 0.15), "single-wheel bed": (0.15, 0.30), "car": (0.30, 0.45), "tractor": (0.45, 0.80)}


def draw_wheel(rng, needs):
    """A wheel: radius, width, lug_height [m], lug_count, inflation [Pa], its class; lugs and air where needed."""
    kind = str(rng.choice(["single-wheel bed", "car", "tractor"] if "inflation" in needs else list(SIZES)))
    low, high = SIZES[kind]
    radius = float(np.exp(rng.uniform(np.log(low), np.log(high))))
    width = radius * float(rng.uniform(0.35, 1.1) if kind != "tractor" else rng.uniform(0.3, 0.75))
    lugged = "lugs" in needs or rng.random() < 0.3
    height = radius * float(rng.uniform(0.04, 0.13)) if lugged else 0.0
    air = "inflation" in needs or (kind in ("car", "tractor") and rng.random() < 0.3)
    return {"kind": kind, "radius": round(radius, 3), "width": round(width, 3), "lug_height": round(height, 4) if lugged else 0.0,
            "lug_count": int(rng.integers(12, 37)) if lugged else 0,
            "inflation": round(float(rng.uniform(25, 160)), 0) * 1e3 if air else 0.0}


def draw_soil(rng, wheel):
    """The true soil, SI: a soil of the list, each value changed at random; k positive at the wheel's width."""
    name, n, kc, kphi, c, phi, shear = SOILS[int(rng.integers(len(SOILS)))]
    n = n * float(np.exp(rng.normal(0, 0.07)))
    spread = lambda value, sd: value * float(np.exp(rng.normal(0, sd)))
    return {"name": name, "exponent": n, "k_c": 1e3 * spread(kc, 0.3), "k_phi": 1e3 * spread(kphi, 0.25),
            "cohesion": 1e3 * spread(c, 0.3), "friction_angle": np.radians(spread(phi, 0.07)),
            "shear_modulus": float(np.clip(spread(shear, 0.35), 0.003, 0.3 * wheel["radius"])),
            "stress_angle_c1": float(rng.uniform(0.15, 0.5)), "stress_angle_c2": float(rng.uniform(0.0, 0.4)),
            "density": float(rng.integers(120, 176)) * 10}


def draw_prior(rng, soil):
    """Standard deviations of what is known beforehand, SI: tight (good tests) or weak (a handbook), one grade a campaign."""
    grade = float(rng.choice([0.35, 0.7, 1.0, 1.6]))
    vary = lambda: grade * float(rng.uniform(0.7, 1.3))
    return {"exponent": 0.07 * vary(), "k_c": 0.25 * vary() * soil["k_c"], "k_phi": 0.18 * vary() * soil["k_phi"],
            "cohesion": 0.22 * vary() * soil["cohesion"], "friction_angle": np.radians(1.8 * vary()),
            "shear_modulus": 0.28 * vary() * soil["shear_modulus"],
            "stress_angle_c1": 0.07 * vary(), "stress_angle_c2": 0.07 * vary()}


def declare(rng, soil, sd):
    """The declared soil: the truth plus a draw of its declared sd, within what a test could have given."""
    found = {}
    for key in base.SOIL_KEYS:
        for _ in range(50):
            value = soil[key] + sd[key] * float(rng.normal())
            low = 0.005 if key.startswith("stress_angle") else 0.15 * soil[key]
            if value > low:
                break
        found[key] = value
    return found


def draw_plan(rng, needs, rich):
    """Which factors vary, the number of levels and runs, re-runs, order, columns, channels, frames."""
    wanted = set(needs) & set(FACTORS)
    odds = 0.5 if rich else 0.22
    vary = {name for name in FACTORS if name in wanted or rng.random() < odds * (0.6 if name in ("transverse",) else 1)}
    spare = sorted(vary - wanted)
    while len(vary) > (6 if rich else 3) and spare:
        vary.remove(spare.pop(int(rng.integers(len(spare)))))
    side = "lateral_force" in needs or ({"yaw", "transverse"} & vary and rng.random() < 0.7) or rng.random() < 0.06
    channels = [c for c in base.CHANNELS if c != "lateral_force" or side]
    drop = rng.random()
    for channel, low, high in (("sinkage", 0.0, 0.12), ("torque", 0.12, 0.2), ("drawbar_pull", 0.2, 0.23)):
        if low <= drop < high and channel not in needs and "channels" not in needs and len(channels) > 2:
            channels.remove(channel)
    loads = int(rng.integers(3, 5)) if rich else int(rng.choice([1, 2, 3], p=[0.25, 0.5, 0.25]))
    if "loads" in needs:
        loads = max(loads, 3 if rich else 2)
    return {"vary": sorted(vary), "channels": channels, "loads": loads, "slips": int(rng.integers(6, 10)),
            "runs": int(rng.integers(50, 81)) if rich else int(rng.integers(15, 26)),
            "rerun_part": float(rng.choice([0.0, 0.15, 0.3, 0.45], p=[0.15, 0.25, 0.35, 0.25])),
            "brake": bool(rng.random() < 0.25), "jitter": bool(rng.random() < 0.5),
            "order": str(rng.choice(["random", "random", "random", "slip", "load"])),
            "present": sorted(n for n in ("speed", "pass", "position", "moisture") if n in vary or rng.random() < 0.3),
            "has_run": bool("run" in needs or rng.random() < 0.85), "has_setpoint": bool(rng.random() < 0.9),
            "other_place": bool(rng.random() < 0.15), "blank": float(rng.choice([0.0, 0.0, 0.0, 0.02, 0.05])),
            "force_frame": "wheel" if rng.random() < 0.3 else "travel",
            "slip_by": "travel_speed" if rng.random() < 0.3 else "wheel_plane_speed",
            "unit_column": str(rng.choice(["", "", "", "", "", "", "", "", "", "", "kN", "mm"]))}


def draw_levels(rng, plan, wheel, soil, depth=None):
    """Levels of every factor: loads from wanted sinkages (z/r about 0.02 - 0.16), the others by the size of the wheel."""
    r = wheel["radius"]
    top = depth if depth else float(np.exp(rng.uniform(np.log(0.05), np.log(0.16))))
    parts = np.array([top]) if plan["loads"] == 1 else np.geomspace(top * rng.uniform(0.2, 0.45), top, plan["loads"])
    loads = [load_for(wheel, soil, float(part) * r) for part in parts]
    slips = np.sort(rng.uniform(0.02, 0.08) + np.linspace(0, rng.uniform(0.5, 0.7), plan["slips"]) ** rng.uniform(0.9, 1.4))
    if plan["brake"]:
        slips = np.concatenate([[-rng.uniform(0.15, 0.4), -rng.uniform(0.02, 0.1)], slips])
    speed = float(np.exp(rng.uniform(np.log(0.02), np.log(0.1)))) if r < 0.3 else float(rng.uniform(0.3, 1.0))
    length = r * float(rng.uniform(8, 16)) + 1.0
    wet = float(rng.uniform(0.5, 14))
    tilt = float(rng.uniform(5, 11))
    levels = {"load": [float(f"{w:.4g}") for w in loads], "slip": [round(float(s), 4) for s in slips],
              "speed": [round(float(speed * f), 4) for f in sorted([1.0, *np.exp(rng.uniform(1.0, 2.2, int(rng.integers(1, 3))))])],
              "pass": [1.0, 2.0, 3.0, 4.0, 5.0][:int(rng.integers(2, 6))],
              "position": [round(float(x), 2) for x in np.linspace(0.15, 0.85, int(rng.integers(4, 8))) * length],
              "moisture": [round(wet + float(d), 2) for d in np.linspace(0, rng.uniform(3, 9), int(rng.integers(3, 6)))],
              "longitudinal": [round(tilt * f, 1) for f in ((-0.5, 0, 0.5, 1.0) if rng.random() < 0.7 else (0, 0.5, 1.0))],
              "transverse": [round(0.7 * tilt * f, 1) for f in (-1.0, 0, 1.0)],
              "yaw": [[0.0, 5.0, 10.0, 20.0], [-10.0, 0.0, 5.0, 15.0], [0.0, 8.0, 16.0]][int(rng.integers(3))]}
    for name in FACTORS:
        if name not in plan["vary"]:
            centre = 0.0 if name in ("longitudinal", "transverse", "yaw") else 1.0 if name == "pass" else None
            levels[name] = [levels[name][int(rng.integers(len(levels[name])))] if centre is None else centre]
    return levels


def load_for(wheel, soil, z):
    """Vertical load [N] that the base model carries at depth z [m], slip 0.2, on the level."""
    one = {key: np.zeros(1) for key in ("position", "moisture", "run", "longitudinal", "transverse", "yaw")}
    one.update(load=np.ones(1), slip=np.full(1, 0.2), speed=np.ones(1))
    one["pass"] = np.ones(1)
    p = base.state(wheel, soil, one)
    return float(base.integrate(p, np.arccos(1 - np.full(1, z) / wheel["radius"]), ())["V"][0])


def _balanced(rng, levels, count):
    """`count` draws of a list in which each value comes equally often, in random order."""
    pool = np.tile(np.asarray(levels, float), count // len(levels) + 1)
    return rng.permutation(pool[:len(levels) * (count // len(levels) + 1)])[:count]


def draw_rows(rng, plan, levels):
    """Rows of the plan, files' units (N, deg, %, m): a balanced random draw of the levels, re-runs, run order."""
    fresh = max(plan["runs"] - int(round(plan["rerun_part"] * plan["runs"])), 10)
    names = ("load", "slip") + FACTORS
    rows = {name: _balanced(rng, levels[name], fresh) for name in names}
    same = rng.integers(0, fresh, size=max(2, fresh // 3))
    again = rng.choice(same, plan["runs"] - fresh) if plan["runs"] > fresh else np.zeros(0, int)
    index = np.concatenate([np.arange(fresh), again])
    key = {"random": rng.random(len(index)), "slip": rows["slip"][index] + 1e-3 * rng.random(len(index)),
           "load": rows["load"][index] * (1 + 1e-3 * rng.random(len(index)))}[plan["order"]]
    index = index[np.argsort(key, kind="stable")]
    rows = {name: value[index] for name, value in rows.items()}
    rows["run"] = np.arange(1, len(index) + 1).astype(float)
    first = {}
    rows["setpoint"] = [f"S{first.setdefault(int(i), len(first) + 1):02d}" for i in index]
    if plan["other_place"] and "position" in plan["vary"]:
        rows["position"] = _balanced(rng, levels["position"], len(index))
    if plan["jitter"]:
        for name, part in (("load", 0.004), ("speed", 0.012), ("moisture", 0.012)):
            rows[name] = rows[name] * (1 + part * rng.normal(size=len(index)))
        rows["slip"] = rows["slip"] + 0.003 * rng.normal(size=len(index))
    return rounded(rows)


def rounded(rows, largest=None):
    """Rows with the digits that the file shows (by its largest load), so that the file's conditions are the true ones."""
    digits = max(0, 3 - int(np.floor(np.log10(largest or np.max(rows["load"])))))
    for name, places in (("load", digits), ("slip", 4), ("speed", 4), ("position", 2), ("moisture", 2),
                         ("longitudinal", 1), ("transverse", 1), ("yaw", 1), ("pass", 0), ("run", 0)):
        rows[name] = np.round(np.asarray(rows[name], float), places)
    return rows


def radians(rows):
    """Rows with the angles in rad, as wheel.state takes them."""
    return {k: np.radians(v) if k in ("longitudinal", "transverse", "yaw") else v for k, v in rows.items()}


def scales(rows, levels, wheel, plan, truth, bin_depth):
    """Typical values of a campaign, on which the forms' constants rest (SI); `truth`: base channels of the rows."""
    spread = {c: float(np.ptp(truth[c]) / 3 + 1e-9) for c in base.CHANNELS}
    position, moisture = levels["position"], levels["moisture"]
    load = float(np.median(rows["load"]))
    speed = float(np.exp(np.mean(np.log(rows["speed"]))))
    return {"load": load, "speed": speed, "sinkage": float(np.median(truth["sinkage"])),
            "pressure": load / (wheel["width"] * wheel["radius"] * float(np.median(np.sin(truth["entry"])))),
            "torque": float(np.median(np.abs(truth["torque"]))), "turn": speed / wheel["radius"] * 1.3,
            "position": float(np.mean([min(position), max(position)])), "runs": len(rows["run"]),
            "position_half": float(max(0.5 * np.ptp(position), 0.1)),
            "moisture": float(np.mean([min(moisture), max(moisture)])),
            "moisture_half": float(max(0.5 * np.ptp(moisture), 0.5)),
            "layer": bin_depth or 2.2 * float(np.max(truth["sinkage"])), "spread": spread,
            "middle": {c: float(0.5 * (np.max(truth[c]) + np.min(truth[c]))) for c in base.CHANNELS},
            "channels": [c for c in plan["channels"]]}


def draw_bin(rng, wheel, truth, needs):
    """Bin depth and width [m], or None: shallow where a hard layer is wanted, deep enough not to matter elsewhere."""
    z = float(np.max(truth["sinkage"]))
    if "layer" in needs:
        if rng.random() < 0.3:
            return None
        depth = z * float(rng.uniform(1.5, 4.0))
    elif rng.random() < 0.6:
        depth = max(8 * z, 1.2 * wheel["radius"]) * float(rng.uniform(1.0, 1.6))
    else:
        return None
    return {"depth": round(depth, 3), "width": round(wheel["width"] * float(rng.uniform(4, 9)), 2)}
