"""Output formats of findings, a module each, imported when it is used, and the functions that they share.

Each module here is a format with the module's name: `SUMMARY` is a sentence for the documentation, `write(diagnostics,
files)` returns the text of findings in pieces; `files` are the linted files in their order. `text`, the format for
people, is printed by the command as findings come.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from hashlib import sha256
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType

from mudline.basics.limits import LONGEST_MESSAGE
from mudline.basics.short_repr import counted, cut, printable
from mudline.language.diagnostics import Diagnostic, Severity

TEXT = "text"
"""Format for people, which is printed to the terminal as findings come."""

TEXT_SUMMARY = "for people: place, message, the source line with a mark; standard output only"


def form_names() -> list[str]:
    """Return the name of every format except text, without importing one."""
    return sorted(module.name for module in iter_modules(__path__))


def form_module(name: str) -> ModuleType:
    """Return the module of a format."""
    return import_module(f"{__name__}.{name}")


def with_fingerprints(diagnostics: Iterable[Diagnostic]) -> Iterator[tuple[Diagnostic, str]]:
    """Yield each finding with a hash of path, code and message, without the line number; equal findings are counted."""
    met: Counter[tuple[str, str, str]] = Counter()
    for found in diagnostics:
        known = (found.file, found.code, found.message)
        met[known] += 1
        text = "\0".join([*known, str(met[known])])
        yield found, sha256(text.encode("utf-8", "backslashreplace")).hexdigest()


def by_severity(diagnostics: Sequence[Diagnostic]) -> Iterator[tuple[Severity, str]]:
    """Yield the severities of some findings, worst first, each with its number of findings: `2 errors`, `1 info`."""
    for severity in reversed(Severity):
        if count := sum(found.severity is severity for found in diagnostics):
            yield severity, f"{count} info" if severity is Severity.INFO else counted(count, severity.value)


def visible(text: str, encoding: str = "utf-8") -> str:
    """Return the text with a space for a tab, and a replacement mark for every other character that does not print.

    Nothing in a deck can then act on a terminal. Characters that the terminal's encoding lacks are escaped, so that the
    text has the same length here and there. A very long text is cut.
    """
    shown = printable(cut(text, LONGEST_MESSAGE).replace("\t", " "))
    if encoding.startswith("utf"):
        return shown
    return shown.encode(encoding, "backslashreplace").decode(encoding)


def visible_lines(text: str) -> str:
    """Return the same for a text of several lines, whose line ends and tabs stay."""
    return printable(text, kept="\n\t")
