"""Configuration of a project: the `[tool.mudline]` of a pyproject.toml, or a mudline.toml."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import lru_cache, reduce
from pathlib import Path
from typing import Any, NamedTuple

from mudline.basics.files import reason
from mudline.basics.outside import CONFIGURATIONS
from mudline.basics.overwriting import reading
from mudline.basics.paths import relative_path
from mudline.basics.patterns import matches
from mudline.basics.spelling import nearest

Values = dict[str, Any]

LISTS = ("select", "ignore", "extend-select", "include", "exclude", "fixable", "unfixable")
WORDS = {"fail-on": ("error", "warning", "info"), "dialect": ("mudline", "flexcom")}
TABLES = ("per-file-ignores", "severity")
EXTEND = "extend"
NO_OUTSIDE = "no-outside"
ENCODING = "encoding"
DEFAULTS: Values = {
    EXTEND: "",
    **{key: [] for key in LISTS},
    "fail-on": "warning",
    "dialect": "mudline",
    NO_OUTSIDE: False,
    ENCODING: "",
    **{key: {} for key in TABLES},
}
"""Value of each key that is not set."""
_ADDED = "extend-select"
OF_CODES = ("select", "ignore", "extend-select", "fixable", "unfixable")
SEVERITIES = ("error", "warning", "info", "off")


def is_encoding(name: str) -> bool:
    """Return True if a name is that of a text encoding."""
    try:
        "".encode(name).decode(name)
    except (LookupError, ValueError):
        return False
    return True


CodeFault = Callable[[str], str]
"""Check of a word that names rules: returns its fault in words, or ""."""


class ConfigurationError(ValueError):
    """Configuration that cannot be used; the message has file, line or key, and what to do."""


@dataclass(frozen=True)
class Configuration:
    """Checked values of a file, with those of the files that it extends; empty without a file.

    path: the file.
    values: the value of each key.
    origins: file and line of each key.
    content: contents of all files, as findings depend on them.
    """

    path: Path | None = None
    values: Values = field(default_factory=dict)
    origins: dict[str, tuple[Path, int]] = field(default_factory=dict)
    content: bytes = b""

    def over(self, base: Configuration) -> Configuration:
        """Return this configuration on top of a base.

        A key replaces that of the base. Tables are joined entry by entry, and `extend-select` adds to that of the base.
        """
        values = base.values | self.values
        for key in TABLES:
            if key in base.values and key in self.values:
                values[key] = base.values[key] | self.values[key]
        if _ADDED in base.values and _ADDED in self.values:
            values[_ADDED] = [*base.values[_ADDED], *self.values[_ADDED]]
        content = b"%d %b%b" % (len(self.content), self.content, base.content)
        return Configuration(self.path, values, base.origins | self.origins, content)

    def value(self, key: str) -> Any:  # noqa: ANN401 - of the kind of its key
        """Return the value of a key, or its default."""
        return self.values.get(key, DEFAULTS[key])

    def lists(self, key: str, path: str) -> bool:
        """Return True if a pattern of a list, `include` or `exclude`, matches the path of a file."""
        patterns = self.value(key)
        return bool(patterns) and matches(self.relative(path), patterns)

    def relative(self, path: str) -> str:
        """Return a path as seen from the folder of the configuration, with `/`."""
        return relative_path(path, os.curdir if self.path is None else self.path.parent)


class CallerSettings(NamedTuple):
    """Settings of a caller that findings depend on; None or empty if the caller leaves them open."""

    chosen: tuple[str, ...] = ()
    ignored: tuple[str, ...] = ()
    also: tuple[str, ...] = ()
    dialect: str | None = None
    units: str | None = None
    no_outside: bool = False


def read_configuration(path: Path, code_fault: CodeFault | None = None) -> Configuration | None:
    """Return the configuration in a file; None for a pyproject.toml without `[tool.mudline]`.

    Files that it extends are read too. Words for rules are checked by `code_fault`
    (`mudline.checks.registry.code_fault`), and not checked without it. Raises OSError and ConfigurationError.
    """
    outermost = _read_one(path, code_fault)
    if outermost is None or EXTEND not in outermost.values:
        return outermost
    chain, at, whole = [path], outermost, [outermost]
    while EXTEND in at.values:
        base, line = Path(os.path.normpath(chain[-1].parent / at.values[EXTEND])), at.origins[EXTEND][1]
        place = f"{chain[-1].as_posix()}:{line}: {EXTEND}"
        known = [os.path.realpath(file) for file in chain]
        if (real := os.path.realpath(base)) in known:
            names = " -> ".join(file.as_posix() for file in (*chain[known.index(real) :], base))
            raise ConfigurationError(f"{place} leads back to itself: {names}")
        try:
            at = _read_one(base, code_fault) or Configuration(base)
        except OSError as error:
            raise ConfigurationError(f"{place}: {base.as_posix()} cannot be read: {reason(error)}") from error
        chain.append(base)
        whole.append(at)
    return reduce(lambda above, own: own.over(above), reversed(whole))


def _read_one(path: Path, code_fault: CodeFault | None) -> Configuration | None:
    """Return the configuration in the file alone, without the files that it extends."""
    reading(path)
    content = path.read_bytes()
    import tomllib  # noqa: PLC0415 - most commands find no file

    try:
        text = content.decode("utf-8-sig").replace("\r\n", "\n")
        document = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise ConfigurationError(f"{path.as_posix()}: this is not TOML: {error}") from error
    except ValueError as error:  # of more digits than Python reads
        raise ConfigurationError(f"{path.as_posix()}: a whole number in this file is too large") from error
    values: object = document
    if path.name == "pyproject.toml":
        tool = document.get("tool")
        values = tool.get("mudline") if isinstance(tool, dict) else None
        if values is None:
            return None
    return _ConfigurationFile(path, content, text, code_fault).checked(values)


class _ConfigurationFile:
    """Checker of one file's values."""

    def __init__(self, path: Path, content: bytes, text: str, code_fault: CodeFault | None) -> None:
        self.path = path
        self.content = content
        self.code_fault = code_fault
        self.rows = text.split("\n")
        self.first = 0
        if path.name == "pyproject.toml":
            heads = [i for i, row in enumerate(self.rows) if re.match(r"\s*\[\s*tool\s*\.\s*mudline\b", row)]
            self.first = heads[0] if heads else 0

    def checked(self, values: object) -> Configuration:
        if not isinstance(values, dict):
            raise self.error("tool", "tool.mudline must be a table")
        for key, value in values.items():
            self.check(key, value)
        origins = {key: (self.path, self.line(key) or 1) for key in values}
        return Configuration(self.path, values, origins, self.content)

    def check(self, key: str, value: object) -> None:
        if key not in DEFAULTS:
            raise self.error(key, f"unknown key {key!r}{_hint(key, DEFAULTS)}")
        if key in (EXTEND, NO_OUTSIDE, ENCODING):
            self.single(key, value)
        elif key in WORDS:
            self.one_of(key, value, WORDS[key])
        elif key == "severity":
            for code, severity in self.pairs(key, value):
                self.codes(key, [code])
                self.one_of(code, severity, SEVERITIES)
        elif key == "per-file-ignores":
            for glob, codes in self.pairs(key, value):
                self.codes(glob, self.texts(glob, codes))
        elif key in LISTS:
            texts = self.texts(key, value)
            self.codes(key, texts if key in OF_CODES else [])

    def single(self, key: str, value: object) -> None:
        if key == NO_OUTSIDE and not isinstance(value, bool):
            raise self.error(key, f"{key} is true or false, not {value!r}")
        if key == ENCODING and not (isinstance(value, str) and is_encoding(value)):
            raise self.error(key, f'{key} must be that of the decks, such as "cp1251", not {value!r}')
        if key == EXTEND and (not isinstance(value, str) or not value.strip()):
            raise self.error(key, f'{key} must be the path of a file, such as "../base.toml", not {value!r}')

    def one_of(self, key: str, value: object, choices: tuple[str, ...]) -> None:
        if not isinstance(value, str) or value not in choices:
            near = _hint(value, choices) if isinstance(value, str) else f": write one of {', '.join(choices)}"
            raise self.error(key, f"{key} cannot be {value!r}{near}")

    def pairs(self, key: str, value: object) -> Iterable[tuple[str, object]]:
        if not isinstance(value, dict):
            raise self.error(key, f"{key} must be a table, not {value!r}")
        return value.items()

    def texts(self, key: str, value: object) -> list[str]:
        if not isinstance(value, list) or not all(isinstance(word, str) and word.strip() for word in value):
            raise self.error(key, f'{key} must be a list of texts, such as ["..."], not {value!r}')
        return value

    def codes(self, key: str, words: list[str]) -> None:
        for word in words:
            if fault := self.code_fault(word) if self.code_fault else "":
                raise self.error(word, f"{key}: {fault}", key)

    def line(self, *words: str) -> int | None:
        """Return the line of a key or a text, if a search of the file finds it."""
        for word in words:
            name = re.escape(word)
            pattern = re.compile(rf"""["']{name}["']|(^|[\s.\[{{,]){name}\s*[=\].]""")
            for number, row in enumerate(self.rows[self.first :], self.first + 1):
                if pattern.search(row.partition("#")[0]):
                    return number
        return None

    def error(self, word: str, message: str, key: str | None = None) -> ConfigurationError:
        line = self.line(word, key or word)
        return ConfigurationError(f"{self.path.as_posix()}{f':{line}' if line else ''}: {message}")


def _hint(word: str, choices: Iterable[str]) -> str:
    near = nearest(word.replace("_", "-"), choices)
    return f": did you mean {near}?" if near else f": choose from {', '.join(choices)}"


@dataclass(eq=False)
class Configured:
    """Source of each deck's configuration: a file `config`, none (`isolated`), or the nearest one upwards.

    `code_fault` checks words that name rules, as in `read_configuration`. All methods raise ConfigurationError for a
    configuration that cannot be read or used.
    """

    config: str | None = None
    isolated: bool = False
    code_fault: CodeFault | None = None
    _fixed: Configuration | None = field(init=False, default=None)
    _in_folder: dict[Path, Configuration | None] = field(init=False, default_factory=dict)
    _nearest: dict[str, Configuration] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        if self.config is not None and self.isolated:
            raise ConfigurationError("--config and --isolated exclude each other: give one of them")
        if self.isolated:
            self._fixed = Configuration()
        elif self.config is not None:
            self._fixed = self._read(Path(self.config)) or Configuration()

    def of(self, path: str | None) -> Configuration:
        """Return the configuration of a file, by its path or the name given for standard input.

        It is the nearest one upwards; in a folder, mudline.toml comes before pyproject.toml.
        """
        if self._fixed is not None:
            return self._fixed
        folder = os.path.dirname(path or "-")  # noqa: PTH120 - asked for each of many files
        if folder not in self._nearest:
            self._nearest[folder] = self._upwards(Path(os.path.abspath(folder)))  # noqa: PTH100 - links stay what they are called
        return self._nearest[folder]

    def _upwards(self, folder: Path) -> Configuration:
        for place in (folder, *folder.parents):
            if place not in self._in_folder:
                files = (place / name for name in CONFIGURATIONS)
                there = filter(os.path.isfile, files)  # Path raises for a folder that may not be searched
                self._in_folder[place] = next(filter(None, map(self._read, there)), None)
            if here := self._in_folder[place]:
                return here
        return Configuration()

    def _read(self, path: Path) -> Configuration | None:
        try:
            return read_configuration(path, self.code_fault)
        except OSError as error:
            what = f"{error.filename}: the configuration cannot be read: {reason(error)}"
            raise ConfigurationError(what) from error

    def includes(self, path: str) -> bool:
        """Return True if a file is a deck in any form, or `include` of its configuration takes it for one."""
        from mudline.language.deck.searching import is_in_any_form  # noqa: PLC0415 - help has none

        return is_in_any_form(path) or self.of(path).lists("include", path)

    def takes(self, path: str, wanted: Callable[[str], bool]) -> bool:
        """Return True if a file of a searched directory is a deck that is `wanted` and not excluded."""
        from mudline.language.deck.searching import may_be_deck  # noqa: PLC0415 - as above

        return wanted(path) and not self.excludes(path) and may_be_deck(path)

    def encoding(self, path: str) -> str:
        """Return the encoding that the file's configuration gives, "" if it gives none."""
        return str(self.of(path).value(ENCODING))

    def excludes(self, path: str) -> bool:
        """Return True if `exclude` of the file's configuration leaves the file out."""
        return self.of(path).lists("exclude", path)


@lru_cache(maxsize=256)
def refuses_outside(folder: Path) -> bool:
    """Return True if the nearest configuration keeps a folder's decks from files outside, or cannot be read."""
    try:
        configuration = Configured().of(str(folder / "-"))
    except ConfigurationError:
        return True
    return bool(configuration.value(NO_OUTSIDE))
