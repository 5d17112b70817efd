"""Features of a deck other than the normal law of its elements, with their lines, and the advice that follows."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, NamedTuple

import numpy as np

from mudline.codes import RUN001
from mudline.diagnostics import Problem, Where
from mudline.scene.model import Scene
from mudline.study import file_of
from mudline.study.pages import Tables, grouped_digits, listed, rounded, time
from mudline.study.pruning.calls import STEP, STREAM
from mudline.study.pruning.scenes import AS_IT_IS
from mudline.study.report import Layout, Section, columns_of

_BY_KEYWORD = {
    "SEABED CONTACT": "smoothing or nodal springs",
    "SEABED FRICTION": "friction",
    "SEABED SUCTION": "suction",
    "SEABED UNLOADING": "unloading",
    "SEABED TRENCH": "trench",
}
_REMEMBER = {"friction", "lateral springs", "suction", "unloading"}
_BY_VALUE = {"friction": "friction", "lateral": "lateral springs", "suction": "suction springs"}


class Feature(NamedTuple):
    """A law that some elements have; the first line of the deck that gives it to one of them, 0 for none.

    remembers: a step depends on the one before.
    file: of the line, in a deck that is continued; "" for the deck itself.
    """

    name: Annotated[str, "feature"]
    line: Annotated[int, "deck line"]
    elements: Annotated[int, "elements"]
    remembers: Annotated[bool, "remembers"]
    file: Annotated[str, "deck file"]


FEATURES = Layout("features", "What the deck has besides normal laws", columns_of(Feature), brief=False)


def study_features(scene: Scene) -> Section:
    """The features of a deck, in the order of its lines."""
    return Section([FEATURES.table(sorted(_features(scene), key=lambda feature: feature.line))])


def _features(scene: Scene) -> Iterator[Feature]:
    for keyword, extension in scene.extensions.items():
        at = extension.of_element[extension.of_element >= 0]
        if at.size and keyword in _BY_KEYWORD:
            yield _feature(scene, _BY_KEYWORD[keyword], extension.places[int(at.min())], at.size)
    resistance = scene.resistance
    for column, name in _BY_VALUE.items():
        values = resistance.column(column)
        given = np.isfinite(values) if values.ndim == 1 else np.isfinite(values).any(axis=1)
        at = resistance.of_element[given & (resistance.of_element >= 0)]
        if at.size:
            yield _feature(scene, name, resistance.places[int(at.min())].inside(column), at.size)


def _feature(scene: Scene, name: str, where: Where, elements: int) -> Feature:
    line = scene.deck.place(Problem(RUN001, "", where=where)).line
    return Feature(name, line, elements, name in _REMEMBER, file_of(scene, where))


def advice(tables: Tables) -> str:
    """How to call the evaluator on the deck, and because of which lines."""
    own = tables.row("stages", scene=AS_IT_IS)
    step, times = time(1e-9 * own.number("time [ns/node/step]")), rounded(own.number("times the curve's"))
    cost = f"a step costs {step} a node, {times} times one with a curve and nothing else"
    if own.text("steps") == "together":
        return f"Use stream or evaluate for a series, because no law of this deck remembers the step before: {cost}."
    names = [f"{row.text('feature')} ({row.place()})" for row in tables.rows("features", remembers="true")]
    laws, remember = (
        (listed(names), "remember" if len(names) > 1 else "remembers") if names else ("its laws", "remember")
    )
    series = [
        max(
            tables.rows("calls", scene=AS_IT_IS, call=call), key=lambda row: (row.number("steps"), -row.number("nodes"))
        )
        for call in (STEP, STREAM)
    ]
    one, together = (row.number("median time [ns/node/step]") for row in series)
    return (
        f"Use stream for a series, because {laws} {remember} the step before: {cost}, and called with step alone on "
        f"{grouped_digits(series[0].number('nodes'))} nodes {rounded(one / together)} times as much as with stream."
    )
