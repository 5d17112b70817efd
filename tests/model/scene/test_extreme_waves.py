"""Seas whose height no number holds."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.language.deck.loading import load_bytes
from mudline.model.scene.load_case import top_motion
from mudline.model.scene.model import resolve
from tests.helpers.builders.decks import CLEAN


@pytest.mark.parametrize("values", ["1e-200, 0.01, 3.3", "0.1, -0.01, 3.3", "0.1, 0.01, -3.3", "1e-300, 1e300, 3.3"])
def test_a_sea_of_a_spectrum_without_a_height_is_no_wave(values: str) -> None:
    deck = f"{CLEAN}$LOAD CASE\n*WAVE-JONSWAP\n FREQUENCY=AREA\n {values}, 0.01, 0.5, 100, 1\n"
    found = top_motion(resolve(load_bytes(deck.encode(), "deck.keyxm")), "a", np.array([1.0, 0.0]))
    assert found.heave == 1.0
    assert found.source.startswith("assumed")
