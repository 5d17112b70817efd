"""Edits that turn the legacy keywords of a text into the new family; all other bytes remain."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from itertools import chain, count
from pathlib import PurePath
from typing import cast

import numpy as np

from mudline.editing.migration.refusals import surfaces
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import folded, name_key
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Span, Where
from mudline.language.keywords.library.seabed_curves import Embedment
from mudline.language.keywords.library.seabed_properties import Surface
from mudline.language.keywords.model import record_schema
from mudline.language.keywords.text import reads_as_name
from mudline.language.syntax.edits import TextEdit
from mudline.language.syntax.fields import trimmed
from mudline.language.syntax.rows import line_spans
from mudline.language.syntax.tree import LeafKind, RawBlock
from mudline.model.scene.laws import DIRECTIONS
from mudline.model.scene.model import Scene
from mudline.model.scene.sets import ALL

_UNSAFE = re.compile(r"[^\w.-]+")
_FRICTION = ("longitudinal", "transverse", "longitudinal_mobilisation", "transverse_mobilisation", "constant")


def unused_definitions(scene: Scene, *, extended: bool = False) -> set[Where]:
    """Return the places of the surface and of the curves that no element follows.

    A curve has no elements if a later curve has the same set or ALL. Other definitions are known to have none only if
    the deck lists all its elements and no deck that continues it has more (`extended`).
    """
    shown = scene.shows_elements and not extended
    later: set[str] = set()
    unused: set[Where] = set()
    legacy = [(i, law) for i, law in enumerate(scene.laws.set_laws) if law.family == "legacy" and law.curve >= 0]
    followed = set(np.unique(scene.laws.of_element).tolist())
    for index, law in reversed(legacy):
        key = name_key(law.set_.name)
        unheld = shown and not law.set_.open and index not in followed
        if key in later or ALL in later or unheld:
            unused.add(law.where)
        later.add(key)
    on_curves = shown and followed <= {index for index, _ in legacy}
    if ALL in later or on_curves:
        unused.update(Where(where.section, where.block) for where, _ in surfaces(scene.deck))
    return unused


class MigrationRewriter:
    """Rewriting of a deck that was read from text and has no refusals; `unused` definitions are left out."""

    def __init__(self, deck: Deck, unused: Container[Where]) -> None:
        self.deck = deck
        self.unused = unused
        self.origin = cast("TextOrigin", deck.origin)
        self.text = self.origin.source.unified
        self.edits: list[TextEdit] = []
        self.files: dict[str, bytes] = {}

    def rewrite(self) -> tuple[list[TextEdit], dict[str, bytes]]:
        """Return the edits of the text, and the content of the files that the new text names, by name."""
        curves: list[tuple[Where, int, str]] = []
        for where, block in self.deck.blocks("EMBEDMENT"):
            given = [(where, i, curve.set_name or "ALL") for i, curve in enumerate(cast("Embedment", block).curves)]
            used = [entry for entry in given if where.inside("curves", entry[1]) not in self.unused]
            self._head(where, "SEABED STIFFNESS" if used else "")
            for _, index, _ in given:
                if where.inside("curves", index) in self.unused:
                    self._leave_out(where, index)
            curves += used
        taken = [curve.name for _, block in self.deck.blocks("SEABED STIFFNESS") for curve in block.curves]
        sets = [set_name for _, _, set_name in curves]
        names = list(curve_names(sets, taken))
        for (where, index, _), name in zip(curves, names, strict=True):
            self._curve(where, index, name)
        for where, block in surfaces(self.deck):
            self._surface(where, block, list(zip(sets, names, strict=True)))
        return self.edits, self.files

    def _edit(self, span: Span, text: str) -> None:
        self.edits.append(TextEdit(span, text))

    def _insert(self, offset: int, text: str) -> None:
        self._edit(Span(offset, offset), text)

    def _raw(self, where: Where) -> RawBlock:
        return self.origin.tree.sections[where.section].blocks[where.block]

    def _head(self, where: Where, keyword: str) -> None:
        """Replace the keyword of a block; "" makes the line a comment."""
        head = trimmed(self.text, *self._raw(where).head.span)
        if keyword:
            self._edit(head, f"*{keyword}")
        else:
            self._insert(self._line_start(head.start), "C ")

    def _rows(self, where: Where) -> list[Span]:
        """Return the lines of a block without comments, blank lines and trailing blanks."""
        leaves = (leaf for leaf in self._raw(where).leaves if leaf.kind is not LeafKind.COMMENT)
        return [trimmed(self.text, *line) for leaf in leaves for line in line_spans(self.text, leaf.span)]

    def _leave_out(self, where: Where, index: int) -> None:
        """Turn the lines of a curve that no element follows into comments."""
        spans = self.origin.read[where.section, where.block].places.spans
        first, following = spans["curves", index], spans.get(("curves", index + 1))
        comment = "C left out, as no element is on this curve:\n"
        for row in self._rows(where):
            if first.start <= row.start and (following is None or row.start < following.start):
                self._insert(self._line_start(row.start), f"{comment}C ")
                comment = ""

    def _line_start(self, offset: int) -> int:
        return self.text.rfind("\n", 0, offset) + 1

    def _indent(self, offset: int) -> str:
        """Return the blanks before the first character of a line; at least one, as a key may begin with C."""
        return " " * max(offset - self._line_start(offset), 1)

    def _row(self, row: Span, lines: str) -> None:
        """Replace a row by settings, indented as the row or by a blank."""
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

        Every block gives all values, as it inherits none. The block for ALL is left out if every element is on a curve.
        On a rigid seabed it is always needed: it says that the elements lie on that seabed.
        """
        self._head(where, "SEABED PROPERTIES")
        rows = self._rows(where)
        fields = self._fields(where, block)
        stiffness, others = fields.get("stiffness", ""), list(_other_lines(fields))
        type_ = block.facts.seabed_type
        lines = [f"TYPE={type_}"]
        if Where(where.section, where.block) in self.unused:
            if stiffness:
                comment = f"C stiffness {stiffness} left out, as every element is on a curve\n"
                self._insert(self._line_start(rows[0].start), comment)
        elif type_ == "RIGID" or stiffness or others:
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
        """Return the fields of the first line as written."""
        spans = self.origin.read[where.section, where.block].places.spans
        columns = [slot.json for slot in record_schema(type(block.properties)).columns]
        places = {name: spans.get(("properties", name), Span(0, 0)) for name in columns}
        return {name: self.text[slice(*span)].strip(" \t\r\n,") for name, span in places.items()}

    def _profile(self, block: Surface, rows: Sequence[Span], indent: str) -> None:
        """Turn the lines after the first into a `*SEABED PROFILE`, including comments between them."""
        self._insert(self.text.index("\n", rows[0].end) + 1, "*SEABED PROFILE\n")
        if block.profile is None:
            value = self.text[slice(*rows[1])].strip(" \t,")
            self._row(rows[1], f"TYPE=SLOPING\n{indent}SLOPE={value}")
            return
        stem = _UNSAFE.sub("-", PurePath(self.deck.source).stem).strip("-.") or "deck"
        name, number = f"{stem}-profile.txt", 2
        while self.deck.folder is not None and (self.deck.folder / name).exists():
            name, number = f"{stem}-profile-{number}.txt", number + 1
        self._row(rows[1], f"TYPE=2D\n{indent}INTERPOLATION=LINEAR\n{indent}FILE={name}")
        for row in rows[2:]:
            end = self.text.find("\n", row.end)
            self._edit(Span(self._line_start(row.start), len(self.text) if end < 0 else end + 1), "")
        points = zip(block.profile.column(0).tolist(), block.profile.column(1).tolist(), strict=True)
        lines = [f"{y!r}, {elevation!r}\n".upper() for y, elevation in points]
        head = f"C Y, elevation: profile of *{block.keyword} of {self.deck.source}\n"
        self.files[name] = (head + "".join(lines)).encode()


def _other_lines(fields: Mapping[str, str]) -> Iterator[str]:
    """Yield the lines of a surface next to its stiffness, from fields as written by name; "" for an empty field."""
    friction = [fields.get(name, "") for name in _FRICTION]
    if any(friction):
        friction[:2] = [value or "0" for value in friction[:2]]
        yield "FRICTION=" + ", ".join(friction).rstrip(", ")
    if fields.get("lateral"):
        yield f"LATERAL={fields['lateral']}"
    suction = [fields.get("suction_stiffness", ""), fields.get("suction_extent", "")]
    if any(suction):
        yield "SUCTION=" + ", ".join([suction[0] or "0", suction[1]]).rstrip(", ")


def curve_names(sets: Iterable[str], taken: Iterable[str]) -> Iterator[str]:
    """Yield a name for each curve of `*EMBEDMENT`: that of its set, with ` curve` and a number appended if needed.

    A name that another curve has, in any case of letters, would name both. A name that reads as a number or an equation
    would be taken for a stiffness.
    """
    used = {folded(name) for name in taken}
    for name in sets:
        base = f"{name} curve" if reads_as_name(f"{name} curve") else "curve"
        candidates = chain([name, base], (f"{base} {number}" for number in count(2)))
        chosen = next(each for each in candidates if folded(each) not in used and reads_as_name(each))
        used.add(folded(chosen))
        yield chosen
