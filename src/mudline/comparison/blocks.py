"""Blocks of two decks that the scene does not resolve as a whole: by keyword, record by record."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from difflib import SequenceMatcher

from mudline.comparison.flat import Flat, flatten
from mudline.comparison.model import Difference, Tolerance
from mudline.comparison.side import Side
from mudline.deck.model import Opaque
from mudline.diagnostics import Where
from mudline.keywords.model import Block

_ONE_IN_ALL = ("MODEL", "PREPROCESSOR")
"""Sections of which several make one."""
_COMMENT = re.compile(r"[Cc](?:(?:[ \t]|[-*=#_.~+]{2}).*)?$")
_MOST_MATCHED = 2000
"""Lines of a block between which the longest common part is sought."""

_Name = tuple[str, str]


def blocks(one: Side, other: Side, tolerance: Tolerance) -> Iterator[Difference]:
    """Modelled blocks by their values, the others by their data lines."""
    first, second = _modelled(one), _modelled(other)
    for name in dict.fromkeys([*first, *second]):
        before = flatten(one, first.get(name, []))
        after = flatten(other, second.get(name, []))
        found = flat_differences(_group(name), (one, before), (other, after), tolerance)
        yield from _presence(name, (one, first), (other, second), found)
    lines, others = _lines(one), _lines(other)
    for name in dict.fromkeys([*lines, *others]):
        yield from _opaque(name, (one, lines.get(name)), (other, others.get(name)))


def flat_differences(
    group: str, before: tuple[Side, Flat], after: tuple[Side, Flat], tolerance: Tolerance
) -> Iterator[Difference]:
    """Values by path that differ, or that only one of two decks has."""
    (one, first), (other, second) = before, after
    for path in dict.fromkeys([*first, *second]):
        old, new = first.get(path), second.get(path)
        where = f"{group}/{(one if old is not None else other).path(path)}"
        if old is not None and new is not None:
            if not tolerance.values(old.compared, new.compared):
                lines = one.line(old.where), other.line(new.where)
                yield Difference("changed", group, where, old.shown, new.shown, *lines)
        elif old is not None:
            yield Difference("removed", group, where, old.shown, None, one.line(old.where), None)
        elif new is not None:
            yield Difference("added", group, where, None, new.shown, None, other.line(new.where))


def _group(name: _Name) -> str:
    section, keyword = name
    return f"*{keyword}" if section == "MODEL" else f"${section} *{keyword}"


def _modelled(side: Side) -> dict[_Name, list[tuple[Where, Block]]]:
    found: dict[_Name, list[tuple[Where, Block]]] = {}
    titles = _titles(side)
    for i, section in enumerate(side.scene.deck.sections):
        for j, block in enumerate(section.blocks):
            name = (titles[i], block.keyword)
            if isinstance(block, Block) and not block.facts.defines:
                found.setdefault(name, []).append((Where(i, j), side.comparable(block, Where(i, j))))
    return found


def _titles(side: Side) -> list[str]:
    """The sections by name; a second load case, which is another one than the first, with its number."""
    counts: dict[str, int] = {}
    titles: list[str] = []
    for section in side.scene.deck.sections:
        count = counts[section.name] = counts.get(section.name, 0) + 1
        titles.append(section.name if count == 1 or section.name in _ONE_IN_ALL else f"{section.name} {count}")
    return titles


_Blocks = dict[_Name, list[tuple[Where, Block]]]


def _presence(
    name: _Name, before: tuple[Side, _Blocks], after: tuple[Side, _Blocks], found: Iterable[Difference]
) -> Iterator[Difference]:
    """A keyword that only one deck has is reported before its values; it may have none."""
    (one, first), (other, second) = before, after
    group = _group(name)
    if name not in second:
        yield Difference("removed", group, group, before_line=one.line(first[name][0][0]))
    if name not in first:
        yield Difference("added", group, group, after_line=other.line(second[name][0][0]))
    yield from found


_Lines = list[tuple[str, Where]]


def _lines(side: Side) -> dict[_Name, _Lines]:
    """Data lines without the blanks at their ends; those of blocks of one keyword follow one another."""
    found: dict[_Name, _Lines] = {}
    deck = side.scene.deck
    titles = _titles(side)
    if data := [(line, Where()) for line in _data(deck.preamble)]:
        found["", ""] = data
    for i, section in enumerate(deck.sections):
        if section.lines:
            found.setdefault((titles[i], ""), []).extend((line, Where(i)) for line in _data(section.lines))
        for j, block in enumerate(section.blocks):
            if isinstance(block, Opaque):
                lines = found.setdefault((titles[i], block.keyword), [])
                lines.append((f"*{block.keyword}", Where(i, j)))
                lines += [(line, Where(i, j)) for line in _data(block.lines)]
    return found


def _data(lines: list[str]) -> Iterator[str]:
    stripped = (line.strip(" \t\r") for line in lines if not _COMMENT.match(line))
    return (line for line in stripped if line)


def _opaque(name: _Name, before: tuple[Side, _Lines | None], after: tuple[Side, _Lines | None]) -> Iterator[Difference]:
    (one, first), (other, second) = before, after
    section, keyword = name
    title = _group(name) if keyword else f"${section}" if section else "before the first section"
    for tag, i, i_end, j, j_end in _changes([line for line, _ in first or []], [line for line, _ in second or []]):
        if tag == "equal":
            continue
        for line, where in (first or [])[i:i_end]:
            yield Difference("removed", title, f"{title}/lines", line, None, one.line(where), None)
        for line, where in (second or [])[j:j_end]:
            yield Difference("added", title, f"{title}/lines", None, line, None, other.line(where))


def _changes(one: list[str], other: list[str]) -> list[tuple[str, int, int, int, int]]:
    """What to do with stretches of lines; long texts are compared between their equal ends only."""
    if one == other:
        return []
    start = next((i for i, (a, b) in enumerate(zip(one, other, strict=False)) if a != b), min(len(one), len(other)))
    end, most = 0, min(len(one), len(other)) - start
    while end < most and one[-1 - end] == other[-1 - end]:
        end += 1
    first, second = one[start : len(one) - end], other[start : len(other) - end]
    if len(first) + len(second) > _MOST_MATCHED:
        return [("replace", start, len(one) - end, start, len(other) - end)]
    found = SequenceMatcher(None, first, second, autojunk=False).get_opcodes()
    return [(tag, i + start, i2 + start, j + start, j2 + start) for tag, i, i2, j, j2 in found]
