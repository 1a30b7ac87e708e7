"""What the notebooks share: exercises that check themselves, sliders, where the measured tables lie."""
from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, Optional

from soilbin._soilbin import InputError, cases_folders

__all__ = ["check", "slider", "table"]


def check(answer: Optional[float], right: float, within: float = 0.02, hint: str = "") -> Optional[bool]:
    """Says whether an exercise's answer is right, to a share `within` of the right one.

    None, with a word, where there is no answer yet; else whether it is right. The hint is shown for a wrong one. Stands in
    the folded cell below the exercise, so that the question shows neither the right number nor the way to it.
    """
    if answer is None:
        print("No answer yet.")
        return None
    correct = abs(answer - right) <= within * abs(right)
    if correct:
        print(f"Right: {right:.4g}.")
    else:
        far = "far off" if right == 0 or not 0.5 < answer / right < 2 else "close"
        print(f"Not yet: {answer:.4g} is {far}." + (f" {hint}" if hint else ""))
    return correct


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
