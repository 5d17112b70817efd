"""One file through the linter: a pure function of its content and its settings, which may run in another process."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from mudline.deck.loading import form_of
from mudline.diagnostics import Diagnostic
from mudline.linting.engine import Fixing, LintSettings, lint_bytes
from mudline.linting.fixing import Fixed, fix_bytes


@dataclass(frozen=True, slots=True)
class FileReport:
    """What came out for one file.

    `found` are the findings in the content as it is after fixing, in their order; `fixed` those that are gone.
    `changed` is the new content, or None where it is the old one. `note` says why fixes were not made, or "";
    a deck in JSON or YAML has none.
    """

    file: str
    found: tuple[Diagnostic, ...]
    fixed: tuple[Diagnostic, ...] = ()
    changed: bytes | None = None
    note: str = ""


def lint_one(name: str, data: bytes, settings: LintSettings, folder: Path | None = None) -> FileReport:
    """Lint the content of a file, and fix it if the settings ask for it; writes nothing and never raises for content.

    `folder` is where files that the deck names are; without it none of them is looked for.
    """
    result = _fixed(name, data, settings, folder)
    content = data if result.changed is None else result.changed
    found = lint_bytes(content, name, settings.rules, units=settings.units, folder=folder, dialect=settings.dialect)
    return FileReport(
        name, _with_severities(found, settings), _with_severities(result.fixed, settings), result.changed, result.note
    )


def _fixed(name: str, data: bytes, settings: LintSettings, folder: Path | None) -> Fixed:
    if settings.fixing is Fixing.NONE or form_of(name) != "keyword":
        return Fixed(None, (), "")
    return fix_bytes(data, name, settings, folder)


def _with_severities(
    found: list[Diagnostic] | tuple[Diagnostic, ...], settings: LintSettings
) -> tuple[Diagnostic, ...]:
    """The findings with the severities that the settings give them."""
    given = settings.severities
    return tuple(replace(one, severity=given[one.code]) if one.code in given else one for one in found)
