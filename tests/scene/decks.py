"""Decks as text, their scenes, and what resolving them tells."""

from __future__ import annotations

from mudline.deck.loading import load_bytes
from mudline.diagnostics import Diagnostic
from mudline.scene.model import Scene, resolve

Finding = tuple[str, str, int, int]
"""Severity letter, code, line and column."""

PIPE = """\
$MODEL
*NODE
 1, -0.05, 0.0
 11, -0.05, 100.0
 GEN=1, 11
*ELEMENT
 1, 1, 2
 GEN=1, 10
"""
"""Ten elements of 10 m just below the bed."""

STEEL = """\
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.25, 0.22, 7850.0
"""

CLAY = """\
*SEABED STIFFNESS
 CURVE=Clay
 0.0, 0.0
 0.5, 4000.0
"""


def scene_of(text: str, name: str = "deck.keyxm") -> Scene:
    return resolve(load_bytes(text.encode(), name))


def diagnostics(scene: Scene) -> list[Diagnostic]:
    return scene.deck.diagnose(scene.problems)


def reported(text: str) -> list[Finding]:
    """What resolving a deck tells, without what reading it tells."""
    return [(d.severity.value[0].upper(), d.code, d.line, d.column) for d in diagnostics(scene_of(text))]


def all_reported(text: str) -> list[Finding]:
    """What reading and resolving a deck tell."""
    scene = scene_of(text)
    found = scene.deck.diagnose([*scene.deck.problems, *scene.problems])
    return [(d.severity.value[0].upper(), d.code, d.line, d.column) for d in found]


def messages(text: str) -> list[str]:
    return [found.message for found in diagnostics(scene_of(text))]


def members(scene: Scene) -> dict[str, list[int]]:
    """Element numbers of every set."""
    return {name: ids.tolist() for name, ids in scene.sets.items()}


def nodes_of(scene: Scene) -> dict[int, list[float]]:
    return dict(zip(scene.node_ids.tolist(), scene.coordinates.tolist(), strict=True))


def ends_of(scene: Scene) -> dict[int, list[int]]:
    """Node numbers of every element; 0 for a node that is not known."""
    ids = [*scene.node_ids.tolist(), 0]
    pairs = [[ids[end] for end in ends] for ends in scene.element_nodes.tolist()]
    return dict(zip(scene.element_ids.tolist(), pairs, strict=True))
