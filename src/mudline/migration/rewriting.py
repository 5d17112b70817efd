"""The edits that turn the legacy keywords of a text into the new family, and what stops a migration.

Every other byte stays. What the new keywords cannot say, or would say differently, is refused.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import count
from pathlib import PurePath
from typing import Any, NamedTuple, cast

from mudline.codes import MIG001
from mudline.deck.model import Deck
from mudline.deck.parameters import folded
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Problem, Span, Where
from mudline.keywords.catalogue import in_order, is_superseded, supersedes
from mudline.keywords.library.embedment import Embedment
from mudline.keywords.model import Block, record_schema
from mudline.keywords.surfaces import Surface
from mudline.keywords.text import reads_as_name
from mudline.keywords.values import Equation
from mudline.syntax.edits import TextEdit
from mudline.syntax.fields import trimmed
from mudline.syntax.rows import line_spans
from mudline.syntax.tree import Kind, RawBlock, canonical_name

DIRECTIONS = ("longitudinal", "transverse")
_DEFAULT_LENGTH = {"metric": 3.048, "imperial": 10.0}
_UNSAFE = re.compile(r"[^\w.-]+")
_FRICTION = ("longitudinal", "transverse", "longitudinal_mobilisation", "transverse_mobilisation", "constant")


def superseded_blocks(deck: Deck) -> list[tuple[Where, Block]]:
    """The blocks of superseded keywords: surfaces first, then curves by set."""
    present = filter(is_superseded, in_order(deck.keywords()))
    return [found for keyword in present for found in deck.blocks(keyword)]


def surfaces(deck: Deck) -> list[tuple[Where, Surface]]:
    """The legacy surfaces of a deck, in the order of the file."""
    return list(deck.blocks_that(lambda declared: declared.facts.seabed_type))


def refusals(deck: Deck, continued_by: Sequence[str] = ()) -> Iterator[Problem]:
    """The reasons why a deck cannot be migrated; `deck` has its equations as written.

    `continued_by` names decks that continue this one with seabed keywords of their own.
    """
    yield from _mixed_families(deck)
    yield from _restarts(deck)
    yield from _continued(deck, continued_by)
    yield from _varied_keywords(deck)
    found = surfaces(deck)
    for where, block in found[1:]:
        yield _refusal(f"a second surface: remove all but one, then migrate *{block.keyword}", where)
    for where, block in found[:1]:
        yield from _lengths(block, where, deck.units)
        yield from _shapes(deck, block, where)


def _refusal(message: str, where: Where) -> Problem:
    return Problem(MIG001, message, where=where)


def _mixed_families(deck: Deck) -> Iterator[Problem]:
    """Which of the two families applies to an element cannot be decided by rewriting."""
    for where, _ in deck.blocks("SEABED PROPERTIES"):
        message = "*SEABED PROPERTIES is used beside legacy keywords: decide which applies and remove the other"
        yield _refusal(message, where)


def _restarts(deck: Deck) -> Iterator[Problem]:
    """A deck that continues another one, whose seabed applies as well."""
    for section, found in enumerate(deck.sections):
        for block, restart in enumerate(found.blocks):
            if found.name == "LOAD CASE" and restart.keyword == "RESTART":
                message = "*RESTART continues another deck, whose seabed applies as well: put the model in one deck"
                yield _refusal(message, Where(section, block))


def _continued(deck: Deck, continued_by: Sequence[str]) -> Iterator[Problem]:
    """The keywords of a deck that continues this one would be combined with others than before."""
    where, _ = superseded_blocks(deck)[0]
    for name in continued_by:
        message = (
            f"{name} continues this deck and has seabed keywords of its own, which would apply differently: "
            "leave both decks unchanged"
        )
        yield _refusal(message, where)


def _varied_keywords(deck: Deck) -> Iterator[Problem]:
    """Actions of `*VARIATION` on keywords that a migration removes or adds."""
    for where, block in deck.blocks("VARIATION", "PREPROCESSOR"):
        for i, variation in enumerate(block.variations):
            for j, item in enumerate(variation.blocks):
                keyword = canonical_name("*" + ",".join(item.keyword))
                if is_superseded(keyword) or supersedes(keyword):
                    message = f"a variation adds or removes *{keyword}, which migration changes: remove the action"
                    yield _refusal(message, where.inside("variations", i, "blocks", j))


def _lengths(block: Surface, where: Where, units: str) -> Iterator[Problem]:
    """Largest characteristic lengths that bound the mobilisation length and are not the default.

    One has no effect where the mobilisation length is given or the friction coefficient is 0. The value of an equation
    may change: it is taken neither as 0 nor as the default.
    """
    values: Any = block.properties
    for direction in DIRECTIONS:
        name = f"{direction}_length"
        length = getattr(values, name)
        if length is None or getattr(values, f"{direction}_mobilisation") is not None:
            continue
        if getattr(values, direction) not in (None, 0.0) and length != _DEFAULT_LENGTH.get(units):
            message = (
                f"the largest {direction} characteristic length bounds the mobilisation length of each element, "
                "and the new family has no field for it: give the mobilisation length instead"
            )
            yield _refusal(message, where.inside("properties", name))


def _shapes(deck: Deck, block: Surface, where: Where) -> Iterator[Problem]:
    """A slope or profile that `*SEABED PROFILE` cannot take over."""
    shaped = block.slope is not None or block.profile is not None
    if block.slope is not None and block.profile is not None:
        yield _refusal("a slope and a profile: remove one of them", where.inside("slope"))
    for keyword in ("SEABED PROFILE", "SEABED PLANES") if shaped else ():
        for other, _ in deck.blocks(keyword):
            yield _refusal(f"*{keyword} and the slope or profile of *{block.keyword}: remove one of them", other)
    for (row, column), word in (block.profile.words if block.profile is not None else {}).items():
        if isinstance(word, Equation):
            message = "an equation in a profile, whose points go to a text file: write the number"
            yield _refusal(message, where.inside("profile", row, column))


# ------------------------------------------------------------------------------------------------------------- edits


class Rewriting(NamedTuple):
    """Edits of a text, and the content of the files that the new text names, by name."""

    edits: list[TextEdit]
    files: dict[str, str]


def rewrite(deck: Deck) -> Rewriting:
    """The edits for a deck that was read from text and that has no refusals."""
    return _Rewriter(deck).rewrite()


class _Rewriter:
    def __init__(self, deck: Deck) -> None:
        self.deck = deck
        self.origin = cast("TextOrigin", deck.origin)
        self.text = self.origin.source.unified
        self.edits: list[TextEdit] = []
        self.files: dict[str, str] = {}

    def rewrite(self) -> Rewriting:
        curves = [
            (where, index, curve.set_name or "ALL")
            for where, block in self.deck.blocks("EMBEDMENT")
            for index, curve in enumerate(cast("Embedment", block).curves)
        ]
        taken = [curve.name for _, block in self.deck.blocks("SEABED STIFFNESS") for curve in block.curves]
        sets = [set_name for _, _, set_name in curves]
        names = curve_names(sets, taken)
        for where, _ in self.deck.blocks("EMBEDMENT"):
            self._head(where, "SEABED STIFFNESS")
        for (where, index, _), name in zip(curves, names, strict=True):
            self._curve(where, index, name)
        for where, block in surfaces(self.deck):
            self._surface(where, block, list(zip(sets, names, strict=True)))
        return Rewriting(self.edits, self.files)

    def _edit(self, span: Span, text: str) -> None:
        self.edits.append(TextEdit(span, text))

    def _insert(self, offset: int, text: str) -> None:
        self._edit(Span(offset, offset), text)

    def _raw(self, where: Where) -> RawBlock:
        return self.origin.tree.sections[where.section].blocks[where.block]

    def _head(self, where: Where, keyword: str) -> None:
        self._edit(trimmed(self.text, *self._raw(where).head.span), f"*{keyword}")

    def _line_start(self, offset: int) -> int:
        return self.text.rfind("\n", 0, offset) + 1

    def _indent(self, offset: int) -> str:
        """The blanks before the first character of a line; one at least, as a key may begin with C."""
        return self.text[self._line_start(offset) : offset] or " "

    def _row(self, row: Span, lines: str) -> None:
        """Settings in the place of a row, indented as it is or by a blank."""
        self._edit(row, lines if self._line_start(row.start) < row.start else f" {lines}")

    def _curve(self, where: Where, index: int, name: str) -> None:
        """Replace SET= by CURVE=, or insert CURVE= before points that have no SET=."""
        places = self.origin.read[where.section, where.block].places
        first = places.spans[("curves", index)]
        if places.has(("curves", index, "set")):
            self._row(first, f"CURVE={name}")
        else:
            self._insert(self._line_start(first.start), f"{self._indent(first.start)}CURVE={name}\n")

    def _surface(self, where: Where, block: Surface, curves: Sequence[tuple[str, str]]) -> None:
        """Replace a surface by a block for ALL with its linear law, then one for each curve, so that curves win.

        Every block gives all values, as it inherits none. On a rigid seabed the block for ALL is needed in any case: it
        says that the elements lie on that seabed.
        """
        self._head(where, "SEABED PROPERTIES")
        rows = [
            trimmed(self.text, *line)
            for leaf in self._raw(where).leaves
            if leaf.kind in (Kind.RUN, Kind.TEXT)
            for line in line_spans(self.text, leaf.span)
        ]
        fields = self._fields(where, block)
        stiffness, others = fields.get("stiffness", ""), _other_lines(fields)
        type_ = block.facts.seabed_type
        lines = [f"TYPE={type_}"]
        if type_ == "RIGID" or stiffness or others:
            lines += ["SET=ALL", *([f"STIFFNESS={stiffness}"] if stiffness else []), *others]
        for set_name, curve in curves:
            lines += [f"SET={set_name}", f"STIFFNESS={curve}", *others]
        indent = self._indent(rows[0].start)
        self._row(rows[0], f"\n{indent}".join(lines))
        lengths = ((direction, fields.get(f"{direction}_length")) for direction in DIRECTIONS)
        if listed := ", ".join(f"{direction} {length}" for direction, length in lengths if length):
            comment = f"C largest characteristic lengths ({listed}) left out: the default, or without effect\n"
            self._insert(self._line_start(rows[0].start), comment)
        if len(rows) > 1:
            self._profile(block, rows, indent)

    def _fields(self, where: Where, block: Surface) -> dict[str, str]:
        """The fields of the first line as they are written."""
        spans = self.origin.read[where.section, where.block].places.spans
        columns = [slot.json for slot in record_schema(type(block.properties)).columns]
        found = {name: spans.get(("properties", name), Span(0, 0)) for name in columns}
        return {name: self.text[slice(*span)].strip(" \t\r\n,") for name, span in found.items()}

    def _profile(self, block: Surface, rows: Sequence[Span], indent: str) -> None:
        """Turn the lines behind the first into a `*SEABED PROFILE`, comments between them included."""
        self._insert(self.text.index("\n", rows[0].end) + 1, "*SEABED PROFILE\n")
        if block.profile is None:
            value = self.text[slice(*rows[1])].strip(" \t,")
            self._row(rows[1], f"TYPE=SLOPING\n{indent}SLOPE={value}")
            return
        name = self._file_name()
        self._row(rows[1], f"TYPE=2D\n{indent}INTERPOLATION=LINEAR\n{indent}FILE={name}")
        for row in rows[2:]:
            end = self.text.find("\n", row.end)
            self._edit(Span(self._line_start(row.start), len(self.text) if end < 0 else end + 1), "")
        points = zip(block.profile.column(0).tolist(), block.profile.column(1).tolist(), strict=True)
        lines = [f"{y!r}, {elevation!r}\n".upper() for y, elevation in points]
        head = f"C Y, elevation: profile of *{block.keyword} of {self.deck.source}\n"
        self.files[name] = head + "".join(lines)

    def _file_name(self) -> str:
        """A name for the file of the profile that no other file beside the deck has."""
        stem = _UNSAFE.sub("-", PurePath(self.deck.source).stem).strip("-.") or "deck"
        name, number = f"{stem}-profile.txt", 2
        while self.deck.folder is not None and (self.deck.folder / name).exists():
            name, number = f"{stem}-profile-{number}.txt", number + 1
        return name


def _other_lines(fields: Mapping[str, str]) -> list[str]:
    """The lines of a surface besides its stiffness: fields by name, as they are written, "" for an empty one."""
    lines: list[str] = []
    friction = [fields.get(name, "") for name in _FRICTION]
    if any(friction):
        friction[:2] = [value or "0" for value in friction[:2]]
        lines.append("FRICTION=" + ", ".join(friction).rstrip(", "))
    if fields.get("lateral"):
        lines.append(f"LATERAL={fields['lateral']}")
    suction = [fields.get("suction_stiffness", ""), fields.get("suction_extent", "")]
    if any(suction):
        lines.append("SUCTION=" + ", ".join([suction[0] or "0", suction[1]]).rstrip(", "))
    return lines


def curve_names(sets: Iterable[str], taken: Iterable[str]) -> list[str]:
    """A name for each curve of `*EMBEDMENT`: that of its set, with ` curve` and a number behind it where needed.

    A name that another curve has, in any case of letters, would name both; one that reads as a number or an equation
    would be taken for a stiffness.
    """
    used = {folded(name) for name in taken}
    names: list[str] = []
    for name in sets:
        chosen = next(one for one in _candidates(name) if folded(one) not in used and reads_as_name(one))
        used.add(folded(chosen))
        names.append(chosen)
    return names


def _candidates(name: str) -> Iterator[str]:
    base = f"{name} curve" if reads_as_name(f"{name} curve") else "curve"
    yield from (name, base)
    yield from (f"{base} {number}" for number in count(2))
