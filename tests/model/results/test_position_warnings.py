"""What an evaluation warns of in positions that it is given: gaps, other lengths, rounding."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.model.contact.arrays import Positions
from mudline.model.results.evaluation import evaluate_scene
from mudline.model.results.warnings import ContactWatch, caption
from tests.helpers.builders.scenes import legal_scene
from tests.model.results.test_warnings import LAW, heights, pipe, watched


def test_elements_without_positions_are_counted() -> None:
    scene = legal_scene(pipe(LAW))
    places = heights(-0.02)
    present = np.arange(11) != 3  # node 3
    places[:, ~present] = np.nan
    evaluation = evaluate_scene(scene, Positions(places, present, None))
    evaluation.run([watch := ContactWatch(evaluation)])
    (found,) = watch.warnings()
    assert found.row() == {
        "code": "RUN007",
        "message": "no positions for 1 node: 2 elements (first: 2) are left out",
        "line": 1,
        "elements": 2,
        "first": 2,
    }
    assert caption([found]) == ""


def test_distances_that_are_not_the_lengths_of_elements() -> None:
    places = heights(-0.02)
    places[0, 5, 2] += 1.5
    (found,) = watched(pipe(LAW), places)[0]
    assert (found.diagnostic.code, found.elements, found.first) == ("RUN006", 2, 4)
    assert found.diagnostic.message.startswith(
        "the ends of 2 of 10 elements are over a tenth nearer or further apart than the element is long (first: 4, "
        "11.5 instead of 10)"
    )
    places[0, 5, 2] -= 0.6
    assert watched(pipe(LAW), places)[0] == []


@pytest.mark.parametrize(
    ("digits", "mobilisation", "expected"),
    [
        (2, 0.0027, "2 decimals, and rounding them makes up to all of the friction, which 0.0027 mobilise: give 5"),
        (
            3,
            0.0027,
            "3 decimals, and rounding them makes up to 19 % of the friction, which 0.0027 mobilise: give 5",
        ),
        (4, 0.0027, ""),
        (3, 0.01, ""),
        (3, 0.0099, "up to 5.1 %"),
        (17, 0.0027, ""),
    ],
)
def test_rounding_that_makes_the_friction(digits: int, mobilisation: float, expected: str) -> None:
    places = heights(-0.02)
    places[0, :, 2] += 0.01 * np.sin(np.arange(11.0))
    places[0, :, 1] = 0.1 * np.cos(np.arange(11.0))
    law = f"{LAW} FRICTION=0.35, 0.6, {mobilisation}, 0.1\n"
    told = [one.diagnostic for one in watched(pipe(law), places.round(digits))[0]]
    assert [one.code for one in told] == ["RUN008"] * bool(expected)
    assert all(expected in one.message for one in told)


def test_caption_is_one_short_line() -> None:
    two = watched(pipe(LAW.replace("50000", "900000") + " SET=East\n FRICTION=0.3, 0.5\n"))[0]
    assert caption(two) == "2 warnings: reaction / submerged weight 38.4; 5 elements in contact without a seabed law"
    assert caption([]) == ""
    assert len(caption(two * 9)) <= 90
