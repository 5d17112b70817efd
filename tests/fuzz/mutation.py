"""Decks changed as people and editors change them: lines doubled, moved and cut, fields replaced by edge values."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Sequence

EDGES = (
    *(b"", b"0", b"-1", b"-0.0", b"1e308", b"1e-320", b"1e999", b"nan", b"inf", b"2147483648", b"9" * 400, b"1,5"),
    *(b"1O", b"=[", b"=[1/0]", b"=[p]", b"=[((((1))))]", b"{", b"{a}", b'"', b"%p%", b"\xe9", b"\xff\xfe", b"\x00"),
    *(b"\x1a", b"\xe2\x80\xae", b"C", b"*", b"$", b"SET=", b"GEN=1, 9, 2", b"TYPE=", b"=", b"a" * 300, b"../x"),
    b"C mudline: ignore",
)
_FIELD = re.compile(rb"[^,\s=\"{}\[\]]+")
_MOST = 20_000
"""Bytes of a deck: longer ones make fewer inputs a second, and find no more."""


class Mutator:
    """Changes inputs; parts of others come from the seeds."""

    def __init__(self, seeds: Sequence[bytes], seed: int) -> None:
        self.random = random.Random(seed)  # noqa: S311 - repeatable, no secret
        self.seeds = [one for one in seeds if len(one) <= _MOST] or [b""]

    def made(self) -> bytes:
        """A seed with one to five changes."""
        return self.changed(self.random.choice(self.seeds), self.random.choice((1, 1, 1, 2, 3, 5)))

    def changed(self, data: bytes, times: int) -> bytes:
        """An input with so many changes."""
        for _ in range(times):
            change = self.random.choice(_CHANGES)
            data = change(self, data)[: 2 * _MOST]
        return data

    def line(self, lines: Sequence[bytes]) -> int:
        """The place of a line."""
        return self.random.randrange(len(lines)) if lines else 0


def _of_lines(change: Callable[[Mutator, list[bytes], int], None]) -> Callable[[Mutator, bytes], bytes]:
    def changed(by: Mutator, data: bytes) -> bytes:
        lines = data.splitlines(keepends=True)
        if lines:
            change(by, lines, by.line(lines))
        return b"".join(lines)

    return changed


@_of_lines
def _doubled(by: Mutator, lines: list[bytes], at: int) -> None:
    lines[at:at] = [lines[at]] * by.random.choice((1, 1, 2, 50))


@_of_lines
def _cut(by: Mutator, lines: list[bytes], at: int) -> None:
    del lines[at : at + by.random.choice((1, 1, 1, 3))]


@_of_lines
def _moved(by: Mutator, lines: list[bytes], at: int) -> None:
    lines.insert(by.line(lines), lines.pop(at))


@_of_lines
def _from_another(by: Mutator, lines: list[bytes], at: int) -> None:
    other = by.random.choice(by.seeds).splitlines(keepends=True)
    start = by.line(other)
    lines[at:at] = other[start : start + by.random.choice((1, 3, 12))]


@_of_lines
def _swallowed_end(_: Mutator, lines: list[bytes], at: int) -> None:
    lines[at] = lines[at].rstrip(b"\r\n")


@_of_lines
def _edge(by: Mutator, lines: list[bytes], at: int) -> None:
    fields = list(_FIELD.finditer(lines[at]))
    if fields:
        start, end = by.random.choice(fields).span()
        lines[at] = lines[at][:start] + by.random.choice(EDGES) + lines[at][end:]


_SLIPS: tuple[tuple[bytes, tuple[bytes, ...]], ...] = (
    (rb"[0-9]", (b"", b"0", b"7", b"O", b"33")),
    (rb"(?<![A-Za-z0-9])-?(?=[0-9.])", (b"-", b"")),
    (rb",", (b"", b" ", b";", b",,", b".")),
    (rb"\.", (b",", b"", b"..")),
    (rb"(?m)^[*$]", (b"", b"C ", b"**", b" *", b"$", b"*")),
    (rb"=", (b"", b" ", b"==", b":")),
    (rb"\b[A-Z]{2,}", (b"ALL", b"X")),
)
"""What a hand slips on: a piece of text, and what stands there then."""


def _slip(by: Mutator, data: bytes) -> bytes:
    pattern, others = by.random.choice(_SLIPS)
    places = [found.span() for found in re.finditer(pattern, data)]
    if not places:
        return data
    start, end = by.random.choice(places)
    return data[:start] + by.random.choice(others) + data[end:]


@_of_lines
def _other_case(by: Mutator, lines: list[bytes], at: int) -> None:
    lines[at] = by.random.choice((bytes.lower, bytes.upper, bytes.swapcase))(lines[at])


@_of_lines
def _misspelt(by: Mutator, lines: list[bytes], at: int) -> None:
    """Two letters change places, or one is doubled or lost, as in a keyword."""
    words = [at for at, line in enumerate(lines) if line[:1] in b"*$" and len(line.strip()) > 3] or [at]
    at = by.random.choice(words)
    line, place = lines[at], by.random.randrange(1, max(len(lines[at]) - 2, 2))
    one, two = line[place : place + 1], line[place + 1 : place + 2]
    lines[at] = line[:place] + by.random.choice((two + one, one + one + two, two)) + line[place + 2 :]


def _byte(by: Mutator, data: bytes) -> bytes:
    at = by.random.randrange(len(data) + 1)
    kind = by.random.randrange(3)
    new = bytes([by.random.randrange(256)]) if kind else b""
    return data[:at] + new + data[at + (kind != 1) :]


def _broken_off(by: Mutator, data: bytes) -> bytes:
    return data[: by.random.randrange(len(data) + 1)]


def _other_ends(by: Mutator, data: bytes) -> bytes:
    return data.replace(b"\n", by.random.choice((b"\r\n", b"\r", b"\n\n")))


_CHANGES = (
    *(_slip, _slip, _slip, _slip, _other_case, _misspelt),
    *(_edge, _edge, _edge, _doubled, _cut, _moved, _from_another, _byte, _byte),
    *(_swallowed_end, _broken_off, _other_ends),
)
