"""The shape of the bed."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.codes import SBD023
from mudline.diagnostics import Problem
from mudline.linting.context import LintContext
from mudline.linting.registry import rule


@rule(SBD023)
def unreadable_profile(context: LintContext) -> Iterator[Problem]:
    """The file of a seabed profile cannot be read.

    A compiled profile (.fcsbd) is binary, and its format is not public: the deck keeps it, and mudline knows nothing of
    the bed that it describes. A linear profile may be a text file instead, with a line `Y, elevation` for each point;
    in such a file the finding names the first line that is no point.

    Bad:
        $MODEL
        *SEABED PROFILE
         TYPE=2D
         FILE=shelf.fcsbd

    Good:
        $MODEL
        *SEABED PROFILE
         TYPE=SLOPING
         SLOPE=1.5

    Finds: 4:7
    """
    yield from context.told(SBD023)
