"""What may correct values that were read and from which other findings follow: numbers, points, copies, units."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import chain

from mudline.codes.references import REF007
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Problem, Span, Where
from mudline.linting.corrections import Blocks, Correction, line_at, start_of, whole
from mudline.syntax.edits import TextEdit
from mudline.syntax.tree import RawBlock

MOST_POINTS = 64
"""Points of a curve that are put in order."""

_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[EeDd][-+]?[0-9]+)?")
_ROW_NUMBER = re.compile(r"[ \t]*([0-9]{1,10})[ \t]*(?=,)")
_RIGID = re.compile(r"[ \t]*TYPE[ \t]*=[ \t]*(RIGID)[ \t\r\n]*", re.IGNORECASE)
_USER_UNITS = (".keyx", ".keyxu")
_OF_DENSITIES = ("UNT004", "UNT005", "UNT006")
"""Codes of rules that compare with the density of the water."""
_MASSES = (0.001, 1000.0)
"""Factors between units of mass that are exchanged: kilograms and tonnes."""


def value_corrections(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Return corrections of what was read as it stands and is at odds with the rest of the deck."""
    parts = (_numbers, _copies, _columns, _points, _law_lines, _rigid, _water)
    return chain.from_iterable(part(blocks, problems) for part in parts)


def _numbers(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """A number that is given twice: one of those that nothing has."""
    text = blocks.text
    missing = list(dict.fromkeys(one.lacks for one in problems if one.code.code in ("REF005", "REF006") and one.lacks))
    for problem in problems if missing else ():
        if problem.code is not REF007:
            continue
        line = line_at(text, start_of(text, problem))
        found = _ROW_NUMBER.match(text.source.unified, *line)
        for number in missing if found else ():
            if found and number in _between(text, line):
                message = f"number {found[1]} is given twice, and {number} is not defined: is this one {number}?"
                yield Correction(problem, (TextEdit(Span(*found.span(1)), number),), line, message, guessed=True)


def _between(text: TextOrigin, line: Span) -> set[str]:
    """The numbers that a row would have if it followed the row above it, or came before the one below it."""
    unified = text.source.unified
    above = _ROW_NUMBER.match(unified, *line_at(text, max(line.start - 1, 0)))
    below = _ROW_NUMBER.match(unified, *line_at(text, min(line.end + 1, len(unified))))
    after, before = (int(row[1]) if row else None for row in (above, below))
    return {str(each) for each in (after and after + 1, before and before - 1) if each}


def _copies(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Blocks of the model that stand there once more, word for word: without the copies."""
    text = blocks.text
    repeats = [one for one in problems if one.code.code in ("REF007", "REF016")]
    if not repeats:
        return
    unified = text.source.unified
    known: dict[str, RawBlock] = {}
    runs: list[list[tuple[RawBlock, RawBlock]]] = [[]]
    for name, block in blocks.blocks:
        written = unified[slice(*whole(block))].strip() if name == "MODEL" else ""
        if written and written in known:
            runs[-1].append((block, known[written]))
        elif runs[-1]:
            runs.append([])
        known.setdefault(written, block)
    for run in filter(None, runs):
        first, last = whole(run[0][0]), whole(run[-1][0])
        cause = next((one for one in repeats if first.start <= start_of(text, one) < last.end), None)
        if cause is None:
            continue
        begin, end = (text.source.position(at)[0] for at in (first.start, last.end - 1))
        original = text.source.position(run[0][1].head.span.start)[0]
        message = f"lines {begin} to {end} repeat what stands from line {original} on, word for word: remove them"
        edits = tuple(TextEdit(whole(block), "") for block, _ in run)
        yield Correction(cause, edits, Span(first.start, last.end), message)


# --------------------------------------------------------------------------------------------------------- curves


def _columns(_: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Curves with their columns exchanged."""
    for problem in problems:
        if problem.code.code == "CRV009" and problem.repair is not None:
            edits = tuple(TextEdit(span, written) for span, written in problem.repair.edits)
            yield Correction(problem, edits, Span(edits[0].span.start, edits[-1].span.end))


def _points(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Several findings about the shape of one curve: without the point of a large ratio, or with rising forces."""
    text = blocks.text
    of_curve: dict[Where, list[Problem]] = {}
    for problem in problems:
        where = problem.where
        if problem.code.code.startswith("CRV") and where is not None and "points" in where.path:
            curve = where._replace(path=where.path[: where.path.index("points")])
            of_curve.setdefault(curve, []).append(problem)
    for curve, found in of_curve.items():
        far = [one for one in found if one.code.code == "CRV010"]
        for problem in far if len(found) > 1 else ():
            line = line_at(text, start_of(text, problem))
            yield Correction(problem, (TextEdit(Span(line.start, line.end + 1), ""),), line)
        falling = [one for one in found if one.code.code == "CRV005"]
        if not far and len(falling) == 1 < len(found) and (edits := _rising(text, curve)):
            region = Span(edits[0].span.start, edits[-1].span.end)
            yield Correction(falling[0], edits, region, guessed=True)


def _rising(text: TextOrigin, curve: Where) -> tuple[TextEdit, ...]:
    """The points of a curve in their order, with its forces in rising order."""
    rows: list[tuple[Span, list[float]]] = []
    for number in range(MOST_POINTS + 1):
        span = text.span(curve.inside("points", number))
        if span is None or (rows and span.start <= rows[-1][0].start):
            break
        values = _NUMBER.findall(text.source.unified[slice(*span)])
        if len(values) != 2:
            return ()
        rows.append((span, [float(value.upper().replace("D", "E")) for value in values]))
    if not 1 < len(rows) <= MOST_POINTS:
        return ()
    forces = sorted(force for _, (_, force) in rows)
    ratios = sorted(ratio for _, (ratio, _) in rows)
    return tuple(
        TextEdit(span, f"{ratio!r}, {force!r}") for (span, _), ratio, force in zip(rows, ratios, forces, strict=True)
    )


# ----------------------------------------------------------------------------------------------------------- laws


def _law_lines(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Lines of *SEABED PROPERTIES under another keyword: its line above them."""
    text = blocks.text
    for problem in problems:
        if problem.code.code == "SBD006" and problem.repair is not None:
            edits = tuple(TextEdit(span, written) for span, written in problem.repair.edits)
            yield Correction(problem, edits, line_at(text, edits[0].span.start))


def _rigid(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """A rigid seabed under extensions that need an elastic one: an elastic one."""
    text = blocks.text
    cause = next((one for one in problems if one.code.code == "EXT001"), None)
    if cause is None:
        return
    edits: list[TextEdit] = []
    for _, block in blocks.blocks:
        if block.name == "SEABED PROPERTIES":
            found = (_RIGID.fullmatch(text.source.unified, *leaf.span) for leaf in block.leaves)
            edits += [TextEdit(Span(*one.span(1)), "ELASTIC") for one in found if one]
    if edits:
        yield Correction(cause, tuple(edits), line_at(text, start_of(text, cause)), place=edits[0].span)


# ---------------------------------------------------------------------------------------------------------- units


def _water(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """In user units, values that do not fit the density of the water: that density in the other unit of mass."""
    text = blocks.text
    wrong = [one for one in problems if one.code.code.startswith("UNT")]
    cause = next((one for one in wrong if one.code.code in _OF_DENSITIES), None)
    if cause is None or len(wrong) < 2 or not text.source.name.lower().endswith(_USER_UNITS):
        return
    ocean = next((block for name, block in blocks.blocks if (name, block.name) == ("MODEL", "OCEAN")), None)
    values = list(_NUMBER.finditer(text.source.unified, *whole(ocean))) if ocean else []
    if len(values) != 3:
        return
    density = values[1]
    place = Span(*density.span())
    for factor in _MASSES:
        other = f"{float(density[0]) * factor:.6g}"
        message = (
            f"the density {density[0]} of the water does not fit the rest of the deck, in which {other} would: "
            "write it in the deck's unit of mass"
        )
        edits = (TextEdit(place, other),)
        yield Correction(cause, edits, line_at(text, place.start), message, guessed=True, place=place)
