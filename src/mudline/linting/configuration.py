"""The configuration of a project: the `[tool.mudline]` of a pyproject.toml, or a mudline.toml."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mudline.spelling import nearest

Values = dict[str, Any]

LISTS = ("select", "ignore", "extend-select", "include", "exclude", "fixable", "unfixable")
WORDS = {"fail-on": ("error", "warning", "info"), "dialect": ("mudline", "flexcom")}
TABLES = ("per-file-ignores", "severity")
KEYS = (*LISTS, *WORDS, *TABLES)
_OF_CODES = ("select", "ignore", "extend-select", "fixable", "unfixable")
_SEVERITIES = ("error", "warning", "info", "off")


CodeFault = Callable[[str], str]
"""What is wrong with a word that is to name rules, or ""."""


class ConfigurationError(ValueError):
    """A configuration that cannot be used; the message has file, line or key, and what to do."""


@dataclass(frozen=True)
class Configuration:
    """The values that a file sets, checked, and its content; none without a file."""

    path: Path | None = None
    values: Values = field(default_factory=dict)
    lines: dict[str, int] = field(default_factory=dict)
    content: bytes = b""

    def words(self, key: str) -> list[str]:
        """A list, empty if it is not set."""
        return list(self.values.get(key, ()))

    def table(self, key: str) -> dict[str, Any]:
        """A table, empty if it is not set."""
        return dict(self.values.get(key, {}))


def read_configuration(
    path: Path, *, demanded: bool = True, code_fault: CodeFault | None = None
) -> Configuration | None:
    """The configuration in a file; None for a pyproject.toml without `[tool.mudline]` that is not `demanded`.

    Words for rules are checked by `code_fault` (`mudline.linting.registry.code_fault`), and taken as they are without.
    Raises OSError and ConfigurationError.
    """
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
        if values is None and not demanded:
            return None
        values = {} if values is None else values
    return _Reading(path, content, text, code_fault).checked(values)


class _Reading:
    """One file being checked."""

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
        return Configuration(self.path, values, {key: self.line(key) or 1 for key in values}, self.content)

    def check(self, key: str, value: object) -> None:
        if key not in KEYS:
            raise self.error(key, f"there is no key {key!r}{_hint(key, KEYS)}")
        if key in WORDS:
            self.one_of(key, value, WORDS[key])
        elif key == "severity":
            for code, severity in self.pairs(key, value):
                self.codes(key, [code])
                self.one_of(code, severity, _SEVERITIES)
        elif key == "per-file-ignores":
            for glob, codes in self.pairs(key, value):
                self.codes(glob, self.texts(glob, codes))
        else:
            texts = self.texts(key, value)
            if key in _OF_CODES:
                self.codes(key, texts)

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
        """The line of a key or a text, as far as a search of the text finds it."""
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


class Search:
    """The nearest configuration upwards of a folder, each folder looked at once; `code_fault` as when one is read."""

    def __init__(self, code_fault: CodeFault | None = None) -> None:
        self._known: dict[Path, Configuration] = {}
        self._code_fault = code_fault

    def nearest(self, folder: Path) -> Configuration:
        """mudline.toml before pyproject.toml in one folder. Raises OSError and ConfigurationError."""
        passed: list[Path] = []
        found = Configuration()
        for place in (folder, *folder.parents):
            if place in self._known:
                found = self._known[place]
                break
            passed.append(place)
            if here := _in(place, self._code_fault):
                found = here
                break
        self._known.update(dict.fromkeys(passed, found))
        return found


def _in(folder: Path, code_fault: CodeFault | None) -> Configuration | None:
    for name in ("mudline.toml", "pyproject.toml"):
        path = folder / name
        if path.is_file() and (found := read_configuration(path, demanded=False, code_fault=code_fault)):
            return found
    return None
