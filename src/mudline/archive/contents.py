"""What a deck gives to each table of an archive: read, resolved and linted once."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from hashlib import blake2b
from pathlib import Path
from typing import Any, cast

import numpy as np

from mudline.archive.tables import TABLES
from mudline.codes.lines import SYN001
from mudline.contact.input import LawKind
from mudline.deck.coverage import coverage_of, extent
from mudline.deck.loading import load_bytes
from mudline.deck.model import Deck, Opaque
from mudline.deck.parameters import Parameters, folded
from mudline.diagnostics import Coverage, DeckError, Diagnostic, Problem, Severity, Where
from mudline.keywords.catalogue import is_extension, is_superseded
from mudline.keywords.keeping import kept_lines
from mudline.keywords.table import AS_TABLES, Listing
from mudline.keywords.values import Equation, Names
from mudline.linting.context import LintContext
from mudline.linting.engine import LintSettings, lint_context
from mudline.linting.fixing import with_severities
from mudline.linting.verdict import all_findings, errors_of
from mudline.scene.deck_curves import OF_SEABED, other_curves
from mudline.scene.deck_values import bare, number
from mudline.scene.model import Scene
from mudline.scene.references import used_names
from mudline.scene.sets import ALL

_DIGEST = 63
"""Bits of digests of values, which are whole numbers in the tables."""
_EQUATION = re.compile(r"=\[((?:[^\[\]]|\[[^\[\]]*\])*)\]|%([^%\s]+)%")
_WORD = re.compile(r"[^\W\d][\w.]*")
_KINDS = [kind.name.lower() for kind in LawKind]


Rows = dict[str, list[tuple[object, ...]]]
"""The rows of a deck by table, in the order of the table's columns."""


def rows_of(data: bytes, name: str, settings: LintSettings, folder: Path | None) -> Rows:
    """The rows of a deck of this content and file name; never raises for content."""
    try:
        deck = load_bytes(data, name, units=settings.units, folder=folder)
    except DeckError as error:
        counts = (len(error.diagnostics), *[0] * 11)
        row = (settings.units or "user", "illegal", *counts, None, None, None)
        return {"decks": [row], "findings": _findings(error.diagnostics)}
    return _Deck(deck, LintContext(deck, dialect=settings.dialect), data).rows(settings)


def _findings(found: Iterable[Diagnostic]) -> list[tuple[object, ...]]:
    return [
        (
            *(one.code, one.slug, one.severity.value, one.message),
            *(one.line, one.column, one.end_line, one.end_column),
            one.fix and one.fix.applicability,
            one.blocks,
        )
        for one in found
    ]


def _legal(coverage: Coverage) -> str:
    return "legal" if coverage.whole else "legal as far as read"


@dataclass
class _Deck:
    deck: Deck
    context: LintContext
    data: bytes
    made: Rows = field(default_factory=lambda: {table.name: [] for table in TABLES})

    @property
    def scene(self) -> Scene:
        return self.context.scene

    def rows(self, settings: LintSettings) -> Rows:
        found = with_severities(lint_context(self.context, settings.rules), settings)
        self.made["findings"] = _findings(found)
        content = self._keywords()
        coverage = coverage_of(self.deck)
        sets = self._sets()
        self._curves()
        self._laws()
        self._parameters()
        counts = Counter(one.severity for one in found)
        illegal = errors_of(all_findings(self.context))
        oceans = [block for _, block in self.scene.deck.blocks("OCEAN")]
        row = (
            self.deck.units,
            "illegal" if illegal else _legal(coverage) if self.deck.sections else "empty",
            *(counts[severity] for severity in (Severity.ERROR, Severity.WARNING, Severity.INFO)),
            len(self.deck.sections),
            coverage.total,
            coverage.read,
            *(sum(named.values()) for named in (coverage.partly, coverage.unread)),
            len(self.scene.node_ids),
            len(self.scene.element_ids),
            sets,
            len(self.scene.laws.curves),
            float(np.nansum(self.scene.length)),
            number(oceans[-1], "depth") if oceans else None,
            content,
        )
        self.made["decks"].append(row)
        return self.made

    def _line(self, where: Where | None) -> int | None:
        return None if where is None else self.deck.place(Problem(SYN001, "", where=where)).line

    def _keywords(self) -> int:
        """Add the blocks; returns the digest of all of them."""
        found = [
            (section.name, block, Where(i, j), _digest(section.name, block))
            for i, section in enumerate(self.deck.sections)
            for j, block in enumerate(section.blocks)
        ]
        total = sum(digest for *_, digest in found)
        for place, (section, block, where, digest) in enumerate(found, 1):
            keyword = block.keyword
            known = type(block) is not Opaque
            facts = (known, extent(block) == "partly", is_superseded(keyword), is_extension(keyword))
            row = (place, section, keyword, self._line(where), *facts, digest, (total - digest) % (1 << _DIGEST))
            self.made["keywords"].append(row)
        return total % (1 << _DIGEST)

    def _sets(self) -> int:
        named = {key: entry for key, entry in self.scene.set_table.named.items() if key != ALL}
        used = self._names_of_sets() if named else set()
        opaque = self._opaque_text() if named else ""
        for key, entry in named.items():
            ids = self.scene.element_ids[entry.elements]
            ends = (int(ids.min()), int(ids.max())) if len(ids) else (None, None)
            is_used = key in used or key in opaque
            row = (entry.name, len(ids), *ends, not entry.open, is_used, self._line(entry.where))
            self.made["sets"].append(row)
        return len(named)

    def _names_of_sets(self) -> set[str]:
        return {folded(bare(name)) for _, name in used_names(self.scene.deck, Names.SET, Names.SUBSET)}

    def _opaque_text(self) -> str:
        """The lines that are not read: they may name sets."""
        blocks = (block for section in self.deck.sections for block in section.blocks)
        lines = (block.lines if type(block) is Opaque else kept_lines(block) for block in blocks)
        return "\n".join(line for own in lines for line in own).casefold()

    def _curves(self) -> None:
        for place, entry in enumerate(self.scene.laws.curves, 1):
            curve = entry.curve
            ratios, forces = (curve.ratios, curve.forces) if curve else np.ascontiguousarray(entry.points.T)
            steepest = float(curve.slopes.max()) if curve is not None else None
            ends = (float(ratios[0]), float(ratios[-1]), float(forces.max())) if len(ratios) else (None, None, None)
            followers = len(self.scene.laws.followers(place - 1)) if len(self.scene.element_ids) else 0
            shape = number_of(ratios.tobytes() + forces.tobytes())
            points = (ratios.tolist(), forces.tolist())
            row = (*points, *ends, steepest, followers, shape, self._line(entry.title))
            keyword = self.scene.deck.sections[entry.where.section].blocks[entry.where.block].keyword
            self.made["curves"].append((place, entry.name, OF_SEABED, keyword, entry.embedment, *row))
        self._other_curves()

    def _other_curves(self) -> None:
        """The curves that are none of a seabed: no element follows them."""
        for place, one in enumerate(other_curves(self.scene.deck), len(self.scene.laws.curves) + 1):
            made = one.made()
            over, values = (made.ratios, made.forces) if made else np.ascontiguousarray(one.points.T)
            ends = (float(over[0]), float(over[-1]), float(values.max())) if len(over) else (None, None, None)
            steepest = float(made.slopes.max()) if made else None
            shape = number_of(over.tobytes() + values.tobytes())
            row = (over.tolist(), values.tolist(), *ends, steepest, 0, shape, self._line(one.title))
            self.made["curves"].append((place, one.name, one.kind, one.keyword, False, *row))

    def _laws(self) -> None:
        scene = self.scene
        followers = np.bincount(scene.laws.of_element + 1, minlength=len(scene.laws.set_laws) + 1)[1:].tolist()
        for place, (law, elements) in enumerate(zip(scene.laws.set_laws, followers, strict=True), 1):
            where = law.where
            keyword = scene.deck.sections[where.section].blocks[where.block].keyword
            kind, curve = _KINDS[law.kind], law.curve + 1 or None
            held = len(law.set_.elements)
            row = (keyword, law.family, kind, law.set_.name, curve, law.stiffness, held, elements, self._line(where))
            self.made["laws"].append((place, *row))

    def _parameters(self) -> None:
        if "PARAMETERS" not in self.deck.keywords("PREPROCESSOR"):
            return
        parameters = Parameters(self.deck)
        varied = "VARIATION" in self.deck.keywords("PREPROCESSOR")
        used = _names_in_equations(self.data)
        for key, found in parameters.definitions.items():
            value = parameters.values.get(key)
            text = value if isinstance(value, str) else None
            equation = str(found.value) if isinstance(found.value, Equation) else None
            is_used = None if varied else key in used
            amount = None if text is not None or value is None else float(value)
            row = (found.name, amount, text, equation, is_used, self._line(found.where))
            self.made["parameters"].append(row)


def _names_in_equations(data: bytes) -> set[str]:
    """The words of the equations and the placeholders in a text."""
    text = data.decode("utf-8", "replace")
    found = (match[1] or match[2] for match in _EQUATION.finditer(text))
    return {folded(word) for piece in found for word in (*_WORD.findall(piece), piece)}


# ------------------------------------------------------------------------------------------------ digests of values


def number_of(data: bytes) -> int:
    """A digest of bytes as a whole number of 63 bits."""
    return int.from_bytes(blake2b(data, digest_size=8).digest()) >> 1


def _digest(section: str, block: Any) -> int:
    """A digest of what a block says: equal for equal values, whatever their layout and comments are."""
    pieces = [section.encode(), block.keyword.encode()]
    if type(block) is Opaque:
        lines = (" ".join(line.split()) for line in block.lines if not re.match(r"C(\s|$)", line))
        pieces += (line.encode("utf-8", "backslashreplace") for line in lines if line)
    else:
        pieces += _pieces(block.model_dump(exclude={"keyword"}, exclude_unset=True, context=AS_TABLES))
    return number_of(b"\0".join(pieces))


def _pieces(value: object) -> Iterator[bytes]:
    if isinstance(value, dict):
        for key, item in value.items():
            if key != "comments" and item is not None:
                yield key.encode()
                yield from _pieces(item)
    elif isinstance(value, Listing):
        yield value.table.values.tobytes()
        yield repr(sorted(value.table.words.items())).casefold().encode("utf-8", "backslashreplace")
    elif isinstance(value, list | tuple):
        yield b"["
        for item in cast("list[object]", value):
            yield from _pieces(item)
        yield b"]"
    elif isinstance(value, str):
        yield value.casefold().encode("utf-8", "backslashreplace")
    elif isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        yield str(int(value)).encode()
    else:
        yield repr(value).encode()
