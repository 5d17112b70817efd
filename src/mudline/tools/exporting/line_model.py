"""Description of a deck's lines for all targets: sections, stretches, end points, seabed.

SI units in the axes of the targets: x and y horizontal, equal to Y and Z of the deck, z up from the sea surface. The
mudline at X = 0 of the deck is at z = -depth.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple, cast

import numpy as np

from mudline.basics.quantities import shown
from mudline.basics.units import UNITS, UnitSystem
from mudline.language.diagnostics import Where
from mudline.language.keywords.library.hydrodynamic_sets import HydrodynamicSets
from mudline.model.contact import ContactResult
from mudline.model.contact.lines import lines_of
from mudline.model.contact.seabed import Seabed
from mudline.model.contact.touchdown import line_summaries
from mudline.model.scene.boundary import NO_FREEDOMS, TRANSLATIONS, held_freedoms
from mudline.model.scene.deck_values import number, unread_makers
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Mask
from mudline.model.scene.seabed import SeabedKind, made_seabed
from mudline.model.scene.sections import Section
from mudline.model.scene.weights import BENDING_CURVES, STIFFNESS_CURVES, Pipe, contents_case, pipe_of, stiffnesses
from mudline.tools.exporting.report import ExportReport, Outcome
from mudline.tools.exporting.soil import ExportSoil, soils_of

_ALIKE = 1e-3
"""Share of the longest element by which equal lengths may differ."""
_AROUND = 5
"""Elements in contact next to each touchdown point whose seabed is used for targets with one seabed."""
_DRAG, _ADDED = 1.2, 1.0
"""Coefficients used if the deck has none."""


class End(NamedTuple):
    """End of lines: a node that is `held` (degrees of freedom of the deck), moved by a `vessel`, or joins lines."""

    node: int
    held: frozenset[int]
    vessel: bool

    @property
    def joins(self) -> bool:
        """True if lines join there and nothing else holds the node."""
        return not self.held & TRANSLATIONS


class PipeSection(NamedTuple):
    """A cross-section with its contents and coefficients, in SI units.

    `diameter` is that of contact, `buoyancy` that of the displaced water. `mass` includes the `contents`. Coefficients
    of drag and added mass, across and along, refer to the buoyancy diameter. `assumed` is True if the deck has none.
    """

    name: str
    where: Where
    diameter: float
    buoyancy: float
    inner: float
    mass: float
    axial: float
    bending: float
    torsion: float
    contents: float
    drag: float
    axial_drag: float
    added: float
    axial_added: float
    assumed: bool


class LineStretch(NamedTuple):
    """Consecutive elements with one section and one seabed: indices of k + 1 nodes in the model, and k lengths.

    If a target takes several sections or seabeds as one, they are those of the first element.
    """

    section: int
    soil: int
    nodes: Indices
    lengths: Floats

    @property
    def length(self) -> float:
        """Length of all elements."""
        return float(self.lengths.sum())

    @property
    def is_even(self) -> bool:
        """True if the elements have equal lengths, apart from the rounding of coordinates."""
        return bool(np.ptp(self.lengths) <= _ALIKE * self.lengths.max())


class ExportLine(NamedTuple):
    """A line from one end to the other: its k elements, with the section and the soil (k, 2) of each.

    `begin` and `end` are indices of the model's ends. Nodes and lengths are as in `LineStretch`.
    """

    name: str
    begin: int
    end: int
    kinds: Indices
    nodes: Indices
    lengths: Floats

    def stretches(self, labels: Indices) -> Iterator[LineStretch]:
        """Yield the stretches of consecutive elements with the same labels (k, j)."""
        changes = np.flatnonzero((np.diff(labels, axis=0) != 0).any(axis=1)) + 1
        for first, end in pairwise([0, *changes.tolist(), len(labels)]):
            section, soil = self.kinds[first].tolist()
            yield LineStretch(section, soil, self.nodes[first : end + 1], self.lengths[first:end])


class LineModel(NamedTuple):
    """Lines of a deck; `places` (n, 3) are those of all its nodes, `depth` is the water depth at X = 0.

    `soil` is that of most of the pipe around touchdown, for targets with one seabed.
    """

    scene: Scene
    report: ExportReport
    places: Floats
    depth: float
    density: float
    gravity: float
    sections: list[PipeSection]
    soils: list[ExportSoil]
    soil: ExportSoil
    at_touchdown: bool
    ends: list[End]
    lines: list[ExportLine]
    seabed: Seabed | None
    units: UnitSystem

    def levels(self, x: Floats, y: Floats) -> Floats:
        """Return the elevation z of an unbounded seabed: outside the deck's seabed, its lowest known elevation."""
        if self.seabed is None:
            return np.full(np.shape(x), -self.depth)
        size = self.units.length
        level = self.seabed.elevation(x / size, y / size) * size - self.depth
        known = level[~np.isnan(level)]
        return np.where(np.isnan(level), known.min() if known.size else -self.depth, level)

    def line_nodes(self) -> Indices:
        """Return the nodes of all lines, each once."""
        return np.unique(np.concatenate([line.nodes for line in self.lines]))


def build(scene: Scene, positions: Floats | None = None) -> LineModel:
    """Describe the lines of a deck that can be evaluated, at positions (n, 3) of its nodes or its own coordinates.

    Raises DeckError for unknown units, a deck without elements or ocean, and an element without a section or an axial
    stiffness. Also raised for an end that nothing holds, a closed line, and an unknown seabed.
    """
    report = ExportReport(scene)
    units = UNITS[scene.units]
    if not units.known:
        raise scene.refusal("the units of this deck are not known: give --units metric or --units imperial")
    _require_elements(scene)
    density, gravity, depth = scene.surroundings
    if not (depth > 0.0 and gravity > 0.0):
        raise scene.refusal("a model for another program needs *OCEAN with depth, density and gravity: give it")
    sections, of_element = _sections(scene, units)
    soils, soil_of = soils_of(scene, units)
    positions_used = scene.coordinates if positions is None else positions
    places = positions_used[:, [1, 2, 0]] * units.length - [0.0, 0.0, depth * units.length]
    ends, lines = _lines(scene, report, units, of_element, soil_of)
    result = scene.contact().evaluate(positions_used)
    carrying, below = np.array([each.stiffness > 0.0 for each in soils]), result.depth.reshape(-1) > 0.0
    near = _around_touchdown(result, below & carrying[soil_of])
    lengths = np.bincount(soil_of, scene.length * np.select([near, below], [1e12, 1e6], 1.0), len(soils))
    soil = soils[int(np.argmax(np.where(carrying, lengths, -1.0)))]
    seabed = None if scene.seabed.kind is SeabedKind.FLAT else made_seabed(scene.seabed)
    si = (depth * units.length, density * units.mass / units.length**3, gravity * units.length)
    values = [value for each in (*sections, *soils) for value in each if isinstance(value, float)]
    if not np.isfinite([*values, *si, *places[scene.element_nodes].ravel()]).all():
        raise scene.refusal("a number of the lines is not finite in SI units: correct the largest of the deck")
    for keyword, target in (
        ("OCEAN", "depth, density, gravity"),
        ("NODE", "end points; the shape between them follows from statics"),
        ("ELEMENT", "lengths and segments"),
        ("ELEMENT SETS", "sections of the lines"),
    ):
        report.claim(keyword, target)
    return LineModel(scene, report, places, *si, sections, soils, soil, bool(near.any()), ends, lines, seabed, units)


def _around_touchdown(result: ContactResult, carried: Mask) -> Mask:
    """Return a mask (m,) of the elements nearest to each touchdown point of their line, among the carried elements."""
    lines, near = result.known.lines, np.zeros(len(carried), np.bool_)
    for line in line_summaries(result):
        elements = lines.elements[line.line - 1]
        elements = elements[carried[elements]]
        for point in line.touchdown:
            apart = np.abs(lines.element_arc[elements] - point.arc_length)
            near[elements[np.argsort(apart, kind="stable")[:_AROUND]]] = True
    return near


def _require_elements(scene: Scene) -> None:
    if not len(scene.element_ids):
        makers = unread_makers(scene.set_table.context.external_definers, "ELEMENT")
        where = next((at for at, _, block in scene.deck.every_block() if block.keyword in makers), None)
        names = " or ".join(f"*{maker}" for maker in makers)
        why = f": those of {names} are not in it, as its lines have no public format" if makers else ""
        raise scene.refusal(f"the deck has no elements to export{why}; give nodes and elements", where)
    unknown = np.flatnonzero((scene.element_nodes < 0).any(axis=1) | ~np.isfinite(scene.length))
    if unknown.size:
        message = "the element has no known length, so its line cannot be exported: give coordinates to its nodes"
        raise scene.refusal(message, scene.table.numbered.where(int(unknown[0])))


# ------------------------------------------------------------------------------------------------------- sections


def _sections(scene: Scene, units: UnitSystem) -> tuple[list[PipeSection], Indices]:
    """Return the cross-sections in use, in the order of the deck, and that of each element (m,)."""
    table = scene.section_table
    bare = np.flatnonzero(table.of_element < 0)
    if bare.size:
        message = "the element has no section: give one to a set of it in *GEOMETRIC SETS"
        raise scene.refusal(message, scene.table.numbered.where(int(bare[0])))
    pipe = pipe_of(scene)
    own = [pipe.contents, pipe.drag, pipe.added_mass, pipe.axial_drag_coefficient, pipe.axial_added_mass]
    keys = np.column_stack([table.of_element, *np.nan_to_num(own), pipe.has_coefficients])
    _, firsts, of_element = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    pipes = [_pipe(scene, units, table.sections[int(table.of_element[at])], pipe, at) for at in firsts.tolist()]
    return pipes, of_element.ravel()


def _pipe(scene: Scene, units: UnitSystem, section: Section, pipe: Pipe, element: int) -> PipeSection:
    row, length, force = section.entry.section, units.length, units.force
    outer = float(scene.diameter[element])
    inner = number(row, "di", 0.0)
    stiffness = stiffnesses(scene, section)
    mass = float(scene.mass_per_length[element])
    if not stiffness[0] > 0.0 or not mass > 0.0 or not outer > 0.0:
        what = "axial stiffness" if not stiffness[0] > 0.0 else "mass" if not mass > 0.0 else "diameter"
        raise scene.refusal(f"the section has no {what} above 0, which other programs need: give it", section.where)
    buoyancy = number(row, "db", outer)
    axial, bending, torsion = (0.0 if math.isnan(each) else each for each in stiffness)
    contents, density = float(pipe.contents[element]), scene.surroundings.density
    drag, added = float(pipe.drag[element]), float(pipe.added_mass[element])
    along, axial_added = float(pipe.axial_drag_coefficient[element]), float(pipe.axial_added_mass[element])
    displaced = density * math.pi / 4.0 * buoyancy**2
    assumed = not pipe.has_coefficients[element]
    return PipeSection(
        section.name,
        section.where,
        number(row, "dc", outer) * length,
        buoyancy * length,
        inner * length,
        (mass + contents) * units.mass / length,
        axial * force,
        bending * force * length**2,
        torsion * force * length**2,
        contents * units.mass / length,
        _DRAG if assumed else _plain(2.0 * drag / (density * buoyancy)),
        _plain(along * number(row, "dd", outer) / buoyancy),
        _ADDED if assumed else _plain(added / displaced),
        _plain(axial_added / displaced),
        assumed,
    )


def _plain(coefficient: float) -> float:
    """Return a coefficient without the rounding error of a division."""
    return float(f"{coefficient:.12g}")


def report_sections(model: LineModel, names: list[str], *, torsion: bool) -> None:
    """Report each cross-section: its name in the target, curves by their slope at 0, torsion."""
    for section, name in zip(model.sections, names, strict=True):
        entry = next(each.entry for each in model.scene.section_table.sections if each.where == section.where)
        curved = [each for each in ("eiyy_curve", "ei_curve", *STIFFNESS_CURVES) if getattr(entry, each)]
        status = Outcome.APPROXIMATED if curved else Outcome.CARRIED
        numbers = f"EA {shown(section.axial, 4)} N, EI {shown(section.bending, 4)} Nm2"
        effect = f"{numbers}: of a curve its slope at 0" if curved else numbers
        effect += f", mass with {shown(section.contents, 4)} kg/m of contents" if section.contents else ""
        model.report.add(section.where, status, f"line type {name}", effect)
    _report_water(model)
    twisted = [section for section in model.sections if section.torsion]
    if twisted and not torsion:
        model.report.add(twisted[0].where, Outcome.LEFT_OUT, "none", "lines do not twist: no effect in plane", "GJ, G")
    for keyword in (BENDING_CURVES, *STIFFNESS_CURVES.values()):
        for where, _ in model.scene.deck.blocks(keyword):
            model.report.add(where, Outcome.APPROXIMATED, "a constant stiffness", "the slope of its curves at 0")


def _report_water(model: LineModel) -> None:
    """Report coefficients and contents."""
    deck = model.scene.deck
    for where, block in deck.blocks("HYDRODYNAMIC SETS"):
        given = cast("HydrodynamicSets", block)
        plain = all(each.constant is not None and each.constant.drag_lift is None for each in given.sets)
        effects = [] if plain and given.option is None else ["no drag lift, no types but CONSTANT"]
        if any(section.axial_drag for section in model.sections):
            effects += ["drag along as it is written, on an area that the manual does not show"]
        status = Outcome.APPROXIMATED if effects else Outcome.CARRIED
        model.report.add(where, status, "Cd, Ca of each line type", "; ".join(effects))
    for section in model.sections:
        if section.assumed:
            effect = f"drag {_DRAG:g} and added mass {_ADDED:g}, as the deck has none: give *HYDRODYNAMIC SETS"
            model.report.add(section.where, Outcome.APPROXIMATED, "Cd, Ca of the line type", effect)
    for where, _ in deck.blocks("INTERNAL FLUID", "LOAD CASE"):
        case = contents_case(model.scene)
        effect = f"its mass at rest{f' in load case {case}' if case else ''}; pressure and flow are not written"
        model.report.add(where, Outcome.APPROXIMATED, "mass of each line type", effect)


# ---------------------------------------------------------------------------------------------------------- lines


def _lines(
    scene: Scene, report: ExportReport, units: UnitSystem, section_of: Indices, soil_of: Indices
) -> tuple[list[End], list[ExportLine]]:
    held, vessels = held_freedoms(scene, [scene.deck])
    traced = lines_of(scene.element_nodes, scene.length, len(scene.node_ids))
    degree = np.bincount(scene.element_nodes.ravel(), minlength=len(scene.node_ids))
    order: dict[int, int] = {}
    ends: list[End] = []
    lines: list[ExportLine] = []

    def end_of(node: int) -> int:
        if node not in order:
            end = End(node, held.get(node, NO_FREEDOMS), node in vessels)
            if end.joins and degree[node] < 2:
                what = f"node {int(scene.node_ids[node])} ends a line, and nothing in *BOUNDARY holds it along an axis"
                raise scene.refusal(f"{what}: a free end cannot be exported; hold the node", scene.nodes.where(node))
            order[node] = len(ends)
            ends.append(end)
        return order[node]

    for elements, nodes in zip(traced.elements, traced.nodes, strict=True):
        if nodes[0] == nodes[-1]:
            message = "the line of this node is closed, and has no end to be held by: it cannot be exported"
            raise scene.refusal(message, scene.nodes.where(int(nodes[0])))
        inner = [at for at, node in enumerate(nodes.tolist()) if held.get(node, NO_FREEDOMS) >= TRANSLATIONS]
        cuts = sorted({0, *inner, len(nodes) - 1})
        for first, last in pairwise(cuts):
            part, through = elements[first:last], nodes[first : last + 1]
            begin, end = end_of(int(through[0])), end_of(int(through[-1]))
            kinds = np.column_stack([section_of[part], soil_of[part]])
            lengths = scene.length[part] * units.length
            lines.append(ExportLine(f"Line{len(lines) + 1}", begin, end, kinds, through, lengths))
    _report_held(scene, report, held, set(order))
    return ends, lines


# ----------------------------------------------------------------------------------------------------------------- ends


def _report_held(scene: Scene, report: ExportReport, held: dict[int, frozenset[int]], ends: set[int]) -> None:
    """Report displacements, types of motion but those of vessels, and nodes inside lines that are held in part."""
    where = Where()
    for where, block in scene.deck.blocks("BOUNDARY", "LOAD CASE"):
        for each in block.types:
            if each.type_ not in ("CONSTANT", "VESSEL"):
                effect = "its nodes are held and not moved"
                report.add(where, Outcome.LEFT_OUT, "none", effect, f"TYPE={each.type_}")
    for line in scene.held:
        value = line.how[0]
        if isinstance(value, float | int) and value and line.nodes.size:
            effect = f"node {int(scene.node_ids[line.nodes[0]])} stays where its coordinates are"
            report.add(line.where._replace(path=()), Outcome.LEFT_OUT, "none", effect, f"displacement {shown(value)}")
    inside: dict[str, list[int]] = {}
    for node in sorted(set(held) - ends):
        inside.setdefault(", ".join(map(str, sorted(held[node]))), []).append(int(scene.node_ids[node]))
    for freedoms, nodes in inside.items():
        effect = f"inside of a line: free here (nodes: {len(nodes)}, the first {nodes[0]})"
        report.add(where, Outcome.LEFT_OUT, "none", effect, f"DOF {freedoms}")


def report_ends(report: ExportReport, ends: list[End], vessel: str, *, clamps: bool = False) -> None:
    """Report the ends: held although partly free, on vessels (`vessel` ends of the target), fixed against rotation."""
    scene = report.scene
    places = [where for where, _ in scene.deck.blocks("BOUNDARY", "LOAD CASE")]
    for where in places:
        report.add(where, Outcome.CARRIED, f"Fixed, {vessel} ends")
    for end in ends:
        node = f"node {int(scene.node_ids[end.node])}"
        if end.vessel:
            status = Outcome.CARRIED if vessel != "Fixed" else Outcome.APPROXIMATED
            report.add(places[-1], status, vessel, f"{node} stays where it is until it is moved", f"vessel at {node}")
        if not end.joins and (missing := sorted(TRANSLATIONS - end.held)):
            effect = f"free in DOF {', '.join(map(str, missing))} in the deck: held at its coordinates"
            report.add(places[-1], Outcome.APPROXIMATED, vessel if end.vessel else "Fixed", effect, node)
        if not clamps and (turned := sorted(end.held - TRANSLATIONS)):
            effect = f"no moment at {node}: the line turns freely there"
            report.add(places[-1], Outcome.LEFT_OUT, "a hinge", effect, f"DOF {', '.join(map(str, turned))}")
