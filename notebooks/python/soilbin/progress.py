"""How far long work is: on a terminal or in a notebook, once it has taken longer than two seconds."""
from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any, Literal, Optional, Union

Told = Callable[[float, str], object]
"""Called a few times a second with the share of the work that is done, 0 .. 1, and the name of its stage."""

Progress = Union[Told, Literal["shown"], None]
"""'shown': on a terminal or in a notebook; None: silent; else what is called. What it raises stops the work."""


def told_to(progress: Progress) -> Optional[Told]:
    """What the library calls."""
    if progress != "shown":
        return progress
    if in_notebook():
        return _Shown(_NotebookLine())
    return _Shown(_TerminalLine()) if sys.stderr.isatty() else None


def in_notebook() -> bool:
    """Whether the code runs in a cell of Jupyter."""
    shell: Any = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    return hasattr(shell, "kernel")


class _TerminalLine:
    def show(self, text: str) -> None:
        print("\r\033[K" + text, end="", file=sys.stderr, flush=True)


class _NotebookLine:
    def __init__(self) -> None:
        self._handle: Any = None

    def show(self, text: str) -> None:
        from IPython.display import display

        if self._handle is None:
            self._handle = display({"text/plain": text}, raw=True, display_id=True)
        else:
            self._handle.update({"text/plain": text}, raw=True)


class _Shown:
    def __init__(self, line: _TerminalLine | _NotebookLine) -> None:
        self._line = line
        self._began = time.monotonic()
        self._open = False

    def __call__(self, share: float, stage: str) -> None:
        passed = time.monotonic() - self._began
        if share >= 1:
            if self._open:
                self._line.show("")
            return
        if passed < 2:
            return
        self._open = True
        left = f", {passed * (1 - share) / share:.0f} s left" if share > 0.02 else ""
        self._line.show(f"{stage + ': ' if stage else ''}{100 * share:.0f} %{left}")
