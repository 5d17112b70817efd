"""Ends of the lines of a deck, and the report on them and on the nodes that the deck holds."""

from __future__ import annotations

from dataclasses import dataclass

from mudline.basics.quantities import shown
from mudline.model.scene.boundary import TRANSLATIONS, held_nodes
from mudline.model.scene.model import Scene
from mudline.tools.exporting.report import ExportReport, Outcome


@dataclass(frozen=True, slots=True)
class End:
    """End of lines: a node that is `held` (degrees of freedom of the deck), moved by a `vessel`, or joins lines."""

    node: int
    held: frozenset[int]
    vessel: bool

    @property
    def joins(self) -> bool:
        """True if lines join there and nothing else holds the node."""
        return not self.held & TRANSLATIONS


def report_held(scene: Scene, report: ExportReport) -> None:
    """Report displacements of held nodes, and types of motion other than those of vessels."""
    for where, block in scene.deck.blocks("BOUNDARY", "LOAD CASE"):
        for each in block.types:
            if each.type_ not in ("CONSTANT", "VESSEL"):
                effect = "its nodes are held and not moved"
                report.add(where, Outcome.LEFT_OUT, "none", effect, f"TYPE={each.type_}")
    for line in held_nodes(scene):
        value = line.how[0]
        if isinstance(value, float | int) and value and line.nodes.size:
            effect = f"node {int(scene.node_ids[line.nodes[0]])} stays where its coordinates are"
            report.add(line.where._replace(path=()), Outcome.LEFT_OUT, "none", effect, f"displacement {shown(value)}")


def report_inside(scene: Scene, report: ExportReport, held: dict[int, frozenset[int]], ends: set[int]) -> None:
    """Report nodes inside lines that are held in some of their degrees of freedom."""
    inside: dict[str, list[int]] = {}
    for node in sorted(set(held) - ends):
        inside.setdefault(", ".join(map(str, sorted(held[node]))), []).append(int(scene.node_ids[node]))
    where = [at for at, _ in scene.deck.blocks("BOUNDARY", "LOAD CASE")]
    for freedoms, nodes in inside.items():
        effect = f"inside of a line: free here (nodes: {len(nodes)}, the first {nodes[0]})"
        report.add(where[-1], Outcome.LEFT_OUT, "none", effect, f"DOF {freedoms}")


def report_ends(report: ExportReport, ends: list[End], fixed: str, vessel: str, *, clamps: bool = False) -> None:
    """Report the ends: held although partly free, on vessels, fixed against rotation."""
    scene = report.scene
    places = [where for where, _ in scene.deck.blocks("BOUNDARY", "LOAD CASE")]
    for where in places:
        report.add(where, Outcome.CARRIED, f"{fixed}, {vessel} ends")
    for end in ends:
        node = f"node {int(scene.node_ids[end.node])}"
        if end.vessel:
            status = Outcome.CARRIED if vessel != fixed else Outcome.APPROXIMATED
            report.add(places[-1], status, vessel, f"{node} stays where it is until it is moved", f"vessel at {node}")
        if not end.joins and (missing := sorted(TRANSLATIONS - end.held)):
            effect = f"free in DOF {', '.join(map(str, missing))} in the deck: held at its coordinates"
            report.add(places[-1], Outcome.APPROXIMATED, vessel if end.vessel else fixed, effect, node)
        if not clamps and (turned := sorted(end.held - TRANSLATIONS)):
            effect = f"no moment at {node}: the line turns freely there"
            report.add(places[-1], Outcome.LEFT_OUT, "a hinge", effect, f"DOF {', '.join(map(str, turned))}")
