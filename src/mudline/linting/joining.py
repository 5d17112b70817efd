"""One cause, one finding: findings that repeat themselves, row after row, and those that say no more than another.

Nothing is read or checked for this: what is joined is known by the codes, places and words of the findings.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain
from typing import NamedTuple

from mudline.codes.fields import SYN002, SYN003, SYN015
from mudline.codes.lines import SYN001, SYN004, SYN012, SYN014
from mudline.codes.references import REF005, REF006, REF007
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import MORE, Problem, Repair, Severity, Span, Where
from mudline.diagnostics import Blocks as Blocking
from mudline.linting.recovery.blocks import also_in, line_at, whole
from mudline.short_repr import counted
from mudline.syntax.rows import NUMBER
from mudline.syntax.tree import RawBlock

# -------------------------------------------------------------------------------------- findings that repeat themselves

FEWEST = 3
"""Rows below each other, or fields of a row, that have one fault; two may each have a fault of their own."""

MOST_NAMED = 4
"""Rows below the first one whose numbers are named."""

_OF_ROWS = frozenset({SYN001, SYN002, SYN003, SYN004, SYN014, SYN015, REF007})
"""Codes of faults of a row, which one slip gives to many rows."""
_MISREAD = frozenset({SYN001, SYN002, SYN003})
"""Codes of rows whose values may not be what was meant."""
_OF_VALUES = ("UNT", "GEO")
"""How the codes of rules begin that judge the values of a row."""

_ROW_NUMBER = re.compile(r"[ \t]*([0-9]{1,10})[ \t]*(?=,)")
_RIGID = re.compile(r"[ \t]*TYPE[ \t]*=[ \t]*(RIGID)[ \t\r\n]*", re.IGNORECASE)
_OF_RIGID = ("EXT001", "EXT003", "SBD001")
"""Codes of what needs an elastic seabed."""
_DIGITS = re.compile(r"-?[0-9]+")
_STRENGTH = (Blocking.NEVER, Blocking.WITH_TENSION, Blocking.ALWAYS)

_Rows = dict[tuple[str, int], list[Problem]]
"""Findings by code and line."""


def joined_findings(text: TextOrigin, problems: list[Problem]) -> list[Problem]:
    """Return the findings with those under another one that say no more (`Problem.following`).

    These are what is said of the values of a row that was misread; further fields of a row with the same fault; rows,
    each directly below the one before, of which the same is said but for the digits; further lines that use a name or a
    number which is not defined; and what follows from a number given twice, from one point of a curve, from a rigid
    seabed, and from the density of the water.
    """
    rows: _Rows = {}
    for problem in problems:
        if problem.code in _OF_ROWS and problem.message != MORE:
            rows.setdefault((problem.code.code, text.place(problem).line), []).append(problem)
    groups = chain(
        _judged(text, problems, rows),
        _spelt_wrong(text, problems, rows),
        _on_one_line(text, problems),
        _alike(text, problems),
        _idle(problems),
        _repeated(text, rows),
        _meant_numbers(text, problems),
        _lacking(text, problems),
        _of_curves(problems),
        _of_rigid(text, problems),
        _of_water(text, problems),
    )
    under: dict[int, Problem] = {}
    hidden: set[int] = set()
    for one, others, words in groups:
        if id(one.first) not in hidden:
            cause = under.get(id(one.first), one.first)
            repair = one.repair or cause.repair
            cause = replace(cause, message=one.message or cause.message, span=one.place or cause.span, repair=repair)
            under[id(one.first)] = joined(cause, [under.get(id(each), each) for each in others], words)
            hidden.update(map(id, others))
    return [under.get(id(one), one) for one in problems if id(one) not in hidden]


class _Cause(NamedTuple):
    """The finding under which others are put, with other words and at another place where these say more."""

    first: Problem
    message: str = ""
    place: Span | None = None
    repair: Repair | None = None


_Group = tuple[_Cause, list[Problem], str]
"""A cause, what is put under it, and how that is said."""


def _judged(text: TextOrigin, problems: list[Problem], rows: _Rows) -> Iterator[_Group]:
    """What is said of the values of rows that were misread, by the first error of each row."""
    misread: dict[int, Problem] = {}
    for (_, line), found in rows.items():
        if found[0].code in _MISREAD and found[0].weight is Severity.ERROR and _may_be_moved(text, found[0]):
            misread.setdefault(line, found[0])
    about: dict[int, list[Problem]] = {}
    for problem in problems if misread else ():
        if problem.code.code.startswith(_OF_VALUES) and (line := text.place(problem).line) in misread:
            about.setdefault(line, []).append(problem)
    for line, found in about.items():
        yield _Cause(misread[line]), found, left_out(len(found))


def _may_be_moved(text: TextOrigin, problem: Problem) -> bool:
    """Whether the values of a row may be those of other columns: one that cannot be read, but for a comma, is alone."""
    span = problem.span
    return problem.code is not SYN002 or span is None or len(text.source.unified[slice(*span)].split()) > 1


def _of_all(first: Problem, others: Sequence[Problem]) -> Repair | None:
    """The repair of a finding with the edits of those that say the same; None where one of them has none."""
    repairs = [one.repair for one in (first, *others) if one.repair]
    if not first.repair or len(repairs) <= len(others):
        return None
    return replace(first.repair, edits=tuple(sorted({edit for repair in repairs for edit in repair.edits})))


def _line(text: TextOrigin, problem: Problem) -> str:
    return text.source.line(text.place(problem).line)


def _repeated(text: TextOrigin, rows: _Rows) -> Iterator[_Group]:
    """Further fields of the same row, and the rows below."""
    seen: set[tuple[str, int]] = set()
    for (code, line), found in sorted(rows.items()):
        if (code, line) in seen:
            continue
        run = [found]
        while (more := rows.get((code, line + len(run)))) and _said(more[0]) == _said(found[0]):
            run.append(more)
        below = run[1:] if len(run) >= FEWEST else []
        seen.update((code, line + number) for number in range(1, len(below) + 1))
        whole_row = len(found) == _line(text, found[0]).count(",") + 1
        same = found[1:] if len(found) >= FEWEST or whole_row or found[0].code is SYN014 else []
        fields = f"{counted(len(same), 'more field')} of this row" if same else ""
        ids = [number[1] for row in below if (number := _ROW_NUMBER.match(_line(text, row[0])))]
        named = f" ({', '.join(ids)})" if len(ids) == len(below) <= MOST_NAMED else ""
        lines = f"{len(below)} more rows of this block{named}, the last in line {line + len(below)}" if below else ""
        if others := [*same, *(one for row in below for one in row)]:
            yield (
                _Cause(found[0], repair=_of_all(found[0], others)),
                others,
                f"and {' and '.join(filter(None, (fields, lines)))}",
            )


def _lacking(text: TextOrigin, problems: list[Problem]) -> Iterator[_Group]:
    """Further lines that use a name or a number of a kind which is not defined."""
    lacking: dict[tuple[str, str], list[Problem]] = {}
    for problem in problems:
        if problem.lacks and problem.message != MORE:
            lacking.setdefault((problem.code.code, problem.lacks.casefold()), []).append(problem)
    for found in lacking.values():
        if len(found) > 1:
            first, *others = sorted(found, key=lambda one: text.place(one).line)
            yield _Cause(first, repair=_of_all(first, others)), others, also_in(text, others)


def _spelt_wrong(text: TextOrigin, problems: list[Problem], rows: _Rows) -> Iterator[_Group]:
    """A decimal comma of a setting, or the NUL character of a number, under what is said of the value."""
    for problem in problems:
        place = text.place(problem)
        misread = next((found[0] for code in _MISREAD if (found := rows.get((code.code, place.line)))), None)
        if misread is None or misread.weight is not Severity.ERROR:
            continue
        setting = problem.code is SYN015 and "=" in text.source.line(place.line)
        if setting or (problem.code is SYN012 and text.place(misread).column <= place.column):
            yield _Cause(misread), [problem], problem.message


_WITH_OTHERS = {"SYN003": ("STY009",), "CRV012": ("CRV005",), "REF006": ("GEO009", "GEO010")}
"""Codes, each with those that say more of it in the same line: why a row is wrong, where a curve falls, which nodes a
generator would make."""


def _on_one_line(text: TextOrigin, problems: list[Problem]) -> Iterator[_Group]:
    """What says more of another finding in its line, under that."""
    more = {code for codes in _WITH_OTHERS.values() for code in codes}
    of_line = {(one.code.code, text.place(one).line): one for one in problems if one.code.code in more}
    for problem in problems if of_line else ():
        line = text.place(problem).line
        codes = _WITH_OTHERS.get(problem.code.code, ())
        if others := [of_line[code, line] for code in codes if (code, line) in of_line]:
            generated = problem.code.code == "REF006"
            yield _Cause(problem), others, left_out(len(others)) if generated else others[0].message


def _alike(text: TextOrigin, problems: list[Problem]) -> Iterator[_Group]:
    """Further fields of a row of which the same is said."""
    alike: dict[tuple[str, int, str], list[Problem]] = {}
    for problem in problems:
        if problem.code not in _OF_ROWS and not problem.lacks and problem.message != MORE:
            alike.setdefault((problem.code.code, text.place(problem).line, problem.message), []).append(problem)
    for first, *others in alike.values():
        if others:
            yield (
                _Cause(first, repair=_of_all(first, others)),
                others,
                f"and {counted(len(others), 'more field')} of it",
            )


def _idle(problems: list[Problem]) -> Iterator[_Group]:
    """The one curve that nothing uses, under the one law that lacks a stiffness."""
    bare, idle = ([one for one in problems if one.code.code == code] for code in ("SBD006", "REF003"))
    if len(bare) == len(idle) == 1:
        yield _Cause(bare[0]), idle, idle[0].message


def _meant_numbers(text: TextOrigin, problems: list[Problem]) -> Iterator[_Group]:
    """A number that is given twice, where its neighbours say that it was to be one that nothing has."""
    lacking: dict[str, list[Problem]] = {}
    for problem in problems:
        if problem.lacks and problem.code in (REF005, REF006):
            lacking.setdefault(problem.lacks, []).append(problem)
    for problem in problems if lacking else ():
        if problem.code is REF007:
            found, near = _numbers_around(text, problem)
            for number in sorted(near & lacking.keys()) if found else ():
                message = f"number {found} is given twice, and {number} is not defined: is this one {number}?"
                yield _Cause(problem, message), lacking[number], left_out(len(lacking[number]))


def _numbers_around(text: TextOrigin, problem: Problem) -> tuple[str, set[str]]:
    """The number of a row, and those that it would have behind the row above it, or before the one below it."""
    unified = text.source.unified
    span = problem.span or (text.span(problem.where) if problem.where else None)
    if span is None:
        return "", set()
    line = line_at(text, span.start)
    places = (line, line_at(text, max(line.start - 1, 0)), line_at(text, min(line.end + 1, len(unified))))
    own, above, below = (_ROW_NUMBER.match(unified, *place) for place in places)
    near = ((above, 1), (below, -1))
    return own[1] if own else "", {str(int(row[1]) + step) for row, step in near if row}


def _of_curves(problems: list[Problem]) -> Iterator[_Group]:
    """What is said of a curve besides one point that is far off, exchanged columns, or forces that all fall."""
    of_curve: dict[Where, list[Problem]] = {}
    for problem in problems:
        where = problem.where
        if problem.code.code.startswith("CRV") and where is not None and "points" in where.path:
            curve = where._replace(path=where.path[: where.path.index("points")])
            of_curve.setdefault(curve, []).append(problem)
    for found in of_curve.values():
        codes = [one.code.code for one in found]
        cause = next((code for code in ("CRV009", "CRV010") if code in codes), "")
        if not cause and codes.count("CRV005") == 1 and {"CRV007", "CRV012"} <= {*codes}:
            cause = "CRV005"
        if cause and len(found) > 1:
            first = codes.index(cause)
            others = found[:first] + found[first + 1 :]
            yield _Cause(found[first]), others, left_out(len(others))


def _of_rigid(text: TextOrigin, problems: list[Problem]) -> Iterator[_Group]:
    """What a rigid seabed leaves without effect, where an extension says that the seabed must not be rigid."""
    cause = next((one for one in problems if one.code.code == "EXT001"), None)
    others = [one for one in problems if one.code.code in _OF_RIGID and one is not cause]
    rigid = [
        found
        for block in _blocks(text, "SEABED PROPERTIES")
        for leaf in block.leaves
        if (found := _RIGID.fullmatch(text.source.unified, *leaf.span))
    ]
    if cause is not None and others and rigid:
        yield _Cause(cause, place=Span(*rigid[0].span(1))), others, left_out(len(others))


def _blocks(text: TextOrigin, keyword: str) -> Iterator[RawBlock]:
    for section in text.tree.sections:
        if section.name == "MODEL":
            yield from (block for block in section.blocks if block.name == keyword)


_OCEAN_VALUES = 3
_OF_DENSITIES = ("UNT004", "UNT005", "UNT006")
"""Codes of rules that compare with the density of the water."""
_USER_UNITS = (".keyx", ".keyxu")
_TONNES = 10.0
"""Densities of water below this are in tonnes, of which the unit of force is 1000 times that of kilograms."""


def _of_water(text: TextOrigin, problems: list[Problem]) -> Iterator[_Group]:
    """In user units, values of several kinds that do not fit the density of the water, which says what units are."""
    wrong = [one for one in problems if one.code.code.startswith("UNT")]
    cause = next((one for one in wrong if one.code.code in _OF_DENSITIES), None)
    if cause is None or len({one.code for one in wrong}) == 1 or not text.source.name.lower().endswith(_USER_UNITS):
        return
    ocean = next(_blocks(text, "OCEAN"), None)
    values = list(NUMBER.finditer(text.source.unified, *whole(ocean))) if ocean else []
    if len(values) == _OCEAN_VALUES:
        density = values[1]
        factor = 1000.0 if float(density[0]) < _TONNES else 0.001
        message = (
            f"the density {density[0]} of the water does not fit the rest of the deck, in which "
            f"{float(density[0]) * factor:.6g} would: write it in the deck's unit of mass"
        )
        others = [one for one in wrong if one is not cause]
        yield _Cause(cause, message, Span(*density.span())), others, left_out(len(others))


def _said(problem: Problem) -> str:
    return _DIGITS.sub("0", problem.message)


def left_out(count: int) -> str:
    """How many findings follow from one, in words."""
    return f"{counted(count, 'finding')} that {'follows' if count == 1 else 'follow'} from it {_are(count)} left out"


def _are(count: int) -> str:
    return "is" if count == 1 else "are"


def joined(cause: Problem, others: Sequence[Problem], words: str) -> Problem:
    """A finding with others under it: as severe as the worst of them, and an error if one keeps from evaluation."""
    everything = (cause, *others)
    blocks = max((one.blocking for one in everything), key=_STRENGTH.index)
    severity = max((one.weight for one in everything), key=lambda severity: severity.rank)
    below = tuple(each for one in others for each in (replace(one, following=()), *one.following))
    return replace(
        cause,
        message=f"{cause.message}; {words}",
        severity=Severity.ERROR if blocks is Blocking.ALWAYS else severity,
        blocks=blocks,
        following=(*cause.following, *below),
    )
