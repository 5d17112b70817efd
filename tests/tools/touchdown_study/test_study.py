"""The study: worked numbers, verdicts, stiff and extreme cases, what is refused, laws with a history."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import count

import numpy as np
import pytest

import mudline
from mudline.tools.touchdown_study import accuracy, stability
from mudline.tools.touchdown_study.screen import extremes_table
from mudline.tools.touchdown_study.study import Study, study
from mudline.tools.touchdown_study.zone import Variant, Zone, touchdown_zone
from tests.helpers.samples import SAMPLES
from tests.tools.touchdown_study.decks import BUOYS, CHAIN, CURVE, FALL, FLEXIBLE, JUMP, SNAP, STEEL, WAVES, Riser


def ticking() -> Callable[[], float]:
    """A clock that does not depend on the machine."""
    ticks = count()
    return lambda: float(next(ticks))


def studied(text: str, *parts: str, units: str = "metric") -> Study:
    scene = mudline.from_keyword(text, units=units).scene()._resolved
    return study(scene, parts or ("accuracy",), timer=ticking())


@cache
def sample(name: str) -> Study:
    return study(mudline.read(SAMPLES / name).scene()._resolved, ("accuracy",), timer=ticking())


MODELS = {
    "scr-dynamic.keyxm": {
        "first_element": 40, "last_element": 136, "touchdown_element": 98, "tension": 244715.0, "lying_length": 315.692,
        "weight": 933.011, "mass": 155.128, "added_mass": 60.02, "bending_stiffness": 3.16901e7, "travel": 3.0945,
        "end_amplitude": 0.89672, "heave": 1.5, "surge": 0.0, "period": 12.0, "left": 121.007, "right": 76.0046,
        "drag": 1.0,
    },
    "scr-vessel.keyxm": {
        "first_element": 52, "last_element": 98, "touchdown_element": 78, "tension": 372236.0, "lying_length": 373.584,
        "weight": 1244.8, "mass": 186.94, "added_mass": 60.02, "bending_stiffness": 3.1746e7, "travel": 11.16,
        "end_amplitude": 2.9856, "heave": 4.034, "surge": 4.034, "period": 14.2, "left": 117.0, "right": 80.0,
        "drag": 1.0,
    },
}  # fmt: skip


@pytest.mark.covered
@pytest.mark.parametrize("name", MODELS)
def test_the_models_of_two_samples(name: str) -> None:
    found = sample(name).json()["model"]
    scheme = found.pop("scheme")
    assert found == {key: pytest.approx(value, rel=1e-3) for key, value in MODELS[name].items()}
    assert (scheme["name"], scheme["rho"], scheme["alpha"]) == ("generalised-alpha", 0.4, None)


STATIC = {"scr-dynamic.keyxm": (1090.66, 120811.0, -1.4536), "scr-vessel.keyxm": (1315.41, 106159.0, 1.6108)}
STEPS = {
    ("scr-dynamic.keyxm", 0.1): (1116.87, 125439.0, 39692.7, -5.9978, 2.9468),
    ("scr-dynamic.keyxm", 0.05): (1112.65, 125952.0, 40404.5, -5.9889, 2.8531),
    ("scr-dynamic.keyxm", 0.025): (1118.47, 125824.0, 40848.7, -5.998, 2.9308),
    ("scr-dynamic.keyxm", 0.00625): (1117.53, 125914.0, 41061.9, -6.0179, 2.8603),
    ("scr-vessel.keyxm", 0.1): (1352.91, 121135.0, 82407.0, -12.258, 14.966),
    ("scr-vessel.keyxm", 0.05): (1399.56, 122433.0, 83190.5, -12.935, 15.197),
}


@pytest.mark.covered
@pytest.mark.parametrize("name", STATIC)
def test_the_state_at_rest(name: str) -> None:
    found = sample(name).json()["static"]
    force, moment, touchdown = STATIC[name]
    assert (found["largest_force"], found["largest_moment"]) == pytest.approx((force, moment), rel=0.002)
    assert found["touchdown"] == pytest.approx(touchdown, abs=0.01)


@pytest.mark.covered
@pytest.mark.parametrize(("name", "step"), STEPS)
def test_the_figures_of_steps(name: str, step: float) -> None:
    (found,) = (row for row in sample(name).json()["steps"] if row["step"] == pytest.approx(step))
    force, moment, bending, *ends = STEPS[name, step]
    assert found["largest_force"] == pytest.approx(force, rel=0.002)
    assert (found["largest_moment"], found["moment_range"]) == pytest.approx((moment, bending), rel=0.002)
    assert found["touchdown"] == pytest.approx(ends, abs=0.04)


@pytest.mark.covered
@pytest.mark.parametrize(
    ("name", "errors", "verdict"),
    [
        ("scr-dynamic.keyxm", (0.0165, -0.016, -0.0044), "short enough"),
        ("scr-vessel.keyxm", (0.011, -0.017, -0.022), "coarse"),
    ],
)
def test_the_verdicts_of_two_samples(name: str, errors: tuple[float, ...], verdict: str) -> None:
    found = sample(name)
    (row,) = (each for each in found.steps if each.own)
    assert row.errors == pytest.approx(errors, rel=0.2)
    assert found.advice.verdict == verdict
    assert found.mesh is not None
    assert found.mesh.changes is not None
    assert found.errors.shape == (4, 3)
    assert (found.run_times > 0.0).all()


def test_the_scheme_of_the_deck() -> None:
    hughes = studied(Riser(loads=f"{WAVES}*TIME STEPPING\n TYPE=HILBER-HUGHES\n -0.2\n").text())
    assert hughes.zone is not None
    assert (hughes.zone.scheme.name, hughes.zone.scheme.alpha) == ("hilber-hughes", -0.2)
    given = studied(Riser(loads=f"{WAVES}*TIME STEPPING\n TYPE=GENERALISED-ALPHA\n 0.25, 0.0\n").text())
    assert given.zone is not None
    assert (given.zone.scheme.alpha_f, given.zone.scheme.alpha_m) == (0.25, 0.0)


def test_a_scheme_that_hardly_damps_is_no_reference() -> None:
    found = studied(Riser(loads=f"{WAVES}*TIME STEPPING\n TYPE=GENERALISED-ALPHA, P-INFINITY=1.0\n").text())
    assert found.notes["accuracy"] == ["The reference is run with generalised-alpha (0.4), which damps."]


def test_a_variable_step_has_its_largest_and_its_first_step() -> None:
    loads = WAVES.replace("FIXED\n 0.0, 100.0, 0.2, 20.0", "VARIABLE\n 0.0, 100.0, 20.0\n 0.05, 0.001, 0.2")
    found = studied(Riser(loads=loads).text())
    assert [(row.step, row.own) for row in found.steps] == [
        (0.4, False), (0.2, True), (0.1, False), (0.05, True)
    ]  # fmt: skip
    assert found.advice.own_step == 0.2


def test_a_deck_without_a_step_is_advised_one() -> None:
    found = studied(Riser(loads="*WAVE-REGULAR\n 2.0, 11.0, 180.0\n").text())
    assert (found.advice.own_step, found.advice.verdict) == (None, "not studied")
    assert found.advice.text.startswith("The deck has no time step in *TIME:")
    assert not any(row.own for row in found.steps)


def test_steps_that_are_too_short_to_be_run_are_compared_with_longer_ones() -> None:
    found = studied(Riser(loads=WAVES.replace("0.2, 20.0", "1.0E-5, 20.0")).text())
    assert found.advice.verdict == "short enough"
    assert not any(row.own for row in found.steps)
    assert found.advice.own_step == 1e-5


def test_a_step_that_is_too_long_is_told_which_one_is_not() -> None:
    found = studied(Riser(loads=WAVES.replace("0.2, 20.0", "1.4, 20.0")).text())
    assert found.advice.verdict == "too long"
    assert (" use " in found.advice.text) == (found.advice.step is not None)


def test_coarse_elements_are_the_finding() -> None:
    found = studied(Riser(elements=50).text())
    assert "Elements of 20" in found.advice.text
    assert "The mesh is the finding" in found.advice.text


def test_without_operators_and_waves_the_motion_is_assumed() -> None:
    none = studied(Riser(loads="*TIME\n STEP=FIXED\n 0.0, 100.0, 0.2\n").text())
    assert none.zone is not None
    assert (none.zone.motion.heave, none.zone.motion.period) == (1.0, 10.0)
    assert none.zone.motion.source == "assumed, no waves"
    waves = studied(Riser().text())
    assert waves.zone is not None
    assert (waves.zone.motion.heave, waves.zone.motion.source) == (1.0, "H/4, assumed")


_SIX = " 0.8, 0.5, 0.0, 0.0, 0.0, 0.0\n 0.0, 90.0, 0.0, 0.0, 0.0, 0.0\n"
RAO = f"*RAO\n VESSEL=Semi\n HEADING=180.0\n {{}}\n{_SIX} {{}}\n{_SIX}"


@pytest.mark.parametrize("frequencies", [(0.4, 0.7), (0.05, 0.12)])
def test_operators_in_radians_or_in_hertz(frequencies: tuple[float, float]) -> None:
    found = studied(Riser(loads=WAVES + RAO.format(*frequencies)).text())
    assert found.zone is not None
    motion = found.zone.motion
    assert abs(motion.heave - 1.6) + abs(motion.surge + 1.0j) < 1e-9
    assert motion.source == "by *RAO, H 4"


def test_a_lazy_wave_in_the_other_order_of_nodes() -> None:
    riser = Riser(300.0, 760.0, 1000.0, 420.0, section=FLEXIBLE.format(buoyancy=0.78), sets=BUOYS)
    found = studied(riser.text())
    assert found.advice.verdict in {"short enough", "coarse", "too long"}
    other_way = "*ELEMENT SETS\n SET=Bare\n GEN=1, 60\n GEN=101, 250\n SET=Buoy\n GEN=61, 100\n"
    mirrored = replace(riser, top_first=True, sets=other_way)
    other = studied(mirrored.text())
    assert found.errors == pytest.approx(other.errors, rel=1e-3, abs=1e-6)


def test_along_a_slope_what_is_left_out_is_said() -> None:
    found = studied(Riser(slope=5.0, model="*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=5.0\n").text())
    assert found.zone is not None
    assert any("which slopes: the weight along it is left out" in note for note in found.zone.notes)


def touchdown_zone_of(text: str) -> Zone:
    scene = mudline.from_keyword(text, units="metric").scene()._resolved
    return touchdown_zone(scene, scene.contact_input(), None, None)


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
    found = studied(replace(Riser(elements=100), **HISTORIES[law]).text())  # type: ignore[arg-type]
    assert found.zone is not None
    assert found.zone.periods == 2
    assert all(row.worst < 0.1 for row in found.steps if row.step <= 0.2)
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


def test_a_jump_gets_a_ramp_and_its_line() -> None:
    text = Riser(soil=JUMP).text()
    found = studied(text, "stability")
    line = line_of(text, " CURVE=Clay")
    assert found.notes["stability"][0].startswith(f"Line {line}: the force jumps to 600 N/m at the mudline: a ramp")
    assert all(row.converged for row in found.extremes[2:])


def test_a_falling_curve_is_named_with_its_stiffness() -> None:
    text = Riser(soil=FALL).text()
    found = studied(text, "stability")
    stiffness = 200.0 / (0.05 * 0.3239)
    (note,) = (each for each in found.notes["stability"] if "falls" in each)
    assert note.startswith(f"Line {line_of(text, ' 0.05, 1700.0')}: curve Clay falls from 1700 to 1500 N/m")
    assert f"-{float(f'{stiffness:.4g}'):,.0f} N/m2 that the line has to carry" in note


def test_stiff_and_extreme_cases() -> None:
    found = studied(Riser().text(), "stability")
    names = [row.case for row in found.extremes]
    assert names == ["soil x 1e3", "soil x 1e6, to 1e9 N/m2", "period x 0.5", "soil x 0.01"]
    assert all(row.converged for row in found.extremes)
    assert found.evaluator is not None
    assert 0.0 <= found.evaluator.error < 1e-15


LINEAR = " TYPE=ELASTIC\n SET=ALL\n STIFFNESS={}\n"


def test_a_soil_that_is_as_stiff_as_rock_is_made_no_stiffer() -> None:
    found = studied(Riser(law=LINEAR.format("1.0E9"), soil="").text(), "stability")
    assert [row.case for row in found.extremes] == ["period x 0.5", "soil x 0.01"]


def test_the_stiffest_soils_converge() -> None:
    zone = touchdown_zone_of(Riser(law=LINEAR.format("1.0E11"), soil="", elements=500).text())
    found, run = zone.run(60)
    softer, _ = zone.run(60, 3, Variant(factor=0.01))
    assert run.most_iterations <= 25
    assert found.largest_moment == pytest.approx(softer.largest_moment, rel=0.01)


def test_a_soil_that_no_longer_carries_the_pipe_is_called_so() -> None:
    """A curve that falls behind its last point, at a hundredth of its forces."""
    falling = CURVE.replace(" 0.05, 700.0\n 0.1, 1000.0\n 0.5, 1900.0\n", " 0.05, 1700.0\n 0.5, 900.0\n")
    found = studied(Riser(soil=falling).text(), "stability")
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
    found = studied(Riser(law=law).text(), "stability")
    (row,) = found.friction
    assert row.steps_per_period == pytest.approx(row.stick_period / 0.2)
    mass, weight = 7850.0, 9.81
    area = np.pi / 4.0 * (0.3239**2 - 0.2827**2)
    submerged = weight * (mass * area - 1025.0 * np.pi / 4.0 * 0.3239**2)
    assert row.stick_period == pytest.approx(2.0 * np.pi * np.sqrt(mass * area * 0.0027 / (0.35 * submerged)), rel=0.4)


@pytest.mark.parametrize("what", ["largest_moment", "moment_range", "largest_force"])
def test_an_unstable_run_is_called_so(what: str) -> None:
    """A run whose moment, its range or force is four times that of the reference."""
    calm = studied(Riser(soil=CURVE).text())
    (own,) = (row for row in calm.steps if row.own)
    assert own.measures is not None
    assert calm.reference is not None
    wild = replace(own, errors=None, measures=own.measures._replace(**{what: 4.0 * getattr(own.measures, what)}))
    judged = accuracy._against(wild, calm.reference)
    assert (judged.state, judged.errors) == ("is unstable", None)
