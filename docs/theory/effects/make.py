"""Writes docs/theory/effects.md, the catalogue of effects with formulas, from what the command says of it.

    /usr/bin/python3 docs/theory/effects/make.py SOILBIN [--check]     --check: fails where the page is not what it would write
"""
import json
import math
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
DOCS, PAGE = HERE.parents[1], HERE.with_suffix(".md")
GREEK = {"theta", "lambda", "sigma", "tau", "gamma", "phi", "psi", "mu", "kappa", "alpha", "beta", "delta", "pi"}
FUNCTIONS = {"sin", "cos", "tan", "cot", "exp", "ln", "max", "min"}
QUANTITIES = {"pass", "density"}  # words that are factors of a formula
NAMED = {"acos": "arccos", "acot": "arccot", "atan": "arctan", "log10": "log_{10}"}
PER_SI = {"deg": (180 / math.pi, "deg"), "mm": (1e3, "mm"), "kPa": (1e-3, "kPa"), "m/s": (1.0, "m/s"), "m": (1.0, "m"),
          "N": (1.0, "N"), "N m": (1.0, "N m"), "%": (100.0, "%"), "kN": (1e-3, "kN"), "1/kPa": (1e3, "1/kPa")}
HEAD = """# The effects and their formulas

Which physical causes can be switched on beyond the wheel of Wong and Reece, and by which equations? This page lists all
of them. It is written by [make.py](effects/make.py) from what `soilbin list effects --json` says, and a test holds it to
that. What trace each effect leaves in measurements: [effects.md]({effects}) and
[effects-bed-and-measurement.md]({bed}).

- An effect may have several **forms**, one equation each. The first is the default.
- **Source**, behind the equation: *published* is the author's own equation; *after* a source has its shape, as others
  quote it; *ours* is stated here for the first time. They count {counts}.
- Parameters: name = default (range). With the first one at 0 the form is the base model, to the bit.
- Sketches, not to scale: the soil is brown, what the effect adds orange ([sketches.py](effects/sketches.py)).
- Symbols: [the list](symbols.md). A subscript 0 is the value without the effect, $z_b$ the sinkage of the balance, $d$
  in drift and gradient the distance from a reference run or place, $L$ its logarithm,
  $N_\\varphi = \\tan^2(\\pi/4 + \\varphi/2)$; of bulldozing $l_0 = z/N_\\varphi$,
  $K_c = (N_c - \\tan\\varphi)\\cos^2\\varphi$, $K_\\gamma = (2 N_\\gamma/\\tan\\varphi + 1)\\cos^2\\varphi$, with Terzaghi's $N_c$ and
  $N_q$, and the fit $N_\\gamma = 2\\,(N_q + 1)\\tan\\varphi/(1 + 0.4\\sin 4\\varphi)$.
"""


def symbol(name):
    """A name of an equation in TeX; None for a word."""
    if name in GREEK:
        return r"\varphi" if name == "phi" else "\\" + name
    if name == "al":  # Bekker's entry angle
        return r"\alpha_e"
    if name in FUNCTIONS:
        return "\\" + name
    if name in NAMED:
        return r"\operatorname{%s}" % NAMED[name].replace("_{10}", "") + ("_{10}" if name == "log10" else "")
    if name == "Int":
        return r"\int"
    if re.fullmatch(r"[A-Za-z]", name):
        return name
    if match := re.fullmatch(r"([A-Za-z])(\d)", name):
        return f"{match[1]}_{match[2]}"
    if "_" in name and (base := symbol(name.split("_")[0])):
        below = name.split("_", 1)[1]
        return f"{base}_{{{symbol(below) or (below if below.isdigit() else chr(92) + 'text{' + below + '}')}}}"
    return None


def closing(text, start):
    """Place of the bracket that closes the one at start."""
    depth = 0
    for place in range(start, len(text)):
        depth += (text[place] == "(") - (text[place] == ")")
        if depth == 0:
            return place
    raise ValueError(f"a bracket that doesn't close: {text}")


def braced(text, opener, with_):
    """OPENER(...) as WITH_{...}."""
    while (at := text.find(opener)) >= 0:
        end = closing(text, at + len(opener) - 1)
        text = f"{text[:at]}{with_}{{{text[at + len(opener):end]}}}{text[end + 1:]}"
    return text


def tex(equation):
    """An equation of the catalogue: formulas in TeX, words as words."""
    text = equation.replace("{", "⦃").replace("}", "⦄")
    text = re.sub(r"\|([^|]+)\|", r"⟨\1⟩", text)                           # absolute values
    if (at := text.find(" (driven ")) >= 0:
        end = closing(text, at + 1)
        text = f"{text[:at]}, driven {text[at + 9:end]}{text[end + 1:]}"
    text = re.sub(r"\b(a|an) (?=(lug|line|third|run|tilt)\b)", r"\1~", text)  # the article, not the amplitude
    text = re.sub(r"\(1 (kN|m/s)\)", lambda m: f"(1~{m[1]})", text)
    text = text.replace("<=", "≤").replace("->", "→")
    text = braced(braced(text, "sqrt(", "§sqrt"), "^(", "^")
    said, formula, depth = [], [], 0

    def close():
        if formula:
            said.append(f"${re.sub(' +', ' ', ' '.join(formula)).strip()}$")
            formula.clear()

    for token in re.findall(r"§sqrt|\d~[A-Za-z/]+|[A-Za-z][\w']*(?:~[A-Za-z/]+)?|\d+(?:\.\d+)?|\S", text):
        made = None if "~" in token else symbol(token) if re.match(r"[A-Za-z]", token) else token
        depth += (token in "([{") - (token in ")]}")
        if made is None and (depth or token in QUANTITIES):
            formula.append(r"\text{%s}" % token.replace("~", r" "))
        elif made is None:
            close()
            said.append(token.replace("~", " "))
        elif token in ",;:" and not depth:
            close()
            said[-1] += token
        else:
            formula.append({"§sqrt": r"\sqrt", "⟨": r"\lvert ", "⟩": r"\rvert ", "⦃": r"\{", "⦄": r"\}", "≤": r"\le ", "→": r"\to "}.get(made, made))
    close()
    return " ".join(said)


def amount(value, unit):
    rate, name = PER_SI.get(unit, (1.0, unit))
    return f"{value * rate:.4g}" + ("" if name == "-" else f" {name}")


def page(catalogue):
    relative = lambda name: Path(*[".."] * 1, next(DOCS.rglob(name)).relative_to(DOCS)).as_posix()
    said = {}  # what an effect is, by the headings of the reference
    for name in ("effects.md", "effects-bed-and-measurement.md"):
        said |= dict(re.findall(r"^## (\w+): (.+)$", (DOCS / "reference" / name).read_text(encoding="utf-8"), flags=re.M))
    counts = ", ".join(f"{sum(form['provenance'] == whose for form in catalogue)} {name}"
                       for whose, name in (("published", "published"), ("after a source", "after a source"), ("ours", "ours")))
    lines = [HEAD.format(effects=relative("effects-bed-and-measurement.md").replace("effects-bed-and-measurement", "effects"),
                         bed=relative("effects-bed-and-measurement.md"), counts=counts)]
    last = None
    for form in catalogue:
        if form["id"] != last:
            last = form["id"]
            lines += ["", f"## {last.replace('_', ' ')}", "", f"`{last}`: {said.get(last, '')}."]
            if (HERE / f"{last}.svg").is_file():
                lines += ["", f"![{last.replace('_', ' ')}, a sketch](effects/{last}.svg)"]
        source = ("published: " if form["provenance"] == "published" else "") + form["source"].replace("stated", "ours", 1)
        lines += ["", f"**{form['form']}**: {tex(form['equation'])}. {source[0].upper()}{source[1:]}."]
        lines += [f"- `{p['name']}` = {amount(p['default'], p['unit'])} ({amount(p['lower'], p['unit'])} .. {amount(p['upper'], p['unit'])}): "
                  f"{p['meaning']}" for p in form["parameters"]]
    return "\n".join(lines) + "\n"


def main():
    listed = subprocess.run([sys.argv[1], "list", "effects", "--json"], check=True, stdout=subprocess.PIPE, text=True).stdout
    made = page(json.loads(listed)["effects"])
    if "--check" in sys.argv:
        if PAGE.read_text(encoding="utf-8") != made:
            sys.exit(f"{PAGE} is not what the command says: make it anew by {Path(__file__).name}")
        return
    PAGE.write_text(made, encoding="utf-8")


if __name__ == "__main__":
    main()
