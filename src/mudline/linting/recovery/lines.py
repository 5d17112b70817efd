"""Lines that another keyword or option has: a `*KEYWORD` line, its star, or an OPTION= is missing above them."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Iterator, Sequence
from functools import cache, lru_cache
from typing import NamedTuple

from mudline.codes.contact import SBD006
from mudline.codes.fields import SYN002, SYN003, SYN016
from mudline.codes.lines import SYN001, SYN004, SYN011, SYN013
from mudline.codes.references import REF007
from mudline.diagnostics import Problem, Repair, Severity, Span
from mudline.keywords import catalogue
from mudline.keywords.model import Block, FieldSpec, record_schema
from mudline.keywords.naming import set_slots
from mudline.keywords.reader import all_keys, reads, schemas_of
from mudline.keywords.values import Kind as Value
from mudline.keywords.values import Names
from mudline.linting.recovery.blocks import (
    ROW_NUMBER,
    Blocks,
    Correction,
    data_of,
    line_at,
    lines_of,
    recovers_from,
    start_of,
    whole,
)
from mudline.linting.recovery.names import key_of_points
from mudline.scene.names import CURVES
from mudline.scene.references import given_names
from mudline.scene.sets import set_key
from mudline.syntax.edits import TextEdit
from mudline.syntax.fields import first_key, trimmed
from mudline.syntax.source import Source
from mudline.syntax.tree import Kind, RawBlock, parse

LONGEST_PIECE = 600
"""Characters of a block that are read to see which keyword its lines belong to."""

MOST_NAMED = 5
"""Keywords that a finding names."""

_OF_FOREIGN_LINES = (SYN001, SYN002, SYN003, SYN004)
"""What the lines of another keyword give in a block."""

# ------------------------------------------------------------------------------------------------------------- the star


@recovers_from(*_OF_FOREIGN_LINES, SYN011, SYN013, SYN016, always=True)
def stars(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Lines that hold a keyword of their section without its star; where nothing is said of them, in column 1 only."""
    text = blocks.text
    said = {line_at(text, start_of(text, one)).start: one for one in reversed(problems)}
    for section in text.tree.sections:
        for leaf in (*section.leaves, *(leaf for block in section.blocks for leaf in block.leaves)):
            if leaf.kind not in (Kind.TEXT, Kind.UNDECIDED):
                continue
            line = line_at(text, leaf.span.start)
            written = text.source.unified[slice(*line)].rstrip()
            name = starless(written.lstrip(), section.name)
            problem = said.get(line.start)
            if not name or (problem is None and written[:1].isspace()):
                continue
            star = Span(line.start, line.start)
            comment = problem.code is SYN013 if problem else leaf.kind is not Kind.TEXT
            read = "a comment" if comment else "data"
            message = f"{written.strip()} without its star is read as {read}: write *{name}"
            repair = Repair("unsafe", f"write *{name}", ((Span(line.start, line.start + len(written)), f"*{name}"),))
            place = problem.span if problem else Span(line.start, line.start + len(written))
            known = problem if problem and problem.code is not SYN016 else None
            code = SYN013 if comment else known.code if known else SYN001
            cause = Problem(code, message, place, known.weight if known and not comment else None, repair=repair)
            certain = section.name in (catalogue.sections_of(name) or ())
            yield Correction(
                cause, (TextEdit(star, "*"),), Span(line.start, blocks.block_at(line.start).end), certain=certain
            )


def starless(line: str, section: str) -> str:
    """The keyword of a section that a line without a star is, or ""."""
    if not line[:1].isalpha() or "=" in line or line.upper() not in _known():
        return ""
    sections = catalogue.sections_of(line.upper())
    return "" if sections and section not in sections else line.upper()


@cache
def _known() -> frozenset[str]:
    return frozenset(catalogue.keywords())


# ------------------------------------------------------------------------------------------------ the line of a keyword


@recovers_from(SYN011)
def first_keyword(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Lines below a `$SECTION` line and above its first keyword: the keyword that they read as."""
    text = blocks.text
    stray = {start_of(text, one): one for one in problems}
    for section in text.tree.sections:
        lines = data_of(section.leaves)
        cause = next((stray[at] for at in stray if lines and lines[0].span.start <= at < lines[0].span.end), None)
        if cause is not None:
            yield from _keyword_line(blocks, section.name, "", cause, Span(lines[0].span.start, lines[-1].span.end))


@recovers_from(*_OF_FOREIGN_LINES, last=True)
def keyword_lines(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Lines in a block that read well as lines of another keyword: that keyword in front of them."""
    text = blocks.text
    wanted = sorted((start_of(text, one), number) for number, one in enumerate(problems))
    for section, block in blocks.blocks if wanted else ():
        first, end = (bisect_left(wanted, (at, 0)) for at in (block.head.span.end, whole(block).end))
        inside = wanted[first:end]
        if inside and any(problems[number].weight is Severity.ERROR for _, number in inside):
            yield from _missing_line(blocks, section, block, problems[inside[0][1]], inside[0][0])


def _missing_line(blocks: Blocks, section: str, block: RawBlock, cause: Problem, at: int) -> Iterator[Correction]:
    end = whole(block).end
    line = blocks.text.source.unified.rfind("\n", 0, at) + 1
    settings = [leaf.span.start for leaf in block.leaves if leaf.kind is Kind.SETTING and leaf.span.start < line]
    first = next((leaf.span.start for leaf in data_of(block.leaves)), end)
    for place in (at for at in (line, *settings[-1:]) if at > first):  # the block has lines of its own before it
        yield from _keyword_line(blocks, section, block.name, cause, Span(place, end), above=place < line)


def _keyword_line(
    blocks: Blocks, section: str, own: str, cause: Problem, lines: Span, *, above: bool = False
) -> Iterator[Correction]:
    """The keyword that some lines read as in front of them; of several, none: they are passed over."""
    found = reads_as(blocks, section, own, blocks.text.source.unified[slice(*lines)], legal=above)
    which = (
        f"the lines from line {blocks.text.source.position(lines.start)[0]} on"
        if above
        else "this line and those below it"
    )
    if len(found) == 1:
        message = f"{which} read as *{found[0]}: that line seems to be missing above them"
        yield Correction(cause, (TextEdit(Span(lines.start, lines.start), f"*{found[0]}\n"),), lines, message)
    elif found:
        names = " or ".join(f"*{keyword}" for keyword in found[:MOST_NAMED])
        message = f"{which} are of another keyword, {names}: its line seems to be missing above them"
        yield Correction(cause, (TextEdit(lines, ""),), lines, message)


@recovers_from(*_OF_FOREIGN_LINES, always=True)
def swallowed_curves(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Curves that the deck lacks, in a block that takes them for others, which nothing uses, or passes them through."""
    if blocks.keywords.isdisjoint(catalogue.users(Names.CURVE)):
        return
    unified = blocks.text.source.unified
    wrong = {blocks.block_at(start_of(blocks.text, one)).start for one in problems}  # looked at for that
    placed = ((line, blocks.raw_at(line.start(1))) for line in _name_of_curve().finditer(unified))
    others = [(line, block) for line, block in placed if block and _may_swallow(block.name)]
    lacked = {set_key(name) for name in blocks.missing[Names.CURVE]} if others else set()
    if lacked:
        lacked -= {set_key(name) for kind in CURVES for _, _, name in given_names(blocks.deck, kind)}
    for line, block in others:
        if set_key(line[1]) in lacked and block.head.span.start not in wrong:
            wrong.add(block.head.span.start)
            cause = Problem(SYN001, "", trimmed(unified, *line.span()))
            lines = Span(line.start(), whole(block).end)
            yield from _keyword_line(blocks, blocks.section_name(line.start(1)), block.name, cause, lines)


def _may_swallow(keyword: str) -> bool:
    """Whether a keyword is known, and defines no curve of the seabed."""
    return keyword not in catalogue.definers(Names.CURVE) and bool(catalogue.sections_of(keyword))


@cache
def _name_of_curve() -> re.Pattern[str]:
    """The line above the points of a curve of the seabed, with its name."""
    definers = filter(None, map(catalogue.declared, catalogue.definers(Names.CURVE)))
    keys = "|".join(filter(None, (key_of_points(declared)[0] for declared in definers)))
    return re.compile(rf"^[ \t]*(?:{keys})[ \t]*=([^,\r\n]*)", re.MULTILINE | re.IGNORECASE)


@recovers_from(REF007, always=True)
def elements_among_nodes(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:  # noqa: ARG001 - of text
    """Rows that begin the numbers of their block again, where the deck lacks the keyword that they read as."""
    text = blocks.text
    for block, declared in blocks.declared():
        lacking = [keyword for keyword in declared.facts.beside if keyword not in blocks.keywords]
        rows = bool(catalogue.facts_of(lacking[0]).defines) if lacking and declared.facts.defines else False
        given: set[str] = set()
        for line in lines_of(text, block) if rows and block.leaves else ():
            number = ROW_NUMBER.match(text.source.unified, *line)
            if number and number[1] in given:
                lines = Span(line.start, block.leaves[-1].span.end)
                thing = declared.facts.defines.removesuffix("s")
                cause = Problem(REF007, f"{thing} {number[1]} is defined twice", Span(*number.span(1)))
                yield from _keyword_line(blocks, "MODEL", block.name, cause, lines)
                break
            given.update(number.groups() if number else ())


def reads_as(blocks: Blocks, section: str, own: str, lines: str, *, legal: bool = False) -> list[str]:
    """The keywords of a section that take some lines as they stand, in the order of the alphabet.

    Those that define names which the deck lacks go before others, and those that it has not yet before those it has.
    Numbers alone fit many keywords: they are of one that stands beside others of the deck. Where the block above can
    have the first line (`legal`), only such names or a new keyword say that it is another one's.
    """
    piece = lines if len(lines) <= LONGEST_PIECE else lines[: lines.rfind("\n", 0, LONGEST_PIECE) + 1]
    text, block = _block(section, own or "-", piece)
    first = next(iter(data_of(block.leaves)), None)
    if first is None:
        return []
    if first.kind in (Kind.SETTING, Kind.UNDECIDED):
        candidates = _taking(section, first_key(text, first.span))
    else:
        beside = {other for each in blocks.keywords for other in catalogue.facts_of(each).beside}
        read = ((each, catalogue.block_class(section, each)) for each in sorted(beside - blocks.keywords))
        candidates = {each: one for each, one in read if one and not ("." in piece and _of_whole_numbers(one))}
    fitting = [
        keyword
        for keyword, declared in candidates.items()
        if keyword != own and reads(*_block(section, keyword, piece), declared)
    ]
    defining = {each: [what for what in blocks.missing if _defines(each, what)] for each in fitting}
    lacked = [each for each, kinds in defining.items() if any(blocks.missing[what] for what in kinds)]
    new = [each for each in fitting if each not in blocks.keywords and not (legal and defining[each])]
    return lacked or new or ([] if legal else fitting)


@lru_cache(256)
def _taking(section: str, key: str) -> dict[str, type[Block]]:
    """The keywords of a section that have a setting, with their declarations."""
    read = ((keyword, catalogue.block_class(section, keyword)) for keyword in catalogue.read_keywords())
    return {keyword: declared for keyword, declared in read if declared and key in all_keys(declared)}


def _block(section: str, keyword: str, lines: str) -> tuple[str, RawBlock]:
    """A block of some lines, and the text around it."""
    text = f"${section}\n*{keyword}\n{lines}"
    return text, parse(Source("", text, clean=True)).sections[0].blocks[0]


def _defines(keyword: str, what: Names) -> bool:
    declared = catalogue.declared(keyword)
    return declared is not None and any(
        slot.about.defines is what for one in schemas_of(declared) for slot in one.slots
    )


def _of_whole_numbers(declared: type[Block]) -> bool:
    """Whether every value that a row of a keyword must have is a whole number."""
    tables = [one.table.row for one in schemas_of(declared) if one.table and one.table.row]
    columns = [slot for row in tables for slot in record_schema(row).columns if slot.required]
    return bool(columns) and all(slot.kind in (Value.WHOLE, Value.IDENT) for slot in columns)


@recovers_from(SBD006, always=True)
def telling_lines(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:  # noqa: ARG001 - of text
    """Lines that one keyword alone has, among those that are passed through: that keyword above them."""
    unified = blocks.text.source.unified
    seen: set[int] = set()
    for section, block, line in _passed_through(blocks):
        keyword = catalogue.telling_lines().get("".join(unified[slice(*line)].split()).upper())
        if not keyword or block.head.span.start in seen or not catalogue.block_class(section, keyword):
            continue
        seen.add(block.head.span.start)
        message = f"*{block.name} has no such line: begin *{keyword} above it, else no seabed law applies"
        place = Span(line.start, line.start)
        repair = Repair("unsafe", f"begin *{keyword} above this line", ((place, f"*{keyword}\n"),))
        cause = Problem(SBD006, message, trimmed(unified, *line), repair=repair)
        yield Correction(cause, (TextEdit(place, f"*{keyword}\n"),), blocks.block_at(line.start), certain=True)


def _passed_through(blocks: Blocks) -> Iterator[tuple[str, RawBlock, Span]]:
    """The lines that are passed through in a section where their keyword belongs, with its name and their block."""
    text = blocks.text
    for number, section in enumerate(text.tree.sections):
        for index, block in enumerate(section.blocks):
            read = text.read.get((number, index))
            if (read is not None and not read.lost) or section.name not in (catalogue.sections_of(block.name) or ()):
                continue
            kept = read.places.kept if read else None
            yield from (
                (section.name, block, line) for line in lines_of(text, block) if kept is None or line.start in kept
            )


@recovers_from(SYN001, last=True)
def lost_names(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """A setting that stands twice below the name of a set: that of another one above it, which is not known."""
    seen: set[int] = set()
    for problem in problems:
        declared = blocks.declared_at(problem.span.start) if problem.span else None
        keys = {named.key for _, named in set_slots(declared)} if declared else set()
        if problem.span is None or len(keys) != 1 or not problem.message.endswith("= is given twice"):
            continue
        block = blocks.block_at(problem.span.start).start
        line = line_at(blocks.text, problem.span.start)
        if block not in seen:  # the settings below it are of the same set
            message = f"{problem.message}: a line {min(keys)}= seems to be missing above this one"
            edit = TextEdit(Span(line.start, line.start), f" {min(keys)}=\n")
            yield Correction(problem, (edit,), line, message, certain=True)
        seen.add(block)


# -------------------------------------------------------------------------------------------------- the OPTION= of rows


class _Formats(NamedTuple):
    """The setting that chooses the format of the rows of a keyword, and how many values a row of each has."""

    setting: FieldSpec
    counts: dict[str, range]


@cache
def _formats(declared: type[Block]) -> _Formats | None:
    """The formats of rows that a keyword has; None where it has one."""
    for slot in record_schema(declared).slots:
        for record in slot.record.values():
            known = {one.name: one for one in record_schema(record).slots}
            chosen = known.get(record.sticky)
            rows = {
                name: known[name.lower()].row for name in (chosen.choices if chosen else ()) if name.lower() in known
            }
            counts = {
                name: range(record_schema(row).fewest, len(record_schema(row).columns) + 1)
                for name, row in rows.items()
                if row
            }
            if chosen and counts:
                return _Formats(chosen, counts)
    return None


@recovers_from(SYN003)
def options(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Rows with as many values as another option has: that option above them."""
    text = blocks.text
    seen: set[int] = set()
    for problem in sorted(problems, key=lambda one: start_of(text, one)):
        at = start_of(text, problem)
        block, declared = blocks.raw_at(at), blocks.declared_at(at)
        formats = _formats(declared) if declared else None
        if block is None or formats is None or block.head.span.start in seen:
            continue
        seen.add(block.head.span.start)
        line = line_at(text, at)
        count = text.source.unified[slice(*line)].count(",") + 1
        above = [leaf.span for leaf in block.leaves if leaf.kind is Kind.SETTING and leaf.span.start < at]
        given = [span for span in above if first_key(text.source.unified, span) == formats.setting.key]
        chosen = text.source.unified[slice(*given[-1])].partition("=")[2].strip().upper() if given else ""
        chosen = chosen or formats.setting.about.default
        own = formats.counts.get(chosen, range(0))
        if not own or (given and own.start - 1 <= count <= own.stop):
            continue  # a value or a comma is missing
        fitting = [name for name, counts in formats.counts.items() if count in counts and name != chosen]
        most = max((formats.counts[name].start for name in fitting), default=0)
        fitting = [name for name in fitting if formats.counts[name].start == most]
        if not fitting or not above:
            continue
        option = f"{formats.setting.key}={fitting[0]}"
        names = " or ".join(f"{formats.setting.key}={name}" for name in fitting)
        wrong = f"this is no row of {chosen}" if count in own else f"{count} values are not {chosen}'s"
        place = line_at(text, above[-1].start)
        number = text.source.position(place.start)[0]
        if given and len(above) > 1 and given[-1] == above[-2]:
            place = line_at(text, given[-1].start)
            message = f"{wrong}: write {names} in line {number - 1}"
            edit = TextEdit(place, f" {option}")
        else:
            message = f"{wrong}: {names} seems to be missing above line {number}"
            edit = TextEdit(Span(place.start, place.start), f" {option}\n")
        yield Correction(problem, (edit,), Span(place.start, whole(block).end), message)
