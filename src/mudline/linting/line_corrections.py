"""What may correct lines from which other findings follow: a `*KEYWORD` line, a name, a number, commas."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain

from mudline.codes.fields import SYN002, SYN003
from mudline.codes.lines import SYN001, SYN004, SYN011, SYN013, SYN014
from mudline.codes.references import REF007
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Problem, Severity, Span
from mudline.keywords import catalogue
from mudline.keywords.model import record_schema
from mudline.keywords.reader import all_keys, read_block, schemas_of
from mudline.keywords.values import Kind as Value
from mudline.linting.corrections import Blocks, Correction, line_at, start_of, whole
from mudline.syntax.edits import TextEdit
from mudline.syntax.fields import first_key
from mudline.syntax.rows import NUMBER, read_number
from mudline.syntax.source import Source
from mudline.syntax.tree import Kind, RawBlock, parse

MOST_SETTINGS = 8
"""Settings of a block that may be the values of one row."""

LONGEST_PIECE = 600
"""Characters of a block that are read to see which keyword its lines belong to."""

_OF_FOREIGN_LINES = (SYN001, SYN002, SYN003, SYN004)
"""What the lines of another keyword give in a block."""
_EACH_OTHER = {"NODE": "ELEMENT", "ELEMENT": "NODE"}
"""Keywords of rows of numbers, and the one that a deck with it has besides."""
_ROW_NUMBER = re.compile(r"[ \t]*([0-9]{1,10})[ \t]*(?=,)")
_MISREAD = str.maketrans({"O": "0", "o": "0", "l": "1", "I": "1"})
_GAP = re.compile(r"(?<=[0-9.])(?:[ \t]+|[ \t]*;[ \t]*)(?=[-+.0-9])")
_STAR = "*"
_UNIT = re.compile(r"[ \t]*[A-Za-z%]")
_CURVE_NAMES = {"EMBEDMENT": "SET", "SEABED STIFFNESS": "CURVE"}
"""Keywords of points, and the setting that names the curve."""
_VALUES = {"RIGID": range(5, 9), "MOORING": range(3, 4)}
"""Options of *GEOMETRIC SETS and how many values their rows have, where those of FLEXIBLE have another count."""
_NAMED_POINT = re.compile(r"[ \t]*([^-+.,=0-9 \t][^,=\n]*?)[ \t]*,[ \t]*([-+.0-9][^\n\r]*?)[ \t\r]*")
_LACKS_NAME = re.compile(r"expected (CURVE|SET)= before this line|(SET|CURVE)= has no value")


def line_corrections(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Return corrections of lines that cannot be read as they stand."""
    if not any(one.code in (*_OF_FOREIGN_LINES, SYN011, SYN013, SYN014) for one in problems):
        return _elements_among_nodes(blocks)
    parts = (_stars, _tables, _first_keyword, _options, _names, _settings, _cut_off, _rows)
    found = [one for part in parts for one in part(blocks, problems)]
    explained = {id(one.cause) for one in found}
    others = [one for one in problems if one.repair is None and id(one) not in explained]
    among = () if any(one.edits[0].text == _STAR for one in found) else _elements_among_nodes(blocks)
    return chain(found, _keyword_lines(blocks, others), among)


# ------------------------------------------------------------------------------------------- *KEYWORD lines


def _stars(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Lines that hold a keyword without its star."""
    text = blocks.text
    known: frozenset[str] | None = None
    for problem in problems:
        if problem.code not in _OF_FOREIGN_LINES or problem.weight is not Severity.ERROR:
            continue
        line = line_at(text, start_of(text, problem))
        written = text.source.unified[slice(*line)].strip()
        if not written[:1].isalpha() or "=" in written:
            continue
        known = known or frozenset(catalogue.keywords())
        if written.upper() in known:
            message = f"{written} without its star is read as data: write *{written.upper()}"
            region = Span(line.start, blocks.block_at(line.start).end)
            certain = blocks.section_name(line.start) in (catalogue.sections_of(written.upper()) or ())
            yield Correction(
                problem, (TextEdit(Span(line.start, line.start), _STAR),), region, message, certain=certain
            )


def _keyword_lines(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Lines in a block that read well as lines of another keyword: that keyword in front of them."""
    text = blocks.text
    wanted = sorted(
        (start_of(text, one), number) for number, one in enumerate(problems) if one.code in _OF_FOREIGN_LINES
    )
    if not wanted:
        return
    for section in text.tree.sections:
        for block in section.blocks:
            end = (block.leaves or [block.head])[-1].span.end
            inside = [(at, number) for at, number in wanted if block.head.span.end <= at < end]
            if inside and any(problems[number].weight is Severity.ERROR for _, number in inside):
                yield from _missing_line(blocks, section.name, block, problems[inside[0][1]], inside[0][0])


def _missing_line(blocks: Blocks, section: str, block: RawBlock, cause: Problem, at: int) -> Iterator[Correction]:
    text = blocks.text
    unified = text.source.unified
    end = block.leaves[-1].span.end
    line = unified.rfind("\n", 0, at) + 1
    settings = [leaf.span.start for leaf in block.leaves if leaf.kind is Kind.SETTING and leaf.span.start < line]
    first = next((leaf.span.start for leaf in block.leaves if leaf.kind not in (Kind.COMMENT, Kind.BLANK)), end)
    for place in (at for at in (line, *settings[-1:]) if at > first):  # the block has lines of its own before it
        for keyword in _reads_as(blocks, section, block.name, unified[place:end], legal=place < line):
            number = text.source.position(place)[0] if place < line else None
            yield _keyword_line(keyword, cause, Span(place, end), number)


def _keyword_line(keyword: str, cause: Problem, lines: Span, number: int | None = None) -> Correction:
    """The line of a keyword above some lines, which begin in line `number` if that is not the one of the problem."""
    which = "this line and those below it" if number is None else f"the lines from line {number} on"
    message = f"{which} read as *{keyword}: that line seems to be missing above them"
    edit = TextEdit(Span(lines.start, lines.start), f"*{keyword}\n")
    return Correction(cause, (edit,), lines, message)


def _first_keyword(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Lines below a `$SECTION` line and above its first keyword: the keyword that they read as."""
    text = blocks.text
    stray = {start_of(text, one): one for one in problems if one.code is SYN011}
    for section in text.tree.sections if stray else ():
        lines = [leaf for leaf in section.leaves if leaf.kind not in (Kind.COMMENT, Kind.BLANK)]
        cause = next((stray[at] for at in stray if lines and lines[0].span.start <= at < lines[0].span.end), None)
        if cause is None:
            continue
        place, end = lines[0].span.start, section.leaves[-1].span.end
        for keyword in _reads_as(blocks, section.name, "", text.source.unified[place:end]):
            yield _keyword_line(keyword, cause, Span(place, end))


def _elements_among_nodes(blocks: Blocks) -> Iterator[Correction]:
    """Rows of *NODE that begin its numbers again, where the deck lacks *ELEMENT and they read as that."""
    text = blocks.text
    model = [block for name, block in blocks.blocks if name == "MODEL"]
    if "ELEMENT" in {block.name for block in model}:
        return
    for block in (block for block in model if block.name == "NODE" and block.leaves):
        given: set[str] = set()
        end = block.leaves[-1].span.end
        for line in _lines(text, block):
            number = _ROW_NUMBER.match(text.source.unified, *line)
            if number and number[1] in given:
                if "ELEMENT" in _reads_as(blocks, "MODEL", "NODE", text.source.unified[line.start : end]):
                    cause = Problem(REF007, f"node {number[1]} is defined twice", Span(*number.span(1)))
                    yield _keyword_line("ELEMENT", cause, Span(line.start, end))
                break
            given.update(number.groups() if number else ())


def _reads_as(blocks: Blocks, section: str, own: str, lines: str, *, legal: bool = False) -> list[str]:
    """The keywords of a section that take some lines as they stand, first those that define what the deck lacks.

    Numbers alone fit several keywords: they are nodes or elements, where the deck has only the other of the two. Where
    the block above can have the first line (`legal`), the names that the deck lacks must say that it is another one's.
    """
    given = blocks.keywords
    piece = lines if len(lines) <= LONGEST_PIECE else lines[: lines.rfind("\n", 0, LONGEST_PIECE) + 1]
    text = f"${section}\n*{own or 'NODE'}\n{piece}"
    leaves = parse(Source("", text, clean=True)).sections[0].blocks[0].leaves
    first = next((leaf for leaf in leaves if leaf.kind not in (Kind.COMMENT, Kind.BLANK)), None)
    if first is None:
        return []
    if first.kind in (Kind.SETTING, Kind.UNDECIDED):
        key = first_key(text, first.span)
        candidates: Iterable[str] = catalogue.read_keywords()
    else:
        key = ""
        candidates = [each for each, other in _EACH_OTHER.items() if each not in given and other in given]
        if "." in piece:  # coordinates
            candidates = [each for each in candidates if each != "ELEMENT"]
    lacked = {"ELEMENT SETS": bool(blocks.missing_sets), "SEABED STIFFNESS": bool(blocks.missing_curves)}
    found: list[str] = []
    for keyword in candidates:
        declared = catalogue.block_class(section, keyword) if keyword != own else None
        if declared is None or (key and key not in all_keys(declared)):
            continue
        source = f"${section}\n*{keyword}\n{piece}"
        read = read_block(source, parse(Source("", source, clean=True)).sections[0].blocks[0], declared, last=False)
        if not read.lost and not any(one.weight is Severity.ERROR for one in read.problems):
            found.append(keyword)
    found = [each for each in found if lacked.get(each, True)] if legal else found
    return sorted(found, key=lambda keyword: (not lacked.get(keyword), keyword in given))


# ------------------------------------------------------------------------------------------- names and rows


def _tables(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Points with the name of their set or curve in front, as a graphical interface shows them."""
    text = blocks.text
    wrong = {
        line_at(text, start_of(text, one)).start: one for one in reversed(problems) if one.code in (SYN002, SYN003)
    }
    for block in (block for section in text.tree.sections for block in section.blocks if block.name in _CURVE_NAMES):
        edits: list[TextEdit] = []
        cause, first = None, ""
        known = ""
        for span in _lines(text, block):
            named = _NAMED_POINT.fullmatch(text.source.unified, *span) if span.start in wrong else None
            if named is None:
                continue
            name, point = named.groups()
            head = "" if name == known else f" {_CURVE_NAMES[block.name]}={name}\n"
            edits.append(TextEdit(span, f"{head} {point}"))
            if cause is None:
                cause, first = wrong[span.start], f"write {head.strip()} on a line of its own, and {point} below it"
            known = name
        if cause is not None:
            message = f"rows of a name and a point, as a graphical interface shows them: {first}"
            yield Correction(cause, tuple(edits), Span(block.head.span.start, block.leaves[-1].span.end), message)


def _lines(text: TextOrigin, block: RawBlock) -> Iterator[Span]:
    """The lines of a block below its head, without their ends."""
    at = block.head.span.end
    end = (block.leaves or [block.head])[-1].span.end
    while at < end:
        line = line_at(text, at)
        yield line
        at = text.source.unified.find("\n", at) + 1 or end


def _names(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """A setting without its name, or points in front of it: the names that nothing defines."""
    text = blocks.text
    missing = {"SET": [*blocks.missing_sets], "CURVE": [*blocks.missing_curves]}
    for problem in problems:
        found = _LACKS_NAME.match(problem.message) if problem.code in (SYN001, SYN003) else None
        if found is None or problem.span is None:
            continue
        key = found[1] or found[2]
        if (
            found[1]
            and not missing[key]
            and (moved := _name_below(text, blocks.raw_at(problem.span.start), problem, key))
        ):
            yield moved
        if missing[key]:
            name = missing[key].pop(0)
            at, written = problem.span.end, name
            if found[1]:
                at, written = line_at(text, problem.span.start).start, f" {key}={name}\n"
            yield Correction(problem, (TextEdit(Span(at, at), written),), line_at(text, problem.span.start))


def _name_below(text: TextOrigin, block: RawBlock | None, problem: Problem, key: str) -> Correction | None:
    """The first line with a name below points without one: above them."""
    at = start_of(text, problem)
    for leaf in block.leaves if block else ():
        if leaf.span.start < at or leaf.kind is not Kind.SETTING:
            continue
        line = line_at(text, leaf.span.start)
        written = text.source.unified[slice(*line)]
        if written.partition("=")[0].strip().upper() != key:
            break
        last, first = (_first_number(text, each) for each in (line.start - 1, line.end + 1))
        if last is not None and first is not None and first < last:
            break  # the points below it are of a curve of their own
        begin = line_at(text, at).start
        message = f"{written.strip()} in line {text.source.position(line.start)[0]} stands below its points: move it up"
        edits = TextEdit(Span(begin, begin), f"{written}\n"), TextEdit(Span(line.start, line.end + 1), "")
        return Correction(problem, edits, Span(begin, line.end), message)
    return None


def _first_number(text: TextOrigin, offset: int) -> float | None:
    """The first number of the line around an offset, None for other lines."""
    words = text.source.unified[slice(*line_at(text, offset))].split(",")
    return read_number(words[0].strip())


def _options(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Rows of sections without an OPTION= above them, which makes them FLEXIBLE: that of so many values."""
    text = blocks.text
    seen: set[int] = set()
    for problem in sorted((one for one in problems if one.code is SYN003), key=lambda one: start_of(text, one)):
        at = start_of(text, problem)
        block = blocks.raw_at(at)
        if block is None or block.name != "GEOMETRIC SETS" or block.head.span.start in seen:
            continue
        seen.add(block.head.span.start)
        above = [leaf for leaf in block.leaves if leaf.kind is Kind.SETTING and leaf.span.start < at]
        written = [text.source.unified[slice(*leaf.span)].strip().upper() for leaf in above]
        count = text.source.unified[slice(*line_at(text, at))].count(",") + 1
        option = next((name for name, counts in _VALUES.items() if count in counts), "")
        if option and written and not any(each.startswith("OPTION") for each in written):
            line = line_at(text, above[-1].span.start)
            edit = TextEdit(Span(line.start, line.start), f" OPTION={option}\n")
            number = text.source.position(line.start)[0]
            message = f"{count} values are not FLEXIBLE's: OPTION={option} seems to be missing above line {number}"
            yield Correction(problem, (edit,), Span(line.start, whole(block).end), message)


def _settings(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Settings that were meant otherwise: CURVE= for SET=, data read as a comment, KEY= where a row belongs."""
    text = blocks.text
    wrong = [one for one in problems if one.code in (SYN004, SYN013)]
    for problem in wrong:
        at = start_of(text, problem)
        block = blocks.raw_at(at)
        if block is None:
            continue
        line = line_at(text, at)
        key, _, value = text.source.unified[slice(*line)].strip().partition("=")
        name = _CURVE_NAMES.get(block.name)
        if name and key.strip().upper() in _CURVE_NAMES.values():
            yield Correction(problem, (TextEdit(line, f" {name}={value.strip()}"),), whole(block))
        elif problem.code is SYN004 and not _has_settings(block) and (row := _as_row(text, block)):
            edits = (TextEdit(Span(block.leaves[0].span.start, whole(block).end), f" {row}\n"),)
            message = f"*{block.name} takes no KEY= at all: write the values as a row, {row}"
            yield Correction(problem, edits, whole(block), message)


def _has_settings(block: RawBlock) -> bool:
    declared = catalogue.declared(block.name)
    return declared is not None and bool(all_keys(declared))


def _as_row(text: TextOrigin, block: RawBlock) -> str:
    """The values of a block of settings alone, as a row; "" for other blocks."""
    lines = [leaf for leaf in block.leaves if leaf.kind not in (Kind.COMMENT, Kind.BLANK)]
    if len(lines) > MOST_SETTINGS or any(leaf.kind is not Kind.SETTING for leaf in lines):
        return ""
    written = (text.source.unified[slice(*leaf.span)] for leaf in lines)
    return ", ".join(line.partition("=")[2].strip() for line in written)


def _cut_off(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """A file that ends behind *SEABED STIFFNESS: the curves that nothing defines."""
    text = blocks.text
    missing = blocks.missing_curves
    for problem in problems if missing else ():
        at = start_of(text, problem)
        block = blocks.raw_at(at) if problem.code is SYN014 else None
        if block is not None and block.name == "SEABED STIFFNESS" and not block.leaves:
            end = len(text.source.unified)
            curves = "".join(f"\n CURVE={name}\n 0.0, 0.0\n 1.0, 100000.0" for name in missing)
            edit = TextEdit(Span(end, end), f"{curves}\n")
            yield Correction(problem, (edit,), whole(block), certain=True)


def _rows(blocks: Blocks, problems: Sequence[Problem]) -> Iterator[Correction]:
    """Numbers and rows with a typing error: what they were to be, as far as that can be seen."""
    text = blocks.text
    for problem in problems:
        make: Callable[[str], list[str]]
        span = problem.span
        if span is None or problem.weight is not Severity.ERROR:
            continue
        if problem.code is SYN002:
            if _is_known_by(text, span, blocks.raw_at(span.start)):
                make = _numbers
            else:
                continue
        elif problem.code in (SYN001, SYN003):
            span = line_at(text, span.start)
            make = _row
        else:
            continue
        written = text.source.unified[slice(*span)]
        for other in make(written):
            if other != written:
                certain = problem.code is SYN002
                yield Correction(problem, (TextEdit(span, other),), line_at(text, span.start), certain=certain)


def _is_known_by(text: TextOrigin, span: Span, block: RawBlock | None) -> bool:
    """Whether other values are known by a value: it is a whole number, or says what the units are."""
    declared = catalogue.declared(block.name) if block else None
    if block is None or declared is None or block.name == "OCEAN":
        return declared is not None
    before = text.source.unified[line_at(text, span.start).start : span.start]
    key = before.partition("=")[0].strip().upper() if "=" in before else ""
    index = before.rpartition("=")[2].count(",")
    for slot in (slot for schema in schemas_of(declared) for slot in schema.slots if slot.key == key):
        columns = record_schema(slot.row).columns if slot.row else [slot]
        if columns[min(index, len(columns) - 1)].kind in (Value.WHOLE, Value.IDENT):
            return True
    return False


def _numbers(written: str) -> list[str]:
    """The numbers that a word with a wrong letter may be."""
    translated = written.translate(_MISREAD)
    found = [translated] if NUMBER.fullmatch(translated) else []
    if (begun := NUMBER.match(written)) and _UNIT.match(written, begun.end()):
        found.append(begun[0])
    return found


def _row(written: str) -> list[str]:
    """The numbers of a line, with commas where blanks or semicolons part them."""
    return [_GAP.sub(", ", written)]
