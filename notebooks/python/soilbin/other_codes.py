"""Grains from other programs' material tables: LIGGGHTS (docs/guide/grains-from-other-programs.md)."""
from __future__ import annotations

import re
from pathlib import Path
from typing import Any, Optional, Union

from soilbin._soilbin import ContactPair, GrainFraction, GranularSoil, InputError, RollingResistance, Soil
from soilbin.arguments import worded
from soilbin.questions import tell

# What a contact takes of the pair's matrices, and how often.
PAIRS = {"coefficientRestitution": "restitution", "coefficientFriction": "sliding_friction",
         "coefficientRollingFriction": "rolling_friction", "coefficientRollingViscousDamping": "rolling_damping"}
# k A with A = 2 pi R* delta (to first order in the overlap) and 4 pi R* delta, beside k_c pi R* delta here.
COHESION = {"sjkr": 2.0, "sjkr2": 4.0}
ROLLING = {"epsd": RollingResistance.elastic_plastic, "cdt": RollingResistance.directional}


class Script:
    """The lines of a script as words: comments left out, continued lines joined, variables put in."""

    def __init__(self, text: str, name: str) -> None:
        self.name = name
        self.lines: list[tuple[int, list[str]]] = []
        variables: dict[str, str] = {}
        joined, begin = "", 0
        for number, line in enumerate(text.splitlines(), 1):
            begin = begin if joined else number
            joined += line.split("#")[0].rstrip()
            if joined.endswith("&"):
                joined = joined[:-1] + " "
                continue
            words = re.sub(r"\$\{(\w+)\}", lambda found: variables.get(found[1], found[0]), joined).split()
            joined = ""
            if len(words) == 4 and words[0] == "variable" and words[2] in ("equal", "string", "index"):
                variables[words[1]] = words[3]
            if words:
                self.lines.append((begin, words))

    def refuse(self, line: int, what: str, hint: str) -> InputError:
        return InputError(f"{self.name}:{line}: {what}\n  hint: {hint}")

    def number(self, line: int, word: str) -> float:
        try:
            return float(word)
        except ValueError:
            hint = "the script with numbers in place of formulas"
            raise self.refuse(line, f"expected a number, not '{word}'", hint) from None


def values_of_types(script: Script) -> dict[str, tuple[int, int, list[float]]]:
    """The properties of types and pairs by name: line, columns, values."""
    found: dict[str, tuple[int, int, list[float]]] = {}
    for line, words in script.lines:
        if words[0] != "fix" or words[3:4] != ["property/global"] or len(words) < 7:
            continue
        name, style, rest = words[4], words[5], words[6:]
        if style in ("peratomtype", "atomtype", "vector"):
            found[name] = (line, len(rest), [script.number(line, word) for word in rest])
        elif style in ("peratomtypepair", "atomtypepair", "matrix"):
            types = int(script.number(line, rest[0]))
            numbers = [script.number(line, word) for word in rest[1:]]
            if len(numbers) != types * types:
                raise script.refuse(line, f"{name} has {len(numbers)} values, not {types} x {types}",
                                    "one for each pair of types")
            found[name] = (line, types, numbers)
    return found


def template_of(script: Script, line: int, words: list[str]) -> dict[str, list[str]]:
    """The keywords of a particle template with what follows each."""
    keywords = ("atom_type", "density", "volume_limit", "radius", "relative")
    out: dict[str, list[str]] = {}
    key = ""
    for word in words:
        key = word if word in keywords else key
        out.setdefault(key, [])
        if word != key:
            out[key].append(word)
    return out


def sizes_of(script: Script, grains: int, untold: list[str]) -> dict[str, Any]:
    """Radii or sizes, and the density, of the templates of this type."""
    templates: dict[str, tuple[int, dict[str, list[str]]]] = {}
    weights: dict[str, float] = {}
    for line, words in script.lines:
        if words[0] != "fix" or len(words) < 5:
            continue
        if words[3] == "particletemplate/sphere":
            templates[words[1]] = (line, template_of(script, line, words[5:]))
        elif words[3].startswith("particledistribution/discrete"):
            if words[3].endswith("numberbased"):
                raise script.refuse(line, "a distribution by number", "particledistribution/discrete, which is by mass")
            weights = {name: script.number(line, weight) for name, weight in zip(words[6::2], words[7::2])}
    mine = {name: one for name, one in templates.items()
            if int(float((one[1].get("atom_type") or ["1"])[0])) == grains and (not weights or name in weights)}
    if not mine:
        raise InputError(f"{script.name}: no particletemplate/sphere of type {grains}\n"
                         "  hint: grains=, the atom type of the grains")
    out: dict[str, Any] = {}
    fractions: list[tuple[float, float]] = []
    for name, (line, told) in mine.items():
        density, radius = told.get("density", []), told.get("radius", [])
        if density[:1] != ["constant"] or radius[:1] not in (["constant"], ["uniform"]):
            what = "a template without a constant density and a radius 'constant' or 'uniform number'"
            raise script.refuse(line, what, "density constant 2500 radius constant 0.0015")
        out["grain_density"] = script.number(line, density[1])
        if radius[0] == "uniform":
            if len(mine) > 1 or radius[1] != "number":
                raise script.refuse(line, "a radius that is spread within a fraction or by mass",
                                    "templates of constant radius")
            out["radius_min"], out["radius_max"] = (script.number(line, word) for word in radius[2:4])
            return out
        fractions.append((script.number(line, radius[1]), weights.get(name, 1.0)))
    if len({script.number(line, told["density"][1]) for line, told in mine.values()}) > 1:
        untold.append("the templates have several densities: that of the last one is taken")
    whole = sum(share for _, share in fractions)
    out["sizes"] = [GrainFraction(radius=radius, share=share / whole) for radius, share in sorted(fractions)]
    return out


def laws_of(script: Script, untold: list[str]) -> dict[str, str]:
    """The words behind 'pair_style gran': model, tangential, rolling_friction, cohesion."""
    for line, words in script.lines:
        if words[:2] == ["pair_style", "gran"]:
            laws = dict(zip(words[2::2], words[3::2]))
            if laws.get("model") != "hertz":
                what = f"the normal law is {laws.get('model', 'none')}, and grains here are of Hertz's"
                raise script.refuse(line, what, "a calibration under model hertz")
            if laws.get("tangential") == "no_history":
                untold.append("tangential no_history: here contacts remember their shear")
            for key in ("limitForce", "tangential_damping", "surface", "tangential_reduce"):
                if key in laws and (key, laws[key]) not in (("limitForce", "off"), ("tangential_damping", "on")):
                    untold.append(f"{key} {laws[key]}")
            return laws
    raise InputError(f"{script.name}: no pair_style gran\n  hint: the script that has the contact law")


@worded
def soil_from_liggghts(script: Union[str, Path], *, grains: int = 1, tire: Optional[int] = None) -> Soil:
    """The grains of a LIGGGHTS input script as a soil: write_soil(soil_from_liggghts("in.sand")) is its file.

    script: a path, of an input script in units si with `pair_style gran model hertz`. grains: the atom type of the
    grains. tire: that of the wheel; None: the tire's contact is that of two grains. Taken are the property/global of
    types and of pairs, the particle templates with their distribution by mass, the laws of rolling (epsd, cdt) and
    cohesion (sjkr, sjkr2, to first order in the overlap), and gravity. What is not carried over is warned of
    (SoilbinWarning). Raises InputError with the line for what can't be read or has no counterpart.

        soil = soilbin.soil_from_liggghts("in.sand", grains=1, tire=2)
        Path("sand.yaml").write_text(soilbin.write_soil(soil))
    """
    path = Path(script)
    try:
        read = Script(path.read_text(), str(path))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: can't be read: {error}") from None
    untold: list[str] = []
    if ["units", "si"] not in [words[:2] for _, words in read.lines]:
        raise InputError(f"{path}: the script has no line 'units si'\n  hint: convert it: numbers are taken in SI")
    laws, values = laws_of(read, untold), values_of_types(read)

    def value(name: str, first: int, second: Optional[int] = None) -> float:
        if name not in values:
            raise InputError(f"{path}: no property/global {name}\n  hint: the script that sets the materials")
        line, columns, numbers = values[name]
        if max(first, second or 1) > columns or min(first, second or 1) < 1:
            raise read.refuse(line, f"{name} has {columns} types", "grains= and tire= as numbers of types, from 1")
        return numbers[first - 1 if second is None else (first - 1) * columns + second - 1]

    rolling, cohesion = laws.get("rolling_friction", "off"), laws.get("cohesion", "off")

    def contact(other: int) -> ContactPair:
        told = {key: value(name, grains, other) for name, key in PAIRS.items()
                if not name.startswith("coefficientRolling")}
        told["rolling_friction"] = value("coefficientRollingFriction", grains, other) if rolling != "off" else 0.0
        if rolling == "epsd":
            told["rolling_damping"] = value("coefficientRollingViscousDamping", grains, other)
        if cohesion in COHESION:
            told["cohesion"] = COHESION[cohesion] * value("cohesionEnergyDensity", grains, other)
        return ContactPair(**told)

    if rolling not in ROLLING and rolling != "off":
        untold.append(f"rolling_friction {rolling}: elastic_plastic is taken, without its dashpot's value")
    if cohesion not in COHESION and cohesion != "off":
        untold.append(f"cohesion {cohesion}: none is taken")
    if tire is None:
        untold.append("the contact of grains and tire: that of two grains is taken")
    else:
        untold.append("the tire's own stiffness, which is the rig's")
    more: dict[str, Any] = sizes_of(read, grains, untold)
    for line, words in read.lines:
        if words[0] == "fix" and words[3:4] == ["gravity"] and len(words) > 4:
            more["gravity"] = read.number(line, words[4])
    known = {*PAIRS, "youngsModulus", "poissonsRatio", "cohesionEnergyDensity", "characteristicVelocity"}
    untold += [f"property/global {name}" for name in values if name not in known]
    granular = GranularSoil(youngs_modulus=value("youngsModulus", grains), poisson_ratio=value("poissonsRatio", grains),
                            rolling_resistance=ROLLING.get(rolling, RollingResistance.elastic_plastic),
                            grain_grain=contact(grains), grain_tire=contact(tire or grains), **more)
    if untold:
        tell([f"{path.name}: not carried over: " + one for one in untold])
    return Soil(name=path.name.removeprefix("in."), granular=granular, source=f"LIGGGHTS script {path.name}")
