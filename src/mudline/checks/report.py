"""Report on a file that was linted; what only remembers reports imports no rule."""

from __future__ import annotations

from dataclasses import dataclass, field

from mudline.language.diagnostics import Coverage, Diagnostic


@dataclass(frozen=True, slots=True)
class FileReport:
    """Outcome of linting and fixing one file.

    file: name of the file.
    found: findings in the content as it is after fixing, in their order.
    fixed: findings that are gone.
    changed: the new content, None if nothing was changed.
    note: the reason why fixes were not made, or ""; a deck in JSON or YAML has none.
    looked_at: the paths on which the findings depend, in addition to the content.
    coverage: how many keywords were read.
    """

    file: str
    found: tuple[Diagnostic, ...]
    fixed: tuple[Diagnostic, ...] = ()
    changed: bytes | None = None
    note: str = ""
    looked_at: tuple[str, ...] = ()
    coverage: Coverage = field(default_factory=Coverage)
