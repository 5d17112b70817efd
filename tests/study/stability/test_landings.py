"""Landings at every phase of a step, and the figures to compare with."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mudline.curves import ForceCurve
from mudline.study.laws import CurveLaw
from mudline.study.schemes import SCHEMES
from mudline.study.stability.landings import (
    FEW_PHASES,
    LANDING_SCHEMES,
    LINEAR_FALL,
    NEVER,
    OMEGA_DTS,
    PHASES,
    Fall,
    Landing,
    envelope,
    landing,
    rebounds,
)


def test_landings_agree_with_the_figures_computed_independently(landed: list[Landing]) -> None:
    assert len(landed) == len(LANDING_SCHEMES) * len(OMEGA_DTS)
    compared = [one for one in landed if one.compared]
    assert len(compared) == 33
    assert all(one.agrees for one in compared)
    assert np.isnan(landing(SCHEMES["velocity-verlet"], 10.0).mean)


def test_only_two_implicit_schemes_gain_next_to_nothing(landed: list[Landing]) -> None:
    """Generalised-alpha with rho = 0 gains 7.6e-5 at omega dt = 0.0316 and 1.2e-4 at 0.0567, which is not nothing."""
    gains = {one.scheme.name for one in landed if one.largest > 1.0 + 1e-4 and not one.scheme.explicit}
    implicit = {name for name in LANDING_SCHEMES if not SCHEMES[name].explicit}
    assert implicit - gains == {"generalised-alpha-0", "backward-euler"}
    small = landing(SCHEMES["generalised-alpha-0"], 0.0316)
    assert small.largest == pytest.approx(1.0000755, abs=5e-8)
    found = envelope(SCHEMES["generalised-alpha-0"], LINEAR_FALL, np.array([0.0567]))
    assert 1e-4 < found.largest[0] - 1.0 < NEVER


@pytest.mark.parametrize(("omega_dt", "largest"), [(1.1, 1.17), (1.5, 1.25), (1.9, 2.61), (1.99, 2.96)])
def test_velocity_verlet_lands_badly_before_it_is_unstable(
    omega_dt: float, largest: float, landed: list[Landing]
) -> None:
    (one,) = [one for one in landed if (one.scheme.name, one.omega_dt) == ("velocity-verlet", omega_dt)]
    assert one.largest == pytest.approx(largest, abs=0.006)


def test_landings_keep_their_speed_up_to_the_limit_and_no_further() -> None:
    """Beside the limit of Newmark's scheme, 0.296, with more phases than the limit was found with."""
    tried = np.pi / np.arange(12.0, 9.0, -0.1)
    found = envelope(SCHEMES["newmark"], LINEAR_FALL, tried)
    assert found.below == found.within == pytest.approx(0.296, abs=0.001)
    beyond = tried[tried > found.below]
    assert np.nanmax(rebounds(SCHEMES["newmark"], LINEAR_FALL, beyond, PHASES)) > 1.01
    assert rebounds(SCHEMES["newmark"], LINEAR_FALL, tried[tried <= found.below], PHASES).max() < 1.0101
    assert np.isnan(envelope(SCHEMES["backward-euler"], LINEAR_FALL, tried).within)


def test_landings_on_a_force_at_ratio_0_need_smaller_steps() -> None:
    """The force jumps to its first value at the mudline: every scheme is of first order there."""
    smooth, jump = (
        Fall(CurveLaw("", ForceCurve([(0.0, first), (1.0, 1000.0 + first)]), 1.0), 1.0, 1.0, 0.03, math.sqrt(1000.0))
        for first in (0.0, 50.0)
    )
    tried = np.array([0.03, 0.06, 0.12])
    losses = [
        np.abs(rebounds(SCHEMES["newmark"], fall, tried, FEW_PHASES) - 1.0).max(axis=1) for fall in (smooth, jump)
    ]
    assert losses[1][0] > 10.0 * losses[0][0]
    assert losses[1][2] / losses[1][0] == pytest.approx(4.0, rel=0.35)


def test_schemes_have_no_envelope_beyond_their_critical_step() -> None:
    nothing = envelope(SCHEMES["velocity-verlet"], LINEAR_FALL, np.array([3.0]))
    assert nothing.omega_dt.size == 0
    assert np.isnan(nothing.below)
