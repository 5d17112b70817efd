"""How a study is run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


def silent(message: str) -> None:
    """Tell nothing."""
    del message


@dataclass(frozen=True, slots=True)
class StudyOptions:
    """What the user chose.

    Attributes:
        full: a longer run, with finer ladders and more repeats.
        progress: is told, in a few words, what is done next.
    """

    full: bool = False
    progress: Callable[[str], None] = silent
