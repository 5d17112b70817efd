"""Lines that belong to another keyword: its `*KEYWORD` line, its star or the name of their set is missing.

Here are also the input of a corrector, the blocks of a deck's text, and its output: a correction of a fault.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property, lru_cache
from itertools import pairwise

from mudline.checks.context import ROW_NUMBER, LintContext
from mudline.checks.rules.coverage import SBD008
from mudline.language.codes.contact import SBD006
from mudline.language.codes.fields import SYN002, SYN003, SYN016
from mudline.language.codes.lines import SYN001, SYN013
from mudline.language.codes.references import REF007
from mudline.language.deck.parameters import name_key
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Problem, Severity, Span
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import is_choice, kinds_of, opened, repeated_set
from mudline.language.keywords.model import Block, record_schema
from mudline.language.keywords.reader import ReadBlock, all_keys, reads, schemas_of
from mudline.language.keywords.values import Facts, Kind, Names
from mudline.language.syntax.edits import TextEdit
from mudline.language.syntax.fields import first_key, trimmed
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import Leaf, LeafKind, RawBlock, parse
from mudline.model.scene.references import CURVES, THINGS
from mudline.model.scene.sets import ALL

LONGEST_PIECE = 600
"""Number of characters of a block that are read to see which keyword its lines belong to."""
MOST_NAMED = 5
"""Number of keywords that a finding names."""
NAMED = CURVES | THINGS | {Names.SET, Names.CURVE}
"""Kinds of names that show the keyword of lines: a name of theirs is used and not defined."""


# ------------------------------------------------------------------------------------------- blocks and corrections


@dataclass(frozen=True, slots=True)
class Correction:
    """Edits that may correct a fault, and the part of the text that they change.

    cause: the finding of the fault.
    edits: the edits.
    region: the part of the text that is read differently with them.
    message: message of the finding if the correction is accepted, "" for its own message.
    does: the effect of the edits in words; the finding then has them as an unsafe repair.
    certain: the correction needs no trial.
    joins: the correction makes its lines part of the block above.
    """

    cause: Problem
    edits: tuple[TextEdit, ...]
    region: Span
    message: str = ""
    does: str = ""
    certain: bool = False
    joins: bool = False


def start_of(text: TextOrigin, problem: Problem) -> int:
    """Return the offset of a problem in the text, -1 if it has no place there."""
    span = text.span_of(problem)
    return -1 if span is None else span.start


def data_of(leaves: Sequence[Leaf]) -> list[Leaf]:
    """Return the lines that are not comments."""
    return [leaf for leaf in leaves if leaf.kind not in (LeafKind.COMMENT, LeafKind.BLANK)]


def lines_of(text: TextOrigin, block: RawBlock) -> Iterator[Span]:
    """Yield the lines of a block below its head, without their ends."""
    first, last = (text.source.position(at)[0] for at in (block.span.start, block.span.end - 1))
    return map(text.source.line_span, range(first + 1, last + 1))


class Blocks:
    """Blocks of a deck's text by their place.

    at: finds the section or block around an offset.
    blocks: all blocks, each with the name of its section.
    keywords: names of all blocks.
    """

    def __init__(self, context: LintContext, text: TextOrigin) -> None:
        self.context = context
        self.deck = context.deck
        self.text = text
        self.at = text.tree.at
        self.blocks = [(spot.section.name, spot.block) for spot in text.tree.spots if spot.block]
        self.keywords = {block.name for _, block in self.blocks}
        self._missing: dict[Names, list[str]] = {}

    def declared_at(self, offset: int) -> type[Block] | None:
        """Return the declaration of the block around an offset; None if its lines are not read."""
        spot = self.at(offset)
        return catalogue.block_class(spot.section.name, spot.keyword)

    def line_of(self, problem: Problem) -> Span:
        """Return the line of a problem, without its end."""
        return self.text.source.line_around(start_of(self.text, problem))

    def first_of_lines(self, problems: Sequence[Problem]) -> dict[Span, Problem]:
        """Return the lines of some problems, each with its first problem."""
        return {self.line_of(one): one for one in reversed(problems)}

    def missing(self, what: Names) -> list[str]:
        """Return the names of a kind that are used and not defined."""
        if what not in self._missing:
            defined = {ALL} if what is Names.SET else set[str]()
            found = [one for one in self.context.names if one.kind is what]
            models = (one for one in found if self.deck.sections[one.where.section].name == "MODEL")
            defined |= {name_key(one.name) for one in models if one.role == "defines"}
            given = (one.name for one in found if one.role == "names")
            self._missing[what] = list(dict.fromkeys(name for name in given if name and name_key(name) not in defined))
        return self._missing[what]

    @cached_property
    def lacked_curves(self) -> dict[str, list[Names]]:
        """Names of curves that are used and not defined, each with the kinds of curves that it may be."""
        found: dict[str, list[Names]] = {}
        for kind in (Names.CURVE, *CURVES):
            for name in self.missing(kind):
                found.setdefault(name_key(name), []).append(kind)
        return found


# ------------------------------------------------------------------------------------------------------------- the star


def stars(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Yield corrections of lines that are a keyword without its star, or a section without its dollar.

    Lines without a problem are considered in column 1 only.
    """
    text = blocks.text
    problems_by_line = blocks.first_of_lines(problems)
    for section in text.tree.sections:
        for leaf in (*section.leaves, *(leaf for block in section.blocks for leaf in block.leaves)):
            if leaf.kind not in (LeafKind.TEXT, LeafKind.UNDECIDED):
                continue
            line = text.source.line_around(leaf.span.start)
            written = text.source.unified[slice(*line)].rstrip()
            name = _marked(written.lstrip(), section.name)
            problem = problems_by_line.get(line)
            if not name or (problem is None and written[:1].isspace()):
                continue
            comment = problem.code is SYN013 if problem else leaf.kind is not LeafKind.TEXT
            read = "a comment" if comment else "data"
            mark = "star" if name[0] == "*" else "dollar"
            message = f"{written.strip()} without its {mark} is read as {read}: write {name}"
            own = Span(line.start, line.start + len(written))
            place = problem.span if problem else own
            known = problem if problem and problem.code is not SYN016 else None
            code = SYN013 if comment else known.code if known else SYN001
            cause = Problem(code, message, place, known.weight if known and not comment else None)
            certain = name[0] == "$" or section.name in (catalogue.sections_of(name[1:]) or ())
            lines = Span(line.start, blocks.at(line.start).span.end)
            yield Correction(cause, (TextEdit(own, name),), lines, does=f"write {name}", certain=certain)


def _marked(line: str, section: str) -> str:
    """Return the keyword of a section that a line without a star is, or the section, with its mark; or ""."""
    name = line.upper()
    if not line[:1].isalpha() or "=" in line:
        return ""
    sections = catalogue.sections_of(name)
    if sections is not None and (not sections or section in sections):
        return f"*{name}"
    return f"${name}" if name in catalogue.SECTIONS else ""


# ------------------------------------------------------------------------------------------------ the line of a keyword


def keyword_lines(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Yield corrections that put a keyword in front of lines that read well as its lines."""
    text = blocks.text
    by_start = sorted((start_of(text, problem), number) for number, problem in enumerate(problems))
    for section, block in blocks.blocks if by_start else ():
        first, end = (bisect_left(by_start, (at, 0)) for at in (block.head.span.end, block.span.end))
        inside = by_start[first:end]
        if inside and any(problems[number].weight is Severity.ERROR for _, number in inside):
            yield from _missing_line(blocks, section, block, problems[inside[0][1]], inside[0][0])


def _missing_line(blocks: Blocks, section: str, block: RawBlock, cause: Problem, at: int) -> Iterator[Correction]:
    end = block.span.end
    line = blocks.text.source.unified.rfind("\n", 0, at) + 1
    settings = [leaf.span.start for leaf in block.leaves if leaf.kind is LeafKind.SETTING and leaf.span.start < line]
    first = next((leaf.span.start for leaf in data_of(block.leaves)), end)
    declared = catalogue.block_class(section, block.name)
    key = first_key(blocks.text.source.unified, blocks.text.source.line_around(line))
    is_own = declared is not None and cause.code in (SYN002, SYN003) and key in all_keys(declared)  # a value is wrong
    places = [*([] if is_own else [line]), *settings[-1:]]
    for place in (at for at in places if at > first):  # the block has lines of its own before it
        legal = () if place == line else blocks.keywords
        corrections = [*_keyword_line(blocks, section, block.name, cause, Span(place, end), legal)]
        if corrections:
            yield from corrections
            return


def _keyword_line(
    blocks: Blocks, section: str, own: str, cause: Problem, lines: Span, present: Collection[str] = ()
) -> Iterator[Correction]:
    """Yield the correction with the keyword that some lines belong to; if several fit, the lines are passed over.

    For `present` see `reads_as`.
    """
    unified = blocks.text.source.unified
    keywords = reads_as(blocks, section, own, unified[slice(*lines)], present)
    which = "this line and those below it"
    if unified.count("\n", lines.start, start_of(blocks.text, cause)):
        which = f"the lines from line {blocks.text.source.position(lines.start)[0]} on"
    above = Span(lines.start, lines.start)
    if len(keywords) == 1:
        message = f"{which} read as *{keywords[0]}: that line seems to be missing above them"
        edits = (TextEdit(above, f"*{keywords[0]}\n"),)
        yield Correction(cause, edits, lines, message, does=f"write *{keywords[0]} above them")
    elif keywords:
        names = " or ".join(f"*{keyword}" for keyword in keywords[:MOST_NAMED])
        message = f"{which} are of another keyword, {names}: its line seems to be missing above them"
        lacked = any(map(blocks.missing, _defined_by(section, keywords[0])))  # all of them define such names
        edit = TextEdit(above, f"*{keywords[0]}\n") if lacked else TextEdit(lines, "")
        yield Correction(cause, (edit,), lines, message)


def reads_as(blocks: Blocks, section: str, own: str, lines: str, present: Collection[str] = ()) -> list[str]:
    """Return the keywords of a section that accept some lines as they are, in alphabetical order.

    Keywords that define names which the deck lacks come first, then keywords that the deck does not have yet. Rows
    alone fit many keywords: only those count that accompany other keywords of the deck, or define its parameters. If
    the keywords `present` are given, the block above can have the first line. Then only keywords count that define
    lacking names, or are not among `present`.
    """
    piece = lines if len(lines) <= LONGEST_PIECE else lines[: lines.rfind("\n", 0, LONGEST_PIECE) + 1]
    text, block = _block(section, own or "-", piece)
    first = next(iter(data_of(block.leaves)), None)
    if first is None:
        return []
    if first.kind in (LeafKind.SETTING, LeafKind.UNDECIDED):
        candidates = _taking(section, first_key(text, first.span))
    else:
        beside = {other for each in blocks.keywords for other in catalogue.facts_of(each).beside}
        beside.update(catalogue.definers(Names.PARAMETER) if "=[" in blocks.text.source.unified else ())
        read = ((each, catalogue.block_class(section, each)) for each in sorted(beside - blocks.keywords))
        candidates = {each: one for each, one in read if one and not ("." in piece and _of_whole_numbers(one))}
    fitting = [
        keyword
        for keyword, declared in candidates.items()
        if keyword != own and reads(*_block(section, keyword, piece), declared)
    ]
    lacked = [each for each in fitting if any(map(blocks.missing, _defined_by(section, each)))]
    if present:
        return lacked or [each for each in fitting if each not in present and not _defined_by(section, each)]
    return lacked or [each for each in fitting if each not in blocks.keywords] or fitting


@lru_cache(256)
def _taking(section: str, key: str) -> dict[str, type[Block]]:
    """Return the keywords of a section that have a setting, with their declarations."""
    read = ((keyword, catalogue.block_class(section, keyword)) for keyword in catalogue.read_keywords())
    return {keyword: declared for keyword, declared in read if declared and key in all_keys(declared)}


def _block(section: str, keyword: str, lines: str) -> tuple[str, RawBlock]:
    """Return a block of some lines, and the text around it."""
    text = f"${section}\n*{keyword}\n{lines}"
    return text, parse(Source("", text, clean=True)).sections[0].blocks[0]


def _defined_by(section: str, keyword: str) -> frozenset[Names]:
    """Return the kinds of names that the lines of a keyword define."""
    declared = catalogue.declared(keyword, section)
    return (kinds_of(declared, "defines") & NAMED) if declared else frozenset()


def _of_whole_numbers(declared: type[Block]) -> bool:
    """Return True if every required value in the rows of a keyword is a whole number."""
    tables = [table.row for schema in schemas_of(declared) for table in schema.tables if table.row]
    columns = [slot for row in tables for slot in record_schema(row).columns if slot.required]
    return bool(columns) and all(slot.kind in (Kind.WHOLE, Kind.IDENT) for slot in columns)


def legal_lines(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Yield corrections of lines that a block can have, but that belong to another keyword, which is missing."""
    text = blocks.text
    worse = (one for one in problems if one.weight is not Severity.INFO)
    wrong = {blocks.at(start_of(text, one)).span.start for one in worse}
    for number, section in enumerate(text.tree.sections):
        present = {block.name for block in section.blocks}
        for index, block in enumerate(section.blocks):
            if block.head.span.start in wrong or section.name not in (catalogue.sections_of(block.name) or ()):
                continue
            for cause in _first_lines(blocks, block, text.read.get((number, index))):
                lines = Span(blocks.line_of(cause).start, block.span.end)
                found = [*_keyword_line(blocks, section.name, block.name, cause, lines, present)]
                yield from (replace(one, message=f"{cause.message}{one.message}") for one in found)
                if found:
                    break


def _first_lines(blocks: Blocks, block: RawBlock, read: ReadBlock | None) -> Iterator[Problem]:
    """Yield the places in a block where lines of another keyword may begin, with the start of their message.

    They begin with the name of a curve that is not defined, or a number that the block has above; otherwise with a set
    that is given a second time with other values, or a line that the block passes through.
    """
    text = blocks.text
    unified = text.source.unified
    facts = read.model.facts if read else Facts()
    lacking = [keyword for keyword in facts.beside if facts.defines and keyword not in blocks.keywords]
    for name in _name_of_curve().finditer(unified, *block.span) if blocks.lacked_curves else ():
        kinds = blocks.lacked_curves.get(name_key(name[1]), [])
        if len(kinds) == 1 and block.name not in catalogue.definers(kinds[0]):
            yield Problem(SYN001, "", trimmed(unified, *name.span()))
            return
    numbers: set[str] = set()
    for line in lines_of(text, block) if lacking else ():
        number = ROW_NUMBER.match(unified, *line)
        if number and number[1] in numbers:
            beginning = f"{facts.defines.removesuffix('s')} {number[1]} is defined twice, and "
            yield Problem(REF007, beginning, Span(*number.span(1)))
            return
        numbers.update(number.groups() if number else ())
    # Rows fit many keywords.
    by_settings = facts.later_wins and all(each.kind is LeafKind.SETTING for each in data_of(block.leaves))
    path = repeated_set(read.model) if read and by_settings else ()
    again = read.places.find(path) if read and path else None
    for start in [again.start] if again else _foreign_lines(text, block, read):
        line = trimmed(unified, *text.source.line_around(start))
        beginning = f"*{block.name} has {unified[slice(*line)]} above, and " if again else ""
        code = SBD008 if again else SBD006 if _is_telling(unified, line) else SYN001
        yield Problem(code, beginning, line, Severity.WARNING)


def _is_telling(unified: str, line: Span) -> bool:
    """Return True if only one keyword has a line, and it gives the laws of the seabed, which would be missing."""
    return "".join(unified[slice(*line)].split()).upper() in catalogue.telling_lines()


@cache
def _name_of_curve() -> re.Pattern[str]:
    """Return the pattern of the line above the points of a curve, with its name."""
    kinds = {Names.CURVE, *CURVES}
    definers = {catalogue.declared(keyword) for kind in kinds for keyword in catalogue.definers(kind)}
    slots = (slot for each in definers if each for schema in schemas_of(each) for slot in schema.slots)
    keys = "|".join(sorted({slot.key for slot in slots if slot.about.defines in kinds}))
    return re.compile(rf"^[ \t]*(?:{keys})[ \t]*=([^,\r\n]*)", re.MULTILINE | re.IGNORECASE)


def _foreign_lines(text: TextOrigin, block: RawBlock, read: ReadBlock | None) -> list[int]:
    """Return the offsets of settings that a block passes through, or that open lines by an unknown value.

    Before each of them comes the setting on the line above it. The last line of a block alone shows too little. In a
    block that is not read at all, lines count that only one keyword has.
    """
    unified = text.source.unified
    if read is None:
        return [line.start for line in lines_of(text, block) if _is_telling(unified, line)]
    leaves = data_of(block.leaves) if read.lost else []
    kept = read.places.kept_starts if leaves else frozenset()
    offsets: list[int] = []
    declared, behind = type(read.model), False
    for above, leaf in pairwise(leaves[:-1]):
        line = text.source.line_around(leaf.span.start)
        key, value = first_key(unified, line), unified[slice(*line)].partition("=")[2]
        choice = is_choice(declared, key, value)
        unknown = bool(opened(declared, key, value)) and not choice
        behind = choice or (behind and line.start in kept)  # lines of an unknown form belong there
        if leaf.kind is LeafKind.SETTING and not behind and (unknown or line.start in kept):
            begins = above.kind is LeafKind.SETTING and above is not leaves[0]
            offsets += [text.source.line_around(above.span.start).start, line.start] if begins else [line.start]
    return list(dict.fromkeys(offsets))[:MOST_NAMED]
