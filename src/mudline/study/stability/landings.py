"""Energy at touchdown: a mass lands on an elastic seabed at every phase of a step, and should leave as fast as it came.

The seabed is elastic, without gravity or damping. What a scheme makes of it depends on omega dt and on the landing
phase alone: the share of a step that is left when the seabed is reached.

The figures to compare with were computed once, apart from this program, with the same 400 phases, and rounded to the
digits that stand here. HHT and generalised-alpha average the forces of both ends of a step.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.scene.model import Scene
from mudline.study.laws import Falling, LinearLaw
from mudline.study.motion import Motion, Scheme, march
from mudline.study.pictures import Picture, label, legend_below
from mudline.study.report import Layout, Section, StudyOptions, columns_of, grouped
from mudline.study.schemes import SCHEMES, STYLES

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.figure import Figure

PHASES: FloatArray = (np.arange(400) + 0.5) / 400
OMEGA_DTS = (0.1, 0.5, 1.0, 4.4721, 10.0, 100.0)
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
"""Least/mean/largest for each of `OMEGA_DTS`."""
_SHOWN = ((0.1, 0.9965, 1.0025), (0.5, 0.89, 1.04), (1.0, 0.2, 1.15), (10.0, -0.1, 3.0))
"""omega dt of each panel, and what it shows of the axis."""
_DRAWN = tuple(name for name in LANDING_SCHEMES if name != "generalised-alpha-1")
"""With a spectral radius of 1 generalised-alpha does what Newmark's scheme does."""
_SETTLING = 64
"""Steps besides those of the contact: backward Euler creeps out of the seabed at large steps, and the acceleration that
the generalised-alpha scheme carries along dies away by the half in each."""


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
    """All schemes at all steps: in which of them the rebound is faster than the landing."""
    options.progress("landings")
    landed = landings()
    agree = [one.agrees for one in landed if one.agrees is not None]
    implicit = grouped((one for one in landed if not one.scheme.explicit), lambda one: one.scheme.title)
    never = [name for name, rows in implicit.items() if max(0.0, *(one.largest for one in rows)) <= 1.0]
    notes = (
        f"{sum(agree)} of {len(agree)} landings agree with independently computed figures, to the last digit given.",
        f"Implicit schemes whose rebound is never faster than the landing: {', '.join(never)}.",
    )
    caption = "Rebound of a mass from an elastic seabed; 1 is exact, above 1 energy is gained."
    return Section([LANDINGS.table(landed)], [Picture("landings", caption, _draw, (10.0, 8.0))], notes)


def _draw(figure: Figure) -> None:
    """Restitution over the landing phase, a panel for each omega dt."""
    panels = figure.subplots(2, 2, sharex=True)
    for axes, (omega_dt, low, high) in zip(panels.flat, _SHOWN, strict=True):
        for index, scheme in enumerate(SCHEMES[name] for name in _DRAWN):
            speeds = speeds_over_phases(scheme, omega_dt)
            axes.plot(PHASES, speeds, label=scheme.title, **STYLES[scheme.title], markevery=(6 * index, 50))
        axes.axhline(1.0, color="0.4", linewidth=0.8, zorder=0)
        axes.set_ylim(low, high)
        label(axes, f"ω dt = {omega_dt:g}{_off(omega_dt, low)}", "", "speed after / before landing [-]")
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
    index = OMEGA_DTS.index(omega_dt)
    least, mean, largest = (texts[index].split("/")) if index < len(texts) else ("", "", "")
    compared = (least, mean, largest) if least else None
    return Landing(scheme, omega_dt, float(speeds.min()), float(speeds.mean()), float(speeds.max()), compared)


def speeds_over_phases(scheme: Scheme, omega_dt: float) -> FloatArray:
    """Restitution over `PHASES`; NaN at all of them where the scheme is unstable in contact."""
    if omega_dt > scheme.limit:
        return np.full(len(PHASES), np.nan)
    return restitution(scheme, omega_dt, PHASES)


def _last_digit(text: str) -> float:
    """One in the last digit of a figure, in the fourth or third for the whole ones."""
    return 10.0 ** -max(len(text.partition(".")[2]), 3) * 1.001


def restitution(scheme: Scheme, omega_dt: float, phases: FloatArray) -> FloatArray:
    """Speed after over speed before contact for landing phases (k,) in (0, 1); NaN where the mass never left again.

    The speed after is that of the free flight, when the acceleration that a scheme carries along has died away.
    """
    system = Falling(np.ones(len(phases)), LinearLaw("", omega_dt * omega_dt), weight=0.0)
    start = Motion.start(system, np.asarray(phases, np.float64), np.full(len(phases), -1.0))
    run = march(scheme, system, start, 1.0, int(np.ceil(2.0 * np.pi / omega_dt)) + _SETTLING)
    left = (run.position[-1] > 0.0) & (run.velocity[-1] > 0.0)
    return np.where(left, run.velocity[-1], np.nan)
