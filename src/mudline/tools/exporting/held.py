"""Which nodes a deck holds, in which degrees of freedom, and what became of the ends of its lines."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.basics.quantities import shown
from mudline.language.deck.evaluated import evaluated
from mudline.language.deck.parameters import folded
from mudline.language.keywords import catalogue
from mudline.language.keywords.table import LARGEST_WHOLE
from mudline.language.keywords.values import Names
from mudline.language.syntax.rows import read_number
from mudline.model.scene.deck_values import number
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices
from mudline.model.scene.references import freedom_and_step
from mudline.tools.exporting.report import Report, Status

if TYPE_CHECKING:
    from mudline.language.keywords.library.loads import Boundary, BoundaryType
    from mudline.language.keywords.library.vessel_motions import Offsets

TRANSLATIONS = frozenset({1, 2, 3})
_NO_FREEDOMS: frozenset[int] = frozenset()


@dataclass(frozen=True, slots=True)
class End:
    """An end of lines: a node that is `held` (degrees of freedom of the deck), moved by a `vessel`, or joins lines."""

    node: int
    held: frozenset[int]
    vessel: bool

    @property
    def joins(self) -> bool:
        """Whether lines join there and nothing else holds it."""
        return not self.held & TRANSLATIONS


@dataclass(frozen=True, slots=True)
class Held:
    """The degrees of freedom in which `*BOUNDARY` holds nodes, by their indices, and those that a vessel moves."""

    freedoms: dict[int, frozenset[int]] = field(default_factory=dict)
    moved: set[int] = field(default_factory=set)

    def of(self, node: int) -> frozenset[int]:
        """Those of a node."""
        return self.freedoms.get(node, _NO_FREEDOMS)


def read_held(scene: Scene, report: Report) -> Held:
    """What `*BOUNDARY` holds; displacements and types of other motions are added to the report."""
    held = Held()
    for where, block in scene.deck.blocks("BOUNDARY", "LOAD CASE"):
        for each in cast("Boundary", block).types:
            if each.type_ not in ("CONSTANT", "VESSEL"):
                effect = "its nodes are held and not moved"
                report.add(where, Status.LEFT_OUT, "none", effect, f"TYPE={each.type_}")
            for nodes, freedoms, value in conditions(scene, each):
                for node in nodes.tolist():
                    held.freedoms[node] = held.of(node) | freedoms
                held.moved.update(nodes.tolist() if each.type_ == "VESSEL" else ())
                if value:
                    effect = f"node {int(scene.node_ids[nodes[0]])} stays where its coordinates are"
                    report.add(where, Status.LEFT_OUT, "none", effect, f"displacement {shown(value)}")
    return held


def conditions(scene: Scene, given: BoundaryType) -> Iterator[tuple[Indices, frozenset[int], float]]:
    """Nodes, degrees of freedom and displacement of each line; a line of a vessel without a freedom holds all."""
    for start, end, step, freedom, value in _ranges(given):
        nodes = scene.nodes.between(start, end, step)
        if nodes.size:
            yield nodes, TRANSLATIONS if freedom is None else frozenset({freedom}), value


def _ranges(given: BoundaryType) -> Iterator[tuple[int, int, int, int | None, float]]:
    for entry in given.entries:
        if hasattr(entry, "generate"):
            values = entry.generate
            at, step = freedom_and_step(values)
            numbers = (values.start, values.end, step, (values.third, values.fourth)[at - 2])
            if all(isinstance(each, int | float) for each in numbers):
                start, end, step, freedom = (int(cast("int", each)) for each in numbers)
                yield start, end, max(1, step), freedom, number(values, "fifth", 0.0)
        elif isinstance(entry.node, int) and isinstance(entry.dof, int | float):
            yield entry.node, entry.node, 1, int(entry.dof), number(entry, "value", 0.0)
    for line in given.unread:
        words = [read_number(word.strip()) for word in line.text.split(",")]
        whole = [int(word) for word in words if word is not None and abs(word) <= LARGEST_WHOLE]
        if words[0] is not None and whole:
            yield whole[0], whole[0], 1, next(iter(whole[1:]), None), 0.0


def held_nodes(scene: Scene) -> tuple[dict[int, frozenset[int]], dict[int, str]]:
    """Return the degrees of freedom in which `*BOUNDARY` holds nodes, by index, and the vessels that move nodes.

    Those of the decks that are continued count too: a restart keeps what it does not change.
    """
    freedoms: dict[int, frozenset[int]] = {}
    vessels: dict[int, str] = {}
    decks = [*(evaluated(base.deck)[0] for base in reversed(scene.deck.bases)), scene.deck]
    keywords = catalogue.definers(Names.VESSEL)
    placed = (block for deck in decks for keyword in keywords for _, block in deck.blocks(keyword))
    known = [str(each.vessel) for block in placed for each in block.vessels]
    only = known[0] if len({folded(name) for name in known}) == 1 else ""
    for deck in decks:
        for _, block in deck.blocks("BOUNDARY", "LOAD CASE"):
            for each in cast("Boundary", block).types:
                for nodes, axes, _ in conditions(scene, each):
                    for node in nodes.tolist():
                        freedoms[node] = freedoms.get(node, frozenset()) | axes
                        if each.type_ == "VESSEL":
                            vessels.setdefault(node, only)
                current = ""
                for line in each.unread if each.type_ == "VESSEL" else ():
                    current = _vessel_of_line(scene, line.text, current, vessels)
    return freedoms, vessels


def _vessel_of_line(scene: Scene, text: str, current: str, vessels: dict[int, str]) -> str:
    """Note the vessel of a node that a line names, `node, vessel` or below VESSEL=; returns the vessel that goes on."""
    key, equals, name = text.partition("=")
    if equals and key.strip().upper() == "VESSEL":
        return name.strip()
    words = [word.strip() for word in text.split(",")]
    node = read_number(words[0])
    own = next((word for word in words[1:] if word and read_number(word) is None), current)
    if node is not None and own and node == int(node):
        at = int(scene.nodes.indices(np.array([int(node)]))[0])
        if at >= 0:
            vessels[at] = own
    return current


def vessel_offset(scene: Scene, vessel: str) -> Floats:
    """Return the offset (3,) of a vessel in the deck's own load case; 0 without one."""
    found = np.zeros(3)
    for _, block in scene.deck.blocks("OFFSET", "LOAD CASE"):
        for each in cast("Offsets", block).offsets:
            if vessel and folded(str(each.vessel)) == folded(vessel):
                found = np.array([number(each.offset, axis, 0.0) for axis in "xyz"])
    return found


def report_inside(scene: Scene, report: Report, held: Held, ends: set[int]) -> None:
    """Add the nodes inside of lines that are held in a part of their degrees of freedom."""
    inside: dict[str, list[int]] = {}
    for node in sorted(set(held.freedoms) - ends):
        inside.setdefault(", ".join(map(str, sorted(held.of(node)))), []).append(int(scene.node_ids[node]))
    where = [at for at, _ in scene.deck.blocks("BOUNDARY", "LOAD CASE")]
    for freedoms, nodes in inside.items():
        effect = f"inside of a line: free here (nodes: {len(nodes)}, the first {nodes[0]})"
        report.add(where[-1], Status.LEFT_OUT, "none", effect, f"DOF {freedoms}")


def report_ends(report: Report, ends: list[End], fixed: str, vessel: str, *, clamps: bool = False) -> None:
    """Add what became of the ends: held where they may move a little, on vessels, against rotation."""
    scene = report.scene
    places = [where for where, _ in scene.deck.blocks("BOUNDARY", "LOAD CASE")]
    for where in places:
        report.add(where, Status.CARRIED, f"{fixed}, {vessel} ends")
    for end in ends:
        node = f"node {int(scene.node_ids[end.node])}"
        if end.vessel:
            status = Status.CARRIED if vessel != fixed else Status.APPROXIMATED
            report.add(places[-1], status, vessel, f"{node} stays where it is until it is moved", f"vessel at {node}")
        if not end.joins and (missing := sorted(TRANSLATIONS - end.held)):
            effect = f"free in DOF {', '.join(map(str, missing))} in the deck: held at its coordinates"
            report.add(places[-1], Status.APPROXIMATED, vessel if end.vessel else fixed, effect, node)
        if not clamps and (turned := sorted(end.held - TRANSLATIONS)):
            effect = f"no moment at {node}: the line turns freely there"
            report.add(places[-1], Status.LEFT_OUT, "a hinge", effect, f"DOF {', '.join(map(str, turned))}")
