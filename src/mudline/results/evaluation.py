"""A scene evaluated at positions: the arrays of the evaluator beside the names of the deck."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from mudline.codes import RUN001
from mudline.contact import ContactModel, ContactResult, ElementError, PositionError
from mudline.diagnostics import DeckError, Problem, Where
from mudline.scene.model import Scene
from mudline.scene.numbering import Floats
from mudline.scene.positions import Positions

Tension = Literal["keep", "cut"]


@dataclass(frozen=True, slots=True)
class Evaluation:
    """A scene, its evaluator, the result for all steps (steps, ...), and the times (steps,) when there are any."""

    scene: Scene
    model: ContactModel
    result: ContactResult
    time: Floats | None
    lengths_from_positions: int = 0

    @property
    def skipped(self) -> int:
        """Elements without a position of both nodes."""
        return int((~self.result.evaluated).sum())

    def law_names(self, step: int) -> list[str]:
        """The law of every element at a step; `curve-cut` where a pulling curve was cut."""
        cut = self.result.cut[step].tolist()
        return ["curve-cut" if is_cut else name for name, is_cut in zip(self.scene.law_names, cut, strict=True)]


def evaluate_scene(scene: Scene, positions: Positions | None = None, tension: Tension = "keep") -> Evaluation:
    """Evaluate a scene at its own coordinates or at positions from a file.

    Raises DeckError: errors in the deck, elements without known nodes or coordinates, a value that overflows.
    """
    scene.require()
    _require_elements(scene)
    scene, filled = _with_lengths(scene, positions)
    try:
        model = scene.contact(tension)
        if positions is None:
            result = model.evaluate(scene.coordinates[np.newaxis])
        else:
            result = model.evaluate(positions.values, present=positions.present)
    except ElementError as error:
        raise _located(scene, str(error), error.element) from error
    except PositionError as error:
        raise _refusal(scene, str(error)) from error
    return Evaluation(scene, model, result, positions.time if positions else None, filled)


def _require_elements(scene: Scene) -> None:
    if not len(scene.element_ids):
        definers = scene.set_table.context.definers
        hint = f": they come from *{definers[0]}, which is not read; give them with --elements" if definers else ""
        raise _refusal(scene, f"the deck has no elements to evaluate{hint}")
    lost = np.flatnonzero((scene.element_nodes < 0).any(axis=1))
    if lost.size:
        message = f"{lost.size} elements end at nodes that are not known: give the elements with --elements"
        raise _located(scene, message, int(scene.element_ids[lost[0]]))


def _with_lengths(scene: Scene, positions: Positions | None) -> tuple[Scene, int]:
    """Lengths that the deck's coordinates do not give come from the first step of the positions."""
    unknown = np.isnan(scene.length)
    if not unknown.any():
        return scene, 0
    coordinates = scene.coordinates if positions is None else positions.values[0]
    ends = np.asarray(coordinates, dtype=np.float64)[scene.element_nodes[unknown]]
    length = scene.length.copy()
    with np.errstate(over="ignore", invalid="ignore"):
        length[unknown] = np.sqrt(((ends[:, 1] - ends[:, 0]) ** 2).sum(axis=1))
    present = np.ones(len(scene.node_ids), dtype=bool) if positions is None else positions.present
    needed = unknown & present[scene.element_nodes].all(axis=1)
    bad = np.flatnonzero(needed & ~np.isfinite(length))
    if bad.size:
        message = "the nodes of an element have no coordinates: give them with --positions"
        raise _located(scene, message, int(scene.element_ids[bad[0]]))
    length[np.isnan(length)] = 0.0
    return replace(scene, table=replace(scene.table, length=length)), int(needed.sum())


def _refusal(scene: Scene, message: str, where: Where | None = None) -> DeckError:
    return DeckError(scene.deck.diagnose([Problem(RUN001, message, where=where)]))


def _located(scene: Scene, message: str, element: int) -> DeckError:
    index = int(np.flatnonzero(scene.element_ids == element)[0])
    return _refusal(scene, message, scene.table.numbered.where(index))
