"""A wrong argument in words: which one it is, what is expected there and what was given.

pybind11 answers with the C++ signatures that it tried. Where a function of the extension refuses its arguments, what its
docstring says of them is compared with what was given; a function of the package is compared by its annotations.
"""
from __future__ import annotations

import functools
import inspect
import numbers
import os
from collections.abc import Callable, Sequence
from typing import Any, Optional, TypeVar

from soilbin import _soilbin

Function = TypeVar("Function", bound=Callable[..., Any])

# How annotations and pybind11's docstrings call what is no class of soilbin: in words, and what is taken.
PLAIN: dict[str, tuple[str, Any]] = {
    "None": ("None", type(None)),
    "str": ("a text", str),
    "float": ("a number", numbers.Real),
    "int": ("a whole number", numbers.Integral),
    "bool": ("True or False", bool),
    "dict": ("a dictionary", dict),
    "Path": ("a path", (str, os.PathLike)),
    "os.PathLike": ("a path", (str, os.PathLike)),
}
LISTS = ("List[", "Sequence[", "Iterable[", "Set[", "list[", "set[")


def parts(text: str) -> list[str]:
    """A text at its top-level commas."""
    out, depth = [""], 0
    for letter in text:
        depth += (letter in "[(<{") - (letter in "])>}")
        if letter == "," and depth == 0:
            out.append("")
        else:
            out[-1] += letter
    return [part.strip() for part in out if part.strip()]


def inside(kind: str) -> list[str]:
    """What stands in the brackets of a kind."""
    return parts(kind[kind.index("[") + 1:-1])


def class_of(kind: str) -> Any:
    if kind == "pd.DataFrame":
        import pandas
        return pandas.DataFrame
    return getattr(_soilbin, kind.removeprefix("soilbin._soilbin."), None)


def takes(kind: str, value: Any) -> bool:
    """Whether a value is of a kind; of kinds that are not known here it is."""
    if kind.startswith("Optional["):
        return value is None or takes(inside(kind)[0], value)
    if kind.startswith("Union["):
        return any(takes(one, value) for one in inside(kind))
    if kind.startswith(LISTS):
        if isinstance(value, (str, bytes)) or not hasattr(value, "__iter__"):
            return False
        return not isinstance(value, (list, tuple)) or all(takes(inside(kind)[0], one) for one in value)
    if kind.startswith(("Dict[", "dict[")):
        return isinstance(value, dict)
    if kind in PLAIN:
        return isinstance(value, PLAIN[kind][1]) or (kind == "float" and hasattr(value, "__float__"))
    known = class_of(kind)
    if not inspect.isclass(known):
        return True
    return isinstance(value, known) or (known is _soilbin.Estimate and isinstance(value, numbers.Real))


def in_words(kind: str) -> str:
    if kind.startswith("Optional["):
        return in_words(inside(kind)[0]) + " or None"
    if kind.startswith("Union["):
        return " or ".join(in_words(one) for one in inside(kind))
    if kind.startswith(LISTS):
        inner = inside(kind)[0]
        if inner.startswith("Union["):
            return "a list of them"
        return f"a list of {inner.rpartition('.')[2] if inner not in PLAIN else PLAIN[inner][0].removeprefix('a ') + 's'}"
    if kind.startswith(("Dict[", "dict[")):
        return "a dictionary"
    if kind in PLAIN:
        return PLAIN[kind][0]
    name = kind.rpartition(".")[2]
    return f"a{'n' if name[:1] in 'AEIO' else ''} {name}"


class Parameter:
    def __init__(self, text: str) -> None:
        name, _, rest = text.partition(":")
        kind, has_default, default = rest.partition(" = ")
        self.name, self.kind, self.required = name.strip(), kind.strip(), not has_default
        if default == "None" and not self.kind.startswith("Optional["):
            self.kind = f"Optional[{self.kind}]"


def parameters_of(function: Callable[..., Any]) -> Optional[list[Parameter]]:
    """By the docstring of a function of the extension; none where it has several signatures."""
    signature = (function.__doc__ or "").partition("\n")[0]
    inner = signature.partition("(")[2].rpartition(") -> ")[0]
    if ") -> " not in signature:
        return None
    return [Parameter(text) for text in parts(inner)]


def annotated(function: Callable[..., Any]) -> list[Parameter]:
    found = []
    for parameter in inspect.signature(function).parameters.values():
        has_default = parameter.default is not inspect.Parameter.empty
        stars = "**" if parameter.kind is inspect.Parameter.VAR_KEYWORD else ""
        found.append(Parameter(f"{stars}{parameter.name}: {parameter.annotation}{' = ...' if has_default else ''}"))
    return found


def what_is_wrong(name: str, known: Sequence[Parameter], given: Sequence[Any], named: dict[str, Any]) -> Optional[str]:
    """In words; none where nothing is found to be. Keywords that `**` takes are left to the function."""
    any_keyword = any(one.name.startswith("**") for one in known)
    known = [one for one in known if not one.name.startswith("*")]
    names = ", ".join(one.name for one in known) or "no arguments"
    if len(given) > len(known):
        return f"{name}() takes {names}; {len(given)} arguments were given"
    for key in named:
        if not any_keyword and key not in [one.name for one in known]:
            return f"{name}() takes {names}, not '{key}'"
    told = {one.name: value for one, value in zip(known, given)} | named
    for one in known:
        if one.required and one.name not in told:
            return f"{name}(): missing argument '{one.name}': {in_words(one.kind)}"
        if one.name in told and not takes(one.kind, told[one.name]):
            return f"{name}(): {one.name}: expected {in_words(one.kind)}, not {told[one.name]!r}"
    return None


def worded(function: Function, known: Optional[Sequence[Parameter]] = None) -> Function:
    """The function, whose wrong arguments are told in words."""
    parameters = annotated(function) if known is None else known

    @functools.wraps(function)
    def asked(*given: Any, **named: Any) -> Any:
        try:
            return function(*given, **named)
        except (TypeError, AttributeError) as error:
            wrong = what_is_wrong(function.__name__, parameters, given, named)
            if wrong is None:
                raise
            raise TypeError(wrong) from (error if known is None else None)

    return asked  # type: ignore[return-value]


def worded_method(method: Any, name: str, known: Sequence[Parameter]) -> Any:
    """As worded, of a method or constructor: its first parameter is the object itself."""
    @functools.wraps(method)
    def asked(self: Any, *given: Any, **named: Any) -> Any:
        try:
            return method(self, *given, **named)
        except TypeError:
            wrong = what_is_wrong(name, known[1:], given, named)
            if wrong is None:
                raise
            raise TypeError(wrong) from None

    return asked


def word_the_extension() -> None:
    """Once, before anything takes a function from the extension."""
    for name, function in list(vars(_soilbin).items()):
        if inspect.isbuiltin(function) and not name.startswith("__"):
            known = parameters_of(function)
            if known is not None:
                setattr(_soilbin, name, worded(function, known))
    for class_name, known_class in list(vars(_soilbin).items()):
        if not inspect.isclass(known_class):
            continue
        for name, method in list(vars(known_class).items()):
            known = parameters_of(method) if type(method).__name__ == "instancemethod" else None
            if known and known[0].name == "self" and (name == "__init__" or not name.startswith("_")):
                setattr(known_class, name, worded_method(method, class_name if name == "__init__" else name, known))


word_the_extension()
