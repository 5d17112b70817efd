"""The pictures of the documentation show what they say, and are the same each time they are drawn."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from mudline.model.contact.laws.suction import SuctionState
from mudline.model.results.plot_data import Cycle
from tests.docs import soil_loop
from tests.docs.full_cycle import cycle
from tests.docs.layer_picture import layer_picture
from tests.docs.pictures import IMAGES, ROOT, write


@pytest.fixture(scope="module")
def path() -> Cycle:
    return cycle(ROOT / "samples")


def test_suction_begins_at_the_trench_bottom_and_ends_at_breakout(path: Cycle) -> None:
    """z_p = z_max - F_max / ku; Delta_B = 0.98 D v^0.26; F_max = 1.12 D cu (v / D)^0.18."""
    bottom = 100.0 - 3769.5276 / 250.0
    pulled = path.penetration[path.state == SuctionState.SUCTION]
    assert pulled.max() == pytest.approx(bottom, abs=0.5)
    assert pulled.min() == pytest.approx(bottom - 980.0 * 0.4064 * 0.01**0.26, abs=0.5)
    assert path.force.min() == pytest.approx(-1.12 * 0.4064 * 2.0 * (0.01 / 0.4064) ** 0.18, rel=1e-9)


def test_the_loop_of_the_soil_pushes_and_pulls_within_its_bounds() -> None:
    """Of the sample: s_u = 2 + 1.5 z kPa, f_suc = 0.6, and at most 1.5 times 6 kN/m3 of displaced soil."""
    found = soil_loop.loop(ROOT / "samples")
    z = np.maximum(found.penetration, 0.0) * 1e-3
    ratio = z / 0.3239
    factor = 6.0 * np.maximum(ratio, 0.1) ** 0.25 * np.sqrt(np.minimum(10.0 * ratio, 1.0))
    most = factor * (2.0 + 1.5 * z) * 0.3239
    assert (found.force <= most + 9.0 * 0.3239**2 * np.pi / 4.0).all()
    assert (found.force >= -0.6 * most).all()
    assert found.force.max() > 2.0
    assert found.force.min() < -0.5


@pytest.mark.covered
def test_all_pictures_are_made_and_no_others(tmp_path: Path) -> None:
    write(tmp_path)
    made = {file.name for file in tmp_path.iterdir() if file.stat().st_size > 10_000}
    elsewhere = {"report-dark.png", "report-light.png", "vscode.png"}
    assert made == {file.name for file in IMAGES.iterdir()} - elsewhere, (
        "those are drawn by make bench, and in a browser; that of the editor is a screenshot"
    )


@pytest.mark.covered
def test_boxes_of_the_layers_do_not_overlap() -> None:
    found = re.findall(r'<rect x="(-?\d+)" y="(\d+)" width="(\d+)"', layer_picture())
    boxes = sorted((int(y), int(x), int(x) + int(width)) for x, y, width in found)
    assert len(boxes) > 15
    assert boxes[0][1] >= 0
    assert [(left, right) for left, right in pairwise(boxes) if left[0] == right[0] and left[2] >= right[1]] == []
