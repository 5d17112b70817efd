"""The bar of a long run, drawn on standard error. It takes one line and leaves nothing behind."""

from __future__ import annotations

import os
import sys

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn


class Bar:
    """A bar that is drawn by hand, without a thread, and leaves both streams as they are."""

    def __init__(self, total: int, color: str) -> None:
        plain = color == "never" or bool(os.environ.get("NO_COLOR"))
        self._progress = Progress(
            BarColumn(bar_width=None),
            MofNCompleteColumn(),
            TimeRemainingColumn(compact=True),
            console=Console(file=sys.stderr, force_interactive=True, no_color=plain),
            auto_refresh=False,
            transient=True,
            expand=True,
            redirect_stdout=False,
            redirect_stderr=False,
        )
        self._task = self._progress.add_task("", total=total)

    def draw(self, done: int) -> None:
        """Show so many steps as done."""
        self._progress.update(self._task, completed=done)
        self._progress.start()
        self._progress.refresh()

    def erase(self) -> None:
        """Leave an empty line where the bar was."""
        self._progress.stop()
