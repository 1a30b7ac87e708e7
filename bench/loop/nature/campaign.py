"""One campaign: draw it, write it as docs/reference/campaigns.md says, keep its truth in a sidecar, make more runs of it."""
import json
import math
from pathlib import Path

import numpy as np

from . import design, noise, sensitivity
from . import wheel as base
from .families import FORM_NEEDS_CHANNELS, build

ANGLES = ("longitudinal", "transverse", "yaw")
COLUMNS = {"run": "run", "setpoint": "setpoint", "load": "load_N", "slip": "slip", "speed": "speed_m_s", "pass": "pass",
           "position": "position_m", "moisture": "moisture_percent", "longitudinal": "longitudinal_incline_deg",
           "transverse": "transverse_incline_deg", "yaw": "yaw_deg"}
MEASURED = {"drawbar_pull": "drawbar_pull_N", "torque": "torque_Nm", "sinkage": "sinkage_m", "lateral_force": "lateral_force_N"}
PLACES = {"slip": 4, "speed": 4, "pass": 0, "run": 0, "position": 2, "moisture": 2, "longitudinal": 1, "transverse": 1, "yaw": 1}


def usable(world, kind, strict=True):
    """Whether a form of this class can leave a trace in the campaign: it has the channels, parts and factors needed.

    Not strict: a cross slope stands in for yaw and for a longitudinal incline, and no channel is asked for (a missing one
    shows as a change of nothing).
    """
    plan, has = world.plan, world.wheel
    for need in kind.NEEDS:
        if strict and need in FORM_NEEDS_CHANNELS and need not in plan["channels"]:
            return False
        instead = set() if strict or need not in ("yaw", "longitudinal") else {"transverse"}
        if need in design.FACTORS and not ({need} | instead) & set(plan["vary"]):
            return False
        if (need == "lugs" and not has["lug_height"]) or (need == "inflation" and not has["inflation"]):
            return False
        if need == "run" and not plan["has_run"]:
            return False
    return True


def draw_world(rng, needs, rich, runs=None):
    """A campaign without effects: wheel, soil, prior, plan, balanced rows, noise; None where some run has no balance.

    runs: how many, in place of what the plan draws.
    """
    plan = design.draw_plan(rng, needs, rich)
    plan["runs"] = runs or plan["runs"]
    wheel = design.draw_wheel(rng, needs)
    soil = design.draw_soil(rng, wheel)
    sd = design.draw_prior(rng, soil)
    for key, digits in sd.items():
        sd[key] = float(f"{digits:.3g}")
    levels = design.draw_levels(rng, plan, wheel, soil)
    rows = design.draw_rows(rng, plan, levels)
    world = sensitivity.World(wheel=wheel, soil=soil, sd=sd, plan=plan, levels=levels, rows=rows, scale=None)
    truth = world.truth()
    if not truth["ok"].all():
        return None
    world.bin = design.draw_bin(rng, wheel, truth, needs)
    world.scale = design.scales(rows, levels, wheel, plan, truth, world.bin["depth"] if world.bin and "layer" in needs else None)
    world.noise = noise.draw(rng, truth, plan)
    world.declared = design.declare(rng, soil, sd)
    count = len(rows["load"])
    shown = np.array([c in plan["channels"] for c in base.CHANNELS])
    world.present = np.tile(shown, (count, 1)) & (rng.random((count, 4)) >= plan["blank"])
    world.present[~world.present.any(axis=1)] = shown
    return sensitivity.prepare(world, truth)


def measure(world, rng, effects, spoil):
    """The campaign's record (JSON values): its truth, its noisy readings and what the file shows."""
    truth = world.truth([build(e) for e in effects])
    read = noise.sample(rng, world.noise, truth)
    spoilt = noise.outliers(rng, world.noise, truth, read, world.plan["channels"]) if spoil else []
    plan = world.plan
    shown = (["run"] if plan["has_run"] else []) + (["setpoint"] if plan["has_setpoint"] else []) + ["load", "slip"]
    shown += [n for n in ("speed", "pass", "position", "moisture") if n in plan["present"]]
    shown += [n for n in ANGLES if n in plan["vary"]]
    plain = lambda value: value if isinstance(value, list) else [float(v) for v in value]
    return {"wheel": world.wheel, "soil": {k: v if isinstance(v, str) else float(v) for k, v in world.soil.items()},
            "declared": {k: float(v) for k, v in world.declared.items()}, "sd": {k: float(v) for k, v in world.sd.items()},
            "bin": world.bin, "plan": plan, "levels": world.levels, "scale": world.scale, "noise": world.noise,
            "effects": effects, "outliers": spoilt, "shown": shown, "calls": 0,
            "rows": {k: plain(v) for k, v in world.rows.items()},
            "read": {c: [float(v) if world.present[i, j] else None for i, v in enumerate(read[c])]
                     for j, c in enumerate(base.CHANNELS) if c in plan["channels"]}}


def decimals(record, channel):
    """Decimals that show a tenth of the channel's noise, in the file's unit."""
    rate = {"kN": 1e-3, "mm": 1e3}[record["plan"]["unit_column"]] if other(record) == channel else 1.0
    return min(7, max(0, math.ceil(-math.log10(0.1 * rate * record["noise"]["a"][channel]))))


def other(record):
    """Channel that the file gives in another unit, or None."""
    channel = {"kN": "drawbar_pull", "mm": "sinkage", "": None}[record["plan"]["unit_column"]]
    return channel if channel in record["plan"]["channels"] else None


def csv_text(record):
    """runs.csv: one header line, '.' decimals, empty cells where nothing was read."""
    rows, shown = record["rows"], record["shown"]
    digits = max(0, 3 - math.floor(math.log10(max(rows["load"]))))
    places = dict(PLACES, load=digits)
    special = {"drawbar_pull": ("Fx_kN", 1e-3), "sinkage": ("z_mm", 1e3)}
    heads = [COLUMNS[n] for n in shown]
    heads += [special[c][0] if c == other(record) else MEASURED[c] for c in record["read"]]
    lines = [",".join(heads)]
    for i in range(len(rows["load"])):
        cells = [rows[n][i] if n == "setpoint" else f"{rows[n][i] + 0.0:.{places[n]}f}" for n in shown]
        for c, values in record["read"].items():
            rate = special[c][1] if c == other(record) else 1.0
            cells.append("" if values[i] is None else f"{values[i] * rate:.{decimals(record, c)}f}")
        lines.append(",".join(cells))
    return "\n".join(lines).replace(",-0.0,", ",0.0,") + "\n"


def yaml_text(name, record):
    """campaign.yaml, as the contract shows it."""
    wheel, mean, sd = record["wheel"], record["declared"], record["sd"]
    lines = ["format: soilbin-campaign/1", f"name: {name}", "wheel:", f"  radius: {wheel['radius']:g} m", f"  width: {wheel['width']:g} m"]
    if wheel["lug_height"]:
        lines.append(f"  lugs: {{height: {wheel['lug_height'] * 1e3:.4g} mm, count: {wheel['lug_count']}}}")
    if wheel["inflation"]:
        lines.append(f"  inflation_pressure: {wheel['inflation'] / 1e3:g} kPa")
    lines.append("soil:")
    units = {"exponent": (1.0, ""), "k_c": (1e-3, " kN/m^(n+1)"), "k_phi": (1e-3, " kN/m^(n+2)"), "cohesion": (1e-3, " kPa"),
             "friction_angle": (180 / math.pi, " deg"), "shear_modulus": (1e3, " mm"),
             "stress_angle_c1": (1.0, ""), "stress_angle_c2": (1.0, "")}
    for key, (rate, unit) in units.items():
        lines.append(f"  {key}: {{value: {mean[key] * rate:.5g}{unit}, sd: {sd[key] * rate:.3g}{unit}}}")
    lines.append(f"  density: {record['soil']['density']:g} kg/m^3")
    if record["bin"]:
        lines.append(f"bin: {{depth: {record['bin']['depth']:g} m, width: {record['bin']['width']:g} m}}")
    lines += ["model: {effects: []}", "data: runs.csv"]
    if other(record):
        head, unit = {"drawbar_pull": ("Fx_kN", "kN"), "sinkage": ("z_mm", "mm")}[other(record)]
        lines.append(f"columns: {{{head}: {{quantity: {other(record)}, unit: {unit}}}}}")
    lines += [f"force_frame: {record['plan']['force_frame']}", f"slip_by: {record['plan']['slip_by']}"]
    return "\n".join(lines) + "\n"


def write(folder, record):
    """Write campaign.yaml, runs.csv and, beside the campaigns, the hidden sidecar that `--more` reads."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder.parent / ".nature").mkdir(exist_ok=True)
    (folder / "campaign.yaml").write_text(yaml_text(folder.name, record))
    (folder / "runs.csv").write_text(csv_text(record))
    (folder.parent / ".nature" / f"{folder.name}.json").write_text(json.dumps(record, sort_keys=False) + "\n")


def read(folder):
    """A campaign's record from its sidecar."""
    folder = Path(folder)
    return json.loads((folder.parent / ".nature" / f"{folder.name}.json").read_text())


def restore(record):
    """World of a record, with its rows as arrays."""
    rows = {k: v if k == "setpoint" else np.array(v, float) for k, v in record["rows"].items()}
    return sensitivity.World(rows=rows, **{k: record[k] for k in ("wheel", "soil", "sd", "plan", "scale", "noise", "levels", "bin")})


def default(record, name):
    """The condition that a run has where none is asked for: flat, straight, first pass, the middle level."""
    if name in ANGLES:
        return 0.0
    levels = sorted(record["levels"][name])
    return 1.0 if name == "pass" else levels[len(levels) // 2]


def more(folder, condition, runs):
    """Append `runs` runs at a condition {column: value in the file's units}; other conditions take their default.

    Deterministic: the n-th call on a campaign draws from the campaign's seed and n. A condition that the file has no
    column for gets one. Returns the indices of the new rows.
    """
    record = read(folder)
    names = {**{c: n for n, c in COLUMNS.items()}, **{n: n for n in COLUMNS}}
    wanted = {}
    for key, value in condition.items():
        if names.get(key, "run") in ("run", "setpoint"):
            raise ValueError(f"no condition '{key}'; known: {', '.join(c for n, c in COLUMNS.items() if n not in ('run', 'setpoint'))}")
        wanted[names[key]] = float(value)
    rows, old = record["rows"], len(record["rows"]["load"])
    rng = np.random.default_rng(record["seed"] + [1000 + record["calls"]])
    label = f"M{record['calls'] + 1:02d}"
    last = max(rows["run"])
    for i in range(runs):
        new = {n: wanted.get(n, default(record, n)) for n in ("load", "slip") + design.FACTORS}
        if record["plan"]["jitter"]:
            new["load"] *= 1 + 0.004 * float(rng.normal())
            new["slip"] = min(max(new["slip"] + 0.003 * float(rng.normal()), -1.0), 0.99)
        for n, value in new.items():
            rows[n].append(float(value))
        rows["run"].append(last + 1 + i)
        rows["setpoint"].append(label)
    record["calls"] += 1
    world = restore(record)
    fresh = design.rounded({k: v[old:] for k, v in world.rows.items()}, max(rows["load"][:old]))
    for n in ("load", "slip") + design.FACTORS:
        rows[n][old:] = [float(v) for v in fresh[n]]
    truth = restore(record).truth([build(e) for e in record["effects"]])
    if not truth["ok"][old:].all():
        raise ValueError("the wheel sinks beyond 0.8 r at that condition: no run was made")
    got = noise.sample(rng, record["noise"], {c: truth[c][old:] for c in base.CHANNELS})
    for c in record["read"]:
        record["read"][c] += [float(v) for v in got[c]]
    for n in ("speed", "pass", "position", "moisture") + ANGLES:
        if n in wanted and n not in record["shown"]:
            record["shown"].append(n)
    write(folder, record)
    return list(range(old, old + runs))
