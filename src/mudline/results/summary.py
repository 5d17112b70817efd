"""What a deck holds, in figures."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mudline.contact import LawKind
from mudline.deck.model import Opaque
from mudline.results.curves import followers, static_embedment
from mudline.results.quantities import finite
from mudline.scene.model import Scene
from mudline.scene.seabed import SeabedKind, SeabedShape


def summarise(scene: Scene) -> dict[str, Any]:
    """Sections, keywords, counts, sets, curves, diameters and laws of a deck."""
    deck = scene.deck
    return {
        "file": deck.file,
        "units": deck.units,
        "continues": [base.deck.file for base in deck.bases],
        "sections": [
            {
                "name": section.name,
                "keywords": [{"keyword": b.keyword, "read": not isinstance(b, Opaque)} for b in section.blocks],
            }
            for section in deck.own_sections
        ],
        "nodes": len(scene.node_ids),
        "elements": len(scene.element_ids),
        "length": _total_length(scene),
        "sets": _sets(scene),
        "curves": _curves(scene),
        "diameters": _diameters(scene),
        "laws": _laws(scene),
        "seabed": sorted(name.lower() for name in scene.laws.types),
        "floor": floor_summary(scene.seabed),
        "bed": bed_summary(scene),
        "extensions": extension_summary(scene),
        "static_embedment": static_embedment(scene),
    }


def _total_length(scene: Scene) -> float | None:
    known = scene.length[~np.isnan(scene.length)]
    return _sum(known) if known.size else None


def _sum(lengths: NDArray[np.float64]) -> float | None:
    """The sum of lengths; None when it overflows, or one of them is not known."""
    with np.errstate(over="ignore", invalid="ignore"):
        return finite(float(lengths.sum()))


def _sets(scene: Scene) -> list[dict[str, Any]]:
    rows = []
    for entry in scene.set_table.named.values():
        count = len(entry.elements)
        length = _sum(scene.length[entry.elements]) if count else None
        rows.append({"name": entry.name, "elements": count, "length": length, "open": entry.open})
    return rows


def _curves(scene: Scene) -> list[dict[str, Any]]:
    rows = []
    for index, entry in enumerate(scene.laws.curves):
        curve = entry.curve
        rows.append(
            {
                "name": entry.name,
                "keyword": "EMBEDMENT" if entry.embedment else "SEABED STIFFNESS",
                "points": len(entry.points),
                "ratios": None if curve is None else [float(curve.ratios[0]), float(curve.ratios[-1])],
                "forces": None if curve is None else [float(curve.forces.min()), float(curve.forces.max())],
                "elements": int(followers(scene, index).sum()),
                "open": any(grant.curve == index and grant.set_.open for grant in scene.laws.set_laws),
            }
        )
    return rows


def _diameters(scene: Scene) -> list[dict[str, Any]]:
    known = scene.diameter[~np.isnan(scene.diameter)]
    values, counts = np.unique(known, return_counts=True)
    rows = [
        {"diameter": value, "elements": count} for value, count in zip(values.tolist(), counts.tolist(), strict=True)
    ]
    missing = len(scene.diameter) - len(known)
    return [*rows, {"diameter": None, "elements": missing}] if missing else rows


def _laws(scene: Scene) -> list[dict[str, Any]]:
    """Laws with the number of their elements; linear ones by stiffness."""
    rows: list[dict[str, Any]] = []
    for index, grant in enumerate(scene.laws.set_laws):
        count = int((scene.laws.of_element == index).sum())
        if count:
            law = scene.law_name(grant)
            stiffness = grant.stiffness if grant.kind is LawKind.LINEAR else None
            rows.append({"law": law, "set": grant.set_.name, "elements": count, "stiffness": stiffness})
    free = int((scene.laws.of_element < 0).sum())
    return [*rows, {"law": "none", "set": None, "elements": free, "stiffness": None}] if free else rows


_PAIRS = ("friction", "mobilisation")
_SINGLE = ("lateral", "suction", "extent")


def floor_summary(floor: SeabedShape) -> dict[str, Any]:
    """The shape of the seabed; null for what its kind has not."""
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
