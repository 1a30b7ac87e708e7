"""Which campaigns a set holds, and their truth: `tune` and `report` draw from seed streams that never meet."""
import json
from pathlib import Path

import numpy as np

from . import campaign, sensitivity
from .families import catalogue, instruments, unknown

STREAMS = {"tune": 1, "report": 2, "check": 3}
KINDS = ("null_rich", "one_rich", "one_poor", "two", "one_rich", "unknown", "null_poor", "one_rich", "one_poor", "outliers",
         "null_rich", "one_rich", "one_poor", "one_rich", "two", "null_poor", "one_poor", "unknown", "one_rich", "null_rich")
ALONE = (*sorted(set(KINDS)), "instrument")  # what --only takes
TRIES = 20


def ratio_range(kind):
    """Wanted size against the minimal detectable one [-], low and high."""
    return {"two": (2.0, 6.0), "unknown": (1.6, 5.0)}.get(kind, (1.6, 6.0))


def pick(rng, options):
    """One of a list."""
    return options[int(rng.integers(len(options)))]


def record_of(form):
    """A form as the sidecar keeps it."""
    return {"id": form.ID, "form": form.NAME, "a": form.a, "shape": form.shape}


def draw_form(world, rng, kind, wanted, measure=sensitivity.ratio):
    """A form of class `kind` of about the wanted size in this world, and its change; (None, None) where it fails."""
    sign = -1.0 if kind.SIGNED and rng.random() < 0.5 else 1.0
    return sensitivity.size(world, kind, kind.draw(rng, world.scale), sign, wanted, measure)


def no_trace(world, found):
    """Ids whose every form, scaled up to its largest, stays far under the detectable size (noncentrality < 4)."""
    out = []
    for name, changes in found.items():
        top = max([k.LARGEST / (0.5 * k.TYPICAL) for k in catalogue()[name]])
        if all(float(d @ d) * top ** 2 < 4.0 for d in changes):
            out.append(name)
    return out


def sized(world, rng, kind, wanted):
    """A form whose ratio, by a non-linear refit of the soil, is about `wanted`; None where that is out of reach."""
    form = draw_form(world, rng, kind, wanted)[0]
    for _ in range(4):
        if form is None or sensitivity.change(world, [form]) is None:
            return None
        got = np.sqrt(sensitivity.refit(world, [form]) / sensitivity.DETECTABLE)
        if abs(got / wanted - 1) < 0.15 or (got < wanted and abs(form.a) >= 0.999 * kind.LARGEST):
            break
        a = min(abs(form.a) * float(np.clip(wanted / max(got, 1e-9), 0.3, 3.0)), kind.LARGEST)
        form = kind(np.sign(form.a) * a, form.shape)
    return form


def refit_ratios(world, forms):
    """Ratio of each effect: what is left of all of them once the soil and the other one are fitted (non-linear)."""
    others = [next((g for g in forms if g is not f), None) for f in forms]
    return [float(np.sqrt(sensitivity.refit(world, forms, other) / sensitivity.DETECTABLE)) for other in others]


def attempt_known(rng, kind, ids, rich, runs):
    """World, forms, total change, ratio of each; None where these draws give no fair campaign."""
    kinds = [pick(rng, instruments() if kind == "instrument" else catalogue()[name]) for name in ids]
    needs = {need for k in kinds for need in k.NEEDS}
    world = campaign.draw_world(rng, needs, rich, runs)
    if world is None or not all(campaign.usable(world, k) for k in kinds):
        return None
    low, high = ratio_range(kind)
    forms = [sized(world, rng, k, float(np.exp(rng.uniform(np.log(low), np.log(high))))) for k in kinds]
    total = None if any(f is None for f in forms) else sensitivity.change(world, forms)
    if total is None:
        return None
    ratios = refit_ratios(world, forms)
    if ids and not (min(ratios) >= 1.5 and max(ratios) <= 6.5):
        return None
    if len(ids) == 1 and not 0.5 <= sensitivity.ratio(total) / ratios[0] <= 2.0:  # too crooked for the linear figures
        return None
    if len(ids) == 2:  # no single id may explain both
        found = sensitivity.families(world, rng, lambda k: campaign.usable(world, k, False))
        if min(sensitivity.leftover(total, span) for span in found.values()) < 1.5 ** 2 * sensitivity.DETECTABLE:
            return None
    return world, forms, total, ratios


def attempt_unknown(rng, rich, runs):
    """The same for an effect outside the catalogue: its size is what neither one family nor two forms can take over."""
    kind = pick(rng, unknown())
    world = campaign.draw_world(rng, set(kind.NEEDS), rich, runs)
    if world is None or not campaign.usable(world, kind):
        return None
    found = sensitivity.families(world, rng, lambda k: campaign.usable(world, k, False))

    def measure(d):
        least = min(min(sensitivity.leftover(d, span) for span in found.values()), sensitivity.beyond_pairs(d, found))
        return float(np.sqrt(max(least, 0.0) / sensitivity.DETECTABLE))

    low, high = ratio_range("unknown")
    form, d = draw_form(world, rng, kind, float(np.exp(rng.uniform(np.log(low), np.log(high)))), measure)
    if form is None or not 1.5 <= measure(d) <= 6.5:
        return None
    whole = np.sqrt(sensitivity.refit(world, [form]) / sensitivity.DETECTABLE)
    return (world, [form], d, [measure(d)]) if measure(d) <= whole * 1.05 <= 12 else None


def draw(set_name, seed, index, kind, ids, runs=None):
    """Record and truth of campaign `index` (from 1); tries until the effects are of the wanted size."""
    rich = {"null_rich": True, "one_rich": True, "null_poor": False, "one_poor": False}.get(kind)
    for attempt in range(TRIES):
        key = [seed, STREAMS[set_name], index, attempt]
        rng = np.random.default_rng(key)
        is_rich = bool(rng.random() < 0.75) if rich is None else rich
        made = attempt_unknown(rng, is_rich, runs) if kind == "unknown" else attempt_known(rng, kind, ids, is_rich, runs)
        if made:
            break
    else:
        return None
    world, forms, total, ratios = made
    record = campaign.measure(world, rng, [record_of(f) for f in forms], kind == "outliers")
    record["seed"] = key
    return record, truth_of(world, rng, record, kind, forms, total, ratios, is_rich)


def truth_of(world, rng, record, kind, forms, total, ratios, rich):
    """The truth.json entry of a campaign."""
    found = sensitivity.families(world, rng, lambda k: campaign.usable(world, k, False))
    ids = [f.ID for f in forms if f.ID]
    limit = sensitivity.DETECTABLE
    alike = {}
    for name, span in found.items():
        rest = sensitivity.leftover(total, span)
        if forms and ids != [name] and rest < limit:
            alike[name] = round(rest, 2)
    sds = np.sqrt(np.einsum("rii->ri", sensitivity.noise.covariance(world.noise, world.base)))
    verdict = "unknown_effect" if kind == "unknown" else "effect_found" if forms else "nothing_missing"
    return {"verdict": verdict, "effects": ids, "kind": kind, "design": "rich" if rich else "poor", "rows": len(sds),
            "forms": [f.NAME for f in forms], "size": [f.a for f in forms],
            "lambda": [round(limit * r * r, 2) for r in ratios],
            "ratio_to_detectable": round(min(ratios), 3) if ratios else 0.0, "ratios": [round(r, 3) for r in ratios],
            "lambda_total": round(float(total @ total), 2),
            "lambda_refit": round(limit * ratios[0] ** 2 if len(ids) == 1 else sensitivity.refit(world, forms), 2) if forms else 0.0,
            "lambda_beyond_pairs": round(sensitivity.beyond_pairs(total, found), 2) if forms else 0.0,
            "alike": alike, "no_trace": no_trace(world, found), "outliers": len(record["outliers"]),
            "vary": record["plan"]["vary"], "channels": record["plan"]["channels"],
            "noise": {c: {"a": float(f"{record['noise']['a'][c]:.4g}"), "b": record["noise"]["b"][c],
                          "median_sd": float(f"{np.median(sds[:, i]):.4g}")}
                      for i, c in enumerate(campaign.MEASURED) if c in record["plan"]["channels"]},
            "correlation": record["noise"]["rho"], "run_level_sd": float(f"{record['noise']['run']:.3g}")}


def wanted_ids(set_name, seed, count, only):
    """(kind, ids) of each campaign: the ids go round the catalogue in a shuffled order, so that each comes as often."""
    rng = np.random.default_rng([seed, STREAMS[set_name], 0])
    names = sorted(catalogue())
    queues = {kind: [] for kind in ALONE}

    def take(kind, avoid=()):
        if not any(n not in avoid for n in queues[kind]):
            queues[kind] += [names[int(i)] for i in rng.permutation(len(names))]
        chosen = next(n for n in queues[kind] if n not in avoid)
        queues[kind].remove(chosen)
        return chosen

    spoilt = 0
    for i in range(count):
        kind = only or KINDS[i % len(KINDS)]
        ids = []
        if kind.startswith("one"):
            ids = [take(kind)]
        elif kind == "instrument":
            ids = ["sensor_offset"]
        elif kind == "two":
            first = take(kind)
            ids = [first, take(kind, (first,))]
        elif kind == "outliers":
            spoilt += 1
            ids = [take(kind)] if spoilt % 2 else []
        yield kind, ids


def generate(set_name, seed, count, out, only=None, say=lambda text: None, runs=None):
    """Write a set of campaigns c001.. and truth.json into `out`; a campaign whose ids find no fair design takes the next id."""
    out = Path(out)
    truth, names = {}, sorted(catalogue())
    for i, (kind, ids) in enumerate(wanted_ids(set_name, seed, count, only), start=1):
        name, made = f"c{i:03d}", None
        for _ in range(5):
            made = draw(set_name, seed, i, kind, ids, runs)
            if made:
                break
            say(f"{name}: no fair design for {kind} {ids}")
            if kind == "instrument":
                continue
            ids = [names[(names.index(n) + 1 + j) % len(names)] for j, n in enumerate(ids)]
            ids = ids if len(set(ids)) == len(ids) else [ids[0], names[(names.index(ids[0]) + 3) % len(names)]]
        if made is None:
            raise RuntimeError(f"{name}: no campaign of kind {kind}")
        record, truth[name] = made
        campaign.write(out / name, record)
        say(f"{name} {kind} {truth[name]['effects']} {truth[name]['forms']} ratio {truth[name]['ratio_to_detectable']}")
    (out / "truth.json").write_text(json.dumps(truth, indent=1) + "\n")
    return truth
