"""Patterns of paths as a `.gitignore` has them, each a regular expression."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cache
from typing import NamedTuple

_PIECE = re.compile(r"(?P<stars>\*+)|\?|\[(?P<not>[!^]?)(?P<set>\]?(?:\\.|[^]\\])*)\]|\\(?P<plain>.)|(?P<other>.)")
_ESCAPED = re.compile(r"\\.", re.DOTALL)
_FOLDERS = "(?:[^/]*/)*"
_MEMBER = re.compile(r"\\?(.)(?:-\\?([^]]))?")


class Pattern(NamedTuple):
    """A pattern: what it fits, whether it takes back what patterns before it say (`!`), whether it means folders only.

    A pattern with a "/" before its end is matched against `whole` paths, any other against each name on its own.
    """

    expression: re.Pattern[str]
    whole: bool
    negated: bool
    folders_only: bool

    def ends(self, path: str) -> Iterator[int]:
        """Where the beginnings of a path end that are fitted: folders above it, and last the path itself."""
        start = 0
        for name in path.split("/"):
            end = start + len(name)
            if (end < len(path) or not self.folders_only) and self._fits(path, start, end):
                yield end
            start = end + 1

    def fits(self, path: str, *, folder: bool) -> bool:
        """Whether a path itself is fitted."""
        return (folder or not self.folders_only) and self._fits(path, path.rfind("/") + 1, len(path))

    def _fits(self, path: str, start: int, end: int) -> bool:
        return self.expression.fullmatch(path, 0 if self.whole else start, end) is not None


@cache
def read_pattern(line: str) -> Pattern | None:
    """The pattern in a line of a `.gitignore`; None for a blank line, a comment, and what can fit nothing."""
    text = _without_trailing_spaces(line.rstrip("\r\n"))
    if not text or text.startswith("#"):
        return None
    negated = text.startswith("!")
    text = text[negated:]
    body = text.removesuffix("/")
    whole = "/" in body
    body = _ESCAPED.sub(lambda found: "/" if found[0] == r"\/" else found[0], body.removeprefix("/"))
    expression = _expression(body, whole=whole) if body and body[0] != "/" else None
    return Pattern(expression, whole, negated, text.endswith("/")) if expression else None


def matches(path: str, lines: Iterable[str]) -> bool:
    """Whether a relative path with "/", or a folder above it, fits patterns, as in a `.gitignore`.

    Of those that fit one of them, the last counts.
    """
    said: dict[int, bool] = {}
    for pattern in filter(None, map(read_pattern, lines)):
        said.update(dict.fromkeys(pattern.ends(path), not pattern.negated))
    return any(said.values())


def _without_trailing_spaces(text: str) -> str:
    stripped = text.rstrip(" ")
    escapes = len(stripped) - len(stripped.rstrip("\\"))
    return stripped + " " * (escapes % 2 and len(text) > len(stripped))


def _expression(body: str, *, whole: bool) -> re.Pattern[str] | None:
    """The regular expression of a pattern; None for one that is not a pattern.

    The names between two `**`, and the letters between two `*`, are taken where they come first: what stands behind
    them can be fitted there if it can be fitted anywhere.
    """
    groups: list[list[str]] = [[]]
    for name in body.split("/") if whole else [body]:
        if whole and len(name) > 1 and not name.strip("*"):
            groups.append([])
            continue
        one = _of_name(name)
        if one is None:
            return None
        groups[-1].append(one)
    first, *between, last = ["/".join(group) for group in groups] if len(groups) > 1 else ["", "/".join(groups[0])]
    written = f"{first}/" if first else ""
    written += "".join(f"(?>{_FOLDERS}?{group}/)" for group in between if group)
    if len(groups) > 1:
        written += _FOLDERS if last else ".+"
    try:
        return re.compile(written + last, re.DOTALL)
    except re.error:  # a range of characters that ends before it begins
        return None


def _of_name(name: str) -> str | None:
    """The regular expression of a pattern between two "/".

    What follows a `*`, up to the next one, is taken where it comes first: a longer way round never fits more.
    """
    runs = [""]
    at = 0
    while at < len(name):
        found = _PIECE.match(name, at)
        if found is None or found["other"] in ("[", "\\") or "[:" in (found["set"] or ""):
            return None
        at = found.end()
        if found["stars"]:
            runs.append("")
        elif found["set"]:
            runs[-1] += _of_set(found["set"], "^/" if found["not"] else "")
        else:
            runs[-1] += re.escape(found["plain"] or found["other"]) if found[0] != "?" else "[^/]"
    first, *behind = runs
    return first + "".join(f"(?>[^/]*?{run})" for run in behind[:-1]) + (f"[^/]*{behind[-1]}" if behind else "")


def _of_set(members: str, start: str) -> str:
    """The regular expression of a class of characters, which never has a "/"."""
    ranges = (re.escape(low) + (f"-{re.escape(high)}" if high else "") for low, high in _MEMBER.findall(members))
    return f"(?!/)[{start}{''.join(ranges)}]"
