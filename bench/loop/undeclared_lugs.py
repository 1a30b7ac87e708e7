"""A lugged wheel whose lugs nobody declares: does the loop list lug_thrust among what could be missing? (CMU wheels.)

Two wheels ran in the same sand, one smooth, one with lugs. The loop reads the lugged wheel's runs without its lugs:

    declared   with the soil as declared, nothing known of the sand but what the laboratory says
    soil       with the soil that the loop fitted to the smooth wheel, and its standard errors
    wheel      with that soil and the effects that stand in on the smooth wheel, so that the lugs alone are new

    /usr/bin/python3 bench/loop/undeclared_lugs.py            a minute or two a line
"""
import argparse
import json
import re
import subprocess
import tempfile
from pathlib import Path

MEASURED = Path(__file__).resolve().parents[2] / "cases" / "measured"


def block(lines, first, indent):
    """Lines below the one that starts with `first`, as long as they are indented by more than `indent`, moved left."""
    start = next(i for i, line in enumerate(lines) if line.strip().startswith(first)) + 1
    out = []
    for line in lines[start:]:
        if len(line) - len(line.lstrip()) <= indent:
            break
        out.append(line[indent + 2:])
    return out


def without_learned(effects):
    """The list of effects without one that has no name."""
    kept, keep = [], True
    for line in effects:
        if line.startswith("- id:"):
            keep = "learned" not in line
        if keep:
            kept.append(line)
    return kept


def campaigns(model, folder):
    """The three readings as campaigns, from the smooth wheel's saved model."""
    lines = model.read_text().splitlines()
    soil = block(lines, "semi_empirical:", 2)
    effects = without_learned(block(lines, "effects:", 6))
    bare = re.sub(r"\n  lugs:.*", "", (MEASURED / "cmu-grousered" / "campaign.yaml").read_text())
    known = re.sub(r"soil:\n(  .*\n)+", "soil:\n" + "".join(f"  {line}\n" for line in soil), bare)
    with_effects = known.replace("model: {effects: []}", "model:\n  effects:\n" + "\n".join(f"    {line}" for line in effects))
    for name, text in (("declared", bare), ("soil", known), ("wheel", with_effects)):
        (folder / name).mkdir()
        (folder / name / "campaign.yaml").write_text(re.sub(r"name: cmu-grousered", f"name: lugs-{name}", text))
        (folder / name / "runs.csv").write_text((MEASURED / "cmu-grousered" / "runs.csv").read_text())
        yield name, folder / name


def main():
    """Prints each reading's list of candidates."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--soilbin", default="build/release/soilbin")
    parser.add_argument("--model", type=Path, help="saved by: soilbin loop cmu-smooth --save-model FILE; else made here")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        model = options.model or Path(folder) / "smooth.yaml"
        if not options.model:
            subprocess.run([options.soilbin, "loop", str(MEASURED / "cmu-smooth"), "--save-model", str(model)], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for name, campaign in campaigns(model, Path(folder)):
            done = subprocess.run([options.soilbin, "loop", str(campaign), "--json", "--folds", "2"], check=True,
                                  capture_output=True, text=True)
            found = json.loads(done.stdout)
            sets = "; ".join(f"{' + '.join(s['effects'])} {s['weight']:.2f}" for s in found["ambiguity_set"])
            listed = any("lug_thrust" in s["effects"] for s in found["ambiguity_set"])
            print(f"{name:9} {found['verdict']}; lug_thrust {'listed' if listed else 'not listed'}; {sets}", flush=True)


if __name__ == "__main__":
    main()
