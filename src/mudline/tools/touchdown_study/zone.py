"""Touchdown zone of a deck: the stretch of its line that touches down and lifts off, as a beam, and its runs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple, cast

import numpy as np

from mudline.basics.units import UNITS
from mudline.model.contact import ContactInput
from mudline.model.contact.input import LawAssignment
from mudline.model.contact.stretch import cut_out, static_depth
from mudline.model.curves import ForceCurve
from mudline.model.scene.load_case import Scheme, TopMotion, scheme_of, top_motion
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Mask
from mudline.model.scene.weights import Pipe, left_out, pipe_of
from mudline.tools.touchdown_study.beam import Beam, BeamRun, NotConvergedError, Solved, at_rest, march
from mudline.tools.touchdown_study.catenary import Catenary, NoRestShapeError
from mudline.tools.touchdown_study.rest_shape import LineAtRest, lines_at_rest, touchdowns, window
from mudline.tools.touchdown_study.soil import BeamSoil, ElementMatrix, ScaledSoil, cost_of, soil_of

RAMP = 0.01
"""Diameters over which a jump of the force at the mudline is replaced by a ramp."""
_DELTA = 0.5
"""Metres by which the top is moved to determine the travel of the touchdown."""
_STEEP = 0.35
"""Slope at the end of a zone above which slopes are not small."""
_SMALL = 1e-6
"""Share of the weight below which a force at the mudline is not a jump."""


class NotStudiedError(Exception):
    """Reason, in a sentence, why a deck has no touchdown zone to study."""


class Measures(NamedTuple):
    """Results about the touchdown, in the deck's units.

    Attributes:
        touchdown: touchdown points (k,) in the last period, or at rest, relative to the node at the touchdown.
        largest_force: force per unit length.
        largest_moment: bending moment.
        moment_range: range of the bending moment.
    """

    touchdown: Floats
    largest_force: float
    largest_moment: float
    moment_range: float


class Weights(NamedTuple):
    """Submerged weight per unit length with contents and empty; `without`: keywords with weight that are in neither."""

    with_contents: float
    empty: float
    without: list[str]


class Variant(NamedTuple):
    """Variant of the zone.

    Attributes:
        parts: number of parts of each element.
        matrix: element matrix.
        factor: factor of the soil.
        law_of: index of the element whose law applies everywhere; -1 for none.
        period: factor of the period.
    """

    parts: int = 1
    matrix: ElementMatrix = "mean"
    factor: float = 1.0
    law_of: int = -1
    period: float = 1.0


@dataclass(frozen=True)
class Zone:
    """The touchdown zone of a line.

    Attributes:
        scene, pipe, line: source of the zone.
        given: laws of the deck, with jumps at the mudline replaced by ramps.
        elements: indices (m,), from the lying side to the hanging side.
        nodes: indices (m + 1,).
        node: place of x = 0 among the nodes.
        beam: the zone at rest and with the motion of its right end.
        scheme, scheme_line: time integration and its line in the deck.
        motion: motion of the top.
        travel: amplitude of the touchdown.
        depth: static embedment at the touchdown.
        notes: limits of the model, in sentences.
    """

    scene: Scene
    given: ContactInput
    pipe: Pipe
    line: LineAtRest
    elements: Indices
    nodes: Indices
    node: int
    beam: Beam
    scheme: Scheme
    scheme_line: int
    motion: TopMotion
    travel: float
    depth: float
    notes: list[str]

    @property
    def own(self) -> int:
        """Index of the element whose section the zone has."""
        return int(self.elements[self.node - 1])

    @property
    def weights(self) -> Weights:
        """Submerged weights of that element."""
        empty = float(self.scene.submerged_weight[self.own]) * self.line.seabed.upright
        return Weights(self.beam.weight, empty, left_out(self.scene, with_masses=False))

    @property
    def length(self) -> float:
        """sqrt(EI/T)."""
        return math.sqrt(self.beam.bending / self.beam.tension)

    @property
    def start(self) -> float:
        """Place of x = 0 along the beam."""
        return float(self.beam.places[self.node])

    @property
    def right(self) -> float:
        """Length of the zone right of x = 0."""
        return float(self.beam.places[-1]) - self.start

    @cached_property
    def landing(self) -> Mask:
        """Elements (m,) on which forces and moments are measured."""
        middle = 0.5 * (self.beam.places[:-1] + self.beam.places[1:]) - self.start
        return middle > -(2.0 * self.travel + 5.0 * self.length)

    @property
    def periods(self) -> int:
        """Periods of a run; the motion grows in the first, and the last is measured."""
        return 3 if self.cost == 1 else 2

    @cached_property
    def soil_length(self) -> float:
        """(4 EI/k)^(1/4) with the secant stiffness k of the soil under the static weight."""
        return float((4.0 * self.beam.bending * self.depth / self.beam.weight) ** 0.25)

    @cached_property
    def cost(self) -> int:
        """Approximate time of a step over that with a soil without memory."""
        return cost_of(self.cut(Variant()))

    @cached_property
    def stiffness(self) -> float:
        """Secant stiffness of the soil under the static weight, per unit length."""
        return self.beam.weight / self.depth

    def cut(self, variant: Variant) -> ContactInput:
        """Return the laws of the zone."""
        cut = cut_out(self.given, self.elements, self.nodes, variant.parts)
        return cut if variant.law_of < 0 else _with_law(self.given, cut, variant.law_of)

    def rest(self, variant: Variant = Variant()) -> tuple[Beam, BeamSoil, Solved]:  # noqa: B008 - a constant
        """Return the beam, its soil and its state at rest. Raises NotConvergedError."""
        lengths, left = np.repeat(self.beam.lengths / variant.parts, variant.parts), self.beam.left
        if variant.law_of >= 0 or variant.factor != 1.0:
            row = self.elements[:1] if variant.law_of < 0 else np.array([variant.law_of])
            left = -float(static_depth(self.given, row, np.array([self.beam.weight / variant.factor]))[0])
            if not math.isfinite(left):
                raise NotConvergedError("the soil does not carry the pipe")
        beam = replace(self.beam, lengths=lengths, period=self.beam.period * variant.period, left=left)
        soil = ScaledSoil(soil_of(self.cut(variant), variant.matrix), variant.factor)
        return beam, soil, at_rest(beam, soil)

    def run(self, steps: int, periods: int = 3, variant: Variant = Variant()) -> tuple[Measures, BeamRun]:  # noqa: B008 - as above
        """Return the measures of a run of `steps`, and the run. Raises NotConvergedError."""
        beam, soil, rest = self.rest(variant)
        run = march(beam, soil, self.scheme, rest, steps, periods)
        return self.measures(beam, run.heights, run.turned, run.forces), run

    def measures(self, beam: Beam, heights: Floats, turned: Floats, forces: Floats) -> Measures:
        """Return the measures from heights and rotations (k, n) of the nodes, and forces (k, m) of the elements."""
        measured = np.repeat(self.landing, len(beam.lengths) // len(self.landing))
        moments = beam.moments(turned)[:, measured]
        return Measures(
            beam.touchdown(heights) - self.start,
            float(forces[:, measured].max()),
            float(np.abs(moments).max()),
            float((moments.max(axis=0) - moments.min(axis=0)).max()),
        )


def _with_law(given: ContactInput, cut: ContactInput, element: int) -> ContactInput:
    """Return the laws of a stretch, with the normal law of one element of the deck everywhere."""
    rows = np.arange(len(cut.element_ids))
    laws = [law for law in cut.laws if law.law in {"unloading", "suction", "damping", "nodal damping"}]
    for law in given.normal_laws:
        at = np.flatnonzero(law.rows == element)
        if at.size:
            parameters = {name: values[at[0]] for name, values in law.parameters.items()}
            laws.append(LawAssignment(law.law.name, rows, parameters))
    return replace(cut, laws=tuple(laws))


# --------------------------------------------------------------------------------------------------------------- making


def touchdown_zone(scene: Scene, given: ContactInput, heave: float | None, period: float | None) -> Zone:
    """Return the touchdown zone of the first line that has one. Raises NotStudiedError."""
    pipe = pipe_of(scene)
    lines, refused = lines_at_rest(scene, given, pipe)
    line = next((each for each in lines if each.catenary is not None), None)
    if line is None:
        lies = "nothing is lifted: no touchdown to study"
        raise NotStudiedError(lies if lines else refused[0][1] if refused else "the deck has no line")
    catenary, arcs = cast("Catenary", line.catenary), line.model.arcs
    arc = touchdowns(catenary, line.model.length)[-1].arc
    node = int(np.clip(np.argmin(np.abs(arcs - arc)), 1, len(line.elements) - 1))
    own = int(line.elements[node - 1])
    weight, bending = float(pipe.weight[own]) * line.seabed.upright, float(np.nan_to_num(pipe.bending[own]))
    mass = float(pipe.mass[own] + pipe.contents[own] + pipe.added_mass[own])
    _require(scene, own, weight, bending, mass)
    tension = catenary.tension * math.hypot(1.0, line.seabed.slope)
    motion = top_motion(scene, line.vessel, line.direction, heave, period)
    travel = _travel(scene, line, motion)
    size, a = math.sqrt(bending / tension), tension / weight
    first, last = window(arcs, node, 2.0 * travel + 10.0 * size, 2.0 * travel + 6.0 * size)
    first = max(first, min(int(np.searchsorted(arcs, catenary.lying[-1][0])), node - 1))
    elements, nodes = line.elements[first : last + 1], line.nodes[first : last + 2]
    given = replace(given, curves=tuple(ramp(curve) if jump(curve, weight) else curve for curve in given.curves))
    depths = static_depth(given, np.array([elements[0], own]), np.array([weight, weight]))
    if not np.isfinite(depths).all() or not depths[1] > 0.0:
        raise NotStudiedError("the soil does not carry the pipe at its touchdown")
    right = float(arcs[last + 1] - arcs[node])
    scheme, scheme_line = scheme_of(scene)
    beam = Beam(
        given.length[elements],
        bending,
        tension,
        weight,
        mass,
        float(pipe.drag[own]),
        -float(depths[0]),
        right * right / (2.0 * a),
        bending * weight / tension,
        travel * right / a,
        motion.period,
    )
    unit, wave = UNITS[scene.units].behind("L"), math.sqrt(tension / mass) * motion.period
    notes = list(_limits(line, 2.0 * travel + 4.0 * size, right, wave, right / a, unit))
    place, schemes = (elements, nodes, node - first), (scheme, scheme_line)
    return Zone(scene, given, pipe, line, *place, beam, *schemes, motion, travel, float(depths[1]), notes)


def _require(scene: Scene, own: int, weight: float, bending: float, mass: float) -> None:
    """Raise NotStudiedError for a pipe or a seabed at the touchdown that the model does not cover."""
    law, element = scene.law_names[own], scene.element_ids[own]
    if not weight > 0.0:
        unit = UNITS[scene.units].behind("F/L")
        raise NotStudiedError(f"the pipe floats: {weight:.4g}{unit} at its touchdown")
    if scene.section_table.of_element[own] < 0:
        raise NotStudiedError(f"element {element} at the touchdown has no section")
    if law in {"rigid", "none"}:
        what = "is rigid" if law == "rigid" else "has no law"
        raise NotStudiedError(f"the seabed {what} at the touchdown (element {element})")
    if not bending > 0.0:
        raise NotStudiedError(f"the section of element {element} at the touchdown has no bending stiffness")
    if not mass > 0.0:
        raise NotStudiedError(f"the mass of element {element} at the touchdown is not known")


def _travel(scene: Scene, line: LineAtRest, motion: TopMotion) -> float:
    """Return the amplitude of the touchdown, from the resting shapes with the top moved a little."""
    step = _DELTA / UNITS[scene.units].length

    def moved(surge: float, heave: float) -> float:
        ends = [touchdowns(line.moved(sign * surge, sign * heave), line.model.length)[-1].arc for sign in (1.0, -1.0)]
        return (ends[0] - ends[1]) / (2.0 * step)

    try:
        return abs(moved(0.0, step) * motion.heave + moved(step, 0.0) * motion.surge)
    except NoRestShapeError as error:
        raise NotStudiedError(f"with the top moved by {step:.3g} the line has no resting shape: {error}") from error


def _limits(line: LineAtRest, shortest: float, right: float, wave: float, slope: float, unit: str) -> Iterator[str]:
    """Yield sentences on limits of the zone, of its waves and of small slopes."""
    if right < shortest:
        yield f"The zone is short: {right:.3g} of {shortest:.3g}{unit} right of the touchdown."
    if right > wave / 4.0:
        yield (
            f"The end of the zone reflects: {right:.3g}{unit} is more than a quarter of a wave, {wave / 4.0:.3g}{unit}."
        )
    if slope > _STEEP:
        yield f"Slopes are not small: {slope:.2f} at the end of the zone."
    if line.seabed.slope:
        yield "The model is along the seabed, which slopes: the weight along it is left out."


def jump(curve: ForceCurve, weight: float) -> float:
    """Return the force of a curve at the mudline; 0 if it is small against a weight."""
    force = float(curve.evaluate(0.0)[0])
    return force if abs(force) > _SMALL * weight else 0.0


def ramp(curve: ForceCurve) -> ForceCurve:
    """Return a curve that grows from 0 at the mudline to its force at 0.01 diameters."""
    beyond = curve.ratios > RAMP
    points = [(0.0, 0.0), (RAMP, float(curve.evaluate(RAMP)[0]))]
    points += list(zip(curve.ratios[beyond].tolist(), curve.forces[beyond].tolist(), strict=True))
    if len(points) == 2:
        points.append((2.0 * RAMP, float(curve.evaluate(2.0 * RAMP)[0])))
    return ForceCurve(points, curve.name)
