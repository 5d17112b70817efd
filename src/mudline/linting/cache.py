"""Findings kept from run to run, for decks whose content, settings and program are what they were.

The cache is a file for each working folder, whole or not at all, bounded in number and size: a head line with a digest
of the rest, then a line for each deck, its key and its findings if it has any.
"""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from hashlib import blake2b
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from mudline.cache_folder import cache_folder
from mudline.deck.loading import form_of
from mudline.diagnostics import Diagnostic, Edit, Fix, Severity
from mudline.files import write_atomically
from mudline.linting.engine import LintSettings
from mudline.linting.fixing import FileReport
from mudline.linting.registry import Guarded, origin
from mudline.linting.rule import Rule
from mudline.resources import grammar_file

LONGEST = 100_000
"""Letters of the findings of one deck; more of them are not kept."""

KEY = 40
"""Letters of a key."""

_PACKAGES = ("mudline", "lark", "numpy", "pydantic", "pyyaml")
_NAMES_A_FILE = re.compile(r"FILE[^\r\nA-Z0-9]*=|RESTART")
_NAMES_A_FILE_IN_A_FORM = re.compile(r"FILE|RESTART|\\")

MOST_FILES = 40
MOST_ENTRIES = 50_000
MOST_BYTES = 64_000_000
_MAGIC = b"mudline-lint-cache/1 "


def stands_alone(name: str, data: bytes) -> bool:
    """Whether a deck certainly names no other file, so that its findings depend on nothing but its content.

    Decks that continue others or read files are linted again in each run, and so is what is not certain: text of
    two bytes a character, and escapes by which JSON and YAML may write any name.
    """
    if b"\0" in data:
        return False
    text = data.decode("utf-8", "replace").upper()
    pattern = _NAMES_A_FILE if form_of(name) == "keyword" else _NAMES_A_FILE_IN_A_FORM
    return pattern.search(text) is None


def program() -> str:
    """What the program is: its version, its files as they are installed, and the libraries it reads decks with."""
    words = [f"{name} {_version(name)}" for name in _PACKAGES]
    for root in {Path(__file__).parents[1], grammar_file("deck.lark").parent}:
        for folder, _, names in os.walk(root):
            words += (_state(os.path.join(folder, name)) for name in names if not name.endswith(".pyc"))  # noqa: PTH118 - quicker than Path
    words.sort()
    return "\n".join(words)


def of_settings(settings: LintSettings, running: str) -> bytes:
    """What the settings and the program add to each key."""
    rules = [
        [rule.code.code, rule.code.severity.value, origin(rule.code.code), _source(rule)] for rule in settings.rules
    ]
    severities = sorted((code, severity.value) for code, severity in settings.severities.items())
    return repr((running, rules, settings.units, settings.dialect, severities)).encode("utf-8", "backslashreplace")


def key(start: bytes, name: str, data: bytes) -> str:
    """The key of a file's content under settings; its name gives units and form, and is named in findings."""
    called = name.encode("utf-8", "surrogatepass")
    digest = blake2b(b"%d %d " % (len(start), len(called)), digest_size=KEY // 2)
    for part in (start, called, data):
        digest.update(part)
    return digest.hexdigest()


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:  # bundled into a program without its metadata
        return ""


def _source(rule: Rule) -> str:
    """The file of a plugin's rule, which may change while its package is written; mudline's own are in `program`."""
    if not isinstance(rule.check, Guarded):
        return ""
    module = sys.modules.get(getattr(rule.check.check, "__module__", ""))
    path = getattr(module, "__file__", None)
    return _state(path) if path else ""


def _state(path: str) -> str:
    try:
        found = os.stat(path)  # noqa: PTH116 - hundreds of files
    except OSError:  # inside an archive
        return path
    return f"{path} {found.st_size} {found.st_mtime_ns}"


def packed(found: Sequence[Diagnostic]) -> str:
    """The findings of one file in ASCII without a line end; "" for none. The file's name is left out."""
    if not found:
        return ""
    return json.dumps([_row(one) for one in found], separators=(",", ":"))


def unpacked(text: str, file: str) -> tuple[Diagnostic, ...]:
    """The findings that `packed` wrote, for a file of that name; raises ValueError for anything else."""
    if not text:
        return ()
    try:
        rows = json.loads(text)
    except RecursionError as error:
        raise ValueError("lists in lists without end") from error
    if not isinstance(rows, list):
        raise ValueError("no list of findings")  # noqa: TRY004 - one kind of error for whatever a file holds
    return tuple(_finding(row, file) for row in rows)


def _row(one: Diagnostic) -> list[object]:
    fix = one.fix and [
        one.fix.applicability,
        one.fix.message,
        [[*edit.start, *edit.end, edit.text] for edit in one.fix.edits],
    ]
    place = (one.line, one.column, one.end_line, one.end_column)
    return [one.code, one.slug, one.severity.value, one.message, *place, fix, one.blocks]


def _finding(row: object, file: str) -> Diagnostic:
    code, slug, severity, message, line, column, end_line, end_column, fix, blocks = _shaped(row, "ssssiiii*b")
    place = (line, column, end_line, end_column)
    repair = None if fix is None else _fix(fix)
    return Diagnostic(file, code, slug, Severity(severity), message, *place, repair, blocks)


def _fix(value: object) -> Fix:
    applicability, message, edits = _shaped(value, "ss*")
    if applicability not in ("safe", "unsafe") or not isinstance(edits, list):
        raise ValueError("no fix")
    rows = (_shaped(edit, "iiiis") for edit in edits)
    return Fix(applicability, message, tuple(Edit((a, b), (c, d), text) for a, b, c, d, text in rows))


def _shaped(value: object, kinds: str) -> list[Any]:
    """The list, if its items are texts (s), numbers from 1 (i), true or false (b), or anything (*) as wanted."""
    if not isinstance(value, list) or len(value) != len(kinds):
        raise ValueError("a row of another length")
    for item, kind in zip(value, kinds, strict=True):
        if (kind == "s" and not isinstance(item, str)) or (kind == "i" and not (type(item) is int and item > 0)):
            raise ValueError("an item of another kind")
        if kind == "b" and not isinstance(item, bool):
            raise ValueError("neither true nor false")
    return value


def file_of(folder: Path, place: Path) -> Path:
    """The file of the cache for runs in a working folder."""
    return folder / f"lint-{blake2b(os.fsencode(place), digest_size=16).hexdigest()}.txt"


def read_entries(path: Path) -> dict[str, str]:
    """Keys and what they hold; nothing for a file that is missing, damaged or no cache."""
    try:
        if not path.is_file() or path.stat().st_size > MOST_BYTES:
            return {}
        head, _, body = path.read_bytes().partition(b"\n")
    except OSError:
        return {}
    if head != _head(body) or not body.isascii():
        return {}
    return {line[:KEY]: line[KEY + 1 :] for line in body.decode("ascii").split("\n") if line}


def write_entries(path: Path, entries: Mapping[str, str]) -> None:
    """Replace a file of the cache by the last of the entries; does nothing where that is not possible."""
    lines: list[bytes] = []
    size = 0
    for key, held in list(entries.items())[: -MOST_ENTRIES - 1 : -1]:
        line = f"{key} {held}\n".encode("ascii")
        size += len(line)
        if size > MOST_BYTES - 1000:
            break
        lines.append(line)
    body = b"".join(reversed(lines))
    with suppress(OSError):
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        write_atomically(path, _head(body) + b"\n" + body)
        _drop_old(path.parent)


def _head(body: bytes) -> bytes:
    return _MAGIC + blake2b(body, digest_size=20).hexdigest().encode("ascii")


def _drop_old(folder: Path) -> None:
    """Keep the files that were written last."""
    with os.scandir(folder) as entries:
        files = [(entry.stat().st_mtime, entry.path) for entry in entries if "lint-" in entry.name and entry.is_file()]
    for _, path in sorted(files)[:-MOST_FILES]:
        with suppress(OSError):
            Path(path).unlink()


@dataclass
class Cache:
    """What is known from runs before in a working folder, and what this run adds."""

    path: Path
    known: dict[str, str]
    new: dict[str, str] = field(default_factory=dict)
    _program: str = field(default_factory=program)
    _starts: dict[int, tuple[LintSettings, bytes]] = field(default_factory=dict)

    def key(self, name: str, data: bytes, settings: LintSettings) -> str:
        """What the findings of a file are kept under; "" if they cannot be kept."""
        return key(self._start(settings), name, data) if stands_alone(name, data) else ""

    def get(self, key: str, name: str) -> FileReport | None:
        """What is known of a file, or None."""
        held = self.known.get(key)
        if held is None:
            return None
        try:
            return FileReport(name, unpacked(held, name))
        except ValueError:
            del self.known[key]
            return None

    def put(self, key: str, report: FileReport) -> None:
        """Keep what was found in a file."""
        held = packed(report.found)
        if len(held) <= LONGEST:
            self.new[key] = held

    def save(self) -> None:
        """Write what was added, if anything was."""
        if self.new:
            write_entries(self.path, {**self.known, **self.new})

    def _start(self, settings: LintSettings) -> bytes:
        """Settings are few, hold for many files, and are alive as long as they are in here."""
        found = self._starts.get(id(settings))
        if found is None:
            found = self._starts[id(settings)] = (settings, of_settings(settings, self._program))
        return found[1]


def opened() -> Cache | None:
    """The cache of the working folder; None where there is no place for one."""
    folder = cache_folder()
    if folder is None:
        return None
    try:
        path = file_of(folder, Path.cwd())
    except OSError:  # the working folder is gone
        return None
    return Cache(path, read_entries(path))
