"""Values outside the range that the declaration of their field gives."""

from __future__ import annotations

import math
from typing import Any

from mudline.codes import SBD010
from mudline.diagnostics import Where
from mudline.keywords.model import Block, ListRow, Part, Slot, layout
from mudline.scene.context import Context


def check_ranges(context: Context) -> None:
    """Every number of `$MODEL` against the range of its field."""
    for i, section in enumerate(context.deck.sections):
        if section.name != "MODEL":
            continue
        for j, block in enumerate(section.blocks):
            if isinstance(block, Block):
                _part(context, block, Where(i, j))


def _part(context: Context, part: Part, where: Where) -> None:
    if isinstance(part, ListRow):
        return
    for slot in layout(type(part)).slots:
        value: Any = getattr(part, slot.name)
        inner = where._replace(path=(*where.path, slot.json))
        if isinstance(value, float | int):
            _number(context, value, slot, inner)
        elif isinstance(value, Part):
            _part(context, value, inner)
        elif isinstance(value, list) and value and isinstance(value[0], Part):
            for index, item in enumerate(value):
                _part(context, item, inner._replace(path=(*inner.path, index)))


def _number(context: Context, value: float, slot: Slot, where: Where) -> None:
    low, above = slot.about.at_least, slot.about.above
    if math.isnan(value) or (low is None and above is None):
        return
    if low is not None and value < low:
        context.tell(SBD010, f"{_name(slot)} is {value!r}: it must not be less than {low:g}", where)
    elif above is not None and value <= above:
        context.tell(SBD010, f"{_name(slot)} is {value!r}: it must be greater than {above:g}", where)


def _name(slot: Slot) -> str:
    """The field in words: `FRICTION=`, `water depth`, `external diameter Do`."""
    meaning = slot.about.meaning.partition(";")[0]
    if slot.key:
        return slot.label
    return meaning if slot.label.lower() in meaning.lower().split() else f"{meaning} {slot.label}"
