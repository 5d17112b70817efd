"""Resting shape of the lines of a deck: catenaries under their own weight, with a beam on the seabed at touchdown.

No load case is solved: the elements have their lengths and submerged weights with contents, nothing else. A line lies
in the vertical plane of its two held ends; the upper end is moved by the `*OFFSET` of its vessel. The part on the
seabed is straight, at static embedment.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from mudline.basics.short_repr import short_repr
from mudline.basics.units import UNITS
from mudline.model.contact import ContactInput
from mudline.model.contact.arrays import Positions
from mudline.model.contact.stretch import cut_out, static_depth
from mudline.model.results.evaluation import require_elements
from mudline.model.scene.boundary import HeldLine, lines_between, vessel_offset
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices
from mudline.model.scene.seabed import SeabedLine, elevations, plane_below
from mudline.model.scene.weights import Pipe, pipe_of
from mudline.tools.touchdown_study.beam import Beam, NotConvergedError, at_rest
from mudline.tools.touchdown_study.catenary import Catenary, HangingLine, NoRestShapeError, rest
from mudline.tools.touchdown_study.soil import soil_of

LEFT, RIGHT = 10.0, 6.0
"""Extent of the beam on either side of a touchdown, in lengths sqrt(EI/T)."""
MOST_LEFT, MOST_RIGHT = 60, 40
"""Largest number of elements of the beam on either side."""
_ROUNDED, _LEAST = 1e-6, 1e-300
_CORRECTIONS, _BALANCES = 3, 8
_STEEP = 0.3
"""Largest slope sqrt(EI/T) q/T, that of the line at this length beyond its touchdown."""
_LIFTED = 5.0
"""Largest lift by a beam, in EI q / T^2 plus diameters; on a rigid seabed the lift is half of EI q / T^2."""
_SUNK = 3.0
"""Diameters below the seabed down to which an end counts as lying on it."""


@dataclass(frozen=True)
class LineAtRest:
    """A line between two held ends, from the lower end to the upper end.

    Attributes:
        number: number of the line in the deck, from 1.
        elements: indices (m,).
        nodes: indices (m + 1,).
        model: lengths and weights.
        start: Y and Z of the first end.
        direction: unit vector (2,) to the last end.
        distance: horizontal distance of the ends.
        heights: heights of the ends above the seabed.
        seabed: the seabed below the line.
        catenary: the shape; None for a line that lies on the seabed.
        vessel: vessel that moves the upper end, or "".
        depth: static embedment (m,) of each element.
    """

    number: int
    elements: Indices
    nodes: Indices
    model: HangingLine
    start: Floats
    direction: Floats
    distance: float
    heights: tuple[float, float]
    seabed: SeabedLine
    catenary: Catenary | None
    vessel: str
    depth: Floats = field(repr=False)

    __repr__ = short_repr

    def moved(self, surge: float, heave: float) -> Catenary:
        """Return the shape with the upper end moved away from the lower end, and up. Raises NoRestShapeError."""
        height = self.heights[1] + heave - self.seabed.slope * surge
        return rest(self.model, self.distance + surge, (self.heights[0], height))


@dataclass(frozen=True)
class RestShape:
    """The resting shape of a deck.

    Attributes:
        positions: positions of all nodes; those of lines without a shape are not present.
        lines: lines with a shape.
        refused: number of each other line, and the reason in a sentence.
    """

    positions: Positions
    lines: list[LineAtRest]
    refused: list[tuple[int, str]]

    __repr__ = short_repr

    def places(self, scene: Scene) -> Floats:
        """Return the positions (n, 3) of all nodes; lines without a shape keep the deck's coordinates."""
        return np.where(self.positions.present[:, None], self.positions.values[0], scene.coordinates)

    def sentences(self, units: str) -> list[str]:
        """Return a sentence on each line: tension and length on the seabed, or why it has no shape."""
        system, listed = UNITS[units], []
        for line in self.lines:
            if line.catenary is None:
                words = "lies on the seabed from end to end"
            else:
                lying = sum(last - first for first, last in line.catenary.lying)
                tension = f"{line.catenary.tension:.6g}{system.behind('F')}"
                words = f"horizontal tension {tension}, {lying:.6g}{system.behind('L')} lie on the seabed"
            listed.append(f"resting shape of line {line.number}: {words}; no load case is solved")
        return [*listed, *(f"line {number} has no resting shape: {why}" for number, why in self.refused)]


def rest_shape(scene: Scene) -> RestShape:
    """Return the resting shape of a scene that can be evaluated.

    Raises DeckError if no line has a shape (with the reason of the first), or if the seabed or the weight of the pipe
    is not known.
    """
    require_elements(scene)
    given, pipe = scene.contact_input("cut" if scene.blocking("keep") else "keep"), pipe_of(scene)
    hung, refused = lines_at_rest(scene, given, pipe)
    values, shaped = np.full((len(scene.node_ids), 3), np.nan), list[LineAtRest]()
    for line in hung:
        try:
            values[line.nodes] = _places(given, pipe, line)
            shaped.append(line)
        except NoRestShapeError as error:
            refused.append((line.number, str(error)))
    if not shaped:
        why = refused[0][1] if refused else "the deck has no line"
        raise scene.refusal(f"no resting shape: {why}; give a solved shape with --positions")
    return RestShape(Positions(values[np.newaxis], np.isfinite(values).all(axis=1), None), shaped, refused)


def lines_at_rest(scene: Scene, given: ContactInput, pipe: Pipe) -> tuple[list[LineAtRest], list[tuple[int, str]]]:
    """Return the lines that have a resting shape, and the number of each other line with the reason."""
    shaped: list[LineAtRest] = []
    refused: list[tuple[int, str]] = []
    for each in lines_between(scene):
        try:
            shaped.append(_line(scene, given, pipe, each))
        except NoRestShapeError as error:
            refused.append((each.number, str(error)))
    return shaped, refused


# ----------------------------------------------------------------------------------------------------------------- line


def _line(scene: Scene, given: ContactInput, pipe: Pipe, each: HeldLine) -> LineAtRest:
    """Return a line with its catenary. Raises NoRestShapeError."""
    places = scene.coordinates[each.nodes[[0, -1]]] + [vessel_offset(scene, vessel) for vessel in each.vessels]
    if not np.isfinite(places).all() or not np.isfinite(scene.length[each.elements]).all():
        raise NoRestShapeError("its ends have no coordinates, or an element no length")
    size = float(np.nanmax(scene.diameter[each.elements], initial=0.0))
    heights = places[:, 0] - elevations(scene.seabed, places[:, 1:])
    if not np.isfinite(heights).all():
        raise NoRestShapeError("there is no seabed below an end of the line")
    elements, nodes, held, vessel = each.elements, each.nodes, each.held, each.vessels[1]
    if heights[0] > heights[1]:
        elements, nodes, held, vessel = elements[::-1], nodes[::-1], held[::-1], each.vessels[0]
        places, heights = places[::-1], heights[::-1]
    _require_held(scene, nodes, held, heights, size)
    if heights[0] < -_SUNK * size:
        raise NoRestShapeError(f"its lower end stands {-heights[0]:.4g} below the seabed")
    weight, length = pipe.weight[elements], given.length[elements]
    if np.isnan(weight).any():
        at = int(elements[np.argmax(np.isnan(weight))])
        raise NoRestShapeError(f"the submerged weight of element {scene.element_ids[at]} is not known")
    across = places[1, 1:] - places[0, 1:]
    distance = float(np.hypot(*across))
    direction = across / distance if distance > 0.0 else np.array([1.0, 0.0])
    seabed = plane_below(scene.seabed, places[0, 1:], direction, distance)
    if seabed is None:
        raise NoRestShapeError("the seabed below the line is not one plane")
    model = HangingLine(length, weight, seabed.slope)
    ends = (float(heights[0]) if heights[0] > size else 0.0, float(heights[1]))
    lies = heights[1] <= size
    if lies and (weight <= 0.0).any():
        raise NoRestShapeError(f"the pipe floats: {weight.min():.4g} per unit length where the line would lie")
    catenary = None if lies else rest(model, distance, ends)
    depth = static_depth(given, elements, np.maximum(weight, 0.0) * seabed.upright)
    lying = [(0.0, model.length)] if catenary is None else catenary.lying
    lies_here = np.any([(model.arcs[:-1] >= a) & (model.arcs[1:] <= b) for a, b in lying], axis=0)
    sinking = np.flatnonzero(lies_here & np.isnan(depth))
    if sinking.size:
        number = scene.element_ids[elements[sinking[0]]]
        raise NoRestShapeError(f"the seabed does not carry the weight of element {number}")
    return LineAtRest(
        each.number, elements, nodes, model, places[0, 1:], direction, distance, ends, seabed, catenary, vessel, depth
    )


def _require_held(scene: Scene, nodes: Indices, held: tuple[frozenset[int], ...], heights: Floats, size: float) -> None:
    """Raise NoRestShapeError for a line that hangs from an end that `*BOUNDARY` does not hold at all."""
    for at, name in ((0, "lower"), (1, "upper")):
        if not held[at] and heights[1] > size:  # the seabed holds a line that lies from end to end
            node = int(scene.node_ids[nodes[-at]])
            place = "at the top" if heights[at] > size else "at the seabed"
            raise NoRestShapeError(f"no held end {place}: nothing in *BOUNDARY holds node {node}, the {name} end")
    if nodes[0] == nodes[-1]:
        raise NoRestShapeError("the line is closed")


# ---------------------------------------------------------------------------------------------------------------- shape


def _places(given: ContactInput, pipe: Pipe, line: LineAtRest) -> Floats:
    """Return the positions (m + 1, 3) of the nodes of a line, from its lower end."""
    depth, arcs = np.nan_to_num(line.depth) / line.seabed.upright, line.model.arcs
    lying = -0.5 * (np.append(depth[:1], depth) + np.append(depth, depth[-1:]))
    if line.catenary is None:  # lies from end to end, between its ends in their positions
        along, height = arcs * (line.distance / max(float(arcs[-1]), _LEAST)), lying
    else:
        along, height = _hung(given, pipe, line, lying)
    at = line.start + along[:, None] * line.direction
    level = line.seabed.height + line.seabed.slope * along
    return np.column_stack([level + height, at])


class _LiftOff(NamedTuple):
    """A point where a line leaves the seabed: its arc length, and True if the hanging part is beyond it."""

    arc: float
    beyond: bool


class _Bend(NamedTuple):
    """A beam at a touchdown: indices along the line and heights of its nodes, and its lift of the hanging part."""

    at: Indices
    heights: Floats
    lift: float


_NO_BEND = _Bend(np.zeros(0, np.intp), np.zeros(0), 0.0)


def _hung(given: ContactInput, pipe: Pipe, line: LineAtRest, lying: Floats) -> tuple[Floats, Floats]:
    """Return distances and heights (m + 1,) with a beam at each touchdown, which lifts the hanging part a little.

    The ends of the catenary are lowered by this lift.
    """
    arcs, (low, high) = line.model.arcs, line.heights
    lifts = [0.0, 0.0]
    for _ in range(_CORRECTIONS):
        trial = rest(line.model, line.distance, (low - lifts[0] if low > 0.0 else low, high - lifts[1]))
        points = touchdowns(trial, line.model.length)
        bends = [_bend(given, pipe, line, trial, point) for point in points]
        lifts = [bends[0].lift if low > 0.0 else 0.0, bends[-1].lift]
    hangs = np.ones(len(arcs), np.bool_)
    for first, last in trial.lying:
        hangs &= (arcs < first) | (arcs > last)
    lifted = np.interp(arcs, [point.arc for point in points], [bend.lift for bend in bends])
    height = np.where(hangs, trial.height + lifted, lying)
    for bend in bends:
        height[bend.at] = bend.heights
    height[-1] = high
    if low > 0.0:
        height[0] = low
    return trial.distance, height


def touchdowns(catenary: Catenary, length: float) -> list[_LiftOff]:
    """Return the points where a line of some length leaves the seabed, along it."""
    points = [_LiftOff(arc, beyond) for part in catenary.lying for arc, beyond in zip(part, (False, True), strict=True)]
    return [point for point in points if 0.0 < point.arc < length]


def window(arcs: Floats, node: int, left: float, right: float) -> tuple[int, int]:
    """Return the first element about a node that ends beyond `-left`, and the first that ends at or beyond `right`.

    At most `MOST_LEFT` and `MOST_RIGHT` elements on either side; two of them meet at the node.
    """
    x = arcs[1:] - arcs[node]
    first = max(int(np.searchsorted(x, -left, side="right")), node - MOST_LEFT, 0)
    last = min(int(np.searchsorted(x, right * (1.0 - _ROUNDED))), node + MOST_RIGHT - 1, len(x) - 1)
    return min(first, node - 1), max(last, node)


def _bend(given: ContactInput, pipe: Pipe, line: LineAtRest, trial: Catenary, point: _LiftOff) -> _Bend:
    """Return the static beam at a touchdown, whose right end has the vertical force of the catenary there."""
    step = 1 if point.beyond else -1
    elements, nodes, depth = line.elements[::step], line.nodes[::step], line.depth[::step]
    arcs = line.model.arcs if point.beyond else line.model.length - line.model.arcs[::-1]
    arc = point.arc if point.beyond else line.model.length - point.arc
    upright, slope = line.seabed.upright, line.seabed.slope
    height, vertical = trial.height[::step] * upright, step * (trial.vertical[::step] - trial.tension * slope) * upright
    tension = trial.tension * math.hypot(1.0, slope)
    node = int(np.clip(np.argmin(np.abs(arcs - arc)), 1, len(elements) - 1))
    own = int(elements[node - 1])
    weight, bending = float(pipe.weight[own]) * upright, float(np.nan_to_num(pipe.bending[own]))
    size = max(math.sqrt(bending / tension), float(given.length[own]))
    if size * weight > _STEEP * tension:  # slopes are not small where the line bends
        return _NO_BEND
    first, last = window(arcs, node, LEFT * size, RIGHT * size)
    length = line.model.length
    others = [each.arc if point.beyond else length - each.arc for each in touchdowns(trial, length)]
    before = max((each for each in others if each < arc), default=0.0)
    middle = 0.5 * (arc + min((each for each in others if each > arc), default=float(arcs[-1])))
    while first < node - 1 and arcs[first] < before:
        first += 1
    while last > node and arcs[last + 1] > middle:
        last -= 1
    if not (depth[first : last + 1] > 0.0).all() or not weight > 0.0:  # rigid seabed, or the pipe is not carried
        return _NO_BEND
    stretch = cut_out(given, elements[first : last + 1], nodes[first : last + 2])
    weights = pipe.weight[elements[first : last + 1]] * upright
    moment = bending * float(weights[-1]) / tension
    inside = slice(first, last + 2)
    # a line without bending stiffness, from its slopes V/T beyond its touchdown
    s = arcs[inside] - arc
    rising = np.where(s > 0.0, vertical[inside] / tension, 0.0)
    drawn = np.append(0.0, np.cumsum(0.5 * (rising[:-1] + rising[1:]) * np.diff(np.maximum(s, 0.0))))
    end = float(drawn[-1])
    left = -float(depth[first])
    beam = Beam(stretch.length, bending, tension, weight, 0.0, 0.0, left, end, moment, weights=weights)
    balanced = _balanced(beam, stretch, float(vertical[last + 1]))
    if balanced is None or abs(balanced[-2] - end) > _LIFTED * (bending * weight / tension**2 + given.diameter[own]):
        return _NO_BEND
    at = np.arange(first, last + 2) if point.beyond else len(nodes) - 1 - np.arange(first, last + 2)
    bent = height[inside] + balanced[::2] - drawn  # the catenary continues the beam, whose slopes are small
    return _Bend(at, bent / upright, (float(balanced[-2]) - end) / upright)


def _balanced(beam: Beam, stretch: ContactInput, vertical: float) -> Floats | None:
    """Return the beam at rest (2 n,), its right end at the height where it carries a vertical force; or None."""
    trials: list[tuple[float, float, Floats]] = []
    height = beam.right
    for _ in range(_BALANCES):
        moved = replace(beam, right=height)
        try:
            state = at_rest(moved, soil_of(stretch)).state
        except NotConvergedError:
            return None
        missing = vertical - float((moved.stiffness @ state - moved.load)[-2])
        trials.append((height, missing, state))
        if abs(missing) <= _ROUNDED * abs(vertical):
            break
        if len(trials) == 1:
            height += 0.5 * beam.bending * beam.weight / beam.tension**2
        else:
            (before, at_before, _), (last, at_last, _) = trials[-2:]
            if at_before == at_last:
                break
            height = last - at_last * (last - before) / (at_last - at_before)
    return min(trials, key=lambda trial: abs(trial[1]))[2]
