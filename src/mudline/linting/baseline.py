"""Findings that are known and hidden: recorded by path, code and the text of their line, not by its number."""

from __future__ import annotations

import json
import os
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from mudline.diagnostics import Diagnostic
from mudline.syntax.source import Source

FORMAT = "mudline-baseline/1"
_KEYS = {"path", "code", "content", "count"}
_LONGEST = 500
"""Characters of a line that are recorded."""


class BaselineError(ValueError):
    """A file that is not a baseline; the message says why."""


class Entry(NamedTuple):
    """What findings are known by: the path from the baseline's folder, the code, and the line without outer blanks."""

    path: str
    code: str
    content: str


@dataclass
class Baseline:
    """Known findings and how often each is there; `folder` is that of the baseline's file."""

    folder: Path
    known: Counter[Entry] = field(default_factory=Counter)
    met: Counter[Entry] = field(default_factory=Counter)
    seen: set[str] = field(default_factory=set)

    def record(self, found: Iterable[Diagnostic], data: bytes, path: str) -> None:
        """Add the findings of a file, whose content is `data`."""
        self.known.update(self._entries(found, data, path))

    def unknown(self, found: Sequence[Diagnostic], data: bytes, path: str) -> list[Diagnostic]:
        """The findings of a file that are not recorded, or more of a kind than are."""
        self.seen.add(self._relative(path))
        new: list[Diagnostic] = []
        for one, entry in zip(found, self._entries(found, data, path), strict=True):
            self.met[entry] += 1
            if self.met[entry] > self.known[entry]:
                new.append(one)
        return new

    def gone(self) -> int:
        """How many recorded findings of the files seen are no longer there."""
        return sum(max(count - self.met[entry], 0) for entry, count in self.known.items() if entry.path in self.seen)

    def text(self) -> str:
        """The content of the file: sorted, an entry a line, ends with LF."""
        entries = sorted((entry, count) for entry, count in self.known.items() if count)
        lines = [json.dumps({**entry._asdict(), "count": count}, ensure_ascii=True) for entry, count in entries]
        inner = ",\n".join(f"  {line}" for line in lines)
        return f'{{\n "format": "{FORMAT}",\n "findings": [' + (f"\n{inner}\n ]\n}}\n" if lines else "]\n}\n")

    def _entries(self, found: Iterable[Diagnostic], data: bytes, path: str) -> Iterator[Entry]:
        source = Source.from_bytes(data, "")
        relative = self._relative(path)
        lines = len(source.line_starts)
        for one in found:
            content = source.line(one.line).strip()[:_LONGEST] if one.line <= lines else ""
            yield Entry(relative, one.code, content)

    def _relative(self, path: str) -> str:
        try:
            relative = os.path.relpath(path, self.folder)
        except ValueError:  # another drive
            relative = str(Path(path).absolute())
        return relative.replace(os.sep, "/")


def read_baseline(path: Path) -> Baseline:
    """The baseline in a file; raises OSError, or BaselineError for a file that is not a baseline."""
    try:
        document = json.loads(path.read_bytes())
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BaselineError(f"it is not JSON ({error})") from error
    except ValueError as error:  # of more digits than Python reads
        raise BaselineError("a whole number in it is too large") from error
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise BaselineError(f'it has no "format": "{FORMAT}"')
    findings = document.get("findings")
    if not isinstance(findings, list):
        raise BaselineError('it has no list "findings"')
    baseline = Baseline(path.parent)
    for number, given in enumerate(findings):
        entry, count = _entry(given, number)
        baseline.known[entry] += count
    return baseline


def _entry(given: object, number: int) -> tuple[Entry, int]:
    if not isinstance(given, dict) or given.keys() != _KEYS:
        raise BaselineError(f"findings[{number}] must have the keys {', '.join(sorted(_KEYS))}, and no others")
    path, code, content, count = (given[key] for key in ("path", "code", "content", "count"))
    if not (isinstance(path, str) and isinstance(code, str) and isinstance(content, str)):
        raise BaselineError(f"findings[{number}]: path, code and content must be texts")
    if not isinstance(count, int) or isinstance(count, bool) or count < 1:
        raise BaselineError(f"findings[{number}]: count must be a whole number from 1")
    return Entry(path, code, content), count
