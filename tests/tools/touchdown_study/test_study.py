"""The study: worked numbers, verdicts, stiff and extreme cases, what is refused, laws with a history."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import count

import numpy as np
import pytest

import mudline
from mudline.model.scene.load_case import own_steps
from mudline.tools.touchdown_study import accuracy, stability
from mudline.tools.touchdown_study.screen import extremes_table
from mudline.tools.touchdown_study.study import Study, study
from mudline.tools.touchdown_study.zone import Variant, Zone, touchdown_zone
from tests.helpers.samples import SAMPLES
from tests.tools.touchdown_study.decks import (
    CHAIN,
    CURVE,
    FALL,
    IMPERIAL,
    JUMP,
    SNAP,
    STEEL,
    WAVES,
    Riser,
)

COARSE = WAVES.replace("0.2, 20.0", "0.5, 20.0")


def ticking() -> Callable[[], float]:
    """A clock that does not depend on the machine."""
    ticks = count()
    return lambda: float(next(ticks))


def studied(text: str, *parts: str, units: str = "metric") -> Study:
    scene = mudline.from_keyword(text, units=units).scene()._resolved
    return study(scene, parts or ("accuracy",), timer=ticking())


def zone_of(text: str) -> Zone:
    scene = mudline.from_keyword(text, units="metric").scene()._resolved
    return touchdown_zone(scene, scene.contact_input(), None, None)


STEPS = {
    ("scr-dynamic.keyxm", 360): (1116.87, 125439.0, 39692.7, -5.9978, 2.9468),
    ("scr-dynamic.keyxm", 720): (1112.65, 125952.0, 40404.5, -5.9889, 2.8531),
    ("scr-vessel.keyxm", 426): (1352.91, 121135.0, 82407.0, -12.258, 14.966),
}


@pytest.mark.covered
@pytest.mark.parametrize(("name", "steps"), STEPS)
def test_worked_numbers_of_two_samples(name: str, steps: int) -> None:
    scene = mudline.read(SAMPLES / name).scene()._resolved
    found, _ = touchdown_zone(scene, scene.contact_input(), None, None).run(steps)
    force, moment, bending, *ends = STEPS[name, steps]
    assert found.largest_force == pytest.approx(force, rel=0.002)
    assert (found.largest_moment, found.moment_range) == pytest.approx((moment, bending), rel=0.002)
    assert (found.touchdown.min(), found.touchdown.max()) == pytest.approx(ends, abs=0.04)


@pytest.mark.parametrize(
    ("row", "name", "alphas"),
    [("HILBER-HUGHES\n -0.2", "hilber-hughes", (0.0, 0.2)), ("GENERALISED-ALPHA\n 0.25, 0.0", "", (0.0, 0.25))],
)
def test_the_scheme_of_the_deck(row: str, name: str, alphas: tuple[float, float]) -> None:
    scheme = zone_of(Riser(loads=f"{WAVES}*TIME STEPPING\n TYPE={row}\n").text()).scheme
    assert (scheme.alpha_m, scheme.alpha_f) == alphas
    assert scheme.name == (name or "generalised-alpha")


def test_a_scheme_that_hardly_damps_is_no_reference() -> None:
    found = studied(
        Riser(elements=50, loads=f"{COARSE}*TIME STEPPING\n TYPE=GENERALISED-ALPHA, P-INFINITY=1.0\n").text()
    )
    assert found.notes["accuracy"] == ["The reference is run with generalised-alpha (0.4), which damps."]


def test_a_variable_step_has_its_largest_and_its_first_step() -> None:
    loads = WAVES.replace("FIXED\n 0.0, 100.0, 0.2, 20.0", "VARIABLE\n 0.0, 100.0, 20.0\n 0.05, 0.001, 0.2")
    found = studied(Riser(elements=50, loads=loads).text())
    assert [(row.step, row.own) for row in found.steps] == [
        (0.4, False), (0.2, True), (0.1, False), (0.05, True)
    ]  # fmt: skip
    assert found.advice.own_step == 0.2


def test_a_deck_without_a_step_is_advised_one() -> None:
    found = studied(Riser(elements=50, loads="*WAVE-REGULAR\n 2.0, 11.0, 180.0\n").text())
    assert (found.advice.own_step, found.advice.verdict) == (None, "not studied")
    assert found.advice.text.startswith("The deck has no time step in *TIME:")
    assert not any(row.own for row in found.steps)


def test_steps_that_are_too_short_to_be_run_are_compared_with_longer_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(accuracy, "MOST_STEPS", 3000)
    found = studied(Riser(loads=WAVES.replace("0.2, 20.0", "1.0E-5, 20.0")).text())
    assert found.advice.verdict == "short enough"
    assert not any(row.own for row in found.steps)
    assert found.advice.own_step == 1e-5


def test_a_step_that_is_too_long_is_told_which_one_is_not() -> None:
    found = studied(Riser(loads=WAVES.replace("0.2, 20.0", "1.4, 20.0")).text())
    assert found.advice.verdict == "too long"
    assert (" use " in found.advice.text) == (found.advice.step is not None)


def test_coarse_elements_are_the_finding() -> None:
    found = studied(Riser(elements=50, loads=COARSE).text())
    assert "Elements of 20" in found.advice.text
    assert "The mesh is the finding" in found.advice.text


@pytest.mark.parametrize(
    ("loads", "heave", "source"),
    [
        ("*TIME\n STEP=FIXED\n 0.0, 100.0, 0.2\n", (1.0, 10.0), "assumed, no waves"),
        (WAVES, (1.0, 11.0), "H/4, assumed"),
    ],
)
def test_without_operators_the_motion_is_assumed(loads: str, heave: tuple[float, float], source: str) -> None:
    motion = zone_of(Riser(loads=loads).text()).motion
    assert (motion.heave, motion.period, motion.source) == (*heave, source)


_SIX = " 0.8, 0.5, 0.0, 0.0, 0.0, 0.0\n 0.0, 90.0, 0.0, 0.0, 0.0, 0.0\n"
RAO = f"*RAO\n VESSEL=Semi\n HEADING=180.0\n {{}}\n{_SIX} {{}}\n{_SIX}"


@pytest.mark.parametrize("frequencies", [(0.4, 0.7), (0.05, 0.12)])
def test_operators_in_radians_or_in_hertz(frequencies: tuple[float, float]) -> None:
    motion = zone_of(Riser(loads=WAVES + RAO.format(*frequencies)).text()).motion
    assert abs(motion.heave - 1.6) + abs(motion.surge + 1.0j) < 1e-9
    assert motion.source == "by *RAO, H 4"


def test_along_a_slope_what_is_left_out_is_said() -> None:
    notes = zone_of(Riser(slope=5.0, model="*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=5.0\n").text()).notes
    assert any("which slopes: the weight along it is left out" in note for note in notes)


HISTORIES = {
    "unloading": {"model": "*SEABED UNLOADING\n SET=ALL\n STIFFNESS=200000.0\n"},
    "suction": {"model": "*SEABED SUCTION\n SET=ALL\n COHESION=3000.0\n"},
    "spring": {"law": " TYPE=ELASTIC\n SET=ALL\n STIFFNESS=20000.0\n SUCTION=5000.0, 0.05\n", "soil": ""},
    "soil": {
        "law": " TYPE=ELASTIC\n SET=ALL\n STIFFNESS=100000.0\n",
        "soil": "",
        "model": "*SEABED SOIL\n SET=ALL\n STRENGTH=2000.0, 1500.0\n SUCTION=0.6, 1.0\n BUOYANCY=1.5, 6000.0\n",
    },
}


@pytest.mark.covered
@pytest.mark.parametrize("law", HISTORIES)
def test_laws_with_a_history_are_stepped_through(law: str) -> None:
    zone = zone_of(replace(Riser(elements=100), **HISTORIES[law]).text())  # type: ignore[arg-type]
    (coarse, _), (fine, _) = zone.run(28, 1), zone.run(112, 1)
    assert zone.periods == 2
    assert stability.change(coarse.largest_force, fine.largest_force) == pytest.approx(0.0, abs=0.1)


def test_a_law_with_a_history_is_studied_over_two_periods() -> None:
    found = studied(replace(Riser(elements=50), **HISTORIES["spring"], loads=COARSE).text())  # type: ignore[arg-type]
    assert found.advice.verdict != "not studied"
    assert found.notes["accuracy"][0].startswith("Laws with memory take long: two periods are run")
    assert found.mesh is None


REFUSED = {
    "no held end at the seabed": Riser(held=False),
    "has no bending stiffness": Riser(section=CHAIN),
    "the seabed is rigid at the touchdown": Riser(law=" TYPE=RIGID\n SET=ALL\n", soil=""),
    "the rest position is not unique": Riser(soil=SNAP),
    "nothing is lifted: no touchdown to study": None,
    "The pipe floats|the pipe floats": Riser(section=STEEL.replace("0.3239, 0.2827", "0.9, 0.89")),
}


@pytest.mark.parametrize("words", REFUSED)
def test_what_cannot_be_studied_is_refused_in_a_sentence(words: str) -> None:
    riser = REFUSED[words]
    text = riser.text() if riser else (SAMPLES / "flowline-gen.keyxm").read_text(encoding="utf-8")
    found = studied(text, "accuracy", "pruning")
    assert any(each in found.advice.text for each in words.split("|"))
    assert found.advice.verdict == "not studied"
    assert found.json()["model"] is None
    assert found.stages is not None


def line_of(text: str, line: str) -> int:
    return text.splitlines().index(line) + 1


def notes_of(text: str) -> list[str]:
    scene = mudline.from_keyword(text, units="metric").scene()._resolved
    return stability.curve_notes(scene, scene.contact_input())


def test_a_jump_gets_a_ramp_and_its_line() -> None:
    text = Riser(soil=JUMP).text()
    (note,) = notes_of(text)
    assert note.startswith(f"Line {line_of(text, ' CURVE=Clay')}: the force jumps to 600 N/m at the mudline: a ramp")
    _, run = zone_of(text).run(90)
    assert run.cuts == 0


def test_a_falling_curve_is_named_with_its_stiffness() -> None:
    text = Riser(soil=FALL).text()
    stiffness = 200.0 / (0.05 * 0.3239)
    (note,) = notes_of(text)
    assert note.startswith(f"Line {line_of(text, ' 0.05, 1700.0')}: curve Clay falls from 1700 to 1500 N/m")
    assert f"-{float(f'{stiffness:.4g}'):,.0f} N/m2 that the line has to carry" in note


def test_stiff_and_extreme_cases() -> None:
    found = studied(Riser(loads=COARSE).text(), "stability")
    names = [row.case for row in found.extremes]
    assert names == ["soil x 1e3", "soil x 1e6, to 1e9 N/m2", "period x 0.5", "soil x 0.01"]
    assert all(row.converged for row in found.extremes)
    assert found.evaluator is not None
    assert 0.0 <= found.evaluator.error < 1e-15


LINEAR = " TYPE=ELASTIC\n SET=ALL\n STIFFNESS={}\n"


@pytest.mark.parametrize(
    ("stiffness", "units", "names"),
    [
        ("1.0E9", "metric", ["period x 0.5", "soil x 0.01"]),
        ("1.0E5", "imperial", ["soil x 1e3, to 2e7 lbf/ft2", "period x 0.5", "soil x 0.01"]),
    ],
)
def test_a_soil_is_made_no_stiffer_than_rock(stiffness: str, units: str, names: list[str]) -> None:
    riser = IMPERIAL if units == "imperial" else Riser()
    text = replace(riser, law=LINEAR.format(stiffness), soil="", loads=COARSE).text()
    assert [row.case for row in studied(text, "stability", units=units).extremes] == names


def test_the_stiffest_soils_converge() -> None:
    zone = zone_of(Riser(law=LINEAR.format("1.0E11"), soil="", elements=500).text())
    found, run = zone.run(60)
    softer, _ = zone.run(60, 3, Variant(factor=0.01))
    assert run.most_iterations <= 25
    assert found.largest_moment == pytest.approx(softer.largest_moment, rel=0.01)


def test_a_soil_that_no_longer_carries_the_pipe_is_called_so() -> None:
    """A curve that falls behind its last point, at a hundredth of its forces."""
    falling = CURVE.replace(" 0.05, 700.0\n 0.1, 1000.0\n 0.5, 1900.0\n", " 0.05, 1700.0\n 0.5, 900.0\n")
    found = studied(Riser(soil=falling, loads=COARSE).text(), "stability")
    (row,) = (each for each in found.extremes if each.case == "soil x 0.01")
    assert (row.converged, row.message) == (False, "the soil does not carry the pipe")


def test_extremes_of_a_short_step_are_run_with_a_longer_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stability, "MOST_STEPS", 1500)
    found = studied(Riser(loads=WAVES.replace("0.2, 20.0", "0.02, 20.0")).text(), "stability")
    assert [row.case for row in found.extremes] == ["soil x 1e3", "soil x 1e6, to 1e9 N/m2", "period x 0.5"]
    assert {row.step for row in found.extremes} == {0.16}
    assert found.notes["stability"] == ["Left out, as the deck's step is short: soil x 0.01."]
    table = extremes_table(found)
    assert table is not None
    assert table.title == "Stiff and extreme: 160 ms, as 20 ms would take long, and what half of it changes"


def test_friction_stands_against_the_step() -> None:
    law = " TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n FRICTION=0.35, 0.60, 0.0027, 0.1365\n"
    scene = mudline.from_keyword(Riser(law=law).text(), units="metric").scene()._resolved
    (row,) = stability.friction_rows(scene, scene.contact_input(), own_steps(scene))
    assert row.steps_per_period == pytest.approx(row.stick_period / 0.2)
    mass, weight = 7850.0, 9.81
    area = np.pi / 4.0 * (0.3239**2 - 0.2827**2)
    submerged = weight * (mass * area - 1025.0 * np.pi / 4.0 * 0.3239**2)
    assert row.stick_period == pytest.approx(2.0 * np.pi * np.sqrt(mass * area * 0.0027 / (0.35 * submerged)), rel=0.4)


def test_an_unstable_run_is_called_so() -> None:
    """A run whose moment, its range or force is four times that of the reference."""
    calm = studied(Riser(elements=100, loads=COARSE).text())
    (own,) = (row for row in calm.steps if row.own)
    assert own.measures is not None
    assert calm.reference is not None
    for what in ("largest_moment", "moment_range", "largest_force"):
        wild = replace(own, errors=None, measures=own.measures._replace(**{what: 4.0 * getattr(own.measures, what)}))
        judged = accuracy._against(wild, calm.reference)
        assert (judged.state, judged.errors) == ("is unstable", None), what
