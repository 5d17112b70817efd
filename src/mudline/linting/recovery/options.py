"""Rows that another OPTION= has than the one above them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from typing import NamedTuple

from mudline.codes.fields import SYN003
from mudline.diagnostics import Problem, Span
from mudline.keywords.model import Block, FieldSpec, record_schema
from mudline.linting.recovery.blocks import Blocks, Correction, data_of, line_at, recovers_from, start_of, whole
from mudline.syntax.edits import TextEdit
from mudline.syntax.fields import first_key
from mudline.syntax.tree import Kind


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
    starts = {start_of(text, one) for one in blocks.deck.problems}
    for problem in sorted(problems, key=lambda one: start_of(text, one)):
        at = start_of(text, problem)
        block, declared = blocks.raw_at(at), blocks.declared_at(at)
        formats = _formats(declared) if declared else None
        if block is None or formats is None or block.head.span.start in seen:
            continue
        seen.add(block.head.span.start)
        line = line_at(text, at)
        count = text.source.unified[slice(*line)].count(",") + 1
        leaves = [leaf for leaf in data_of(block.leaves) if leaf.span.start < line.start]
        above = [leaf.span for leaf in leaves if leaf.kind is Kind.SETTING]
        if not above or leaves[-1].span != above[-1] or any(above[-1].start <= each < at for each in starts):
            continue  # the row is not the first of its set, or the line above it has a fault of its own
        given = [span for span in above if first_key(text.source.unified, span) == formats.setting.key]
        chosen = text.source.unified[slice(*given[-1])].partition("=")[2].strip().upper() if given else ""
        chosen = chosen or formats.setting.about.default
        own = formats.counts.get(chosen, range(0))
        if not own or (given and own.start - 1 <= count <= own.stop):
            continue  # a value or a comma is missing
        fitting = [name for name, counts in formats.counts.items() if count in counts and name != chosen]
        most = max((formats.counts[name].start for name in fitting), default=0)
        fitting = [name for name in fitting if formats.counts[name].start == most]
        if not fitting:
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
