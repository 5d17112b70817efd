"""The step that a deck allows each scheme: critical steps of its contacts, landings on them, and the advice."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from mudline.contact.stiffest import ADVISED_OMEGA_DT, rounded_down
from mudline.keywords.catalogue import holds_in_soil
from mudline.scene.model import Scene
from mudline.scene.oscillation import Segment, line_of, steepest_segment
from mudline.study import file_of, without_springs
from mudline.study.laws import CurveLaw, LinearLaw
from mudline.study.motion import Scheme
from mudline.study.pages import Tables
from mudline.study.pictures import Picture, drawn, label, legend_below
from mudline.study.report import Layout, Omission, Section, StudyOptions, columns_of
from mudline.study.schemes import PREFERRED, SCHEMES, STYLES
from mudline.study.stability.contacts import CONTACTS, Contact, can_oscillate, find_contacts
from mudline.study.stability.critical import CRITICAL_STEPS, Measured, measure
from mudline.study.stability.landings import ALLOWED, LANDING_SCHEMES, TRIED, Fall, contact_steps, envelope

if TYPE_CHECKING:  # only drawing needs matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_CONTACTS = 8
"""Stepped by default, those with the smallest steps; all of them in a full run."""
STEPPED = tuple(SCHEMES)
"""The schemes that are stepped on each contact."""
MOST_LANDINGS = 2
"""Seabeds on which landings are tried by default, the stiffest."""
FARTHEST = 3.0
"""Largest omega dt of landings on a deck's own laws."""
_FINER = np.geomspace(0.001, 0.02, 14)
"""omega dt that are tried where all larger ones are too large: where the force jumps at the mudline."""
_EXPLICIT = "central-difference"
_LIKE_EXPLICIT = "velocity-verlet"
"""The scheme of `LANDING_SCHEMES` with the same positions."""
_MOST_STEPS, _MOST_FINER = 5000, 20_000
"""Steps of a landing at the smallest omega dt of `TRIED`, and of `_FINER`."""
NO_FREQUENCY = (
    "No contact of this deck has a frequency: that takes a law with a stiffness, which a rigid seabed has not, and "
    "sections with a mass."
)
_SHALLOW = 0.05
"""Of the diameter: depth of the fall of a pipe whose static penetration is not known."""


class DeckLanding(NamedTuple):
    """A scheme on a seabed of the deck.

    below: the largest step tried up to which no landing gains more than 1 % of its speed; NaN where all do.
    within: the same for gain and loss.
    speed: of the landing.
    least: the smallest omega dt tried.
    """

    contact: Contact
    scheme: Scheme
    below: float
    within: float
    speed: float
    least: float


DECK_LANDINGS = Layout[DeckLanding](
    "deck-landings",
    f"Steps up to which landings on the deck's seabeds keep their speed within {ALLOWED:.0%}, 64 landing phases",
    {
        "contact": lambda one: one.contact.name,
        "scheme": lambda one: one.scheme.title,
        "landing speed [{length}/s]": lambda one: one.speed,
        "landings below 1.01 [s]": lambda one: one.below,
        "landings within 1 % [s]": lambda one: one.within,
        "omega dt below 1.01 [-]": lambda one: one.below * one.contact.omega,
        "omega dt within 1 % [-]": lambda one: one.within * one.contact.omega,
        "critical step [s]": lambda one: one.contact.critical_step(one.scheme.name),
    },
)


class DeckStep(NamedTuple):
    """The step that a deck allows a scheme: the smallest of all contacts, and the contact; NaN where not known."""

    scheme: Scheme
    critical: float
    by: Contact
    below: float
    within: float
    lands_on: Contact | None


DECK_STEPS = Layout[DeckStep](
    "deck-steps",
    "The step of each scheme that all contacts of the deck allow",
    {
        "scheme": lambda one: one.scheme.title,
        "critical step [s]": lambda one: one.critical,
        "set by": lambda one: one.by.name if math.isfinite(one.critical) else "",
        "deck line": lambda one: one.by.line if math.isfinite(one.critical) else None,
        "landings below 1.01 [s]": lambda one: one.below,
        "landings within 1 % [s]": lambda one: one.within,
        "landing on": lambda one: one.lands_on.name if one.lands_on else "",
        "deck file": lambda one: one.by.file if math.isfinite(one.critical) else "",
    },
)


class Advice(NamedTuple):
    """Which scheme with which step, because of what; and what an explicit scheme needs instead."""

    scheme: Annotated[str, "scheme"]
    step: Annotated[float, "step [s]"]
    contact: Annotated[str, "because of"]
    line: Annotated[int, "deck line"]
    why: Annotated[str, "why"]
    explicit: Annotated[str, "explicit scheme"]
    explicit_step: Annotated[float, "explicit step [s]"]
    explicit_contact: Annotated[str, "explicit because of"]
    explicit_line: Annotated[int, "explicit deck line"]
    explicit_why: Annotated[str, "explicit why"]
    file: Annotated[str, "deck file"]
    explicit_file: Annotated[str, "explicit deck file"]


ADVICE = Layout[Advice]("advice", "Advised step", columns_of(Advice), brief=False)

LANDS, OSCILLATES, MISSES, GROWS = "landings", "omega dt", "no step", "stability"
_WHY = {
    LANDS: "above it landings there gain or lose more than 1 % of their speed",
    OSCILLATES: f"omega dt is {ADVISED_OMEGA_DT:g} there",
    MISSES: "even there landings gain or lose more than 1 % of their speed, as at every larger step tried",
    GROWS: "above it a small motion there grows",
}


class NarrowSegment(NamedTuple):
    """A segment of a curve that alone sets the step of a contact, and the curve without one of its points."""

    contact: Contact
    segment: Segment
    diameter: float
    line: int
    removed_line: int
    file: str

    @property
    def step(self) -> float:
        """The advised step without the point."""
        return ADVISED_OMEGA_DT * math.sqrt(self.contact.mass) / math.sqrt(self.segment.secant / self.diameter)


SEGMENTS = Layout[NarrowSegment](
    "steep-segments",
    "Narrow segments of curves that set the step, and the curve without one of their points",
    {
        "contact": lambda one: one.contact.name,
        "deck line": lambda one: one.line,
        "from ratio [-]": lambda one: one.segment.low,
        "to ratio [-]": lambda one: one.segment.high,
        "stiffness [{force}/{length}2]": lambda one: one.contact.stiffness,
        "advised step [s]": lambda one: one.contact.advised_step,
        "point to remove, deck line": lambda one: one.removed_line,
        "stiffness without it [{force}/{length}2]": lambda one: one.segment.secant / one.diameter,
        "advised step without it [s]": lambda one: one.step,
        "largest change of force [{force}/{length}]": lambda one: one.segment.difference,
        "deck file": lambda one: one.file,
    },
)


def study_steps(scene: Scene, options: StudyOptions) -> Section:
    """Every scheme on the contacts with the smallest critical steps, or in a full run on all of them."""
    found, omissions = find_contacts(scene)
    wide = [one for one in found if can_oscillate(one)]
    omissions += [
        Omission(one.name, "not stepped: a small oscillation there is below rounding")
        for one in found
        if one not in wide
    ]
    stepped = wide if options.full else wide[:MOST_CONTACTS]
    omissions += [
        Omission(one.name, "not stepped: slower than those that were (--full)") for one in wide[len(stepped) :]
    ]
    measured: list[Measured] = []
    for contact in options.each(stepped, lambda contact: f"steps on {contact.name}"):
        measured += [measure(scene, contact, SCHEMES[name]) for name in STEPPED]
    seabeds = [one for one in wide if one.oscillation.kind == "normal"]
    landed: list[DeckLanding] = []
    for contact in seabeds if options.full else seabeds[:MOST_LANDINGS]:
        if contact_steps(fall := fall_on(scene, contact), float(TRIED[0])) > _MOST_STEPS:
            reason = f"no landings: one would take more than {_MOST_STEPS} steps, its stiffest part is so narrow"
            omissions.append(Omission(contact.name, reason))
            continue
        landed += [deck_landing(contact, SCHEMES[name], fall) for name in LANDING_SCHEMES]
    omissions += [
        Omission(f"*{keyword}", "left out of all steps: the evaluator has no springs of this keyword")
        for keyword in sorted(scene.deck.keywords())
        if holds_in_soil(keyword)
    ]
    steps = [_deck_step(scheme, found, landed) for scheme in SCHEMES.values()] if found else []
    advised = [_advice(found, landed)] if any(one.omega > 0.0 for one in found) else []
    tables = (
        CONTACTS.table(found, scene.units),
        CRITICAL_STEPS.table(measured),
        DECK_STEPS.table(steps),
        DECK_LANDINGS.table(landed, scene.units),
        SEGMENTS.table(narrow_segments(scene, found), scene.units),
        ADVICE.table(advised),
    )
    pictures = [_picture(found, measured, landed, advised)] if measured else []
    return Section(tables, pictures, _notes(scene, found, measured), omissions)


def _notes(scene: Scene, found: Sequence[Contact], measured: Sequence[Measured]) -> list[str]:
    if not found:
        return [f"No contact of this deck has a frequency: {without_springs(scene)}."]
    return [
        (
            f"{sum(one.as_predicted for one in measured)} of {len(measured)} runs of a scheme on a contact behaved as "
            "predicted: bounded below the critical step, growing above it."
        )
    ]


def narrow_segments(scene: Scene, found: Sequence[Contact]) -> list[NarrowSegment]:
    """The curves whose stiffness is that of a narrow segment alone, and their stiffness without one of its points."""
    rows = []
    for one in found:
        law = scene.set_law(one.element) if one.oscillation.kind == "normal" else None
        segment = None if law is None or law.curve < 0 else steepest_segment(scene.laws.curves[law.curve])
        if segment is not None and segment.narrow and segment.removed is not None and segment.secant > 0.0:
            lines = line_of(scene, segment.where), line_of(scene, segment.removed)
            file = file_of(scene, segment.where)
            rows.append(NarrowSegment(one, segment, float(scene.diameter[one.element]), *lines, file))
    return rows


def deck_landing(contact: Contact, scheme: Scheme, fall: Fall) -> DeckLanding:
    """Land on the law of a contact over the ladder of omega dt."""
    tried = TRIED[TRIED <= FARTHEST]
    found = envelope(scheme, fall, tried)
    finer = scheme.name in (*PREFERRED, "velocity-verlet", "rk4") and contact_steps(fall, _FINER[0]) <= _MOST_FINER
    if math.isnan(found.within) and finer:
        tried = _FINER
        found = envelope(scheme, fall, tried)
    limits = found.below / contact.omega, found.within / contact.omega
    return DeckLanding(contact, scheme, *limits, fall.speed, float(tried[0]))


def fall_on(scene: Scene, contact: Contact) -> Fall:
    """A fall on the law of a contact, fast enough to reach its static penetration."""
    arrays, element = scene.law_arrays(), contact.element
    weight, diameter = float(scene.submerged_weight[element]), float(scene.diameter[element])
    law: CurveLaw | LinearLaw
    index = int(arrays.curve_index[element])
    if index >= 0:
        law = CurveLaw(contact.name, arrays.curves[index], diameter)
        ratios = [ratio for ratio in law.curve.ratios_at_force(weight) if ratio > 0.0] if weight > 0.0 else []
        depth = min(ratios, default=_SHALLOW) * diameter
    else:
        width = contact.setting.laws.get("smoothed", {}).get("half_width", 0.0)
        stiffness = float(arrays.linear_stiffness[element])
        law = LinearLaw(contact.name, stiffness, width)
        depth = weight / stiffness if weight > 0.0 else _SHALLOW
    speed = math.sqrt(2.0 * float(law.work(np.array([depth]))[0]) / contact.mass)
    return Fall(law, contact.mass, speed, depth + law.top, contact.omega)


def _deck_step(scheme: Scheme, found: Sequence[Contact], landed: Sequence[DeckLanding]) -> DeckStep:
    by = min(found, key=lambda one: one.critical_step(scheme.name))
    name = _LIKE_EXPLICIT if scheme.name == _EXPLICIT else scheme.name
    own = [one for one in landed if one.scheme.name == name]
    lands_on = min(own, key=_least, default=None)
    below, within = (min((getattr(one, which) for one in own), default=math.nan) for which in ("below", "within"))
    return DeckStep(scheme, by.critical_step(scheme.name), by, below, within, lands_on and lands_on.contact)


def _least(one: DeckLanding) -> float:
    return 0.0 if math.isnan(one.within) else one.within


class _Allowed(NamedTuple):
    """A step that is advised, the contact that sets it, and why."""

    step: float
    contact: Contact
    why: str


def _allowed(scheme: str, found: Sequence[Contact], landed: Sequence[DeckLanding]) -> _Allowed:
    """The largest step with which every spring of the deck is resolved and landings keep within 1 %.

    A spring that never lifts off counts too.
    """
    fastest = max(found, key=lambda one: one.omega)
    resolved = _Allowed(fastest.advised_step, fastest, OSCILLATES)
    limit = min((one for one in landed if one.scheme.name == scheme), key=_least, default=None)
    if limit is None:
        return resolved
    if math.isnan(limit.within):
        return _Allowed(limit.least / limit.contact.omega, limit.contact, MISSES)
    return min(resolved, _Allowed(limit.within, limit.contact, LANDS), key=lambda one: one.step)


def _advice(found: Sequence[Contact], landed: Sequence[DeckLanding]) -> Advice:
    """The implicit scheme of second order that is allowed the largest step, and what central difference is allowed."""
    names = [name for name in PREFERRED if any(one.scheme.name == name for one in landed)] or PREFERRED[:1]
    allowed = {name: _allowed(name, found, landed) for name in names}
    best = max(names, key=lambda name: (allowed[name].why != MISSES, allowed[name].step))
    own = allowed[best]
    by = min(found, key=lambda one: one.critical_step(_EXPLICIT))
    stable = _Allowed(by.critical_step(_EXPLICIT), by, GROWS)
    other = min(stable, _allowed(_LIKE_EXPLICIT, found, landed), key=lambda one: one.step)
    return Advice(
        SCHEMES[best].title,
        rounded_down(own.step),
        own.contact.name,
        own.contact.line,
        own.why,
        SCHEMES[_EXPLICIT].title,
        rounded_down(other.step),
        other.contact.name,
        other.contact.line,
        other.why,
        own.contact.file,
        other.contact.file,
    )


def advice(tables: Tables) -> str:
    """The sentence about the deck; raises MissingTableError for a deck without a frequency."""
    row = tables.row("advice")
    place, explicit = (f"{row.text(f'{start}because of')} ({row.place(start)})" for start in ("", "explicit "))
    return (
        f"Use {row.text('scheme')} with a step of {row.number('step [s]'):.3g} s or less, because of {place}: "
        f"{_WHY[row.text('why')]}; {row.text('explicit scheme')} needs {row.number('explicit step [s]'):.3g} s or "
        f"less, because of {explicit}: {_WHY[row.text('explicit why')]}."
    )


# ------------------------------------------------------------------------------------------------------------- picture

_DRAWN = ("central-difference", "velocity-verlet", "rk4")


def _picture(
    found: Sequence[Contact], measured: Sequence[Measured], landed: Sequence[DeckLanding], advised: Sequence[Advice]
) -> Picture:
    """The critical step of each contact, and the step that the whole deck allows."""
    stepped = {one.contact.name for one in measured}
    rows = [one for one in found if one.name in stepped]
    caption = "The contact furthest to the left sets the step of the whole model."
    return Picture(
        "critical-steps", caption, partial(_draw, rows, measured, landed, advised), (10.0, 2.6 + 0.55 * len(rows))
    )


def _draw(
    rows: Sequence[Contact],
    measured: Sequence[Measured],
    landed: Sequence[DeckLanding],
    advised: Sequence[Advice],
    figure: Figure,
) -> None:
    axes = figure.subplots()
    row_of = {one.name: row for row, one in enumerate(rows)}
    for index, name in enumerate(_DRAWN):
        scheme = SCHEMES[name]
        own = [one for one in measured if one.scheme.name == name]
        heights = [row_of[one.contact.name] + 0.22 * (index - 1) for one in own]
        look = {**STYLES[scheme.title], "linestyle": "", "markersize": 8}
        axes.semilogx([one.predicted for one in own], heights, label=f"{scheme.title}: grows above", **look)
        wrong = [(one.predicted, height) for one, height in zip(own, heights, strict=True) if not one.as_predicted]
        if wrong:
            axes.plot(*zip(*wrong, strict=True), "x", color="#b2182b", markersize=14, label="not as predicted")
    springs = [(one.advised_step, row) for row, one in enumerate(rows) if one.omega > 0.0]
    axes.plot(*zip(*springs, strict=True), "|", color="0.2", markersize=16, label=f"omega dt = {ADVISED_OMEGA_DT:g}")
    newmark = [one for one in landed if one.contact.name in row_of and one.scheme.name == "newmark"]
    within = [(one.within, row_of[one.contact.name]) for one in newmark]
    if within:
        look = {**STYLES[SCHEMES["newmark"].title], "linestyle": "", "markersize": 8}
        axes.plot(*zip(*within, strict=True), label="Newmark: landings within 1 % up to", **look)
    for one in advised:
        text = f"{one.scheme}: {one.step:.3g} s"
        axes.axvline(one.step, color=STYLES[one.scheme]["color"], linewidth=1.5, label=f"advised, {text}")
    _mark_limit(axes, rows)
    places = [f"line {one.line} of {drawn(one.file)}" if one.file else f"deck line {one.line}" for one in rows]
    names = [f"{drawn(one.name)}\n{place}" for one, place in zip(rows, places, strict=True)]
    axes.set_yticks(range(len(rows)), names, fontsize="small")
    axes.set_ylim(len(rows) - 0.4, -0.6)
    by = min(rows, key=lambda one: one.critical_step(_EXPLICIT))
    step = rounded_down(by.critical_step(_EXPLICIT))
    title = f"This deck: central difference below {step:.3g} s, because of {drawn(by.name)}"
    title += "".join(f"\n{one.scheme} up to {one.step:.3g} s, because of {drawn(one.contact)}" for one in advised)
    label(axes, title, "time step [s]", "")
    legend_below(figure, axes, 3)


def _mark_limit(axes: Axes, rows: Sequence[Contact]) -> None:
    """Green where central difference is stable on every contact, red where it is on none."""
    steps = [one.critical_step(_EXPLICIT) for one in rows]
    low, high = 0.3 * min(steps), 3.0 * max(steps)
    axes.set_xlim(low, high)
    axes.axvspan(
        low, min(steps), color="#009e73", alpha=0.15, linewidth=0, label="central difference stable on all contacts"
    )
    axes.axvspan(max(steps), high, color="#d55e00", alpha=0.15, linewidth=0, label="central difference stable on none")
