"""Landings at every phase of a step, and the figures to compare with."""

from __future__ import annotations

import numpy as np

from mudline.study.schemes import SCHEMES
from mudline.study.stability.landings import LANDING_SCHEMES, OMEGA_DTS, Landing, landing


def test_landings_agree_with_the_figures_computed_independently(landed: list[Landing]) -> None:
    assert len(landed) == len(LANDING_SCHEMES) * len(OMEGA_DTS)
    compared = [one for one in landed if one.compared]
    assert len(compared) == 33
    assert all(one.agrees for one in compared)
    assert np.isnan(landing(SCHEMES["velocity-verlet"], 10.0).mean)


def test_only_two_implicit_schemes_never_gain_energy(landed: list[Landing]) -> None:
    gains = {one.scheme.name for one in landed if one.largest > 1.0 and not one.scheme.explicit}
    implicit = {name for name in LANDING_SCHEMES if not SCHEMES[name].explicit}
    assert implicit - gains == {"generalised-alpha-0", "backward-euler"}
