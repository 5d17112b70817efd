"""Suction that lets go: how stiff a structure must be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mudline.contact.laws.suction import SuctionLaw
from mudline.study.sample import TEXT, sample_scene
from mudline.study.stability.release import equilibria, releases
from tests.builders.scenes import legal_scene


def test_one_equilibrium_needs_the_stiffness_that_is_given() -> None:
    scene = sample_scene()
    suction = scene.contact_input().assigned["suction"]
    found = releases(scene, suction)
    assert [one.velocity for one in found] == [1e-3, 1e-2, 0.1, 1.0]
    assert found[2].needed == pytest.approx(42662.876092, rel=1e-10)
    assert {one.equilibria for one in found} == {(3, 3, 1, 1)}
    assert equilibria(SuctionLaw(*suction.columns).rows(slice(0, 1)), 0.1, 1e9) == 1


def test_the_release_is_that_of_a_first_uplift() -> None:
    """A factor that is applied once per cycle is not applied yet; elements that differ in it alone have one law."""
    scene = sample_scene()
    given = scene.contact_input().assigned["suction"]
    found = releases(scene, given)
    weaker = replace(given, parameters={**given.parameters, "cyclic": np.full(7, 0.5)})
    assert releases(scene, weaker)[2].needed == pytest.approx(0.5 * found[2].needed)
    per_cycle = {"cyclic": np.array([0.0, *np.full(6, 0.5)]), "cyclic_floor": np.full(7, 0.2)}
    assert releases(scene, replace(given, parameters={**given.parameters, **per_cycle})) == found


def test_suction_of_no_force_asks_for_nothing() -> None:
    scene = legal_scene(TEXT.replace("COHESION=5.0E3", "COHESION=0"))
    suction = scene.contact_input().assigned["suction"]
    assert releases(scene, suction) == []
