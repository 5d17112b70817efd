"""Causes that keep a solution from being found, or from being right."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from mudline.basics.units import UNITS
from mudline.checks.context import LintContext
from mudline.language.diagnostics import Code, Problem, Severity
from mudline.language.keywords.text import shown
from mudline.language.rules import rule
from mudline.model.contact.input import LawKind
from mudline.model.scene.curves import SceneCurve
from mudline.model.scene.deck_values import number
from mudline.model.scene.laws import Extension, rule_of_extension
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices

EXT008 = Code("EXT008", "soft-unloading", Severity.WARNING)
STB001 = Code("STB001", "suction-snap", Severity.INFO)
STB002 = Code("STB002", "coarse-time-step", Severity.INFO)
STB003 = Code("STB003", "stiff-jump", Severity.WARNING)
STB004 = Code("STB004", "lateral-softening", Severity.INFO)

FARTHEST = 1.0e4


@rule_of_extension(STB001, "SEABED SUCTION", blocks=False)
def suction_snap(scene: Scene, extension: Extension) -> Iterator[Problem]:
    """The suction force decreases while the pipe keeps rising.

    From the second corner of the trapezoid to breakout, the suction decreases with slope F_max / ((1 - xc2) Delta_B).
    This is a negative stiffness. A static or quasi-static solution is unique only where the stiffness of the pipe
    itself, per unit length, is greater; elsewhere the pipe snaps off the seabed, and the solver may not converge. The
    message gives the stiffness at the velocity of REGULARISATION=, for the element that needs most. Use smaller steps
    at lift-off, or a linear SUCTION=.

    Example on pipe:
          STIFFNESS=50000.0
        -*SEABED SUCTION
        - SET=ALL
        - COHESION=5000.0
        + SUCTION=15000.0, 0.05

    Finds: 18:2
    """
    from mudline.model.contact.laws.suction import release_stiffness  # noqa: PLC0415 - most decks do without
    from mudline.model.scene.assignments import suction_law  # noqa: PLC0415 - most decks do without

    for _, where, held in extension.blocks():
        elements = np.flatnonzero(held)
        law = suction_law(scene, extension, elements)
        with np.errstate(all="ignore"):
            usable = (law.second_corner >= 0.01) & (law.second_corner <= 0.99) & (law.regularisation > 0.0)
            needed = np.where(usable, release_stiffness(law, law.regularisation), np.nan)
        known = np.flatnonzero(np.isfinite(needed) & (needed > 0.0))
        if known.size:
            worst = int(known[np.argmax(needed[known])])
            unit = UNITS[scene.units].behind("F/L2")
            message = (
                f"the release of the suction is softening: equilibrium needs a structural stiffness per unit length "
                f"above F_max / ((1 - xc2) Delta_B) = {needed[worst]:.6g}{unit} at the velocity of "
                f"REGULARISATION= (element {scene.element_ids[elements[worst]]})"
            )
            yield Problem(STB001, message, where=where)


@rule(STB002, off=True)
def coarse_time_step(context: LintContext) -> Iterator[Problem]:
    """The fixed time step is coarse for the stiffest contact.

    A node on the seabed oscillates at omega = sqrt(stiffness / mass), with the mass that the node carries. The stiffest
    law counts: the normal law, *SEABED UNLOADING, *SEABED SOIL where the pipe turns, sticking friction, lateral
    springs, and suction while it is mobilised.

    Unconditional stability of an implicit scheme holds for linear systems only. Contact that opens and closes adds
    energy to a bare mass that lands, if omega times the step is large:

    * with Newmark's scheme the rebound is up to 3 % too fast at 0.5, and far more above;
    * generalised-alpha with rho = 0 adds 1 % of the speed on a clay that softens, 5 % where its force jumps at the
      mudline, and more at other speeds;
    * backward Euler never adds energy. It damps, as generalised-alpha does.

    This rule, off unless it is selected, considers such a mass without bending, tension and water, which soften the
    landing of a line. `mudline study` measures if the step of a deck is short enough for its touchdown zone. The mass
    is that of the section without contents and added water. Friction with a mobilisation length has its spring under
    the static normal force. If `mudline study` finds the deck's step too long, give the step that the message names.

    Example on pipe:
          STIFFNESS=50000.0
        |$LOAD CASE
        |*TIME
        | STEP=FIXED
        - 0.0, 120.0, 0.1, 24.0
        + 0.0, 120.0, 0.02, 24.0

    Finds: 20:14
    """
    scene = context.scene
    blocks = context.blocks("TIME", "LOAD CASE")
    if not blocks or not len(scene.element_ids) or scene.blocking("cut"):
        return
    from mudline.model.contact.stiffest import ADVISED_OMEGA_DT, rounded_down  # noqa: PLC0415 - most decks do without
    from mudline.model.scene.oscillation import oscillations  # noqa: PLC0415 - most decks do without

    springs = [spring for spring in oscillations(scene, scene.contact_input("cut")).found if spring.omega > 0.0]
    if not springs:
        return
    stiffest = max(springs, key=lambda spring: spring.omega)
    line, base = scene.line_of(stiffest.where), scene.deck.base_of(stiffest.where)
    contact = f"{stiffest.name}, node {scene.node_ids[stiffest.node]}" + (f", line {line}" if line else "")
    contact += f" of {Path(base[0].file).name}" if base else ""
    advised = rounded_down(ADVISED_OMEGA_DT / stiffest.omega)
    for where, block in blocks:
        step = number(block.fixed, "increment")
        if stiffest.omega * step > ADVISED_OMEGA_DT:
            message = (
                f"omega dt = {stiffest.omega * step:.3g} on the stiffest contact ({contact}, "
                f"omega = {stiffest.omega:.4g} rad/s): {_effect(stiffest.kind, stiffest.omega * step)}; give a step of "
                f"{advised:.3g} or less if `mudline study` finds this one too long"
            )
            yield Problem(STB002, message, where=where.inside("fixed", "increment"))


@rule_of_extension(STB004, "SEABED FRICTION", blocks=False)
def lateral_softening(scene: Scene, extension: Extension) -> Iterator[Problem]:
    """The lateral resistance decreases while the pipe keeps moving.

    Beyond the breakout of LATERAL=PEAK-RESIDUAL or F114 the resistance decreases to its residual. This is a negative
    stiffness: (peak - residual) N over the distance between the two displacements. Only a structure that is stiffer
    sideways, per unit length, has a unique equilibrium there. A softer one jumps, and the motion grows at the rate
    sqrt(that stiffness / mass).

    The message gives the stiffness under the static normal force, for the node that needs most, and the step that
    resolves the rate, if weight and mass are known. Use that step through breakout, or a static solution controlled by
    displacement.

    Example on pipe:
         $MODEL
        |*OCEAN
        | 100.0, 1025.0

          STIFFNESS=50000.0
        |*SEABED FRICTION
        | SET=ALL
        | COEFFICIENTS=0.3, 0.6
        | STIFFNESS=20000.0
        - LATERAL=PEAK-RESIDUAL
        - PEAK=1.2, 0.03
        - RESIDUAL=0.6, 0.3

    Finds: 24:2
    """
    from mudline.model.scene.assignments import softens  # noqa: PLC0415 - most decks do without
    from mudline.model.scene.oscillation import oscillations, softening_needs  # noqa: PLC0415 - most decks do without

    if not any(map(softens, extension.entries)) or scene.blocking("cut"):
        return
    known = {spring.where: spring for spring in oscillations(scene, scene.contact_input("cut")).softening}
    needs = "equilibrium needs a structural stiffness per unit length above (peak - residual) N / distance"
    for entry, place in zip(extension.entries, extension.places, strict=True):
        where = place.inside("peak")
        if softens(entry):
            numbers = softening_needs(scene, known[where]) if where in known else ", with N and mass as they will be"
            yield Problem(STB004, f"the lateral resistance falls behind its peak: {needs}{numbers}", where=where)


def _effect(kind: str, product: float) -> str:
    """Return the effect of omega dt on a mass that lands, or on a spring that does not lift off, in words."""
    if kind in {"friction", "lateral"}:
        return "the spring of what sticks is not resolved"
    fast = "up to 11 %" if product <= 1.0 else "far" if product <= 2.0 else "up to three times"
    return f"with Newmark's scheme a bare mass rebounds {fast} too fast"


@rule(STB003)
def stiff_jump(context: LintContext) -> Iterator[Problem]:
    """The stiffness of the seabed jumps by a factor of more than 10 000.

    It does so where two segments of a curve meet, flat segments left out, or where an element on a curve has a
    neighbour on a linear seabed that is stiffer, or softer, than every segment by this factor. The solver loses digits
    at such a jump, and the pipe bends sharply at the edge. Usually an exponent is wrong. Correct the point or the
    stiffness; real rock next to mud needs a transition.

    Example on clay:
        - 0.1, 1.2E-3
        + 0.1, 1200.0
          0.5, 4200.0
        | 1.0, 8000.0

    Finds: 5:2
    """
    for entry in context.scene.laws.curves:
        if entry.curve is not None and entry.whole:
            yield from _inside(entry, entry.curve.ratios, entry.curve.slopes)
    yield from _beside(context)


def _inside(entry: SceneCurve, ratios: Floats, slopes: Floats) -> Iterator[Problem]:
    """Yield jumps at points of a curve."""
    steep = np.flatnonzero(slopes)
    before, behind = np.abs(slopes[steep[:-1]]), np.abs(slopes[steep[1:]])
    jumps = np.flatnonzero((before / FARTHEST > behind) | (behind / FARTHEST > before))
    if not len(jumps):
        return
    order = entry.points[:, 0].argsort(kind="stable")
    points = order[np.searchsorted(entry.points[:, 0], ratios[steep[jumps + 1]], sorter=order)]
    for at, point in zip(jumps.tolist(), points.tolist(), strict=True):
        message = (
            f"the slope goes from {before[at]:.6g} to {behind[at]:.6g} here, over {FARTHEST:g} times: correct the "
            "point, or add a transition"
        )
        yield Problem(STB003, message, where=entry.point(point))


def _beside(context: LintContext) -> Iterator[Problem]:
    """Yield jumps between an element on a curve and its neighbour on a linear seabed, one for each pair of laws."""
    scene = context.scene
    grants = scene.laws.set_laws
    reported: set[tuple[int, int]] = set()
    if not scene.laws.curves:
        return
    linear, curved = _neighbours(scene)
    extremes = np.array([*map(_extremes, scene.laws.curves), (math.nan, math.nan)])
    curve_of = np.array([*(grant.curve for grant in grants), -1], dtype=np.intp)
    stiffness = np.array([*(grant.stiffness for grant in grants), np.nan])[scene.laws.of_element[linear]]
    with np.errstate(all="ignore"):
        softest, steepest = (extremes[curve_of[scene.laws.of_element[curved]]] / scene.diameter[curved][:, None]).T
        far = (stiffness / FARTHEST > steepest) | ((stiffness > 0.0) & (softest / FARTHEST > stiffness))
    for at in np.flatnonzero(far).tolist():
        pair = (int(scene.laws.of_element[linear[at]]), int(scene.laws.of_element[curved[at]]))
        if pair in reported:
            continue
        reported.add(pair)
        message = (
            f"the linear stiffness {stiffness[at]:.6g} of element {scene.element_ids[linear[at]]} is over "
            f"{FARTHEST:g} times away from that of curve {shown(scene.laws.curves[curve_of[pair[1]]].name)} at its "
            f"neighbour {scene.element_ids[curved[at]]}, {softest[at]:.6g} to {steepest[at]:.6g}: correct it, or "
            "add a transition"
        )
        yield Problem(STB003, message, where=grants[pair[0]].where)


def _extremes(entry: SceneCurve) -> tuple[float, float]:
    """Return the smallest and the largest slope of a curve, flat segments left out; NaN without any."""
    slopes = np.abs(entry.curve.slopes) if entry.curve is not None and entry.whole else np.zeros(0)
    slopes = slopes[slopes > 0.0]
    return (float(slopes.min()), float(slopes.max())) if slopes.size else (math.nan, math.nan)


def _neighbours(scene: Scene) -> tuple[Indices, Indices]:
    """Return pairs of elements that meet at a node: the first on a linear seabed, the second on a curve."""
    law, nodes = scene.law, scene.element_nodes.ravel()
    order = np.argsort(nodes, kind="stable")
    elements, at = order // 2, nodes[order]
    meet = (at[1:] == at[:-1]) & (at[1:] >= 0)
    first, second = elements[:-1][meet], elements[1:][meet]
    first, second = np.append(first, second), np.append(second, first)
    mixed = (law[first] == LawKind.LINEAR) & (law[second] == LawKind.CURVE)
    return first[mixed], second[mixed]


@rule_of_extension(EXT008, "SEABED UNLOADING", blocks=False)
def soft_unloading(scene: Scene, extension: Extension) -> Iterator[Problem]:
    """The unloading stiffness is below the steepest slope of the loading law.

    Soil unloads at least as stiffly as it was loaded. With a softer return path a cycle would release energy, and the
    trench would lie above the seabed. The stiffness is raised to the slope reached. Give a higher stiffness.

    Example on pipe:
          STIFFNESS=50000.0
        |*SEABED UNLOADING
        | SET=ALL
        - STIFFNESS=20000.0
        + STIFFNESS=500000.0

    Finds: 19:12
    """
    steepest = np.where(scene.nodal, np.nan, _steepest(scene))
    for entry, where, held in extension.blocks():
        stiffness = number(entry, "stiffness")
        softer = np.flatnonzero(held & (steepest > stiffness))
        if stiffness > 0.0 and softer.size:
            unit = UNITS[scene.units].behind("F/L2")
            message = (
                f"unloading stiffness {stiffness!r} is below the steepest slope of the loading law of "
                f"{scene.describe(softer, '', '')}, {float(steepest[softer].max()):.6g}{unit}: it is raised to that; "
                "give at least as much"
            )
            yield Problem(EXT008, message, where=where.inside("stiffness"))


def _steepest(scene: Scene) -> Floats:
    """Return the steepest slope of each element's law below the mudline, per unit of penetration; NaN if not known."""
    linear = np.array([*(np.nan if grant.unknown else grant.stiffness for grant in scene.laws.set_laws), np.nan])
    slopes = np.array([*(_curve_slope(scene, grant.curve) for grant in scene.laws.set_laws), np.nan])
    of_element = scene.laws.of_element
    with np.errstate(over="ignore"):
        steep: Floats = np.where(scene.law == LawKind.LINEAR, linear[of_element], slopes[of_element] / scene.diameter)
    return steep


def _curve_slope(scene: Scene, index: int) -> float:
    from mudline.model.contact.laws.linear import steepest_slopes  # noqa: PLC0415 - most decks do without

    curve = scene.laws.curves[index].curve if index >= 0 else None
    return math.nan if curve is None else float(steepest_slopes(curve)[-1])
