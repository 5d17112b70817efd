"""Frequencies of a scene's contacts, the rule that holds a deck's step against them, and steps that are really made."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mudline.contact.stiffest import CRITICAL_OMEGA_DT
from mudline.linting.engine import lint_bytes
from mudline.linting.registry import select
from mudline.scene.model import Scene
from mudline.study import SAMPLE_TEXT, sample_scene
from mudline.study.schemes import SCHEMES
from mudline.study.stability import contacts
from mudline.study.stability.contacts import can_oscillate, find_contacts
from mudline.study.stability.critical import BOUNDED, GROWS, SHARES, Measured, measure
from mudline.study.stability.families import all_cells
from mudline.study.stability.judging import Judgement
from tests.builders.scenes import legal_scene
from tests.study.stability.conftest import STEPPED

MASS = 7850.0 * 0.25 * np.pi * (0.3**2 - 0.25**2)
FRICTION = (0.5 * 9.81 * (MASS - 1025.0 * 0.25 * np.pi * 0.3**2) / 0.003 / MASS) ** 0.5
"""The frequency of friction on Sand, with its mobilisation length of 3 mm: more than that of the soft clay."""


def curved(rows: str) -> Scene:
    head, tail = SAMPLE_TEXT.split(" CURVE=Soft Clay\n")
    return legal_scene(f"{head} CURVE=Soft Clay\n{rows}*SEABED CONTACT{tail.partition('*SEABED CONTACT')[2]}")


def test_the_contacts_of_the_sample() -> None:
    found, left_out = find_contacts(sample_scene())
    assert left_out == []
    assert [(one.name, one.elements, one.line) for one in found] == [
        ("suction damping on Clay", 7, 43),
        ("suction mobilisation on Clay", 7, 43),
        ("friction on Sand", 4, 28),
        ("curve:Soft Clay on Clay", 7, 32),
        ("friction on Clay", 7, 25),
        ("linear on Sand", 3, 27),
    ]
    curve, sand = found[3], found[5]
    assert curve.stiffness == pytest.approx(45000.0 / 0.3, rel=1e-12)
    assert curve.omega == pytest.approx((45000.0 / 0.3 / MASS) ** 0.5, rel=1e-12)
    assert (curve.depth, curve.reach) == pytest.approx((0.0015, 0.0015))
    assert sand.omega == pytest.approx((50000.0 / MASS) ** 0.5, rel=1e-12)


def test_contacts_without_a_frequency_say_why() -> None:
    found, left_out = find_contacts(legal_scene(SAMPLE_TEXT.replace("7850.0", "0.0")))
    assert found == []
    assert {one.reason for one in left_out if "friction" not in one.what} == {
        "no frequency: the mass per unit length is not known"
    }
    assert [one.what for one in left_out if "weight" in one.reason] == ["friction"]
    _, floating = find_contacts(legal_scene(SAMPLE_TEXT.replace("0.3, 0.25,", "0.3, 0.295,")))
    assert [(one.what, one.reason) for one in floating] == [
        ("friction", "no springs at 11 nodes: they follow the submerged weight, and the pipe floats")
    ]
    found, left_out = find_contacts(curved(" 0, 1000\n 1, 0\n"))
    assert "linear on Sand" in {one.name for one in found}
    assert [tuple(one) for one in left_out] == [("curve:Soft Clay on Clay", "no frequency: its law never stiffens")]


def test_a_scene_without_springs_has_no_contacts() -> None:
    assert find_contacts(legal_scene("$MODEL\n")) == ([], [])


def test_nodes_with_a_stiffness_of_their_own() -> None:
    """A node carries the mass of half of each of its elements, 2 m inside the line, 1 m at its end."""
    nodal = SAMPLE_TEXT.replace(" SMOOTHING=AUTO", " NODAL STIFFNESS=1.0E5")
    scene = legal_scene(nodal)
    found, _ = find_contacts(scene)
    one = next(contact for contact in found if contact.name.startswith("nodal"))
    assert (one.name, one.elements) == ("nodal 100000 at node 11", 4)
    assert one.omega == pytest.approx((1e5 / MASS) ** 0.5)
    assert one.stiffness == pytest.approx(1e5)
    assert measure(scene, one, SCHEMES["central-difference"]).as_predicted
    left_out = find_contacts(legal_scene(nodal.replace("7850.0", "0.0")))[1]
    assert "nodal stiffness 100000" in {omission.what for omission in left_out}


def test_unloading_may_be_the_stiffest() -> None:
    back = SAMPLE_TEXT.replace("*SEABED SUCTION", "*SEABED UNLOADING\n SET=Clay\n STIFFNESS={}\n*SEABED SUCTION")
    scene = legal_scene(back.format("4.0E5"))
    found, _ = find_contacts(scene)
    one = next(contact for contact in found if contact.name == "unloading of curve:Soft Clay on Clay")
    assert one.omega == pytest.approx((4e5 / MASS) ** 0.5, rel=1e-12)
    assert measure(scene, one, SCHEMES["velocity-verlet"]).as_predicted
    softer, _ = find_contacts(legal_scene(back.format("1.0E5")))
    assert [other.name for other in softer] == [other.name for other in find_contacts(sample_scene())[0]]


def test_the_continued_end_may_be_the_steepest() -> None:
    found, _ = find_contacts(curved(" -2, -30\n -1, -10\n"))
    curve = next(one for one in found if one.name == "curve:Soft Clay on Clay")
    assert curve.stiffness == pytest.approx(20.0 / 0.3)
    assert 0.0 < curve.reach <= curve.depth


@pytest.mark.parametrize(("extra", "expected"), [("", ["24.29"]), (" 99, 1, 77\n", [])])
def test_a_stiffness_of_nodes_counts_for_the_step(extra: str, expected: list[str]) -> None:
    """The last node carries half of an element, 1 m; a deck whose nodes are not known has no step to tell of."""
    text = SAMPLE_TEXT.replace(" SMOOTHING=AUTO", " NODAL STIFFNESS=1.0E5").replace(" FRICTION=", "C ")
    text = text.replace(" STIFFNESS=Soft Clay", " STIFFNESS=1.0")
    text = text.replace(" 1, 1, 2\n GEN=1, 10\n", f" 1, 1, 2\n GEN=1, 10\n{extra}")
    text += "*TIME\n STEP=FIXED\n 0.0, 120.0, 0.1, 24.0\n"
    findings = lint_bytes(text.encode(), "deck.keyxm", select(["STB002"]))
    assert [found.message.partition("omega = ")[2][:5] for found in findings] == expected


@pytest.mark.parametrize(("stiffness", "omega"), [("4.0E5", (4e5 / MASS) ** 0.5), ("1.0E3", FRICTION)])
def test_unloading_counts_for_the_step_where_it_is_stiffer(stiffness: str, omega: float) -> None:
    text = f"{SAMPLE_TEXT}*TIME\n STEP=FIXED\n 0.0, 120.0, 0.1, 24.0\n"
    text = text.replace("$LOAD CASE", f"*SEABED UNLOADING\n SET=Clay\n STIFFNESS={stiffness}\n$LOAD CASE")
    (found,) = lint_bytes(text.encode(), "deck.keyxm", select(["STB002"]))
    assert f"omega = {omega:.4g} rad/s" in found.message


@pytest.mark.parametrize("step", ["0.1", "0.0163", "0.0164"])
def test_a_restart_is_reported_the_step_that_does_on_the_bed_of_its_static_deck(tmp_path: Path, step: str) -> None:
    (tmp_path / "static.keyxm").write_text(SAMPLE_TEXT, encoding="utf-8")
    dynamic = f"$LOAD CASE\n*RESTART\n LAST=static\n*TIME\n STEP=FIXED\n 0.0, 120.0, {step}, 24.0\n"
    path_ = tmp_path / "dynamic.keyxm"
    findings = lint_bytes(dynamic.encode(), path_.as_posix(), select(["STB002"]), folder=tmp_path)
    if step == "0.0163":
        assert findings == []
        return
    assert [(found.code, found.line, found.column) for found in findings] == [("STB002", 6, 14)]
    assert "(friction on Sand, node 11, line 28 of static.keyxm, omega = 30.6 rad/s)" in findings[0].message
    assert "give a step of 0.0163 or less" in findings[0].message


@pytest.mark.parametrize("name", STEPPED)
def test_schemes_do_on_contacts_what_is_predicted(name: str, measured: dict[tuple[str, str], Measured]) -> None:
    for contact in find_contacts(sample_scene())[0]:
        found = measured[contact.name, name]
        assert found.as_predicted
        if 0.0 < found.predicted < np.inf:
            if not contact.rate:
                assert found.predicted == pytest.approx(CRITICAL_OMEGA_DT[name] / contact.omega)
            assert found.measured == pytest.approx(found.predicted, rel=0.0076 if contact.rate else 0.0051)
            assert (found.below, found.above, len(found.tried)) == (BOUNDED, GROWS, len(SHARES))


def test_the_schemes_and_the_rules_have_the_same_limits() -> None:
    limits = {name: CRITICAL_OMEGA_DT.get(name, np.inf) for name in SCHEMES}
    assert limits == {name: scheme.limit for name, scheme in SCHEMES.items()}


@pytest.mark.untraced
@pytest.mark.parametrize("family", ["segment width", "tiny linear stiffness", "huge curve ratios"])
def test_contacts_of_extreme_decks_are_stepped_as_predicted_or_left_out(
    family: str, judged: dict[tuple[str, str], Judgement]
) -> None:
    stepped = 0
    for cell in all_cells():
        if cell.family != family or not judged[cell.family, cell.value].results:
            continue
        scene = legal_scene(cell.text)
        for contact in filter(can_oscillate, find_contacts(scene)[0]):
            stepped += 1
            for name in ("rk2", "newmark"):
                assert measure(scene, contact, SCHEMES[name]).as_predicted, (cell.value, name)
    assert stepped > 1


def test_a_step_that_is_not_as_predicted_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = {"central-difference": 2.2, "rk4": 1.0}
    monkeypatch.setattr(contacts, "critical_step", lambda scheme, omega, _: wrong[scheme] / omega)
    scene = sample_scene()
    contact = next(one for one in find_contacts(scene)[0] if one.oscillation.kind == "normal")
    early = measure(scene, contact, SCHEMES["central-difference"])
    assert (early.as_predicted, early.below, early.above) == (False, GROWS, GROWS)
    assert early.measured == pytest.approx(2.0 / contact.omega, rel=0.0051)
    never = measure(scene, contact, SCHEMES["rk4"])
    assert not never.as_predicted
    assert np.isnan(never.measured)


@pytest.mark.parametrize("share", [0.985, 1.015])
def test_a_critical_step_that_is_a_little_off_is_seen(monkeypatch: pytest.MonkeyPatch, share: float) -> None:
    """At 0.99 and 1.01 of what is predicted, and no farther away from it."""
    monkeypatch.setattr(contacts, "critical_step", lambda _scheme, omega, _rate: share * 2.0 / omega)
    scene = sample_scene()
    contact = next(one for one in find_contacts(scene)[0] if one.oscillation.kind == "normal")
    assert not measure(scene, contact, SCHEMES["central-difference"]).as_predicted
