"""The stability study: its parts, one after the other, and what follows from them."""

from __future__ import annotations

from collections.abc import Sequence

from mudline.contact.stiffest import ADVISED_OMEGA_DT, rounded_down
from mudline.scene.model import Scene
from mudline.study.newton import Newton
from mudline.study.report import Omission, StudyOptions, StudyReport
from mudline.study.schemes import SCHEMES
from mudline.study.stability.bounded import Measured, can_swing, measure
from mudline.study.stability.contacts import Contact, find_contacts
from mudline.study.stability.cycles import EXAMPLE, cyclings, path
from mudline.study.stability.ladder.cells import cells
from mudline.study.stability.ladder.chance import chance_cells
from mudline.study.stability.ladder.judging import judge
from mudline.study.stability.ladder.suction import judge_suction, suction_cells
from mudline.study.stability.ladder.verdict import Judgement
from mudline.study.stability.landings import Landing, landings
from mudline.study.stability.pictures import critical_picture, ladder_picture, landings_picture
from mudline.study.stability.release import Release, releases
from mudline.study.stability.tables import (
    cells_table,
    contacts_table,
    critical_table,
    cycles_table,
    landings_table,
    release_table,
    summary_table,
)

MOST_CONTACTS = 6
"""Stepped by default, the fastest; all of them in a full run."""
BY_CHANCE = 4000
"""Decks by chance in a full run."""


def study_scene(scene: Scene, options: StudyOptions) -> StudyReport:
    """The whole study of a scene."""
    found, omissions = find_contacts(scene)
    wide = [one for one in found if can_swing(one)]
    omissions += [
        Omission(one.name, "not stepped: a small swing there is lost in rounding") for one in found if one not in wide
    ]
    stepped = wide if options.full else wide[:MOST_CONTACTS]
    omissions += [
        Omission(one.name, "not stepped: slower than those that were (--full)") for one in wide[len(stepped) :]
    ]
    measured = _measured(scene, stepped, options)
    options.progress("landings")
    landed = landings()
    options.progress("release of suction")
    released = _released(scene, omissions)
    judgements = _judged(options)
    return StudyReport(
        "stability",
        f"Stability of the contacts of {scene.deck.file}",
        (
            contacts_table(found, scene.units),
            critical_table(measured),
            landings_table(landed),
            cycles_table(cyclings()),
            release_table(released, scene.units),
            summary_table(judgements),
            cells_table(judgements),
        ),
        (
            *([critical_picture(measured)] if measured else []),
            landings_picture(),
            ladder_picture([one for one in judgements if one.family != "by chance"]),
        ),
        (*_of_contacts(found, measured), *_of_landings(landed), _of_cycles(), *_of_ladder(judgements)),
        tuple(omissions),
    )


def _measured(scene: Scene, contacts: Sequence[Contact], options: StudyOptions) -> list[Measured]:
    found = []
    for contact in contacts:
        options.progress(f"steps on {contact.name}")
        found += [measure(scene, contact, scheme) for scheme in SCHEMES.values()]
    return found


def _released(scene: Scene, omissions: list[Omission]) -> list[Release]:
    suction = scene.contact_input().assigned.get("suction")
    if suction is None:
        omissions.append(Omission("release of suction", "no element has *SEABED SUCTION"))
        return []
    return releases(scene, suction)


def _judged(options: StudyOptions) -> list[Judgement]:
    options.progress("ladder of extremes")
    judgements = [*map(judge, cells()), *map(judge_suction, suction_cells())]
    if options.full:
        options.progress(f"{BY_CHANCE} decks by chance")
        judgements += map(judge, chance_cells(BY_CHANCE))
    return judgements


def _of_contacts(found: Sequence[Contact], measured: Sequence[Measured]) -> list[str]:
    if not found:
        return ["No contact of this deck has a frequency: laws with a stiffness and sections with a mass are needed."]
    fastest = found[0]
    odd = [one for one in measured if not one.as_predicted]
    step = (
        f"The fastest contact, {fastest.name}, swings with {fastest.omega:.4g} rad/s: give implicit schemes a step of "
        f"{rounded_down(ADVISED_OMEGA_DT / fastest.omega):.3g} s or less (omega dt = {ADVISED_OMEGA_DT:g})."
    )
    runs = (
        f"{len(measured) - len(odd)} of {len(measured)} runs of a scheme on a contact did as predicted: bounded below "
        "the critical step, growing above it."
    )
    return [step, runs]


def _of_landings(landed: Sequence[Landing]) -> list[str]:
    compared = [one for one in landed if one.agrees is not None]
    never = [name for name, most in _largest(landed).items() if most <= 1.0]
    agree = (
        f"{sum(bool(one.agrees) for one in compared)} of {len(compared)} landings agree with figures reckoned apart, "
        "to the last digit given."
    )
    return [
        agree,
        f"Implicit schemes that never throw the mass back faster than it came: {', '.join(never)}.",
    ]


def _largest(landed: Sequence[Landing]) -> dict[str, float]:
    """The largest restitution of the schemes that can take any step."""
    found: dict[str, float] = {}
    for one in landed:
        if not one.scheme.explicit:
            found[one.scheme.title] = max(found.get(one.scheme.title, 0.0), one.largest)
    return found


def _of_cycles() -> str:
    plain, halved = (
        path(EXAMPLE, 1.0, Newton(most=most, halving=halving)) for most, halving in ((6, False), (50, True))
    )
    return (
        "Newton's method on friction (kb = 1, kt = 99, mu N = 10, F = 5, from 1) goes "
        f"{_points(plain.iterates)}, ... without end; with halved corrections {_points(halved.iterates)}: "
        f"{halved.iterations} iterations."
    )


def _points(iterates: Sequence[float]) -> str:
    return ", ".join(f"{point:.4g}" for point in iterates)


def _of_ladder(judgements: Sequence[Judgement]) -> list[str]:
    unsound = [one for one in judgements if not one.verdict.sound]
    sound = (
        f"{len(judgements) - len(unsound)} of {len(judgements)} cells of the ladder of extremes are right within their "
        "bound or refused with a line of the deck."
    )
    return [sound] + [f"{one.family} {one.value}: {one.verdict.value}: {one.told}" for one in unsound]
