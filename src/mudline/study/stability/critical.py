"""Critical steps, predicted and measured: each scheme steps a mass on each contact of the scene."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.scene.model import Scene
from mudline.study.motion import Motion, Scheme, march
from mudline.study.newton import Newton
from mudline.study.report import Layout
from mudline.study.schemes import OneStep, RungeKutta
from mudline.study.stability.contacts import Contact, LoadedContact

STEPS = 200
"""On springs; Runge-Kutta schemes grow slowest, by half a percent in a step at 1.005 of the critical step."""
STEPS_DAMPED = 1000
"""With damping the growth at 1.01 is no more than 1 to 2 percent in a step."""
GROWTH = 100.0
"""A motion that exceeds its first amplitude by this factor grows."""
AMPLITUDE = 1e-6
"""Of the reach of the segment: implicit schemes guess (omega dt)^2 times as far, and still the law is linear."""
_SHARE_OF_SPEED = 1e-7
"""Of the pull-out velocity, for motions added to a steady one."""
SHARES = np.array([*np.arange(180, 200), *np.arange(201, 221)]) / 200.0
"""Of the predicted critical step, from 0.9 to 1.1 and without 1: at the critical step itself growth has no rate."""
FAR = 100.0
"""omega dt, or damping rate times dt, at which schemes without a critical step are tried."""
ALWAYS = 1.0
"""The same for those that grow at every step."""

BOUNDED, GROWS, NO_CONVERGENCE, NOT_TRIED = "bounded", "grows", "no convergence", "-"


class Measured(NamedTuple):
    """A scheme on a contact.

    predicted: critical step; inf for none, 0 for a scheme that grows at every step.
    measured: the middle between the largest step that stayed bounded and the smallest that grew; NaN where there is
        only one try.
    below: outcome at 0.99 of the predicted step; at omega dt = FAR where there is none.
    above: outcome at 1.01 of it; at omega dt = ALWAYS where it is 0.
    tried: outcome at each of `SHARES`; empty without a critical step above 0.
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


CRITICAL_STEPS = Layout[Measured](
    "critical-steps",
    f"Critical steps (none: tried at omega dt = {FAR:g}; 0: tried at {ALWAYS:g})",
    {
        "contact": lambda one: one.contact.name,
        "scheme": lambda one: one.scheme.title,
        "predicted [s]": lambda one: one.predicted,
        "measured [s]": lambda one: one.measured,
        "at 0.99": lambda one: one.below,
        "at 1.01": lambda one: one.above,
        "as predicted": lambda one: "yes" if one.as_predicted else "NO",
    },
)


def measure(scene: Scene, contact: Contact, scheme: Scheme) -> Measured:
    """Step a scheme on a contact below and above its critical step."""
    step, fastest = contact.critical_step(scheme.name), max(contact.omega, contact.rate)
    if step in {0.0, np.inf}:
        (word,) = _outcomes(scene, contact, scheme, np.array([ALWAYS if step == 0.0 else FAR]) / fastest)
        below, above = (NOT_TRIED, word) if step == 0.0 else (word, NOT_TRIED)
        return Measured(contact, scheme, step, np.nan, below, above)
    words = _outcomes(scene, contact, scheme, step * SHARES)
    below, above = (words[int(np.argmin(np.abs(SHARES - share)))] for share in (0.99, 1.01))
    return Measured(contact, scheme, step, step * _change(words), below, above, tuple(words))


def _change(words: list[str]) -> float:
    """The share between the last that stayed bounded and the first that grew; NaN where there is none."""
    first = words.index(GROWS) if GROWS in words else 0
    if not first or set(words[:first]) != {BOUNDED} or set(words[first:]) != {GROWS}:
        return float("nan")
    return float(0.5 * (SHARES[first - 1] + SHARES[first]))


def _outcomes(scene: Scene, contact: Contact, scheme: Scheme, dt: FloatArray) -> list[str]:
    """The outcome of a small motion, for steps (k,)."""
    setting = contact.setting
    system = LoadedContact(scene.contact_input("cut"), contact.oscillation, setting, len(dt))
    if isinstance(scheme, OneStep):
        largest = max(abs(system.load), setting.factor * contact.stiffness * setting.scale)
        enough = 64.0 * float(np.finfo(np.float64).eps) * largest
        scheme = scheme.solved_by(replace(Newton(), tolerance=enough))
    start = AMPLITUDE * setting.reach
    speed = min(_SHARE_OF_SPEED * setting.speed, start * max(contact.omega, contact.rate))
    if speed:  # start without the acceleration of the force: at the critical step it would take all of the speed
        start = 0.0
    motion = Motion.start(system, np.full(len(dt), start), np.full(len(dt), speed))
    if speed:
        motion = motion._replace(acceleration=np.zeros(len(dt)))
    bound = GROWTH * max(start, speed * float(dt.max()))
    steps = STEPS if not (contact.rate and scheme.explicit) else STEPS_DAMPED
    if isinstance(scheme, RungeKutta):
        steps = min(steps, STEPS_DAMPED // 2)
    run = march(scheme, system, motion, dt, steps, bound=bound)
    words = [BOUNDED] * len(dt)
    for index, why in run.failures.items():
        words[index] = NO_CONVERGENCE if "Newton" in why else GROWS
    return words
