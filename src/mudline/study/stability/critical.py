"""Critical steps, predicted and measured: each scheme really steps a mass on each contact of the scene.

The contacts of a scene are those of `mudline.scene.oscillation`: normal laws, unloading, friction that sticks, lateral
springs, and suction with its damping, each with the mass that its node carries.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, NamedTuple

import numpy as np

from mudline.contact import ContactInput
from mudline.contact.arrays import FloatArray
from mudline.contact.stiffest import ADVISED_OMEGA_DT, critical_step
from mudline.scene.model import Scene
from mudline.scene.oscillation import Oscillation, line_of, oscillations
from mudline.study.motion import Motion, Scheme, march
from mudline.study.newton import Newton
from mudline.study.report import Layout, Omission, columns_of
from mudline.study.schemes import OneStep, RungeKutta
from mudline.study.stability.oscillator import LoadedContact, Setting, setting_of


class Contact(NamedTuple):
    """One kind of contact.

    name: its law, and the set through which its elements have it.
    element: index of an element at the node that asks for the smallest step.
    elements: how many elements share it; of laws of nodes how many nodes.
    stiffness: the largest tangent stiffness that its law can reach, per unit length.
    mass: that the node carries, per unit length.
    omega: root of stiffness over mass, radians per unit of time.
    damping: the largest derivative of its force by velocity, per unit length.
    rate: damping over mass.
    node: number of the node.
    line: of the deck, that sets it; 0 for none.
    oscillation: the same as the scene has it.
    setting: how copies of it are set up.
    """

    name: Annotated[str, "contact"]
    element: int
    elements: Annotated[int, "elements"]
    stiffness: Annotated[float, "largest stiffness [{force}/{length}2]"]
    mass: Annotated[float, "mass [{mass}/{length}]"]
    omega: Annotated[float, "omega [rad/s]"]
    damping: float
    rate: float
    node: int
    line: int
    oscillation: Oscillation
    setting: Setting

    @property
    def depth(self) -> float:
        """A penetration in the middle of where the law has this stiffness."""
        return self.setting.depth

    @property
    def reach(self) -> float:
        """How far to both sides it has it."""
        return self.setting.reach

    def critical_step(self, scheme: str) -> float:
        """The largest step of a scheme, by its name, at which a small motion does not grow."""
        return critical_step(scheme, self.omega, self.rate)

    @property
    def advised_step(self) -> float:
        """The step at which omega dt is `ADVISED_OMEGA_DT`; infinite for damping alone."""
        return ADVISED_OMEGA_DT / self.omega if self.omega > 0.0 else np.inf

    @property
    def place(self) -> str:
        """Name and line of the deck, for sentences."""
        return f"{self.name} (deck line {self.line})" if self.line else self.name


CONTACTS = Layout[Contact](
    "contacts",
    "Frequencies of the contacts, the smallest step first",
    {
        **columns_of(Contact),
        "advised step, implicit [s]": lambda one: one.advised_step,
        "critical step, central-difference [s]": lambda one: one.critical_step("central-difference"),
        "critical step, rk4 [s]": lambda one: one.critical_step("rk4"),
        "critical step, velocity-verlet [s]": lambda one: one.critical_step("velocity-verlet"),
        "damping [{force} s/{length}2]": lambda one: one.damping,
        "damping rate [1/s]": lambda one: one.rate,
        "kind": lambda one: one.oscillation.kind,
        "node": lambda one: one.node,
        "deck line": lambda one: one.line,
    },
)


def find_contacts(scene: Scene) -> tuple[list[Contact], list[Omission]]:
    """The contacts that oscillate, the smallest step first, and those of which no frequency is known."""
    given = scene.contact_input("cut")
    found, unknown = oscillations(scene, given)
    return [_contact(scene, given, one) for one in found], [Omission(*each) for each in unknown]


def _contact(scene: Scene, given: ContactInput, one: Oscillation) -> Contact:
    return Contact(
        one.name,
        one.element,
        one.shared,
        one.stiffness,
        one.mass,
        one.omega,
        one.damping,
        one.rate,
        int(scene.node_ids[one.node]),
        line_of(scene, one.where),
        one,
        setting_of(scene, given, one),
    )


STEPS = 200
"""On springs; Runge-Kutta schemes grow slowest, by half a percent in a step at 1.005 of the critical one."""
STEPS_DAMPED = 1000
"""With damping the growth at 1.01 is no more than 1 to 2 percent in a step."""
GROWTH = 100.0
"""A motion that leaves so many times its first amplitude behind grows."""
AMPLITUDE = 1e-6
"""Of the reach of the segment: implicit schemes guess (omega dt)^2 times as far, and still the law is linear."""
_SHARE_OF_SPEED = 1e-7
"""Of the pull-out velocity, for motions beside a steady one."""
SHARES = np.array([*np.arange(180, 200), *np.arange(201, 221)]) / 200.0
"""Of the predicted critical step, from 0.9 to 1.1 and without 1: at the critical step itself growth has no rate."""
FAR = 100.0
"""omega dt, or damping rate times dt, at which schemes without a critical step are tried."""
ALWAYS = 1.0
"""The same for those that grow at every step."""

BOUNDED, GROWS, NO_CONVERGENCE, NOT_TRIED = "bounded", "grows", "no convergence", "-"

_NARROWEST = 1e-5
_SOFTEST = 1e-280
_SLOWEST = 1e-140
"""And the fastest the other way round: the square of a step must be a number."""


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


def can_oscillate(contact: Contact) -> bool:
    """Whether a small oscillation is more than the rounding of depths and forces."""
    setting = contact.setting
    wide = _NARROWEST * setting.scale < setting.reach < np.inf
    felt = contact.omega == 0.0 or (
        _SOFTEST < contact.stiffness * setting.reach < np.inf and _SLOWEST < contact.omega < 1.0 / _SLOWEST
    )
    return wide and felt and contact.rate < 1.0 / _SLOWEST


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
    """The share between the last that stayed bounded and the first that grew; NaN where there is none such."""
    first = words.index(GROWS) if GROWS in words else 0
    if not first or set(words[:first]) != {BOUNDED} or set(words[first:]) != {GROWS}:
        return float("nan")
    return float(0.5 * (SHARES[first - 1] + SHARES[first]))


def _outcomes(scene: Scene, contact: Contact, scheme: Scheme, dt: FloatArray) -> list[str]:
    """What a small motion does, for steps (k,)."""
    setting = contact.setting
    system = LoadedContact(scene.contact_input("cut"), contact.oscillation, setting, len(dt))
    if isinstance(scheme, OneStep):
        largest = max(abs(system.load), setting.factor * contact.stiffness * setting.scale)
        enough = 64.0 * float(np.finfo(np.float64).eps) * largest
        scheme = scheme.solved_by(replace(Newton(), tolerance=enough))
    start = AMPLITUDE * setting.reach
    speed = min(_SHARE_OF_SPEED * setting.speed, start * max(contact.omega, contact.rate))
    if speed:  # a motion without the acceleration of its force: at the critical step that would take all of its speed
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
