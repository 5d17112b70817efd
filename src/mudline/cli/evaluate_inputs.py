"""Inputs of `evaluate` and `batch`: the scene of a deck, and positions and elements from files."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeVar

import click

from mudline.api import Scene as PublicScene
from mudline.api import read_positions
from mudline.basics.overwriting import reading
from mudline.checks.engine import naming_causes
from mudline.cli.options import ABOVE_ZERO, Adding, flag, gathered, input_option, option
from mudline.cli.streams import naming
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import unquoted
from mudline.model.contact.arrays import Positions
from mudline.model.results.evaluation import Evaluation, Prepared, Tension, evaluate_scene, prepare
from mudline.model.results.forms import TABLES
from mudline.model.results.series import SERIES
from mudline.model.scene.csv_file import read_external
from mudline.model.scene.model import Scene, resolve
from mudline.model.scene.positions import COLUMNS

_MAPPING = re.compile(r"""\s*(\w+)\s*=\s*("[^"]*"|.*?)\s*(?:,(?=\s*\w+\s*=)|,?\s*$)""", re.DOTALL)
"""NAME=HEADING up to a comma that is followed by another name: a heading may contain commas."""

_Read = TypeVar("_Read")


@dataclass(frozen=True)
class EvaluateInputs:
    """Inputs of an evaluation; `positions` is a file, for `batch` also a folder or a pattern."""

    tension: Tension = "keep"
    positions: str | None = None
    elements: str | None = None
    time_step: float | None = None
    headings: Mapping[str, str] = field(default_factory=dict)
    rest_shape: bool = False
    summary_only: bool = False

    def __post_init__(self) -> None:
        if self.headings and self.positions is None:
            raise click.UsageError("--columns is for positions from a CSV: give --positions too")
        if self.rest_shape and self.positions is not None:
            raise click.UsageError("--rest-shape is a shape of its own: leave --positions out")

    @property
    def tables(self) -> Sequence[str]:
        """Names of the tables of the results."""
        return SERIES if self.summary_only else TABLES

    def scene(self, deck: Deck) -> Scene:
        """Return the scene of a deck; raises DeckError with the causes that prevent evaluation."""
        external = read_file(self.elements, read_external) if self.elements else None
        with naming_causes(deck):
            return resolve(deck, external).require_evaluable(self.tension)

    def evaluation(self, deck: Deck) -> Evaluation:
        """Return the evaluation of a deck at positions of a file or its own. Raises DeckError, click.ClickException."""
        scene = self.scene(deck)
        if self.rest_shape:
            from mudline.tools.touchdown_study.rest_shape import rest_shape  # noqa: PLC0415 - few runs ask for it

            rest = rest_shape(scene)
            return evaluate_scene(scene, rest.positions, self.tension, at_rest=rest.sentences(scene.units))
        return evaluate_scene(scene, self._placed(scene), self.tension)

    def prepared(self, deck: Deck) -> Prepared:
        """Return the evaluator of a deck, for its plan. Raises DeckError, click.ClickException."""
        scene = self.scene(deck)
        return prepare(scene, self._placed(scene), self.tension)

    def _placed(self, scene: Scene) -> Positions | None:
        """Return the positions of a scene's nodes, with times from `time_step` if they have none."""
        path = self.positions
        if path is None:
            return None
        if self.headings and Path(path).suffix.lower() in {".npz", ".npy"}:
            raise click.UsageError(f"--columns is for CSV: the arrays of {path} have names already")
        positions = read_file(path, lambda file: read_positions(file, PublicScene(scene), columns=self.headings))
        if self.time_step is None:
            return positions
        if positions.time is None or positions.timed:
            what = "has times of its own" if positions.timed and positions.time is not None else "is one state"
            raise click.UsageError(f"--time-step is for positions without times: {path} {what}")
        return replace(positions, time=positions.time * self.time_step, timed=True)


def takes_inputs(positions_help: str) -> Adding:
    """Add the options about the inputs; they reach the command as `inputs`, an EvaluateInputs."""
    positions = input_option("--positions", metavar="FILE", help=positions_help)
    return gathered("inputs", EvaluateInputs, positions, *_INPUTS)


_INPUTS = (
    input_option(
        "--columns",
        "headings",
        multiple=True,
        callback=lambda _context, _option, given: read_headings(given),
        metavar="NAME=HEADING,...",
        help='Headings of positions in a CSV of another program: time="Time [s]",node=Node,x=X. Repeatable.',
    ),
    input_option(
        "--time-step",
        type=ABOVE_ZERO,
        metavar="DT",
        help="Set the time between the steps of positions without times.",
    ),
    input_option(
        "--elements", metavar="FILE", help="Read the elements from a CSV, for decks whose elements come from *LINES."
    ),
    input_option(
        "--rest-shape",
        is_flag=True,
        help="Evaluate the resting shape: lines hang and lie under weight and contents alone, without a load case.",
    ),
    option(
        "--tension",
        type=click.Choice(["keep", "cut"]),
        default="keep",
        show_default=True,
        help="Where a curve is negative in contact: keep the tension, or cut force and stiffness to 0.",
    ),
)

summary_only = flag(
    "--summary-only", help="Of a long series, keep only extremes with their times, counts and envelopes."
)

fail_on = option(
    "--fail-on",
    type=click.Choice(["error", "warning"]),
    default="error",
    show_default=True,
    help="Exit with 1 for errors only, or also for warnings about the results.",
)


def read_file(path: str, read: Callable[[Path], _Read]) -> _Read:
    """Return the content of a file as read by `read`; ends the command if the file cannot be read."""
    reading(path)
    with naming(path):
        return read(Path(path))


def read_headings(given: Sequence[str]) -> dict[str, str]:
    """Return headings of position columns from texts such as `time="Time [s]",node=Node`; raises click.UsageError."""
    headings: dict[str, str] = {}
    for text in given:
        place = 0
        while place < len(text) or not text:
            match = _MAPPING.match(text, place)
            if match is None or not (heading := unquoted(match[2])):
                raise click.UsageError(f'--columns {text!r}: expected NAME=HEADING, as in node=Node,x="X [m]"')
            name, place = match[1].lower(), match.end()
            if name not in COLUMNS:
                names = f"{', '.join(COLUMNS[:-1])} or {COLUMNS[-1]}"
                raise click.UsageError(f"--columns: {match[1]!r} is not a column of positions: use {names}")
            if name in headings:
                raise click.UsageError(f"--columns gives {name} twice")
            headings[name] = heading
    return headings
