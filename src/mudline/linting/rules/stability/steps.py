"""Time steps and the stiffness of contact."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.contact.input import LawKind
from mudline.contact.stiffest import (
    ADVISED_OMEGA_DT,
    CRITICAL_OMEGA_DT,
    critical_step,
    omega,
    rounded_down,
    steepest_slope,
)
from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.assignments import given_stiffness, nodal_stiffness
from mudline.scene.model import Scene
from mudline.scene.numbering import Floats

if TYPE_CHECKING:
    from mudline.keywords.library.time import TimeSpan

STB002 = Code("STB002", "coarse-time-step", Severity.INFO)

_CONSEQUENCES = (
    (1.0, "Newmark, HHT and generalised-alpha may throw it back up to 11 % too fast"),
    (CRITICAL_OMEGA_DT["central-difference"], "Newmark, HHT and generalised-alpha may throw it back far too fast"),
    (
        inf,
        "Newmark, HHT and generalised-alpha may throw it back up to three times too fast, central difference fails",
    ),
)
"""What happens to a landing pipe, up to a product of frequency and step."""


@rule(STB002, off=True)
def coarse_time_step(context: LintContext) -> Iterator[Problem]:
    """The fixed time step is coarse for the stiffest contact.

    A pipe on the seabed swings with omega, the root of stiffness over mass, both per unit length. Implicit schemes that
    are called unconditionally stable are so for linear systems: contact that opens and closes gives energy to the pipe
    when omega times the step is large, within 3 % of its speed at 0.5 and far more above; explicit schemes fail above
    2. Only backward Euler never does. The stiffness of *SEABED UNLOADING counts where it is the larger one. The mass is
    that of the section without added water, and the third value of *TIME is read as the step (inferred). Give the step
    that the message names.

    Example:
         $MODEL
         *NODE
          1, -0.05, 0.0
          5, -0.05, 40.0
          GEN=1, 5
         *ELEMENT
          1, 1, 2
          GEN=1, 4
         *GEOMETRIC SETS
          OPTION=MOORING
          SET=ALL
          480.0E6, 200.0, 0.3
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
         $LOAD CASE
         *TIME
          STEP=FIXED
        - 0.0, 120.0, 0.1, 24.0
        + 0.0, 120.0, 0.03, 24.0

    Finds: 20:14
    """
    scene = context.scene
    blocks = list(scene.deck.blocks("TIME", "LOAD CASE"))
    if not blocks or not len(scene.element_ids):
        return
    frequencies = omega(_stiffness(scene), scene.mass_per_length)
    if np.isnan(frequencies).all():
        return
    stiffest = int(np.nanargmax(frequencies))
    frequency = float(frequencies[stiffest])
    advised = rounded_down(float(critical_step(frequencies[stiffest], ADVISED_OMEGA_DT)))
    for where, block in blocks:
        step = getattr(cast("TimeSpan", block), "increment", None)
        if isinstance(step, int | float) and frequency * step > ADVISED_OMEGA_DT:
            effect = next(words for limit, words in _CONSEQUENCES if frequency * step <= limit)
            message = (
                f"omega dt = {frequency * step:.3g} on the stiffest contact (element {scene.element_ids[stiffest]}, "
                f"omega = {frequency:.4g} rad/s): {effect}; give a step of {advised:.3g} or less "
                "(inferred: the third value is the step)"
            )
            yield Problem(STB002, message, where=where._replace(path=("increment",)))


def _stiffness(scene: Scene) -> Floats:
    """The largest stiffness of the contact of each element, per unit length; NaN without one."""
    grants = scene.laws.set_laws
    linear = np.array([*(grant.stiffness for grant in grants), np.nan])[scene.laws.of_element]
    steepest = np.full(len(linear), np.nan)
    for number, entry in enumerate(scene.laws.curves):
        if entry.curve is not None and entry.whole:
            steepest[scene.laws.followers(number)] = steepest_slope(entry.curve.ratios, entry.curve.slopes)
    found = np.where(scene.law == LawKind.CURVE, steepest / scene.diameter, linear)
    if "SEABED UNLOADING" in scene.extensions:
        found = np.where(np.isnan(found), np.nan, np.fmax(found, given_stiffness(scene.extensions["SEABED UNLOADING"])))
    return np.where(scene.nodal, _nodal(scene), found) if scene.nodal.any() else found


def _nodal(scene: Scene) -> Floats:
    """Stiffness of the stiffer end of each element, spread over the halves of the elements that meet there."""
    nodes, length = scene.element_nodes, np.zeros(len(scene.node_ids))
    if (nodes < 0).any():
        return np.full(len(nodes), np.nan)
    for end in nodes.T:
        np.add.at(length, end, 0.5 * scene.length)
    with np.errstate(all="ignore"):
        spread = nodal_stiffness(scene, scene.extensions["SEABED CONTACT"]) / length
    found: Floats = np.fmax(*spread[nodes].T)
    return found
