"""Patterns of paths as a `.gitignore` has them, matched in one pass over the path, whatever the pattern is."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache

_WILD = re.compile(r"[*?\[\\]")
_POSIX = {
    "alnum": str.isalnum,
    "alpha": str.isalpha,
    "blank": " \t".__contains__,
    "cntrl": lambda char: ord(char) < 32 or ord(char) == 127,
    "digit": str.isdigit,
    "graph": lambda char: char.isprintable() and char != " ",
    "lower": str.islower,
    "print": str.isprintable,
    "punct": "!\"#$%&'()*+,-./:;<=>?@[\\]^_`{|}~".__contains__,
    "space": str.isspace,
    "upper": str.isupper,
    "xdigit": "0123456789abcdefABCDEF".__contains__,
}


class _MalformedError(Exception):
    """A pattern that fits nothing, as it is not a pattern."""


@dataclass(frozen=True, slots=True)
class _Set:
    """A character class: ranges of characters and names of POSIX classes; "/" is in none."""

    ranges: tuple[tuple[str, str], ...] = ()
    named: tuple[str, ...] = ()
    negated: bool = False

    def __contains__(self, char: str) -> bool:
        inside = any(low <= char <= high for low, high in self.ranges) or any(_POSIX[name](char) for name in self.named)
        return char != "/" and inside is not self.negated


_ANY = _Set(negated=True)
"""`?`: any character but "/"."""


@dataclass(slots=True)
class _Machine:
    """All ways to match tokens at once: bit i of a state says that the tokens before i are matched.

    `single[i]` is the character that token i takes, None for those that take any number: `name` marks `*`, `folders`
    marks `**/` and `rest` a last `**`. A `**/` has two bits: the first is skipped to the second, in which folders are
    passed, or to the one behind it.
    """

    single: list[str | _Set | None] = field(default_factory=list)
    name: int = 0
    folders: int = 0
    rest: int = 0
    _taken: dict[str, tuple[int, int]] = field(default_factory=dict)

    def add(self, token: str | _Set | None) -> int:
        """Append a token; its bit."""
        self.single.append(token)
        return 1 << len(self.single) - 1

    def ends(self, text: str) -> Iterator[int]:
        """Where the beginnings of a text end that are matched, those before a "/" and the whole of it."""
        final = 1 << len(self.single)
        state = self._open(1)
        for position, char in enumerate(text):
            if char == "/" and state & final:
                yield position
            step, stay = self._taken.get(char) or self._take(char)
            state = self._open((state & step) << 1 | state & stay)
            if not state:
                return
        if state & final:
            yield len(text)

    def _open(self, state: int) -> int:
        """A state with what can be skipped skipped; behind a `*` there is never a `**/`."""
        deep = state & self.folders
        state |= deep << 1 | deep << 2
        return state | (state & self.name) << 1

    def _take(self, char: str) -> tuple[int, int]:
        """The bits that go one further with a character, and those that stay."""
        step = sum(1 << i for i, token in enumerate(self.single) if token is not None and char in token)
        passing = self.folders << 1 | self.rest << 1
        stay = passing | (self.name if char != "/" else 0)
        found = self._taken[char] = (step | self.rest | (self.folders << 1 if char == "/" else 0), stay)
        return found


@dataclass(frozen=True, slots=True)
class Pattern:
    """A pattern: what it fits, whether it takes back what patterns before it say (`!`), whether it means folders only.

    A pattern with a "/" before its end is matched against `whole` paths, any other against each name on its own. What
    it fits begins with `prefix`, and a name ends with `suffix`; without wildcards it is a prefix and has no machine.
    """

    prefix: str
    suffix: str
    machine: _Machine | None
    whole: bool
    negated: bool
    folders_only: bool

    def ends(self, path: str, *, folder: bool = False) -> Iterator[int]:
        """Where the beginnings of a path end that are fitted: folders above it, and last the path itself."""
        for end in self._whole(path) if self.whole else self._names(path):
            if end < len(path) or folder or not self.folders_only:
                yield end

    def fits(self, path: str, *, folder: bool) -> bool:
        """Whether a path itself is fitted."""
        if self.folders_only and not folder:
            return False
        return len(path) in self._whole(path) if self.whole else self._fits(path.rpartition("/")[2])

    def _whole(self, path: str) -> Iterator[int]:
        if self.machine is not None and path.startswith(self.prefix):
            yield from self.machine.ends(path)
        elif self.machine is None and f"{path}/".startswith(f"{self.prefix}/"):
            yield len(self.prefix)

    def _names(self, path: str) -> Iterator[int]:
        start = 0
        for name in path.split("/"):
            if self._fits(name):
                yield start + len(name)
            start += len(name) + 1

    def _fits(self, name: str) -> bool:
        if self.machine is None:
            return name == self.prefix
        return name.startswith(self.prefix) and name.endswith(self.suffix) and len(name) in self.machine.ends(name)


@cache
def read_pattern(line: str) -> Pattern | None:
    """The pattern in a line of a `.gitignore`; None for a blank line, a comment, and what can fit nothing."""
    text = _without_trailing_spaces(line.rstrip("\r\n"))
    if not text or text.startswith("#"):
        return None
    negated = text.startswith("!")
    text = text[negated:]
    folders_only = text.endswith("/")
    body = text.removesuffix("/")
    whole = "/" in body
    body = body.removeprefix("/")
    if not body:
        return None
    if not _WILD.search(body):
        return Pattern(body, "", None, whole, negated, folders_only)
    try:
        machine = _machine(body, whole=whole)
    except _MalformedError:
        return None
    prefix = body[: _first_wild(body)]
    suffix = "" if "\\" in body or "[" in body else re.split(r"[*?]", body)[-1]
    return Pattern(prefix, suffix, machine, whole, negated, folders_only)


def fits(path: str, patterns: Iterable[Pattern]) -> bool:
    """Whether a file, or a folder above it, fits the patterns: of those that fit one of them, the last counts."""
    said: dict[int, bool] = {}
    for pattern in patterns:
        said.update(dict.fromkeys(pattern.ends(path), not pattern.negated))
    return any(said.values())


def matches(path: str, lines: Iterable[str]) -> bool:
    """Whether a relative path with "/", or a folder above it, fits patterns, as in a `.gitignore`."""
    return fits(path, filter(None, map(read_pattern, lines)))


def _without_trailing_spaces(text: str) -> str:
    stripped = text.rstrip(" ")
    escapes = len(stripped) - len(stripped.rstrip("\\"))
    return stripped + " " * (escapes % 2 and len(text) > len(stripped))


def _first_wild(body: str) -> int:
    found = _WILD.search(body)
    return len(body) if found is None else found.start()


def _machine(body: str, *, whole: bool) -> _Machine:
    machine = _Machine()
    names = body.split("/") if whole else [body]
    last = len(names) - 1
    for number, name in enumerate(names):
        if name == "**" and whole:
            if number == last:
                machine.rest |= machine.add(None)
            elif number == 0 or names[number - 1] != "**":
                machine.folders |= machine.add(None)
                machine.add(None)
            continue
        _name(name, machine)
        if number < last:
            machine.add("/")
    return machine


def _name(name: str, machine: _Machine) -> None:
    """The tokens of a pattern between two "/"."""
    at = 0
    while at < len(name):
        char = name[at]
        at += 1
        if char == "*":
            if name[at : at + 1] != "*":
                machine.name |= machine.add(None)
        elif char == "?":
            machine.add(_ANY)
        elif char == "[":
            found, at = _set(name, at)
            machine.add(found)
        elif char == "\\":
            if at == len(name):
                raise _MalformedError
            machine.add(name[at])
            at += 1
        else:
            machine.add(char)


def _set(name: str, at: int) -> tuple[_Set, int]:
    """The character class that is opened before a place, and the place behind it."""
    negated = name[at : at + 1] in ("!", "^")
    at += negated
    ranges: list[tuple[str, str]] = []
    named: list[str] = []
    first = True
    while first or name[at : at + 1] != "]":
        first = False
        end = name.find("]", at + 2)
        if name.startswith("[:", at) and end > at + 2 and name[end - 1] == ":":
            if name[at + 2 : end - 1] not in _POSIX:
                raise _MalformedError
            named.append(name[at + 2 : end - 1])
            at = end + 1
            continue
        low, at = _member(name, at)
        high = low
        if name[at : at + 1] == "-" and name[at + 1 : at + 2] not in ("", "]"):
            high, at = _member(name, at + 1)
        ranges.append((low, high))
    return _Set(tuple(ranges), tuple(named), negated), at + 1


def _member(name: str, at: int) -> tuple[str, int]:
    """A character in a class, and the place behind it."""
    at += name[at : at + 1] == "\\"
    if at >= len(name):
        raise _MalformedError
    return name[at], at + 1
