"""Critical steps that are really stepped."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.contact.stiffest import CRITICAL_OMEGA_DT
from mudline.study.sample import sample_scene
from mudline.study.schemes import SCHEMES
from mudline.study.stability import critical
from mudline.study.stability.contacts import find_contacts
from mudline.study.stability.critical import BOUNDED, GROWS, SHARES, can_oscillate, measure
from mudline.study.stability.ladder.cells import all_cells
from mudline.study.stability.ladder.judging import judge
from tests.builders.scenes import legal_scene


@pytest.mark.parametrize("name", ["central-difference", "rk4", "newmark", "backward-euler", "rk2", "forward-euler"])
def test_schemes_do_on_contacts_what_is_predicted(name: str) -> None:
    scene = sample_scene()
    for contact in find_contacts(scene)[0]:
        found = measure(scene, contact, SCHEMES[name])
        assert found.as_predicted
        if 0.0 < found.predicted < np.inf:
            assert found.predicted == pytest.approx(CRITICAL_OMEGA_DT[name] / contact.omega)
            assert found.measured == pytest.approx(found.predicted, rel=0.0051)
            assert (found.below, found.above, len(found.tried)) == (BOUNDED, GROWS, len(SHARES))


def test_the_schemes_and_the_rules_have_the_same_limits() -> None:
    limits = {name: CRITICAL_OMEGA_DT.get(name, np.inf) for name in SCHEMES}
    assert limits == {name: scheme.limit for name, scheme in SCHEMES.items()}


@pytest.mark.untraced
@pytest.mark.parametrize("family", ["segment width", "tiny linear stiffness", "huge curve ratios"])
def test_contacts_of_extreme_decks_are_stepped_as_predicted_or_left_out(family: str) -> None:
    stepped = 0
    for cell in all_cells():
        if cell.family != family or not judge(cell).results:
            continue
        scene = legal_scene(cell.text)
        for contact in filter(can_oscillate, find_contacts(scene)[0]):
            stepped += 1
            for name in ("rk2", "newmark"):
                assert measure(scene, contact, SCHEMES[name]).as_predicted, (cell.value, name)
    assert stepped > 1


def test_a_step_that_is_not_as_predicted_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(critical, "CRITICAL_OMEGA_DT", {"central-difference": 2.2, "rk4": 1.0})
    scene = sample_scene()
    contact = find_contacts(scene)[0][0]
    early = measure(scene, contact, SCHEMES["central-difference"])
    assert (early.as_predicted, early.below, early.above) == (False, GROWS, GROWS)
    assert early.measured == pytest.approx(2.0 / contact.omega, rel=0.0051)
    never = measure(scene, contact, SCHEMES["rk4"])
    assert not never.as_predicted
    assert np.isnan(never.measured)
