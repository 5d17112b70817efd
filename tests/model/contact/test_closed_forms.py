"""A mass that falls on the seabed, and one that bounces: closed solutions."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mudline.model.contact import ContactModel
from mudline.model.contact.arrays import FloatArray
from tests.helpers.builders.contact import at_depths, chain, on

pytestmark = pytest.mark.slow

MASS, G, K = 500.0, 9.81, 5e4


def fall(speed: float, gravity: float, dt: float) -> tuple[FloatArray, FloatArray]:
    """Depths and forces of a mass that meets the seabed at a speed, until it has left it."""
    contact = ContactModel(chain([], on("nodal", 1, stiffness=K)))
    z, v, force = 0.0, speed, 0.0
    depths, forces = [], []
    while z >= 0.0:
        v += 0.5 * dt * (gravity - force / MASS)
        z += dt * v
        force = float(contact.evaluate(at_depths([z])).reaction[0, 0])
        v += 0.5 * dt * (gravity - force / MASS)
        depths.append(z)
        forces.append(force)
    return np.array(depths), np.array(forces)


def test_a_mass_that_falls_on_the_seabed() -> None:
    depths, forces = fall(0.5, G, 5e-4)
    still = MASS * G / K
    assert depths.max() == pytest.approx(still + math.sqrt(still**2 + MASS * 0.5**2 / K), rel=1e-5)
    assert depths.max() == pytest.approx(0.20820726588, rel=1e-5)
    assert forces.max() == pytest.approx(10410.363294, rel=1e-5)


def test_a_mass_without_weight_that_bounces() -> None:
    depths, _ = fall(0.5, 0.0, 5e-4)
    assert depths.max() == pytest.approx(0.05, rel=1e-5)
    assert len(depths) * 5e-4 == pytest.approx(0.31415926536, abs=6e-4)


EI, SPRING, LOAD = 2e7, 1e5, 1e4
