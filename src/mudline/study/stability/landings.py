"""Energy at touchdown: a mass lands on an elastic seabed at every phase of a step, and should rebound as fast.

The seabed is elastic, without gravity or damping. The outcome of a scheme depends on omega dt and on the landing phase
alone: the share of a step that is left when the seabed is reached.

The figures to compare with were computed once, independently of this program, with the same 400 phases, and rounded to
the digits given here. HHT and generalised-alpha average the forces of both ends of a step.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.scene.model import Scene
from mudline.study.laws import Falling, Law, LinearLaw
from mudline.study.motion import Motion, Scheme, march
from mudline.study.pictures import Picture, draw_lines, label, legend_below
from mudline.study.report import Layout, Section, StudyOptions, columns_of, grouped
from mudline.study.schemes import SCHEMES, STYLES, bracketed

if TYPE_CHECKING:  # only drawing needs matplotlib
    from matplotlib.figure import Figure

PHASES: FloatArray = (np.arange(400) + 0.5) / 400
OMEGA_DTS = (0.0316, 0.1, 0.5, 1.0, 1.1, 1.5, 1.9, 1.99, 4.4721, 10.0, 100.0)
LANDING_SCHEMES = (
    "velocity-verlet",
    "rk4",
    "newmark",
    "hht-0.3",
    "generalised-alpha-1",
    "generalised-alpha-0.5",
    "generalised-alpha-0",
    "backward-euler",
)
_COMPARED = {
    "newmark": "0.9988/1.0000/1.0012 0.9711/1.0004/1.0297 0.8995/1.0056/1.1116 0.429/1.381/2.329 0.352/1.599/2.841 "
    "0.335/1.666/2.993",
    "hht-0.3": "0.9987/0.9999/1.0012 0.9658/0.9951/1.0244 0.8774/0.9790/1.0804 0.450/1.170/1.889 0.370/1.319/2.267 "
    "0.353/1.365/2.376",
    "generalised-alpha-0.5": "0.9987/0.9999/1.0012 0.9657/0.9950/1.0243 0.8769/0.9788/1.0802 0.448/1.168/1.884 "
    "0.370/1.317/2.261 0.354/1.362/2.370",
    "generalised-alpha-0": "0.9974/0.9986/0.9998 0.9084/0.9288/0.9492 0.7502/0.8009/0.8517 0.430/0.623/0.818 "
    "0.352/0.656/0.960 0.334/0.667/0.998",
    "backward-euler": "0.8538/0.8549/0.8559 0.4604/0.4698/0.4792 0.25/0.25/0.25 0.017/0.030/0.043 0.003/0.007/0.010 "
    "0/0.0001/0.0001",
    "velocity-verlet": "0.9988/1.0000/1.0012 0.9783/1.0002/1.0221 1/1/1",
}
"""Least/mean/largest for each of `_COMPARED_AT`."""
_COMPARED_AT = (0.1, 0.5, 1.0, 4.4721, 10.0, 100.0)
_SHOWN = ((0.1, 0.9965, 1.0025), (0.5, 0.89, 1.04), (1.0, 0.2, 1.15), (10.0, -0.1, 3.0))
"""omega dt of each panel, and the limits of its axis."""
_DRAWN = tuple(name for name in LANDING_SCHEMES if name != "generalised-alpha-1")
"""With a spectral radius of 1 generalised-alpha coincides with Newmark's scheme."""
_SETTLING = 64
"""Steps after those of the contact: backward Euler creeps out of the seabed at large steps, and the acceleration of the
generalised-alpha scheme is halved in each."""


class Landing(NamedTuple):
    """Speed after over speed before contact, over all phases.

    least, mean, largest: NaN where the scheme is unstable in contact.
    compared: the figures to compare with, as texts; None where there are none.
    """

    scheme: Scheme
    omega_dt: Annotated[float, "omega dt [-]"]
    least: Annotated[float, "least [-]"]
    mean: Annotated[float, "mean [-]"]
    largest: Annotated[float, "largest [-]"]
    compared: tuple[str, str, str] | None

    @property
    def agrees(self) -> bool | None:
        """Whether all three differ by no more than one in the last digit; None without figures to compare with."""
        if self.compared is None:
            return None
        found = (self.least, self.mean, self.largest)
        return all(
            abs(value - float(text)) <= _last_digit(text) for value, text in zip(found, self.compared, strict=True)
        )


LANDINGS = Layout[Landing](
    "landings",
    "Speed after landing over speed before, 400 landing phases",
    {
        "scheme": lambda one: one.scheme.title,
        **columns_of(Landing),
        "compared with": lambda one: "/".join(one.compared or ()),
        "agrees": lambda one: {None: "", True: "yes", False: "NO"}[one.agrees],
    },
)


def study_landings(_: Scene, options: StudyOptions) -> Section:
    """All schemes at all steps, and where the rebound is faster than the landing."""
    options.progress("landings")
    landed, over = landings(), [envelope(SCHEMES[name], LINEAR_FALL) for name in LANDING_SCHEMES]
    agree = [one.agrees for one in landed if one.agrees is not None]
    notes = [
        f"{sum(agree)} of {len(agree)} landings agree with independently computed figures, to the last digit given.",
        _never(landed, over),
    ]
    tables = (LANDINGS.table(landed), LIMITS.table(over), ENVELOPES.table(_rows(over)))
    caption = "Rebound of a mass from an elastic seabed; 1 is exact, above 1 energy is gained."
    pictures = (
        Picture("landings", caption, _draw, (10.0, 8.0)),
        Picture("landing-gain", "The largest gain of all landing phases, up to each step.", partial(_draw_gain, over)),
    )
    return Section(tables, pictures, notes)


def _never(landed: Sequence[Landing], over: Sequence[Envelope]) -> str:
    """The implicit schemes whose rebound never exceeds the landing by more than `NEVER`, and by how much it does."""
    most = {
        title: float(np.nanmax([one.largest for one in rows]))
        for title, rows in grouped(landed, lambda one: one.scheme.title).items()
    }
    words = []
    for one in over:
        highest = max(most[one.scheme.title], float(np.nanmax(one.largest)))
        if not one.scheme.explicit and highest <= 1.0 + NEVER:
            words.append(f"{one.scheme.title} ({highest:.7f} at most)")
    return (
        f"Implicit schemes whose rebound is never faster than the landing by more than {NEVER:g} of its speed, "
        f"at any omega dt tried from {TRIED[0]:.2g} to {TRIED[-1]:.3g}: {', '.join(words) or 'none'}."
    )


def _draw(figure: Figure) -> None:
    """Restitution over the landing phase, a panel for each omega dt."""
    panels = figure.subplots(2, 2, sharex=True)
    for axes, (omega_dt, low, high) in zip(panels.flat, _SHOWN, strict=True):
        for index, scheme in enumerate(SCHEMES[name] for name in _DRAWN):
            speeds = speeds_over_phases(scheme, omega_dt)
            axes.plot(PHASES, speeds, label=scheme.title, **STYLES[scheme.title], markevery=(6 * index, 50))
        axes.axhline(1.0, color="0.4", linewidth=0.8, zorder=0)
        axes.set_ylim(low, high)
        label(axes, f"omega dt = {omega_dt:g}{_off(omega_dt, low)}", "", "speed after / before landing [-]")
    for axes in panels[1]:
        axes.set_xlabel("landing phase, share of the step left at the seabed [-]")
    legend_below(figure, panels.flat[0])


def _off(omega_dt: float, low: float) -> str:
    """Where backward Euler lies, if it is below the panel."""
    speeds = speeds_over_phases(SCHEMES["backward-euler"], omega_dt)
    if speeds.min() >= low:
        return ""
    return f"  (backward Euler below: {speeds.min():.2f} to {speeds.max():.2f})"


def landings() -> list[Landing]:
    """All schemes at all steps."""
    return [landing(SCHEMES[name], omega_dt) for name in LANDING_SCHEMES for omega_dt in OMEGA_DTS]


def landing(scheme: Scheme, omega_dt: float) -> Landing:
    """One scheme at one step, over all phases."""
    speeds = speeds_over_phases(scheme, omega_dt)
    texts = _COMPARED.get(scheme.name, "").split()
    index = _COMPARED_AT.index(omega_dt) if omega_dt in _COMPARED_AT else len(texts)
    least, mean, largest = (texts[index].split("/")) if index < len(texts) else ("", "", "")
    compared = (least, mean, largest) if least else None
    return Landing(scheme, omega_dt, float(speeds.min()), float(speeds.mean()), float(speeds.max()), compared)


def speeds_over_phases(scheme: Scheme, omega_dt: float) -> FloatArray:
    """Restitution over `PHASES`; NaN at all of them where the scheme is unstable in contact."""
    if omega_dt > scheme.limit:
        return np.full(len(PHASES), np.nan)
    return restitution(scheme, omega_dt, PHASES)


def restitution(scheme: Scheme, omega_dt: float, phases: FloatArray) -> FloatArray:
    """Speed after over speed before contact for landing phases (k,) in (0, 1); NaN where the mass never left again.

    The speed after is that of the free flight, when the acceleration that a scheme carries along has died away.
    """
    speeds: FloatArray = rebounds(scheme, LINEAR_FALL, np.array([omega_dt]), phases)[0]
    return speeds


def _last_digit(text: str) -> float:
    """One in the last digit of a figure, in the fourth or third for the whole ones."""
    return 10.0 ** -max(len(text.partition(".")[2]), 3) * 1.001


class Fall(NamedTuple):
    """A mass that lands at a speed on an elastic seabed; `depth` is its approximate penetration."""

    law: Law
    mass: float
    speed: float
    depth: float
    omega: float


LINEAR_FALL = Fall(LinearLaw("", 1.0), 1.0, 1.0, 1.0, 1.0)
TRIED: FloatArray = np.unique(
    [
        *np.geomspace(0.02, 0.1, 24),
        *np.pi / np.arange(31.4, 5.2, -0.1),
        *np.geomspace(0.6, 100.0, 60),
        *(0.0316, 0.0567, 1.99, 1.9999),
    ]
)
"""omega dt at which the landings of a scheme are tried, up to its critical one.

The outcome depends on pi / (omega dt) too, the steps of a landing: the values are dense where limits are expected.
"""
FEW_PHASES: FloatArray = (np.arange(64) + 0.5) / 64
NEVER = 2e-4
"""Smaller gains are neglected; generalised-alpha with rho = 0 has 7.6e-5 at omega dt = 0.0316 and 1.2e-4 at 0.0567."""
ALLOWED = 0.01
"""Gain, or gain and loss, that a limit allows."""


class Envelope(NamedTuple):
    """Landings of a scheme over omega dt: least and largest speed after over before, of `FEW_PHASES`."""

    scheme: Scheme
    omega_dt: FloatArray
    least: FloatArray
    largest: FloatArray

    @property
    def below(self) -> float:
        """Largest omega dt tried up to which no landing gains more than `ALLOWED`; NaN where all do."""
        return self._up_to(self.largest <= 1.0 + ALLOWED)

    @property
    def within(self) -> float:
        """Largest omega dt tried up to which no landing gains or loses more than `ALLOWED`; NaN where all do."""
        return self._up_to((self.largest <= 1.0 + ALLOWED) & (self.least >= 1.0 - ALLOWED))

    def _up_to(self, good: BoolArray) -> float:
        count = len(good) if good.all() else int(np.argmin(good))
        return float(self.omega_dt[count - 1]) if count else float("nan")


def envelope(scheme: Scheme, fall: Fall, tried: FloatArray | None = None) -> Envelope:
    """All of `TRIED`, or other values of omega dt, below the critical one of a scheme."""
    omega_dt = TRIED if tried is None else tried
    omega_dt = omega_dt[omega_dt < scheme.limit]
    if not len(omega_dt):
        return Envelope(scheme, omega_dt, omega_dt, omega_dt)
    speeds = rebounds(scheme, fall, omega_dt, FEW_PHASES)
    return Envelope(scheme, omega_dt, speeds.min(axis=1), speeds.max(axis=1))


def contact_steps(fall: Fall, omega_dt: float) -> int:
    """About how many steps a landing takes; many where the stiffest part of a law is far stiffer than the rest."""
    return math.ceil(2.0 * math.pi * fall.depth / fall.speed * fall.omega / omega_dt)


def rebounds(scheme: Scheme, fall: Fall, omega_dt: FloatArray, phases: FloatArray) -> FloatArray:
    """Speed after over speed before contact (k, p) for steps (k,) and landing phases (p,) in (0, 1).

    NaN where the mass never left again.
    """
    dt = np.repeat(omega_dt / fall.omega, len(phases))
    system = Falling(np.full(len(dt), fall.mass), fall.law, weight=0.0)
    high = fall.law.top + np.tile(phases, len(omega_dt)) * dt * fall.speed
    start = Motion.start(system, high, np.full(len(dt), -fall.speed))
    steps = contact_steps(fall, float(omega_dt.min())) + _SETTLING
    run = march(bracketed(scheme), system, start, dt, steps)
    left = (run.position[-1] > fall.law.top) & (run.velocity[-1] > 0.0)
    return np.where(left, run.velocity[-1] / fall.speed, np.nan).reshape(len(omega_dt), -1)


LIMITS = Layout[Envelope](
    "landing-limits",
    f"omega dt up to which landings keep their speed within {ALLOWED:.0%}, 64 landing phases",
    {
        "scheme": lambda one: one.scheme.title,
        "critical omega dt [-]": lambda one: one.scheme.limit,
        "landings below 1.01 [-]": lambda one: one.below,
        "landings within 1 % [-]": lambda one: one.within,
        "largest at any step [-]": lambda one: float(np.nanmax(one.largest)) if len(one.largest) else None,
        "least at any step [-]": lambda one: float(np.nanmin(one.least)) if len(one.least) else None,
    },
)


class _EnvelopeRow(NamedTuple):
    scheme: Annotated[str, "scheme"]
    omega_dt: Annotated[float, "omega dt [-]"]
    least: Annotated[float, "least [-]"]
    largest: Annotated[float, "largest [-]"]


ENVELOPES = Layout[_EnvelopeRow](
    "landing-envelopes",
    "Least and largest speed after landing over speed before, 64 landing phases",
    columns_of(_EnvelopeRow),
    brief=False,
)


def _rows(over: Sequence[Envelope]) -> list[_EnvelopeRow]:
    return [
        _EnvelopeRow(one.scheme.title, *numbers)
        for one in over
        for numbers in zip(one.omega_dt.tolist(), one.least.tolist(), one.largest.tolist(), strict=True)
    ]


def _draw_gain(over: Sequence[Envelope], figure: Figure) -> None:
    """The largest gain up to each step, which never falls."""
    axes = figure.subplots()
    lines = {
        one.scheme.title: list(zip(one.omega_dt, np.fmax.accumulate(one.largest) - 1.0, strict=True))
        for one in over
        if one.scheme.name in _DRAWN
    }
    gaining = {title: points for title, points in lines.items() if points[-1][1] > 0.0}
    title = "Largest gain of speed in landings with a step up to this one"
    draw_lines(axes, gaining, title, "omega dt [-]", "speed after / before - 1 [-]", styles=STYLES)
    axes.axhline(ALLOWED, color="0.3", linewidth=1.2)
    axes.text(axes.get_xlim()[0], 1.1 * ALLOWED, f"  {ALLOWED:.0%}", color="0.3")
    for limit, name in ((2.0, "velocity-verlet"), (2.0 * 2.0**0.5, "rk4")):
        axes.axvline(limit, color=STYLES[SCHEMES[name].title]["color"], linewidth=1.0, linestyle=":")
    axes.set_ylim(1e-5, 5.0)
    never = [title for title, points in lines.items() if title not in gaining]
    for line in axes.get_lines():
        line.set_markevery(0.08)
    axes.text(0.98, 0.03, "".join(f"{title} never gains" for title in never), ha="right", transform=axes.transAxes)
    legend_below(figure, axes)
