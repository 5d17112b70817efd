"""The edits that turn the legacy keywords of a text into the new family; every other byte stays."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import PurePath
from typing import cast

from mudline.deck.model import Deck
from mudline.deck.parameters import folded
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Span, Where
from mudline.keywords.library.embedment import Embedment
from mudline.keywords.model import layout
from mudline.keywords.surface import Surface
from mudline.keywords.text import reads_as_name
from mudline.migration.refusals import SurfaceLines, lengths_given, surface_lines, surfaces
from mudline.syntax.edits import TextEdit
from mudline.syntax.fields import trimmed
from mudline.syntax.rows import line_spans
from mudline.syntax.tree import Kind, RawBlock

_UNSAFE = re.compile(r"[^\w.-]+")


@dataclass(slots=True)
class Rewriting:
    """Edits of a text, and the files that it names from now on."""

    edits: list[TextEdit] = field(default_factory=list)
    files: dict[str, str] = field(default_factory=dict)


def rewrite(deck: Deck) -> Rewriting:
    """The edits for a deck that was read from text and that nothing speaks against."""
    return _Rewriter(deck).rewrite()


class _Rewriter:
    def __init__(self, deck: Deck) -> None:
        self.deck = deck
        self.origin = cast("TextOrigin", deck.origin)
        self.text = self.origin.source.unified
        self.found = Rewriting()

    def rewrite(self) -> Rewriting:
        curves = [
            (where, index, curve.set_name or "ALL")
            for where, block in self.deck.blocks("EMBEDMENT")
            for index, curve in enumerate(cast("Embedment", block).curves)
        ]
        taken = [curve.name for _, block in self.deck.blocks("SEABED STIFFNESS") for curve in block.curves]
        names = curve_names([set_name for _, _, set_name in curves], taken)
        for where, _ in self.deck.blocks("EMBEDMENT"):
            self._head(where, "SEABED STIFFNESS")
        for (where, index, _), name in zip(curves, names, strict=True):
            self._curve(where, index, name)
        by_set = [(set_name, name) for (_, _, set_name), name in zip(curves, names, strict=True)]
        for where, block in surfaces(self.deck):
            self._surface(where, block, by_set)
        return self.found

    def _edit(self, span: Span, text: str) -> None:
        self.found.edits.append(TextEdit(span, text))

    def _raw(self, where: Where) -> RawBlock:
        return self.origin.tree.sections[where.section].blocks[where.block]

    def _head(self, where: Where, keyword: str) -> None:
        self._edit(trimmed(self.text, *self._raw(where).head.span), f"*{keyword}")

    def _line_start(self, offset: int) -> int:
        return self.text.rfind("\n", 0, offset) + 1

    def _indent(self, offset: int) -> str:
        """The blanks before the first character of a line; one at least, as a key may begin with C."""
        return self.text[self._line_start(offset) : offset] or " "

    def _curve(self, where: Where, index: int, name: str) -> None:
        """SET= becomes CURVE=; points before any SET= get a CURVE= before them."""
        places = self.origin.read[where.section, where.block].places
        first = places.spans[("curves", index)]
        line = f"CURVE={name}"
        if places.has(("curves", index, "set")):
            self._row(first, line)
        else:
            start = self._line_start(first.start)
            self._edit(Span(start, start), f"{self._indent(first.start)}{line}\n")

    def _rows(self, raw: RawBlock) -> list[Span]:
        return [
            trimmed(self.text, *line)
            for leaf in raw.leaves
            if leaf.kind in (Kind.RUN, Kind.TEXT)
            for line in line_spans(self.text, leaf.span)
        ]

    def _row(self, row: Span, lines: str) -> None:
        """Settings in the place of a row, indented as it is or by a blank."""
        self._edit(row, lines if self._line_start(row.start) < row.start else f" {lines}")

    def _surface(self, where: Where, block: Surface, by_set: list[tuple[str, str]]) -> None:
        self._head(where, "SEABED PROPERTIES")
        rows = self._rows(self._raw(where))
        fields = self._fields(where, block)
        type_ = block.keyword.split()[0]
        lines = [f"TYPE={type_}", *_sets(surface_lines(fields), by_set, rigid=type_ == "RIGID")]
        indent = self._indent(rows[0].start)
        self._row(rows[0], f"\n{indent}".join(lines))
        start = self._line_start(rows[0].start)
        if given := lengths_given(fields):
            listed = ", ".join(given)
            comment = f"C largest characteristic lengths ({listed}) left out: the default, or without effect\n"
            self._edit(Span(start, start), comment)
        if len(rows) > 1:
            self._profile(block, rows, indent)

    def _fields(self, where: Where, block: Surface) -> dict[str, str]:
        """The fields of the first line as they are written."""
        spans = self.origin.read[where.section, where.block].places.spans
        columns = [slot.json for slot in layout(type(block.properties)).columns]
        found = {name: spans.get(("properties", name), Span(0, 0)) for name in columns}
        return {name: self.text[slice(*span)].strip(" \t\r\n,") for name, span in found.items()}

    def _profile(self, block: Surface, rows: list[Span], indent: str) -> None:
        """The lines behind the first become a block of their own, comments between them included."""
        after = self.text.index("\n", rows[0].end) + 1
        self._edit(Span(after, after), "*SEABED PROFILE\n")
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
        self.found.files[name] = head + "".join(lines)

    def _file_name(self) -> str:
        """A name for the file of the profile that no other file beside the deck has."""
        stem = _UNSAFE.sub("-", PurePath(self.deck.source).stem).strip("-.") or "deck"
        name, number = f"{stem}-profile.txt", 2
        while self.deck.folder is not None and (self.deck.folder / name).exists():
            name, number = f"{stem}-profile-{number}.txt", number + 1
        return name


def _sets(surface: SurfaceLines, by_set: list[tuple[str, str]], *, rigid: bool) -> list[str]:
    """A block for ALL with what is linear, then one for each curve, so that the curves win; each has all of it.

    On a rigid bed the block alone says something: that its elements lie on that bed.
    """
    blocks = surface.block("ALL", surface.stiffness) if rigid or surface.stiffness or surface.others else []
    for set_name, curve in by_set:
        blocks += surface.block(set_name, curve)
    return blocks


def curve_names(sets: Iterable[str], taken: Iterable[str]) -> list[str]:
    """A name for each curve: that of its set, with ` curve` and a number behind it where that would not do.

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


def _candidates(name: str) -> Iterable[str]:
    yield name
    base = f"{name} curve" if reads_as_name(f"{name} curve") else "curve"
    yield base
    number = 2
    while True:
        yield f"{base} {number}"
        number += 1
