"""Anonymous copies of decks: the data that contact needs, with other names and another origin.

Names become `Set1`, `Curve2` and so on, equations their values. Comments, titles, unread lines and keywords that the
contact does not need are left out. Numbers of nodes and elements, elevations, soil and sections stay.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

import numpy as np

from mudline.language.codes import RUN001
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.model import Deck, Opaque, Section
from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import DeckError, Problem, Where
from mudline.language.keywords.model import Block, FieldSpec, Path
from mudline.language.keywords.rebuilding import rebuilt
from mudline.language.keywords.table import Table
from mudline.language.keywords.values import Names
from mudline.model.contact.result import ContactResult
from mudline.model.scene.model import Scene, resolve
from mudline.model.scene.numbering import Floats
from mudline.model.scene.seabed import SeabedKind

TOLERANCE = 1e-9
"""Share of the largest force by which the forces of both decks may differ."""

_NEEDED = {
    "MODEL": {
        *("NODE", "ELEMENT", "ELEMENT SETS", "GEOMETRIC SETS", "HYDRODYNAMIC SETS", "OCEAN"),
        *("FORCE-STRAIN", "MOMENT-CURVATURE", "TORQUE-TWIST"),
    },
    "LOAD CASE": {"INTERNAL FLUID"},
    "ANALYSIS": {"UNITS"},
}
_ALL = "all"
_AXES = {"y": 0, "y_min": 0, "y_max": 0, "z": 1, "z_min": 1, "z_max": 1}
"""Fields that are horizontal coordinates: 0 for Y, 1 for Z."""
_COLUMNS = {"nodes": {2: 0, 3: 1}, "profile": {0: 0}}
"""Columns of such coordinates in the tables that have them."""


class Anonymous(NamedTuple):
    """An anonymous deck.

    Attributes:
        deck: the new deck.
        left_out: the keywords left out, in order.
        shift: the amounts subtracted from Y and Z.
    """

    deck: Deck
    left_out: tuple[str, ...]
    shift: tuple[float, float]


def anonymous(deck: Deck) -> Anonymous:
    """Return the deck with other names and another origin of Y and Z, after a check that its forces are the same.

    Both decks are evaluated at their own coordinates, pressed down and moved sideways. A seabed that slopes through the
    origin keeps the coordinate along the slope; if it slopes along neither Y nor Z, it keeps both.

    Raises DeckError: the deck cannot be evaluated, it needs other files, or the forces differ by more than `TOLERANCE`.
    """
    before = resolve(deck).require_evaluable()
    shift = _shift(before)
    hiding = _Hiding(shift)
    sections = [
        Section(section.name, [*hiding.blocks(index, section)]) for index, section in enumerate(before.deck.sections)
    ]
    if hiding.file is not None:
        raise _refused(deck, "it names a file, which would have to be made anonymous too", hiding.file)
    anonymised = Deck("anonymous", units=deck.units, sections=[section for section in sections if section.blocks])
    read = load_bytes(dump(anonymised, "keyword").encode(), "anonymous.keyx", units=deck.units)
    left_out = tuple(dict.fromkeys(hiding.left_out))
    try:
        same = _same(before, resolve(read).require_evaluable())
    except DeckError:
        same = False
    if not same:
        lost = ", ".join(f"*{keyword}" for keyword in left_out)
        raise _refused(deck, f"the forces would change without {lost}" if lost else "the forces would change", None)
    return Anonymous(read, left_out, shift)


def _refused(deck: Deck, why: str, where: Where | None) -> DeckError:
    return DeckError(deck.diagnose([Problem(RUN001, f"the deck is not made anonymous: {why}", where=where)]))


def _shift(scene: Scene) -> tuple[float, float]:
    """Return whole numbers near Y and Z of the first node, 0 for a coordinate in which the seabed must not be moved."""
    y, z = (float(round(value)) for value in scene.coordinates[0, 1:]) if len(scene.coordinates) else (0.0, 0.0)
    if scene.seabed.kind is not SeabedKind.SLOPING:
        return y, z
    direction = scene.seabed.direction % 180.0
    return (0.0 if direction != 90.0 else y), (0.0 if direction != 0.0 else z)


@dataclass
class _Hiding:
    """Maker of the parts of the new deck.

    Attributes:
        shift: the amounts subtracted from Y and Z.
        names: new names by casefolded old name.
        left_out: the keywords left out.
        file: place of the first file name in the deck.
    """

    shift: tuple[float, float]
    names: dict[str, str] = field(default_factory=dict)
    left_out: list[str] = field(default_factory=list)
    file: Where | None = None

    def blocks(self, index: int, section: Section) -> Iterator[Block]:
        """Yield the blocks that the contact needs."""
        for number, block in enumerate(section.blocks):
            if isinstance(block, Opaque) or not _is_needed(section.name, block):
                self.left_out.append(block.keyword)
            else:
                yield rebuilt(block, partial(self._changed, Where(index, number)), bare=True)

    def _changed(self, block: Where, value: object, slot: FieldSpec, path: Path) -> object:
        """Return a value with another name, or counted from the new origin."""
        if slot.about.names is Names.FILE:
            self.file = self.file or block.inside(*path)
        if isinstance(value, Table):
            return _moved(value, {column: self.shift[axis] for column, axis in _COLUMNS.get(slot.name, {}).items()})
        if isinstance(value, str) and value not in slot.choices:
            return self._name(value, slot)
        return value - self.shift[_AXES[slot.name]] if isinstance(value, float) and slot.name in _AXES else value

    def _name(self, name: str, slot: FieldSpec) -> str:
        if folded(name) == _ALL:
            return name
        thing = slot.about.names or slot.about.defines
        word = "Name" if thing is None else thing.name.capitalize()
        return self.names.setdefault(folded(name), f"{word}{len(self.names) + 1}")


def _is_needed(section: str, block: Block) -> bool:
    return block.keyword in _NEEDED.get(section, ()) or (section == "MODEL" and block.subject == "seabed")


def _moved(table: Table, by: dict[int, float]) -> Table:
    """Return a table without labels, with amounts subtracted from columns; an omitted Z is 0."""
    values, words = table.values.copy(), dict.fromkeys(table.words)  # a label of *LABEL is a number by now
    lengths = table.lengths.copy()
    for column, amount in by.items():
        if amount:
            values[:, column] = np.nan_to_num(values[:, column]) - amount
            lengths = np.maximum(lengths, column + 1)
            words = {place: word for place, word in words.items() if place[1] != column}
    return Table(values, lengths, words, table.columns)


# ---------------------------------------------------------------------------------------------------------- the proof


def _same(before: Scene, after: Scene) -> bool:
    """Return True if both decks have the same elements and, in a few positions, the same forces."""
    if not (np.array_equal(before.node_ids, after.node_ids) and np.array_equal(before.element_ids, after.element_ids)):
        return False
    first, second = _evaluated(before), _evaluated(after)
    pairs = [(getattr(first, name), getattr(second, name)) for name in ("force", "stiffness", "reaction", "friction")]
    return all(_near(a, b) for a, b in pairs)


def _near(first: Floats | None, second: Floats | None) -> bool:
    if first is None or second is None:
        return first is second
    largest = float(np.nanmax(np.abs(first), initial=0.0))
    return bool(np.allclose(first, second, rtol=0.0, atol=TOLERANCE * largest, equal_nan=True))


def _evaluated(scene: Scene) -> ContactResult:
    """Evaluate at the deck's coordinates, then a third of a diameter lower, as far sideways, and back."""
    diameters = scene.diameter[np.isfinite(scene.diameter)]
    step = float(diameters.max(initial=0.0)) / 3.0 or math.ulp(1.0)
    moves = np.array([(0.0, 0.0, 0.0), (-step, 0.0, 0.0), (-step, step, step), (0.0, 0.0, 0.0)])
    return scene.contact(backend="numpy").evaluate(scene.coordinates + moves[:, None], times=np.arange(4.0))
