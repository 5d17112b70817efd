"""The parts of the study on small decks: contacts and their steps, errors and run times, extremes, stages, advice."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mudline.model.contact.stiffest import critical_step
from mudline.model.curves import ForceCurve
from mudline.model.scene.model import Scene
from mudline.tools.study import Study, precision, study
from mudline.tools.study.extremes import extremes
from mudline.tools.study.schemes import SCHEMES
from mudline.tools.study.stability import contacts_of, judged, landing_at, landing_on, largest_step, own_step
from tests.helpers.builders.scenes import legal_scene
from tests.tools.study.decks import CURVE, EVERYTHING, LINEAR, MASS, SPRINGS, Ticking, deck, line_of


def studied(text: str, *parts: str) -> Study:
    """The study of a deck with a clock that goes on by a millisecond whenever it is asked."""
    return study(legal_scene(text), parts or ("precision", "stability", "pruning"), timer=Ticking())


@pytest.fixture(scope="module")
def everything() -> Scene:
    return legal_scene(deck(EVERYTHING))


@pytest.fixture(scope="module")
def whole(everything: Scene) -> Study:
    """Its study, with fewer steps to an octave than users get."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(precision, "_PER_OCTAVE", 3)
        return study(everything, timer=Ticking())


# ------------------------------------------------------------------------------------------------------------ stability


def test_the_critical_step_of_a_linear_seabed_is_its_formula() -> None:
    found = studied(deck(), "stability")
    assert found.stability is not None
    ((row, words),) = found.stability
    assert row.kind == "linear"
    assert row.mass == pytest.approx(MASS, rel=1e-12)
    assert row.explicit_step == pytest.approx(2.0 * math.sqrt(MASS / 50e3), rel=1e-12)
    assert row.deck_line == line_of(deck(), "STIFFNESS=")
    assert (row.at_own_step, words[:5]) == ("stable", "loses")


def test_a_lateral_resistance_that_falls_is_advised_on_with_stiffness_and_step() -> None:
    """(peak - residual) W / distance, which a structure has to have, and half of the time in which motion grows."""
    breakout = "*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=0.3, 0.6\n STIFFNESS=2E4\n"
    text = deck(LINEAR + breakout + " LATERAL=PEAK-RESIDUAL\n PEAK=1.2, 0.03\n RESIDUAL=0.6, 0.3\n")
    advice = studied(text, "stability", "pruning").advice.text
    needed = 0.6 / 0.27 * (MASS - 1025.0 * math.pi / 4.0 * 0.3**2) * 9.81
    assert f"line {line_of(text, 'PEAK=')} (softening on ALL)" in advice
    assert f"above {needed:.6g} N/m2" in advice
    assert f"steps of {math.floor(500.0 / math.sqrt(needed / MASS)) / 1e3:.3g} s or less" in advice


def test_damping_lowers_the_critical_step_of_velocity_verlet(whole: Study) -> None:
    """(omega dt)^2 + 4 gamma dt < 4, gamma = c / m."""
    assert whole.stability is not None
    damped = [one.row for one in whole.stability if one.row.kind == "suction"]
    assert damped
    for row in damped:
        dt, gamma = row.explicit_step, row.damping / row.mass
        assert (row.omega * dt) ** 2 + 4.0 * gamma * dt == pytest.approx(4.0, rel=1e-9)
        assert row.at_own_step == "diverges"
        assert row.explicit_step == critical_step("velocity-verlet", row.omega, gamma)


def test_landings_keep_their_speed_up_to_the_landing_step_and_not_above(everything: Scene) -> None:
    contacts, *_ = contacts_of(everything, everything.contact_input("cut"))
    rows = {one.row.contact: one.row for one in judged(everything, contacts, None)}
    landed = [one for one in contacts if one.law is not None]
    assert {one.row.kind for one in landed} == {"curve", "linear"}
    for contact in landed:
        step = rows[contact.row.contact].landing_step
        assert step is not None
        assert contact.law is not None
        drop = landing_on(everything, contact, contact.law)
        for share in (1.0, 0.97, 0.8, 0.5, 0.23):
            assert landing_at(drop, share * step).kept.all(), (contact.row.contact, share)
        assert not all(landing_at(drop, share * step).kept.all() for share in (1.01, 1.02, 1.05, 1.1))


def test_the_largest_step_is_below_the_first_that_fails() -> None:
    """Also where larger ones meet the goal again."""
    found = largest_step(lambda dt: (dt < 0.3) | (dt > 0.5), 0.01, 2.0)
    assert found is not None
    assert 0.295 < found < 0.3
    assert largest_step(lambda dt: dt < 0.0, 0.01, 2.0) is None
    assert largest_step(lambda dt: dt > 0.0, 0.01, 2.0) == pytest.approx(2.0)


def test_a_jump_at_the_mudline_is_named_with_its_line_and_the_step_without_it() -> None:
    text, smooth = deck(CURVE.format(first="800.0")), deck(CURVE.format(first="0.0"))
    found, without = studied(text, "stability"), studied(smooth, "stability")
    assert found.stability is not None
    assert without.stability is not None
    row, other = found.stability[0].row, without.stability[0].row
    assert row.jump
    assert not other.jump
    assert row.without_jump is not None
    assert row.without_jump.step is not None
    assert row.without_jump.step == pytest.approx(other.landing_step)
    assert row.without_jump.deck_line == line_of(text, "0.00,")
    assert row.landing_step is None or row.landing_step < 0.2 * row.without_jump.step
    line = f"line {line_of(text, '0.00,')} (curve:Crust on ALL)"
    assert f"The force jumps at the mudline, {line}; without the jump landings keep" in found.advice.text
    assert f"{found.milliseconds(row.without_jump.step)} ms" in found.advice.text


def test_contacts_that_differ_in_name_only_share_a_row(whole: Study) -> None:
    split = LINEAR.replace("SET=ALL", "SET=Clay") + LINEAR.partition("TYPE=ELASTIC\n")[2].replace("ALL", "Sand")
    found = studied(deck(split), "stability")
    assert found.stability is not None
    lines = {(one.row.contact, one.row.elements) for one in found.stability}
    assert lines == {("linear on Clay", 7), ("linear on Sand", 3)}  # from two lines: two rows
    assert whole.stability is not None
    assert len({one.row[1:9] for one in whole.stability}) == len(whole.stability)


# ------------------------------------------------------------------------------------------------------------ precision


def test_errors_meet_their_goals_at_the_steps_that_are_given(whole: Study) -> None:
    assert whole.precision is not None
    rows = whole.precision.rows
    assert [row.scheme for row in rows[:6:2]] == list(SCHEMES)
    assert {row.kind for row in rows} == {"curve", "friction", "suction"}
    for row in rows:
        assert row.step is not None
        assert row.error is not None
        assert row.evaluations is not None
        assert 0.0 < row.error <= row.goal
        assert row.evaluations * row.step >= {"velocity Verlet": 1.0, "RK4": 4.0}.get(row.scheme, 2.0) - 1e-9
        assert row.error_at_own_step is None or row.error_at_own_step > 0.01
    for one, tenth in zip(rows[::2], rows[1::2], strict=True):
        assert (one.goal, tenth.goal) == (0.01, 0.001)
        assert (tenth.step or 1.0) < (one.step or 0.0)


def test_run_time_is_that_of_the_evaluations(whole: Study) -> None:
    """A millisecond for each call of the clock: of a march of some steps of sixteen masses."""
    assert whole.precision is not None
    for one, tenth in zip(whole.precision.rows[::2], whole.precision.rows[1::2], strict=True):
        assert one.run_time is not None
        assert tenth.run_time is not None
        assert tenth.run_time / one.run_time == pytest.approx((tenth.evaluations or 0.0) / (one.evaluations or 1.0))
        assert 0.0 < one.run_time < 1.0


# ------------------------------------------------------------------------------------------------------------- extremes


def test_every_extreme_of_every_law_holds(whole: Study) -> None:
    assert whole.extremes is not None
    assert whole.extremes.failed == []
    assert whole.extremes.tried == whole.extremes.held > 25
    assert {"at its given points to the bit", "velocity 1e3", "displaced by 1e6", "elements of length 1e-12"} < {
        *whole.extremes.cases
    }


def test_every_extreme_of_springs_and_unloading_lines_holds() -> None:
    found = studied(deck(SPRINGS), "stability")
    assert found.stability is not None
    assert found.extremes is not None
    kinds = {one.row.kind for one in found.stability}
    assert kinds == {"curve", "unloading", "lateral", "suction spring", "nodal"}
    assert found.extremes.failed == []
    assert {"displaced to its end", "unloaded to the mudline", "unloading stiffness x 1e12"} < {*found.extremes.cases}
    landed = {one.row.kind for one in found.stability if one.row.landing_step is not None}
    assert landed == {"curve", "nodal"}


def test_a_law_that_is_wrong_is_listed_with_its_line(monkeypatch: pytest.MonkeyPatch, everything: Scene) -> None:
    """A part in 10^10 too much, which no screen shows; at the points of the curve too."""
    right = ForceCurve.fill

    def fill(curve: ForceCurve, ratios: np.ndarray, force: np.ndarray, slope: np.ndarray) -> None:
        right(curve, ratios, force, slope)
        force *= 1.0 + 1e-10

    monkeypatch.setattr(ForceCurve, "fill", fill)
    given = everything.contact_input("cut")
    found = extremes(given, contacts_of(everything, given)[0])
    assert found.held < found.tried
    text = deck(EVERYTHING)
    assert {failure.deck_line for failure in found.failed} == {line_of(text, "0.01,")}
    assert any(failure.case.endswith("1e6 diameters deep") for failure in found.failed)
    assert all("exact is" in failure.message for failure in found.failed)


# -------------------------------------------------------------------------------------------------------------- pruning


def test_stages_are_those_of_the_plan_with_their_lines(whole: Study) -> None:
    assert whole.stages is not None
    rows = {row.stage: row for row in whole.stages.rows}
    text = deck(EVERYTHING)
    lines = {name: row.deck_line for name, row in rows.items() if row.deck_line}
    assert lines["friction"] == line_of(text, "FRICTION=")
    assert lines["suction"] == line_of(text, "*SEABED SUCTION") + 1
    assert {name for name, row in rows.items() if not row.active} == {"unloading", "lateral", "trench"}
    for row in rows.values():
        assert row.active == (row.cost_if_added is None)
        assert row.share is None or 0.0 <= row.share <= 1.0
    assert "no element has" in rows["lateral"].why


def test_shares_follow_from_steps_with_and_without(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of seconds that are given here instead of measured."""
    seconds = {"": 10e-6, "floor": 2e-6, "normal law": 3e-6, "friction": 4e-6, "smoothing": 9e-6, "suction": 7e-6}
    added = {"unloading": 12e-6, "lateral": 11e-6, "trench": 32e-6}
    monkeypatch.setattr(
        "mudline.tools.study.pruning.seconds_per_step", lambda models, _: {**seconds, **added} | {} if models else {}
    )
    found = studied(deck(EVERYTHING), "pruning")
    assert found.stages is not None
    rows = {row.stage: row for row in found.stages.rows}
    shares = {name: row.share for name, row in rows.items() if row.share is not None}
    assert shares == pytest.approx({"floor": 0.2, "normal law": 0.1, "smoothing": 0.1, "suction": 0.3, "friction": 0.6})
    assert rows["trench"].cost_if_added == pytest.approx(2e-6)  # for each of eleven nodes
    assert found.advice.text.startswith("Most of a step goes to the stage friction (line")


# --------------------------------------------------------------------------------------------------------------- advice


def test_advice_names_line_and_step(whole: Study) -> None:
    """On the linear seabed what the tables have; where suction damps, its step of velocity Verlet."""
    found = studied(deck())
    assert found.precision is not None
    text = deck()
    verlet = found.precision.rows[0].step
    advice = found.advice
    assert (advice.scheme, advice.step, advice.own_step) == ("velocity Verlet", verlet, 0.05)
    assert advice.deck_line == line_of(text, "STIFFNESS=")
    assert f"Use velocity Verlet with {found.milliseconds(verlet)} ms, or HHT (-0.3) with" in advice.text
    assert f"The deck's own step, 50 ms (line {line_of(text, '0.0, 120.0')}), is" in advice.text
    assert whole.stability is not None
    assert whole.advice.step == min(one.row.explicit_step for one in whole.stability)


def test_advice_on_stability_alone_is_that_of_landings() -> None:
    found = studied(deck(), "stability")
    assert found.stability is not None
    assert (found.advice.scheme, found.advice.step) == ("HHT (-0.3)", found.stability[0].row.landing_step)
    assert found.precision is None
    assert found.stages is None


def test_a_deck_whose_step_is_short_enough_is_told_so() -> None:
    found = studied(deck().replace("0.05,", "0.0005,"), "precision").advice.text
    assert "50 ms" not in found
    assert "0.5 ms (line" in found
    assert found.endswith("is short enough.")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (deck(time=False), "The deck has no *TIME with a fixed step to compare with."),
        (deck(mass=False), "No contact of this deck has a frequency: no section has a mass."),
        (deck(""), "No contact of this deck has a frequency: no element has a seabed law."),
        (deck(LINEAR.replace("ELASTIC", "RIGID").replace(" STIFFNESS=50.0E3\n", "")), "the seabed is rigid."),
    ],
)
def test_what_is_missing_is_said_and_the_rest_is_there(text: str, says: str) -> None:
    found = studied(text)
    assert any(says in note for note in found.notes["precision"])
    assert found.stages is not None
    assert found.stages.rows
    assert (own_step(legal_scene(text)) is None) == ("*TIME" in says)
    if "*TIME" not in says:
        assert found.advice.scheme is None
        assert says in found.advice.text


def test_the_last_time_step_of_the_deck_counts() -> None:
    text = deck() + "*TIME\n STEP=FIXED\n 120.0, 130.0, 0.01\n"
    found = own_step(legal_scene(text))
    assert found is not None
    assert (found.step, found.deck_line) == (0.01, len(text.splitlines()))
