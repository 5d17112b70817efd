"""A scene evaluated at positions: arrays of the evaluator with the names of the deck."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from mudline.basics.short_repr import counted, cut, outline
from mudline.language.codes.lines import SYN009
from mudline.model.contact import ContactModel, ElementError, LawKind, PositionError
from mudline.model.contact.arrays import Positions, StepReader
from mudline.model.contact.columns import ResultTable, by_number
from mudline.model.contact.result import ResultPart
from mudline.model.contact.touchdown import Touchdown, result_table
from mudline.model.scene.deck_values import unread_makers
from mudline.model.scene.mesh import distances
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Mask, distinct
from mudline.model.scene.weights import contents_case, left_out, pipe_of

Tension = Literal["keep", "cut"]
PositionSource = Literal["deck", "file", "rest shape"]
Prepared = tuple[Scene, ContactModel, int]
"""A scene with all lengths, its evaluator, and the number of lengths taken from the first positions."""

_HISTORY = "this deck has laws whose result depends on the steps before, which need ascending times"


class ResultConsumer(Protocol):
    """Consumer of the results of a few steps at a time."""

    def take(self, part: ResultPart) -> None:
        """Take some steps."""


@dataclass(frozen=True)
class Evaluation:
    """A scene, its evaluator, and the positions (steps, n, 3) to evaluate; `present` (n,) are nodes with a position.

    Nothing is evaluated before `parts` is called. `time` (steps,) is None for a single state without a time.
    """

    scene: Scene
    model: ContactModel
    positions: NDArray[np.floating] | StepReader
    present: Mask
    time: Floats | None = None
    velocities: NDArray[np.floating] | None = None
    lengths_from_positions: int = 0
    source: PositionSource = "file"
    """Source of the positions; the deck's own coordinates are rarely a solved shape."""
    notes: tuple[str, ...] = ()
    """Sentences about a resting shape."""

    def __repr__(self) -> str:
        elements, nodes = counted(len(self.elements), "element"), counted(len(self.nodes), "node")
        size = f"{self.scene.units}, {counted(self.steps, 'step')}, {elements}, {nodes}"
        return outline(f"Evaluation of {cut(self.scene.deck.file, 80)!r}", size)

    @property
    def steps(self) -> int:
        """Number of steps; 1 for a single state."""
        return len(self.positions)

    @cached_property
    def elements(self) -> Indices:
        """Indices of the evaluated elements, whose two nodes have positions."""
        return np.flatnonzero(self.evaluated)

    @property
    def evaluated(self) -> Mask:
        """The evaluated elements (m,)."""
        return np.asarray(self.present[self.scene.element_nodes].all(axis=1))

    @cached_property
    def weights_without(self) -> list[str]:
        """Weights in the deck that the weights here leave out; a resting shape leaves out masses at nodes."""
        return left_out(self.scene, with_masses=self.source != "rest shape")

    @cached_property
    def contents_case(self) -> int | None:
        """Number of the load case whose contents the weights have; None if all load cases have the same."""
        return contents_case(self.scene)

    @cached_property
    def nodes(self) -> Indices:
        """Indices of the nodes that have a position, in ascending order of their numbers."""
        return by_number(self.model.input, self.present)

    @property
    def has_seabed_law(self) -> bool:
        """True if a law of the seabed acts on an evaluated element, or springs of the seabed on nodes."""
        scene = self.scene
        lawful = (scene.law[self.elements] != LawKind.NONE).any() or not self.elements.size
        return bool(lawful or scene.nodal.any() or "SEABED SUCTION" in scene.extensions)

    @cached_property
    def lines(self) -> Indices:
        """Indices of the lines with an evaluated element."""
        return distinct(self.model.input.lines.of_element[self.elements])

    @cached_property
    def touchdown(self) -> Touchdown:
        """Finder of the touchdown of the lines in the results of some steps."""
        return Touchdown(self.model.input)

    def table(self, name: str) -> ResultTable:
        """Return the rows of the evaluated "elements", the "nodes" with a position, or the lines ("summary").

        Those of a line are touchdown, largest forces, reaction and weight.
        """
        return result_table(self.model.input, name, self.evaluated, self.present)

    def run(self, consumers: Sequence[ResultConsumer], done: Callable[[int], None] = lambda _: None) -> None:
        """Evaluate all steps once and pass the results on; `done` is called with the number of steps of each part.

        Raises the exceptions of `parts` and of the consumers.
        """
        for part in self.parts():
            for consumer in consumers:
                consumer.take(part)
            done(part.count)

    def parts(self) -> Iterator[ResultPart]:
        """Evaluate a few steps at a time; memory does not grow with the number of steps.

        Raises DeckError: a position that is not finite, a value that overflows.
        """
        clock = self.time if self.model.input.needs_velocities else None
        with as_deck_errors(self.scene):
            for part in self.model.stream(
                self.positions, present=self.present, velocities=self.velocities, times=clock
            ):
                times = None if self.time is None else self.time[part.steps]
                yield part if times is None else ResultPart(part.start, replace(part.result, times=times))


def evaluate_scene(
    scene: Scene,
    positions: Positions | None = None,
    tension: Tension = "keep",
    *,
    at_rest: Sequence[str] | None = None,
) -> Evaluation:
    """Return a scene ready to be evaluated at its own coordinates, or at positions from a file or of a resting shape.

    `at_rest` has the sentences about a resting shape, whose weight includes contents; None for other positions.

    Raises DeckError: errors in the deck, elements without known nodes or coordinates, times that a law cannot use.
    """
    if positions is None:
        missing = np.isnan(scene.require_evaluable(tension).coordinates).any(axis=1)
        if missing.any():
            example = int(scene.node_ids[np.argmax(missing)])
            message = f"{int(missing.sum())} nodes have no coordinates, node {example} is one"
            raise scene.refusal(f"{message}: give them with --positions")
    complete, model, filled = prepare(scene, positions, tension)
    if at_rest is not None:
        model = ContactModel(replace(model.input, weight=pipe_of(scene).weight))
    used = positions or Positions(scene.coordinates[np.newaxis], np.ones(len(scene.nodes), dtype=bool), None)
    if model.plan.history:
        _require_clock(complete, model.input.needs_velocities, used)
    return Evaluation(
        complete,
        model,
        used.values,
        used.present,
        used.time,
        used.velocities,
        filled,
        source="deck" if positions is None else "file" if at_rest is None else "rest shape",
        notes=tuple(at_rest or ()),
    )


def prepare(scene: Scene, positions: Positions | None = None, tension: Tension = "keep") -> Prepared:
    """Return a scene with its evaluator.

    Raises DeckError: errors in the deck, elements without known nodes.
    """
    require_elements(scene.require_evaluable(tension))
    complete, filled = _with_lengths(scene, positions)
    with as_deck_errors(complete):
        return complete, complete.contact(tension), filled


@contextmanager
def as_deck_errors(scene: Scene) -> Iterator[None]:
    """Raise errors of the evaluator as errors of the deck, at the line of the element or node."""
    try:
        yield
    except ElementError as error:
        raise scene.refusal(str(error), element=error.element) from error
    except PositionError as error:
        raise scene.refusal(str(error), node=error.node) from error


def require_elements(scene: Scene) -> None:
    """Raise DeckError for a scene without elements, or with elements that end at unknown nodes."""
    definers = scene.set_table.context.external_definers
    if not len(scene.element_ids):
        hint = _maker_hint(definers, "ELEMENT")
        unknown = sum(problem.code == SYN009 for problem in scene.deck.problems)
        if unknown and not hint:  # a keyword of the elements may be among them
            hint = f": {counted(unknown, 'unknown keyword')}, `mudline lint` names them"
        raise scene.refusal(f"the deck has no elements to evaluate{hint}")
    dangling = np.flatnonzero((scene.element_nodes < 0).any(axis=1))
    if dangling.size:
        count = f"{dangling.size} elements end" if dangling.size > 1 else "an element ends"
        message = f"{count} at nodes that are not known{_maker_hint(definers, 'NODE')}"
        raise scene.refusal(message, scene.table.numbered.where(int(dangling[0])))


def _maker_hint(definers: Sequence[str], keyword: str) -> str:
    makers = unread_makers(definers, keyword)
    names = " or ".join(f"*{maker}" for maker in makers or definers[:1])
    why = "may make them, and is not read" if makers else "is about lines that may make them"
    return f": {names} {why}; give them to `mudline evaluate --elements`" if names else ""


def _with_lengths(scene: Scene, positions: Positions | None) -> tuple[Scene, int]:
    """Return the scene with lengths that the deck's coordinates do not give, and their number.

    They come from the first step of the positions; unknown lengths are 0.
    """
    unknown = np.isnan(scene.length)
    if not unknown.any():
        return scene, 0
    places = scene.coordinates if positions is None else np.asarray(positions.values[0], dtype=np.float64)
    ends = places[scene.element_nodes[unknown]]
    between = distances(ends[:, 0], ends[:, 1])
    length = scene.length.copy()
    length[unknown] = np.where(np.isnan(between), 0.0, between)
    return replace(scene, table=scene.table._replace(length=length)), int((~np.isnan(between)).sum())


def _require_clock(scene: Scene, needing: Sequence[str], positions: Positions) -> None:
    """Raise DeckError for times or velocities that a law with a history cannot use.

    Steps need ascending times; the laws `needing` velocities need these, or times.
    """
    if positions.time is None or len(positions.time) < 2:
        return
    laws = needing if positions.velocities is None else []
    if not positions.timed:
        if laws:
            message = f"{laws[0]} needs velocities, or the times of the steps: the positions have neither"
            raise scene.refusal(message)
        return
    falls = np.flatnonzero(np.diff(positions.time) <= 0.0)
    if falls.size:
        before, after = positions.time[falls[0] : falls[0] + 2].tolist()
        what = f"{laws[0]} needs velocities, or ascending times" if laws else _HISTORY
        raise scene.refusal(f"{what}: {after!r} follows {before!r}")
