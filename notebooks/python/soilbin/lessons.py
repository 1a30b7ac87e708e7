"""What the notebooks share: exercises that check themselves, sliders, where the measured tables lie."""
from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, Optional

from soilbin._soilbin import InputError, cases_folders

__all__ = ["check", "is_right", "slider", "table"]


def is_right(answer: float, right: float, within: float = 0.02) -> bool:
    """Whether an answer is the right one, to a share `within` of it; prints nothing.

    By this a solution tests itself. Raises TypeError where the answer is not one number.
    """
    return abs(_number(answer) - right) <= within * abs(right)


def check(answer: Optional[float], right: float, within: float = 0.02, hint: str = "") -> Optional[bool]:
    """Says whether an exercise's answer is right, to a share `within` of the right one.

    None, with a word, where there is no answer yet; else whether it is right. The hint is shown for a wrong one. An answer
    that is not one number, such as the text '172,2', is told how to write it, and is not right. Stands in the folded cell
    below the exercise, so that the question shows neither the right number nor the way to it.
    """
    if answer is None:
        print("No answer yet.")
        return None
    try:
        number = _number(answer)
    except TypeError as wrong:
        print(f"Not yet: {wrong}.")
        return False
    correct = is_right(number, right, within)
    if correct:
        print(f"Right: {right:.4g}.")
    else:
        far = "far off" if right == 0 or not 0.5 < number / right < 2 else "close"
        print(f"Not yet: {number:.4g} is {far}." + (f" {hint}" if hint else ""))
    return correct


def _number(answer: Any) -> float:
    """An answer as a number. Raises TypeError that says how to write one."""
    how = "write one number, without quotes and with a decimal point, such as 172.2"
    if isinstance(answer, (str, tuple)):  # 172,2 is a pair to Python
        kind = "a text" if isinstance(answer, str) else "several numbers"
        raise TypeError(f"{answer!r} is {kind}; {how}")
    try:
        return float(answer)
    except (TypeError, ValueError):
        raise TypeError(f"an answer of the type {type(answer).__name__} is not a number; {how}") from None


def slider(draw: Callable[..., object], **ranges: tuple[float, float, float]) -> None:
    """Draws once, with a slider for each argument where ipywidgets is there. A range is (lowest, highest, at first).

    With SOILBIN_STILL set, as for exported pages, or without ipywidgets it draws what the sliders show at first.
    """
    first = {name: start for name, (_, _, start) in ranges.items()}
    try:
        if os.environ.get("SOILBIN_STILL"):
            raise ImportError
        import ipywidgets
    except ImportError:
        draw(**first)
        return
    widgets: Any = {name: ipywidgets.FloatSlider(min=low, max=high, value=start, step=(high - low) / 50,
                                                 continuous_update=False)
                    for name, (low, high, start) in ranges.items()}
    ipywidgets.interact(draw, **widgets)


def table(name: str) -> Path:
    """A file of the library of cases, such as 'measured/plates/grc1-plates.csv'. Raises InputError."""
    for folder in cases_folders():
        if (Path(folder) / name).is_file():
            return Path(folder) / name
    raise InputError(f"no {name} in {', '.join(map(str, cases_folders()))}")
