"""The files that `mudline evaluate` reads besides the deck."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import isfinite
from pathlib import Path
from typing import TypeVar

import click

from mudline.cli.terminal import reason
from mudline.results.against import Reference, read_reference
from mudline.results.evaluation import Evaluation
from mudline.scene.external import ExternalElements, read_external
from mudline.scene.model import Scene
from mudline.scene.positions import Positions, read_positions

_Read = TypeVar("_Read")


def read_elements(path: str) -> ExternalElements:
    """The elements of a CSV file."""
    return _read(path, read_external)


def read_positions_of(path: str, scene: Scene, time_step: float | None) -> Positions:
    """Positions of a scene's nodes; with `time_step` those without times get them."""
    positions = _read(path, lambda file: read_positions(file, scene.nodes))
    if time_step is None:
        return positions
    if not (isfinite(time_step) and time_step > 0.0):
        raise click.UsageError(f"--time-step is {time_step!r}: it must be greater than 0")
    if positions.time is None or positions.timed:
        what = "has times of its own" if positions.timed and positions.time is not None else "is one state"
        raise click.UsageError(f"--time-step is for positions without times: {path} {what}")
    return replace(positions, time=positions.time * time_step, timed=True)


def read_against(path: str, evaluation: Evaluation) -> Reference:
    """Element results to compare with."""
    return _read(path, lambda file: read_reference(file, evaluation))


def _read(path: str, read: Callable[[Path], _Read]) -> _Read:
    try:
        return read(Path(path))
    except OSError as error:
        raise click.ClickException(f"{path}: {reason(error)}") from error
