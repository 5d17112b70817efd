"""Path patterns in the syntax of `.gitignore`, translated to regular expressions."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from itertools import accumulate
from typing import NamedTuple

_PIECE = re.compile(r"(?P<stars>\*+)|\?|\[(?P<not>[!^]?)(?P<set>\]?(?:\\.|[^]\\])*)\]|\\(?P<plain>.)|(?P<other>.)")
_ESCAPED = re.compile(r"\\.", re.DOTALL)
_FOLDERS = "(?:[^/]*/)*"
_MEMBER = re.compile(r"\\?(.)(?:-\\?([^]]))?")


class PathPattern(NamedTuple):
    """A pattern of a path.

    A pattern with a "/" before its end is matched against the whole path, any other pattern against each name.

    Attributes:
        expression: the regular expression.
        whole: True if the pattern is matched against whole paths.
        negated: True if a match cancels earlier patterns (`!`).
        folders_only: True if the pattern matches only folders.
    """

    expression: re.Pattern[str]
    whole: bool
    negated: bool
    folders_only: bool

    def fits(self, path: str, *, folder: bool) -> bool:
        """Return True if the path itself matches, not only a folder above it."""
        start = 0 if self.whole else path.rfind("/") + 1
        return (folder or not self.folders_only) and self.expression.fullmatch(path, start) is not None


@cache
def read_pattern(line: str) -> PathPattern | None:
    """Return the pattern in a line of a `.gitignore`; None for a blank line, a comment or an invalid pattern."""
    text = _without_trailing_spaces(line.rstrip("\r\n"))
    if not text or text.startswith("#"):
        return None
    negated = text.startswith("!")
    text = text[negated:]
    body = text.removesuffix("/")
    whole = "/" in body
    body = _ESCAPED.sub(lambda match: "/" if match[0] == r"\/" else match[0], body.removeprefix("/"))
    expression = _expression(body, whole=whole) if body and body[0] != "/" else None
    return PathPattern(expression, whole, negated, text.endswith("/")) if expression else None


def matches(path: str, lines: Iterable[str]) -> bool:
    """Return True if a relative path with "/", or a folder above it, matches the patterns of a `.gitignore`.

    For each folder or file the last matching pattern decides.
    """
    patterns = list(filter(None, map(read_pattern, lines)))
    above = accumulate(path.split("/"), "{}/{}".format)
    return any(hides(reversed(patterns), part, folder=part != path) for part in above)


def hides(patterns: Iterable[PathPattern], path: str, *, folder: bool) -> bool | None:
    """Return True if the first of the patterns that matches a path is not negated; None if no pattern matches."""
    return next((not pattern.negated for pattern in patterns if pattern.fits(path, folder=folder)), None)


def _without_trailing_spaces(text: str) -> str:
    stripped = text.rstrip(" ")
    escapes = len(stripped) - len(stripped.rstrip("\\"))
    return stripped + " " * (escapes % 2 and len(text) > len(stripped))


def _expression(body: str, *, whole: bool) -> re.Pattern[str] | None:
    """Return the regular expression of a pattern; None for an invalid pattern.

    Names between two `**`, and letters between two `*`, match at the first possible place: if the following part
    matches at all, it matches there.
    """
    groups: list[list[str]] = [[]]
    for name in body.split("/") if whole else [body]:
        if whole and len(name) > 1 and not name.strip("*"):
            groups.append([])
            continue
        part = _of_name(name)
        if part is None:
            return None
        groups[-1].append(part)
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
    """Return the regular expression of a pattern between two "/"; None for an invalid pattern.

    The text after a `*`, up to the next one, matches at its first possible place: a later place never matches more.
    """
    runs = [""]
    at = 0
    while at < len(name):
        piece = _PIECE.match(name, at)
        if piece is None or piece["other"] in ("[", "\\") or "[:" in (piece["set"] or ""):
            return None
        at = piece.end()
        if piece["stars"]:
            runs.append("")
        elif piece["set"]:
            runs[-1] += _of_set(piece["set"], "^/" if piece["not"] else "")
        else:
            runs[-1] += re.escape(piece["plain"] or piece["other"]) if piece[0] != "?" else "[^/]"
    first, *behind = runs
    return first + "".join(f"(?>[^/]*?{run})" for run in behind[:-1]) + (f"[^/]*{behind[-1]}" if behind else "")


def _of_set(members: str, start: str) -> str:
    """Return the regular expression of a character class, which never matches "/"."""
    ranges = (re.escape(low) + (f"-{re.escape(high)}" if high else "") for low, high in _MEMBER.findall(members))
    return f"(?!/)[{start}{''.join(ranges)}]"
