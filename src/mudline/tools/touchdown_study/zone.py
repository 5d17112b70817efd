"""Touchdown zone of a deck: the stretch of its line that is laid down and lifted, as a beam, and its runs."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.model.contact import ContactInput
from mudline.model.contact.embedment import static_depth
from mudline.model.contact.input import LawAssignment
from mudline.model.contact.stretch import cut_out
from mudline.model.curves import ForceCurve
from mudline.model.scene.deck_values import number
from mudline.model.scene.load_case import TopMotion, top_motion
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Mask
from mudline.model.scene.oscillation import line_of
from mudline.model.scene.pipe import Pipe, pipe_of
from mudline.tools.touchdown_study.beam import Beam, Rest, Run, Scheme, at_rest, march
from mudline.tools.touchdown_study.catenary import Catenary, NoRestShapeError
from mudline.tools.touchdown_study.rest_shape import LineAtRest, lines_at_rest, touchdowns, window
from mudline.tools.touchdown_study.soil import ElementMatrix, ScaledSoil, Soil, has_history, soil_of

if TYPE_CHECKING:
    from mudline.language.keywords.library.analysis import TimeStepping

RAMP = 0.01
"""Diameters over which a force that jumps at the mudline grows instead."""
_DELTA = 0.5
"""Lengths by which the top is moved to see how far the touchdown goes, over those of a metre."""
_LARGE = 1e9
"""N/m2: stiffness up to which a soil is made stiffer."""
_SMALL = 1e-6
"""Of the weight: smaller forces at the mudline are no jump."""


class NotStudiedError(Exception):
    """A deck has no touchdown zone to study; the text says why in a sentence."""


class Measures(NamedTuple):
    """A run about the touchdown, in the deck's units.

    touchdown: (k,) in the last period, from the node at the touchdown. largest_force: per unit length. landings: how
    often elements came down.
    """

    times: Floats
    touchdown: Floats
    largest_force: float
    largest_moment: float
    moment_range: float
    landings: int
    run: Run


class Variant(NamedTuple):
    """The zone otherwise than it is: elements in parts, their matrix, factor of the soil, one law, period."""

    parts: int = 1
    matrix: ElementMatrix = "mean"
    factor: float = 1.0
    law_of: int = -1
    period: float = 1.0


@dataclass(frozen=True)
class Zone:
    """The touchdown zone of a line.

    Attributes:
        given: the laws of the deck, jumps at the mudline ramped. scene, pipe, line: what it is cut out of.
        elements, nodes: (m,) and (m + 1,) indices from the lying side to the hanging one; node: which of them is x = 0.
        beam: at rest and with the motion of its right end. motion: of the top. travel: amplitude of the touchdown.
        length: sqrt(EI/T). depth: static embedment at the touchdown. notes: what limits the model, in sentences.
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

    @cached_property
    def soil_length(self) -> float:
        """(4 EI/k)^(1/4) with the secant stiffness k of the soil under the static weight."""
        return float((4.0 * self.beam.bending * self.depth / self.beam.weight) ** 0.25)

    @cached_property
    def stepped(self) -> bool:
        """Whether the soil remembers."""
        return has_history(self.cut(Variant()))

    @cached_property
    def stiffness(self) -> float:
        """Secant stiffness of the soil under the static weight, per unit length."""
        return self.beam.weight / self.depth

    def cut(self, variant: Variant) -> ContactInput:
        """Return the laws of the zone."""
        found = cut_out(self.given, self.elements, self.nodes, variant.parts)
        return found if variant.law_of < 0 else _with_law(self.given, found, variant.law_of)

    def soil(self, variant: Variant) -> Soil:
        """Return the soil of the zone, with nothing remembered."""
        soil = soil_of(self.cut(variant), variant.matrix)
        return soil if variant.factor == 1.0 else ScaledSoil(soil, variant.factor)

    def rest(self, variant: Variant = Variant()) -> tuple[Beam, Soil, Rest]:  # noqa: B008 - a constant
        """Return the beam, its soil and its state at rest. Raises NotConvergedError."""
        lengths, period = np.repeat(self.beam.lengths / variant.parts, variant.parts), self.beam.period * variant.period
        left = self.beam.left
        if variant.law_of >= 0 or variant.factor != 1.0:
            row = self.elements[:1] if variant.law_of < 0 else np.array([variant.law_of])
            depth = float(static_depth(self.given, row, np.array([self.beam.weight / variant.factor]))[0])
            left = -depth if math.isfinite(depth) else left
        beam, soil = replace(self.beam, lengths=lengths, period=period, left=left), self.soil(variant)
        return beam, soil, at_rest(beam, soil)

    def run(self, steps: int, variant: Variant = Variant(), periods: int = 3) -> Measures:  # noqa: B008 - as above
        """Return what is measured in a run of so many steps. Raises NotConvergedError."""
        beam, soil, rest = self.rest(variant)
        run = march(beam, soil, self.scheme, rest, steps, periods)
        wanted = np.repeat(self.landing, variant.parts)
        moments = beam.moments(run.turned)[:, wanted]
        return Measures(
            run.times,
            beam.touchdown(run.heights) - self.start,
            float(run.forces[:, wanted].max()),
            float(np.abs(moments).max()),
            float((moments.max(axis=0) - moments.min(axis=0)).max()),
            run.landings,
            run,
        )


def _with_law(given: ContactInput, cut: ContactInput, element: int) -> ContactInput:
    """The laws of a stretch, with the normal law of one element of the deck everywhere."""
    rows = np.arange(len(cut.element_ids))
    laws = [law for law in cut.laws if law.law in {"unloading", "suction", "damping", "nodal damping"}]
    for law in given.normal_laws:
        at = np.flatnonzero(law.rows == element)
        if at.size:
            laws.append(
                LawAssignment(law.law.name, rows, {name: values[at[0]] for name, values in law.parameters.items()})
            )
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
    weight, bending = float(pipe.weight[own]) * line.seabed.upright, float(pipe.bending[own])
    mass = float(pipe.mass[own] + pipe.contents[own] + pipe.added_mass[own])
    _require(scene, own, weight, bending, mass)
    tension = catenary.tension * math.hypot(1.0, line.seabed.slope)
    motion = top_motion(scene, line.vessel, line.direction, heave, period)
    travel = _travel(scene, line, motion)
    size, a = math.sqrt(bending / tension), tension / weight
    first, last = window(arcs, node, 2.0 * travel + 10.0 * size, 2.0 * travel + 6.0 * size)
    first = max(first, min(int(np.searchsorted(arcs, catenary.lying[-1][0])), node - 1))
    elements, nodes = line.elements[first : last + 1], line.nodes[first : last + 2]
    given = _ramped(given, weight)
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
    notes = list(_limits(line, travel, size, right, a, math.sqrt(tension / mass) * motion.period))
    return Zone(
        scene,
        given,
        pipe,
        line,
        elements,
        nodes,
        node - first,
        beam,
        scheme,
        scheme_line,
        motion,
        travel,
        float(depths[1]),
        notes,
    )


def _require(scene: Scene, own: int, weight: float, bending: float, mass: float) -> None:
    """Raise NotStudiedError for a pipe or a seabed at the touchdown that the model cannot have."""
    law, element = scene.law_names[own], scene.element_ids[own]
    if not weight > 0.0:
        raise NotStudiedError(f"The pipe floats: {weight:.4g} {_unit(scene)} at its touchdown")
    if scene.section_table.of_element[own] < 0:
        raise NotStudiedError(f"element {element} at the touchdown has no section")
    if law in {"rigid", "none"}:
        what = "is rigid" if law == "rigid" else "has no law"
        raise NotStudiedError(f"the seabed {what} at the touchdown (element {element})")
    if not bending > 0.0:
        raise NotStudiedError(f"the section of element {element} at the touchdown has no bending stiffness")
    if not mass > 0.0:
        raise NotStudiedError(f"the mass of element {element} at the touchdown is not known")


def _unit(scene: Scene) -> str:
    return {"metric": "N/m", "imperial": "lbf/ft"}.get(scene.units, "")


def _travel(scene: Scene, line: LineAtRest, motion: TopMotion) -> float:
    """Amplitude of the touchdown: how far it goes with the top, by the resting shapes with the top moved a little."""
    step = _DELTA / 0.3048 if scene.units == "imperial" else _DELTA

    def moved(surge: float, heave: float) -> float:
        ends = [touchdowns(line.moved(sign * surge, sign * heave), line.model.length)[-1].arc for sign in (1.0, -1.0)]
        return (ends[0] - ends[1]) / (2.0 * step)

    try:
        return abs(moved(0.0, step) * motion.heave + moved(step, 0.0) * motion.surge)
    except NoRestShapeError as error:
        raise NotStudiedError(f"with the top moved by {step:.3g} the line has no resting shape: {error}") from error


def _limits(line: LineAtRest, travel: float, size: float, right: float, a: float, wave: float) -> list[str]:
    """Where the window, or small slopes, do not hold."""
    found = []
    if right < 2.0 * travel + 4.0 * size:
        found.append(f"The zone is short: {right:.3g} of {2.0 * travel + 4.0 * size:.3g} right of the touchdown.")
    if right > wave / 4.0:
        found.append(f"The end of the zone reflects: {right:.3g} is more than a quarter of a wave, {wave / 4.0:.3g}.")
    if right / a > 0.35:
        found.append(f"Slopes are not small: {right / a:.2f} at the end of the zone.")
    if line.seabed.slope:
        found.append("The model is along the seabed, which slopes: the weight along it is left out.")
    return found


def _ramped(given: ContactInput, weight: float) -> ContactInput:
    """The laws with a ramp in the place of a force that a curve has at the mudline."""
    return replace(given, curves=tuple(ramp(curve) if jump(curve, weight) else curve for curve in given.curves))


def jump(curve: ForceCurve, weight: float) -> float:
    """Return the force of a curve at the mudline, 0 where it is small against a weight."""
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


def stiffest_factor(zone: Zone, factor: float) -> float:
    """Return a factor of the soil, less where it would be stiffer than any seabed."""
    most = _LARGE / 47.88 if zone.scene.units == "imperial" else _LARGE
    return min(factor, max(most / zone.stiffness, 1.0)) if factor > 1.0 else factor


def generalised_alpha(rho: float) -> Scheme:
    """Return generalised-alpha (Chung and Hulbert 1993) with the spectral radius `rho` at infinity."""
    return Scheme("generalised-alpha", (2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0), rho=rho)


def hilber_hughes(alpha: float) -> Scheme:
    """Return the scheme of Hilber, Hughes and Taylor (1977), `alpha` from -1/3 to 0."""
    return Scheme("hilber-hughes", 0.0, -alpha, alpha=alpha)


_DEFAULT_RHO, _DEFAULT_HUGHES = 0.4, -0.25


def scheme_of(scene: Scene) -> tuple[Scheme, int]:
    """Return the scheme of the last `*TIME STEPPING`, the program's default without one, and its line, 0 for none."""
    found, line = generalised_alpha(_DEFAULT_RHO), 0
    for where, block in scene.deck.blocks("TIME STEPPING", "LOAD CASE"):
        given, line = cast("TimeStepping", block), line_of(scene, where)
        if given.type_ == "HILBER-HUGHES":
            found = hilber_hughes(max(number(given.hilber_hughes, "coefficient", _DEFAULT_HUGHES), -1.0 / 3.0))
        elif given.alphas is not None:
            default = generalised_alpha(_DEFAULT_RHO)
            alpha_m = number(given.alphas, "alpha_m", default.alpha_m)
            alpha_f = number(given.alphas, "alpha_f", default.alpha_f)
            found = Scheme("generalised-alpha", alpha_m, alpha_f)
        else:
            found = generalised_alpha(number(given, "infinity", _DEFAULT_RHO))
    return found, line
