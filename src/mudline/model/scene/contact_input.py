"""Input of the evaluator from a scene: laws, seabed, and what is left out and why."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from typing import Literal

import numpy as np

from mudline.basics.installed import install_hint
from mudline.basics.short_repr import counted
from mudline.language.codes import RUN001
from mudline.language.diagnostics import DeckError, Problem
from mudline.model.contact import ElementError
from mudline.model.contact.input import ContactInput, LawAssignment, LawKind
from mudline.model.contact.seabed import Seabed
from mudline.model.scene import assignments
from mudline.model.scene.numbering import Indices, Mask
from mudline.model.scene.resolved import LawArrays, ResolvedDeck
from mudline.model.scene.seabed import SeabedKind, made_seabed
from mudline.model.scene.weights import operating_weight

_REFUSED = "; this cannot be evaluated"


def contact_input(scene: ResolvedDeck, tension: Literal["keep", "cut"]) -> ContactInput:
    """Return the arrays that the evaluator is made from; raises DeckError (RUN001) for faults that no check covers."""
    springs = ~np.isin(scene.law, (LawKind.NONE, LawKind.RIGID, LawKind.NODAL))
    unknown = scene.element_nodes.min(axis=1, initial=0) < 0
    endless = springs & ~np.isfinite(scene.length) & ~unknown
    problems = []
    for found, one, many in (
        (unknown, "ends at a node that is not known", "end at nodes that are not known"),
        (endless, "has no known finite length", "have no known finite length"),
    ):
        for at in np.flatnonzero(found)[:1].tolist():
            message = f"{scene.describe(found, one, many)}{_REFUSED}"
            problems.append(Problem(RUN001, message, where=scene.table.numbered.where(at)))
    if problems:
        raise DeckError(scene.deck.diagnose(problems))
    arrays = scene.law_arrays()
    laws = tuple(law for law in (*_normal_laws(scene, arrays), *_laws_beside(scene)) if len(law.rows))
    left_out: dict[str, str] = {}
    for stage, why in _reasons(scene, [law.law for law in laws]):
        left_out[stage] = f"{left_out[stage]}; {why}" if stage in left_out else why
    tables = assignments.resistance_tables(scene) if "SEABED TRENCH" in scene.extensions else []
    try:
        return ContactInput(
            node_ids=scene.node_ids,
            coordinates=scene.coordinates,
            element_ids=scene.element_ids,
            element_nodes=scene.element_nodes,
            length=np.where(np.isfinite(scene.length), scene.length, 0.0),  # what is not finite has no spring
            diameter=scene.diameter,
            laws=laws,
            curves=arrays.curves,
            tables=tuple(tables),
            tension=tension,
            seabed=_seabed(scene),
            weight=operating_weight(scene),
            empty_weight=operating_weight(scene, filled=False),
            left_out=left_out,
            names=scene,
        )
    except ElementError as error:
        raise scene.refusal(f"{error}{_REFUSED}", element=error.element) from error


def _normal_laws(scene: ResolvedDeck, arrays: LawArrays) -> list[LawAssignment]:
    """Return curves, linear laws, and laws of extension keywords: nodal laws, damping, soils, unloading."""
    (on_curve,), (linear,) = (np.nonzero(scene.law == kind) for kind in (LawKind.CURVE, LawKind.LINEAR))
    laws = [
        LawAssignment("rigid", np.flatnonzero(scene.law == LawKind.RIGID)),
        LawAssignment("curve", on_curve, {"curve": arrays.curve_index[on_curve]}),
    ]
    extended: list[LawAssignment] = []
    if "SEABED CONTACT" in scene.extensions:
        laws.append(smoothing := assignments.element_smoothing(scene))
        linear = np.setdiff1d(linear, smoothing.rows, assume_unique=True)
        if scene.nodal.any():
            extended.append(assignments.nodal_springs(scene))
        extended += assignments.damping(scene)
    if "SEABED SOIL" in scene.extensions:
        extended.append(assignments.soils(scene))
    if "SEABED UNLOADING" in scene.extensions:
        extended.append(assignments.unloading_lines(scene))
    return [*laws, LawAssignment("linear", linear, {"stiffness": arrays.linear_stiffness[linear]}), *extended]


def _laws_beside(scene: ResolvedDeck) -> list[LawAssignment]:
    """Return suction, lateral springs, friction, trenches."""
    stiffness, extent = scene.resistance.column("suction"), scene.resistance.column("extent")
    # a spring without an extent of its zone has no effect
    rows = np.flatnonzero((stiffness > 0.0) & (extent > 0.0) & (scene.law != LawKind.RIGID))
    laws = [LawAssignment("suction spring", rows, {"stiffness": stiffness[rows], "extent": extent[rows]})]
    if "SEABED SUCTION" in scene.extensions:
        laws.append(assignments.element_suction(scene))
    lateral = _lateral(scene)
    laws.append(LawAssignment("lateral", lateral, {"stiffness": scene.resistance.column("lateral")[lateral]}))
    friction = friction_of(scene)
    if friction is not None:
        laws += [friction, *assignments.node_breakouts(scene, friction)]
    if "SEABED TRENCH" in scene.extensions:
        laws += assignments.trenches(scene)
    return laws


def friction_of(scene: ResolvedDeck) -> LawAssignment | None:
    """Return the friction of the nodes; None if nothing gives any."""
    given = any(coefficient > 0.0 for values in scene.resistance.values for coefficient in values.friction)
    if "SEABED FRICTION" not in scene.extensions and not given:
        return None
    return assignments.node_friction(scene, _lateral(scene))


def _lateral(scene: ResolvedDeck) -> Indices:
    """Return the elements with a lateral spring."""
    return np.flatnonzero((scene.resistance.column("lateral") > 0.0) & (scene.law != LawKind.RIGID))


def _seabed(scene: ResolvedDeck) -> Seabed | None:
    """Return the shape of the seabed; None for a flat one at elevation 0.

    Raises DeckError for faults that no check covers: files of a deck without a folder, points that only their
        triangulation refuses, and a missing package.
    """
    seabed = scene.seabed
    if seabed.kind is SeabedKind.FLAT:
        return None
    if seabed.missing:
        raise scene.refusal(f"the seabed is not known: {seabed.missing}{_REFUSED}", seabed.where)
    if seabed.kind is SeabedKind.SURFACE and find_spec("scipy") is None:
        message = f"a 3D surface needs scipy, which is not installed: {install_hint('bathymetry')}"
        raise scene.refusal(message, seabed.where)
    try:
        return made_seabed(seabed)
    except ValueError as error:
        raise scene.refusal(f"{error}{_REFUSED}", seabed.where) from error


def _reasons(scene: ResolvedDeck, laws: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Yield stage of the plan and reason of each request that is not evaluated, or not as written."""

    def where_given(name: str) -> Mask:
        return scene.resistance.column(name) > 0.0

    rigid = scene.law == LawKind.RIGID
    if "SEABED CONTACT" in scene.extensions and (count := assignments.weightless(scene)):
        elements = counted(count, "element")
        yield "smoothing", f"none for {elements} of SMOOTHING=AUTO: no submerged weight above 0 is known"
    if count := int((where_given("suction") & ~where_given("extent") & ~rigid).sum()):
        yield "suction", f"SUCTION= without an extent of its zone has no effect: {counted(count, 'element')}"
    asked = where_given("friction").any(axis=1)
    if extension := scene.extensions.get("SEABED FRICTION"):
        asked |= extension.of_element >= 0
    if count := int((asked & rigid).sum()):
        elements = counted(count, "element")
        yield "friction", f"none on a rigid seabed, whose reaction is that of a constraint: {elements}"
    if "lateral" in laws and asked.any():
        yield "friction", "LATERAL= replaces the transverse coefficient"
    if where_given("constant").any():
        why = "the constant friction force coefficient is not evaluated: the manual does not say what it means"
        yield "friction", why
    if where_given("friction_stiffness").any():
        yield "friction", "friction stiffnesses of FRICTION= are for modal and frequency runs (inferred)"
