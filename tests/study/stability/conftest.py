"""What the studies of stability find, computed once: the study of the sample and the tests of its parts share it."""

from __future__ import annotations

import pytest

from mudline.study import sample_scene
from mudline.study.schemes import SCHEMES
from mudline.study.stability import critical, landings, statics
from mudline.study.stability.contacts import find_contacts
from mudline.study.stability.critical import Measured
from mudline.study.stability.families import all_cells, judge
from mudline.study.stability.judging import Judgement
from mudline.study.stability.landings import Landing
from mudline.study.stability.statics import CycleCount

STEPPED = ("central-difference", "rk4", "newmark", "backward-euler", "forward-euler")
"""Schemes of each kind, which are stepped on every contact of the sample."""


@pytest.fixture(scope="session")
def measured() -> dict[tuple[str, str], Measured]:
    """Some schemes on every contact of the sample, by the names of both."""
    scene = sample_scene()
    contacts, _ = find_contacts(scene)
    return {
        (contact.name, name): critical.measure(scene, contact, SCHEMES[name])
        for contact in contacts
        for name in STEPPED
    }


@pytest.fixture(scope="session")
def judged() -> dict[tuple[str, str], Judgement]:
    """The verdict on every cell of the ladder, by family and value."""
    return {(cell.family, cell.value): judge(cell) for cell in all_cells()}


@pytest.fixture(scope="session")
def landed() -> list[Landing]:
    """Every scheme that lands at every step."""
    return landings.landings()


@pytest.fixture(scope="session")
def cycles() -> list[CycleCount]:
    """How often Newton's method does not end on friction."""
    return statics.cycle_counts()
