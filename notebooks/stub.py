"""Writes the type stub of soilbin._soilbin from the signatures and docstrings that the extension carries.

The build writes it into build/release/python/soilbin/_soilbin.pyi (notebooks/CMakeLists.txt).
"""
import enum
import inspect
import keyword
import re
import textwrap

import soilbin._soilbin as module

HEAD = '''"""soilbin's C++ floors; made by notebooks/stub.py. SI and radians throughout."""
from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import ClassVar, Optional, Union

from numpy import float64
from numpy.typing import NDArray

Array = NDArray[float64]
Told = Callable[[float, str], object]
'''

# What pybind11 can't say: what a dictionary or an object is.
SAID_BETTER = {
    "samples": "dict[str, Array]", "nodes": "dict[str, Array]", "patch": "dict[str, Array]", "curve": "dict[str, Array]",
    "profile": "dict[str, Array]", "budget": "dict[str, float]", "budget_rest": "dict[str, float]",
    "held_out": "dict[str, dict[str, float]]",
    "left_out": "dict[str, dict[str, Array]]",
}


def spelled(text):
    """A type of pybind11's docstrings as Python spells it."""
    text = text.replace("soilbin._soilbin.", "").replace("os.PathLike", "Path")
    text = re.sub(r"numpy\.ndarray(\[[^]]*\])?", "Array", text)
    for old, new in (("List", "list"), ("Dict", "dict"), ("Set", "set"), ("Tuple", "tuple")):
        text = re.sub(rf"\b{old}\[", new + "[", text)
    return text


def taken(text):
    """The same for an argument: a number does where an Estimate or an array is asked for, any sequence for a list."""
    text = spelled(text)
    text = re.sub(r"\bEstimate\b", "Union[Estimate, float]", text)
    text = re.sub(r"\bArray\b", "Union[Array, Sequence[float]]", text)
    text = re.sub(r"\blist\[", "Sequence[", text)
    text = re.sub(r"Annotated\[Sequence\[float\], FixedSize\(3\)\]|Sequence\[float\[3\]\]", "Sequence[float]", text)
    return text.replace("Path", "Union[str, PathLike[str]]")


def split(arguments):
    """Arguments at their top-level commas."""
    out, depth = [""], 0
    for letter in arguments:
        depth += (letter in "[(<") - (letter in "])>")
        if letter == "," and depth == 0:
            out.append("")
        else:
            out[-1] += letter
    return [part.strip() for part in out if part.strip()]


def argument(text):
    if text.startswith("**"):
        return "**parameters: float"
    name, _, rest = text.partition(":")
    if not rest:
        return name
    kind, equals, default = rest.partition(" = ")
    kind = taken(kind.strip())
    if name == "progress":
        kind = "Optional[Told]"
    elif default == "None" and not kind.startswith("Optional"):
        kind = f"Optional[{kind}]"
    return f"{name}: {kind}{' = ...' if equals else ''}"


def documented(doc, indent):
    text = doc.strip()
    if not text:
        return " ..."
    listing = "\n  " in text  # lines of its own
    lines = text.split("\n") if listing else textwrap.wrap(text.replace("\n", " "), 118 - indent)
    if len(lines) == 1 and len(lines[0]) < 110 - indent:
        return f'\n{" " * indent}"""{lines[0]}"""'
    body = "\n".join(" " * indent + line for line in lines)
    return f'\n{" " * indent}"""{body.strip()}\n{" " * indent}"""'


def function(name, doc, indent, owner=None):
    signature, _, rest = (doc or "").partition("\n")
    inner, _, gives = signature[len(name) + 1:].rpartition(") -> ")
    arguments = split(inner)
    if owner is not None:
        arguments[0] = "self"
    arguments = [arguments[0] if i == 0 and owner else argument(a) for i, a in enumerate(arguments)]
    if name in ("__init__", "replace") and arguments[-1] == "**parameters: float" and len(arguments) == 2:
        arguments = ["self", "*", *keywords(owner, all_optional=name == "replace")]
    gives = "None" if name == "__init__" else spelled(gives)
    return f"{' ' * indent}def {name}({', '.join(arguments)}) -> {gives}:{documented(rest, indent + 4)}\n"


def keywords(owner, all_optional):
    required = required_of(owner)
    return [f"{name}: {taken(kind)}{'' if name in required and not all_optional else ' = ...'}"
            for name, kind, _, settable in properties(owner) if settable and not keyword.iskeyword(name)]


def required_of(owner):
    """The keywords that a constructor asks for, found by leaving them out."""
    given, names = {}, []
    while True:
        try:
            owner(**given)
            return names
        except TypeError as error:
            missing = re.search(r"missing keyword argument '(\w+)'", str(error))
            if not missing:
                return names
            names.append(missing[1])
            given[missing[1]] = None
        except ValueError:
            return names


def properties(owner):
    for name, value in owner.__dict__.items():
        if isinstance(value, property):
            doc = value.fget.__doc__ or ""
            signature, _, rest = doc.partition("\n")
            kind = spelled(signature.rpartition(" -> ")[2])
            if kind in ("dict", "object") or name in SAID_BETTER:
                kind = SAID_BETTER.get(name, kind)
            yield name, kind, value.__doc__ or rest, value.fset is not None


def enumeration(name, cls):
    words = "".join(f"    {word}: ClassVar[{name}]\n" for word in cls.__members__)
    words += f"    __members__: ClassVar[dict[str, {name}]]\n"
    return (f"class {name}:{documented(cls.__doc__.split('Members:')[0], 4)}\n{words}"
            f"    def __init__(self, value: int) -> None: ...\n    def __int__(self) -> int: ...\n"
            f"    @property\n    def name(self) -> str: ...\n    @property\n    def value(self) -> int: ...\n")


def klass(name, cls):
    if hasattr(cls, "__members__"):
        return enumeration(name, cls)
    base = cls.__mro__[1].__name__
    out = f"class {name}{'' if base == 'pybind11_object' else f'({base})'}:{documented(cls.__doc__ or '', 4)}\n"
    if name == "InputError":
        return out + "    file: Optional[str]\n    line: Optional[int]\n    column: Optional[int]\n"
    for member, kind, doc, settable in properties(cls):
        if keyword.iskeyword(member):
            continue  # `pass`: by getattr and replace(**{"pass": 2})
        out += f"    @property\n    def {member}(self) -> {kind}:{documented(doc, 8)}\n"
        if settable:
            out += f"    @{member}.setter\n    def {member}(self, value: {kind}) -> None: ...\n"
    for member, value in cls.__dict__.items():
        if inspect.isroutine(value) and (member in ("__init__", "__float__") or not member.startswith("_")):
            doc = value.__doc__ or ""
            if doc.startswith(member + "("):
                out += function(member, doc, 4, cls)
    return out if out.count("\n") > 1 or "def" in out or out.rstrip().endswith('"""') else out + "    ...\n"


def main():
    print(HEAD)
    print("__version__: str\n")
    for name, value in module.__dict__.items():
        if inspect.isclass(value):
            print(klass(name, value))
        elif inspect.isroutine(value) and not name.startswith("__"):
            print(function(name, value.__doc__, 0))


if __name__ == "__main__":
    main()
