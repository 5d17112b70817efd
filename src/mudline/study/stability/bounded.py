"""Critical steps, predicted and measured: each scheme really steps a mass on each contact of the scene."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.stiffest import CRITICAL_OMEGA_DT
from mudline.scene.model import Scene
from mudline.study.motion import Motion, Scheme, march
from mudline.study.newton import Newton
from mudline.study.schemes import OneStep
from mudline.study.stability.contacts import Contact
from mudline.study.stability.pressed import Pressed

STEPS = 400
GROWTH = 100.0
"""A motion that leaves so many times its first amplitude behind grows."""
AMPLITUDE = 1e-6
"""Of the reach of the segment: implicit schemes guess (omega dt)^2 times as far, and still the law is linear."""
SHARES = np.array([*np.arange(180, 200), *np.arange(201, 221)]) / 200.0
"""Of the predicted critical step, from 0.9 to 1.1 and without 1: at the critical step itself growth has no rate."""
FAR = 100.0
"""omega dt at which schemes without a critical step are tried."""
ALWAYS = 1.0
"""The same for those that grow at every step."""

BOUNDED, GROWS, NO_CONVERGENCE, NOT_TRIED = "bounded", "grows", "no convergence", "-"

_NARROWEST = 1e-5
_SOFTEST = 1e-280
_SLOWEST = 1e-140
"""And the fastest the other way round: the square of a step must be a number."""


def can_swing(contact: Contact) -> bool:
    """Whether a small swing is more than the rounding of depths and forces."""
    wide = _NARROWEST * contact.scale < contact.reach < np.inf
    felt = _SOFTEST < contact.stiffness * contact.reach < np.inf
    return wide and felt and _SLOWEST < contact.omega < 1.0 / _SLOWEST


class Measured(NamedTuple):
    """A scheme on a contact.

    predicted: critical step; inf for none, 0 for a scheme that grows at every step.
    measured: the middle between the largest step that stayed bounded and the smallest that grew; NaN where there is
        only one try.
    below: what the motion did at 0.99 of the predicted step; at omega dt = FAR where there is none.
    above: what it did at 1.01 of it; at omega dt = ALWAYS where it is 0.
    tried: what it did at each of `SHARES`; empty without a critical step above 0.
    """

    contact: Contact
    scheme: Scheme
    predicted: float
    measured: float
    below: str
    above: str
    tried: tuple[str, ...] = ()

    @property
    def as_predicted(self) -> bool:
        """Whether it stayed bounded where it should and grew where it should."""
        return self.below in {BOUNDED, NOT_TRIED} and self.above in {GROWS, NOT_TRIED}


def measure(scene: Scene, contact: Contact, scheme: Scheme) -> Measured:
    """Step a scheme on a contact below and above its critical step."""
    limit = CRITICAL_OMEGA_DT.get(scheme.name, np.inf)
    if limit == np.inf:
        return Measured(
            contact, scheme, np.inf, np.nan, _outcomes(scene, contact, scheme, np.array([FAR]))[0], NOT_TRIED
        )
    if limit == 0.0:
        return Measured(
            contact, scheme, 0.0, np.nan, NOT_TRIED, _outcomes(scene, contact, scheme, np.array([ALWAYS]))[0]
        )
    words = _outcomes(scene, contact, scheme, limit * SHARES)
    step = limit / contact.omega
    below, above = (words[int(np.argmin(np.abs(SHARES - share)))] for share in (0.99, 1.01))
    return Measured(contact, scheme, step, step * _change(words), below, above, tuple(words))


def _change(words: list[str]) -> float:
    """The share between the last that stayed bounded and the first that grew; NaN where there is none such."""
    first = words.index(GROWS) if GROWS in words else 0
    if not first or set(words[:first]) != {BOUNDED} or set(words[first:]) != {GROWS}:
        return float("nan")
    return float(0.5 * (SHARES[first - 1] + SHARES[first]))


def _outcomes(scene: Scene, contact: Contact, scheme: Scheme, omega_dt: FloatArray) -> list[str]:
    """What a small motion does, for values (k,) of omega dt."""
    system = Pressed(scene, contact, len(omega_dt))
    if isinstance(scheme, OneStep):
        enough = 64.0 * float(np.finfo(np.float64).eps) * max(abs(system.load), contact.stiffness * contact.scale)
        scheme = scheme.solved_by(replace(Newton(), tolerance=enough))
    start = AMPLITUDE * contact.reach
    motion = Motion.start(system, np.full(len(omega_dt), start), np.zeros(len(omega_dt)))
    run = march(scheme, system, motion, omega_dt / contact.omega, STEPS, bound=GROWTH * start)
    words = [BOUNDED] * len(omega_dt)
    for index, why in run.failures.items():
        words[index] = NO_CONVERGENCE if "Newton" in why else GROWS
    return words
