"""`mudline evaluate`."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import cast

import click

from mudline.cli import options
from mudline.cli.exits import DONE
from mudline.cli.guard import refuses_bad_decks
from mudline.cli.inputs import load, reason
from mudline.cli.lazy import printing
from mudline.cli.options import View
from mudline.cli.terminal import tell
from mudline.cli.writing import write
from mudline.results.evaluation import Evaluation, Tension, evaluate_scene
from mudline.results.formats import csv_text, json_text, npz_bytes, plan_rows
from mudline.scene.build import resolve
from mudline.scene.external import ExternalElements, read_external
from mudline.scene.model import Scene
from mudline.scene.positions import Positions, read_positions

_MOST_ROWS = 40


@click.command("evaluate")
@options.deck
@click.option("--positions", metavar="FILE", help="Positions of the nodes: CSV, NPZ or NPY, one state or time steps.")
@click.option("--elements", metavar="FILE", help="Elements as CSV, for decks whose elements come from *LINES.")
@click.option(
    "--tension",
    type=click.Choice(["keep", "cut"]),
    default="keep",
    show_default=True,
    help="Where a curve is negative in contact: keep the pull, or cut force and stiffness to 0.",
)
@click.option(
    "-o", "--output", metavar="OUT.csv|json|npz", help="Write the results; CSV writes OUT-nodes.csv beside it."
)
@click.option("--plan", "plan_only", is_flag=True, help="Tell what the scene needs and what was left out, and why.")
@click.option(
    "--table",
    type=click.Choice(["elements", "nodes"]),
    default="elements",
    show_default=True,
    help="Which rows text and CSV on standard output show.",
)
@options.output_format("text", "json", "csv")
@options.units
@options.common
@refuses_bad_decks
def command(
    *,
    deck: str,
    positions: str | None,
    elements: str | None,
    tension: str,
    output: str | None,
    plan_only: bool,
    table: str,
    output_format: str,
    units: str | None,
    view: View,
) -> int:
    """Contact forces and stiffnesses of a deck, at its own coordinates or at positions from a file.

    Forces are per unit length, in the deck's units; reactions are the total force of the bed on a node.
    """
    suffix = _output_suffix(output)
    scene = resolve(load(deck, units=units), _read_elements(elements) if elements else None)
    if plan_only:
        return _plan(scene.require(), output_format, view, cast("Tension", tension))
    given = _read_positions(positions, scene) if positions else None
    evaluation = evaluate_scene(scene, given, cast("Tension", tension))
    if not view.quiet:
        _notes(evaluation, given)
    if output:
        _write(evaluation, Path(output), suffix, quiet=view.quiet)
    elif output_format == "json":
        sys.stdout.writelines(json_text(evaluation))
    elif output_format == "csv":
        sys.stdout.writelines(csv_text(evaluation, table))
    else:
        most = None if view.verbose else _MOST_ROWS
        printing("evaluate").print_evaluation(evaluation, table, view.color, most)
    return DONE


def _output_suffix(output: str | None) -> str:
    if output is None:
        return ""
    suffix = Path(output).suffix.lower()
    if suffix not in {".csv", ".json", ".npz"}:
        raise click.UsageError(f"{output}: results are written as .csv, .json or .npz")
    return suffix


def _read_elements(path: str) -> ExternalElements:
    try:
        return read_external(Path(path))
    except OSError as error:
        raise click.UsageError(f"{path}: {reason(error)}") from error


def _read_positions(path: str, scene: Scene) -> Positions:
    scene.require()
    try:
        return read_positions(Path(path), scene.nodes)
    except OSError as error:
        raise click.UsageError(f"{path}: {reason(error)}") from error


def _notes(evaluation: Evaluation, given: Positions | None) -> None:
    """What a reader of the results should know."""
    if given is not None and given.missing:
        tell(f"no positions for {given.missing} nodes: {evaluation.skipped} elements are left out")
    if evaluation.lengths_from_positions:
        tell(f"the lengths of {evaluation.lengths_from_positions} elements come from the first positions")
    for stage in evaluation.model.plan:
        if "not evaluated in this version" in stage.why:
            tell(f"{stage.stage}: {stage.why}")


def _plan(scene: Scene, form: str, view: View, tension: Tension) -> int:
    plan = scene.contact(tension).plan
    if form == "json":
        click.echo(json.dumps({"units": scene.units, "plan": plan_rows(plan)}, indent=1))
        return DONE
    printing("evaluate").print_plan(plan, view.color)
    return DONE


def _write(evaluation: Evaluation, path: Path, suffix: str, *, quiet: bool) -> None:
    if suffix == ".npz":
        write(path, npz_bytes(evaluation))
    elif suffix == ".json":
        write(path, "".join(json_text(evaluation)).encode())
    else:
        write(path, "".join(csv_text(evaluation, "elements")).encode())
        nodes = path.with_name(f"{path.stem}-nodes{path.suffix}")
        write(nodes, "".join(csv_text(evaluation, "nodes")).encode())
        if not quiet:
            tell(f"nodes -> {nodes.as_posix()}")
    if not quiet:
        tell(f"{evaluation.scene.deck.file} -> {path.as_posix()}")
