"""The bed of a deck, in figures: its shape, friction and suction, and the laws of the extension keywords."""

from __future__ import annotations

from typing import Any

from mudline.results.numbers import finite
from mudline.scene.model import Scene
from mudline.scene.seabed import SeabedKind, SeabedShape

_PAIRS = ("friction", "mobilisation")
_SINGLE = ("lateral", "suction", "extent")


def floor_summary(floor: SeabedShape) -> dict[str, Any]:
    """The shape of the bed; null for what its kind has not."""
    slope = floor.kind is SeabedKind.SLOPING
    from_points = floor.kind in (SeabedKind.PROFILE, SeabedKind.SURFACE)
    return {
        "kind": floor.kind.value,
        "slope": finite(floor.slope) if slope else None,
        "direction": finite(floor.direction) if slope or from_points else None,
        "interpolation": floor.interpolation if from_points else None,
        "points": len(floor.points) if from_points and not floor.missing else None,
        "planes": len(floor.planes) or None,
        "file": floor.file or None,
        "missing": floor.missing or None,
    }


def bed_summary(scene: Scene) -> list[dict[str, Any]]:
    """Friction, mobilisation, lateral stiffness and suction by block, with the number of elements that have them.

    Friction coefficients and mobilisation lengths are longitudinal and transverse. Blocks that give none of all this
    are left out.
    """
    rows = []
    for index, (values, where) in enumerate(zip(scene.resistance.values, scene.resistance.places, strict=True)):
        pairs = {name: [finite(value) for value in getattr(values, name)] for name in _PAIRS}
        single = {name: finite(getattr(values, name)) for name in _SINGLE}
        if any(value is not None for value in (*single.values(), *(one for pair in pairs.values() for one in pair))):
            entry: Any = scene.deck.sections[where.section].blocks[where.block]
            name = (entry.sets[where.path[1]].set_name or "ALL") if where.path[0] == "sets" else "ALL"
            rows.append({"set": name, "elements": int((scene.resistance.of_element == index).sum()), **pairs, **single})
    return rows


def extension_summary(scene: Scene) -> list[dict[str, Any]]:
    """The blocks of the extension keywords, with the elements that follow each."""
    return [
        {
            "keyword": keyword,
            "set": getattr(entry, "set_name", None),
            "elements": int((found.of_element == index).sum()),
        }
        for keyword, found in scene.extensions.items()
        for index, entry in enumerate(found.entries)
    ]
