"""Command `mudline batch`: many decks or load cases evaluated, with a row and a result file for each."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import click
from click.core import ParameterSource
from pydantic import TypeAdapter

from mudline.basics.files import remove_left
from mudline.basics.limits import SHOWN_ROWS
from mudline.basics.overwriting import claim, reading
from mudline.basics.quantities import csv_lines
from mudline.basics.short_repr import counted
from mudline.cli import DONE, FOUND, evaluate_inputs, options
from mudline.cli.batch_cases import (
    SUMMARY,
    BatchCase,
    Done,
    Order,
    check_positions,
    evaluate_case,
    failed,
    named_cases,
    positions_of,
    print_cases,
)
from mudline.cli.evaluate_inputs import EvaluateInputs, takes_inputs
from mudline.cli.inputs import STDIN, GivenDecks, Input, Inputs, many_files, takes_decks
from mudline.cli.result_files import is_installed, require_library
from mudline.cli.streams import emit, emit_json, make_folder, notify, write_text, writing
from mudline.cli.view import View
from mudline.model.results.cases import CASES, CaseSummary, worst_first, write_parquet
from mudline.tools.running.executors import check_address
from mudline.tools.running.remembered import Memory, state

_MEMORY = ".mudline-batch"
"""File in the result folder that records the inputs of each result."""
_REMEMBERED = TypeAdapter(Done)


@options.command("batch")
@takes_inputs(
    "Read the positions of the nodes from one file for all decks, from a folder with a file NAME.csv, .npz or .npy for "
    "each deck, or by a pattern such as {folder}/{name}.csv."
)
@evaluate_inputs.summary_only
@options.output_option(
    "-o",
    "--output",
    required=True,
    metavar="DIR",
    help="Write a result file for each deck and the rows as summary.parquet into this folder.",
)
@options.output_option(
    "--form",
    type=click.Choice(["csv", "json", "npz", "parquet"]),
    help="Write result files in this form (default: Parquet, or NPZ where pyarrow is not installed).",
)
@options.output_format("text", "json", "csv")
@evaluate_inputs.fail_on
@options.jobs
@options.run_option(
    "--scheduler",
    metavar="ADDRESS",
    help="Use the workers of a Dask scheduler: tcp://HOST:PORT or tls://HOST:PORT (needs mudline[cluster]).",
)
@options.run_option("--no-cache", is_flag=True, help="Evaluate every deck again, also those with results in DIR.")
@takes_decks("DECKS...", stdin=False)
def command(
    *,
    inputs: EvaluateInputs,
    decks: GivenDecks,
    output: str,
    form: str | None,
    output_format: str,
    fail_on: str,
    jobs: int,
    scheduler: str | None,
    no_cache: bool,
    view: View,
) -> int:
    """Evaluate many decks or load cases. Each has a row: failed decks first, then by largest force.

    DECKS are files or directories (searched for *.keyx, *.keyxm, *.keyxi, *.das). Decks that have not changed since
    their results in DIR were written are not evaluated again.
    """
    if scheduler is not None:
        if click.get_current_context().get_parameter_source("jobs") is not ParameterSource.DEFAULT:
            raise click.UsageError("--jobs is for processes without --scheduler: leave one of them out")
        check_address(scheduler)
    if STDIN in decks.paths:
        raise click.UsageError("- is one deck, from standard input: mudline evaluate takes it")
    form = form or ("parquet" if is_installed("parquet") else "npz")
    require_library(form)
    check_positions(inputs.positions)
    selected = decks.collect()
    if not selected.files:
        return selected.code
    once: dict[str, Input] = {}
    for file in selected.files:  # a file may be given by several names
        once.setdefault(os.path.abspath(file.place), file)  # noqa: PTH100 - links stay what they are called
    selected.files = list(once.values())
    common, cases = named_cases(selected.files, form, inputs.tables)
    folder = Path(output)
    make_folder(folder)
    for path in (_summary_path(folder), *(folder / result for case in cases for result in case.results)):
        claim(path)
    memory = Memory(folder / _MEMORY, repr((inputs, decks.units, form)))
    order = Order(cases[0], b"", inputs, folder, decks.units)
    done, taken = _evaluated(selected, cases, order, memory, view, fresh=no_cache, jobs=jobs, scheduler=scheduler)
    ranked = worst_first(result.row for result in done)
    summary = _write_summary(ranked, folder)
    if not view.quiet:
        _notify_warnings(done)
        evaluated = counted(sum(not row.failed for row in ranked), "deck")
        notify(f"results of {evaluated} -> {folder.as_posix()}, {taken} taken over from an earlier run")
        notify(f"summary -> {summary}")
    if output_format == "json":
        emit_json([row.row() for row in ranked])
    elif output_format == "csv":
        emit(_csv(ranked))
    else:
        print_cases(ranked, common, {case.file.name: case.inside for case in cases}, view)
    failing = any(row.failed or (row.warnings and fail_on == "warning") for row in ranked)
    return max(selected.code, FOUND if failing else DONE)


# --------------------------------------------------------------------------------------------------------- evaluating


_Task = tuple[Input, str, Sequence[str], Done | None]
"""A deck, the key of its results, the files that it depends on, and a result that needs no work."""


def _evaluated(
    decks: Inputs,
    cases: Sequence[BatchCase],
    first: Order,
    memory: Memory,
    view: View,
    *,
    fresh: bool,
    jobs: int,
    scheduler: str | None,
) -> tuple[list[Done], int]:
    """Evaluate the decks; return all results, and how many came from an earlier run.

    New results are remembered, also if the run is interrupted; half-written files are then removed.

    A deck fails if it cannot be read, if it has no positions, or if the program fails.
    """
    case_of = {case.file: case for case in cases}

    def prepared(file: Input) -> tuple[_Task, tuple[Order] | None]:
        case, given, data = case_of[file], first.inputs, file.read()
        try:
            positions = positions_of(case, given.positions)
        except click.ClickException as error:
            return (file, "", (), failed(file.name, error.message)), None
        files = [path for path in (positions, given.elements) if path]
        for path in files:
            reading(path)
        key = memory.key(file.name, case.results[0], data, *files)
        if not fresh and (known := _known(memory, key, file, first.output)):
            return (file, key, (), known), None
        order = first._replace(case=case, data=data, inputs=replace(given, positions=positions))
        near = [os.path.abspath(path) for path in files]  # noqa: PTH100 - links stay what they are
        return (file, key, near, None), (order if scheduler is None else order.from_anywhere(),)

    done: dict[Input, Done] = {}
    taken = 0
    results = many_files(decks, prepared, evaluate_case, view, jobs=jobs, scheduler=scheduler)
    try:
        with closing(results):
            for (file, key, near, known), result in results:
                if result is not None:
                    done[file] = result
                    if not result.row.failed:
                        held = _REMEMBERED.dump_python(result._replace(read=()), mode="json")
                        memory.put(key, held, [*result.read, *near])
                elif known is not None:
                    done[file] = known
                    taken += not known.row.failed
    except BaseException:
        for place in {(first.output / case.results[0]).parent for case in cases}:
            remove_left(str(place))  # half-written files of processes that were ended
        raise
    finally:
        memory.save()
    return [done.get(file) or failed(file.name, decks.undone[file]) for file in decks.files], taken


# -------------------------------------------------------------------------------------------------------- remembering


def _known(memory: Memory, key: str, file: Input, output: Path) -> Done | None:
    """Return the result of an earlier run, if its result files are still unchanged."""
    try:
        done = _REMEMBERED.validate_python(memory.get(key))
    except ValueError:  # nothing, or what this program does not write
        return None
    unchanged = all(state(str(output / name)) == mark for name, mark in done.written.items())
    return done if unchanged and done.row.deck == file.name and not done.row.failed else None


# ------------------------------------------------------------------------------------------------------------ output


def _write_summary(rows: Sequence[CaseSummary], folder: Path) -> str:
    """Write the rows of all decks, in Parquet if installed, else as CSV. Return the path."""
    path = _summary_path(folder)
    if path.suffix == ".parquet":
        with writing(path) as stream:
            write_parquet(rows, stream)
    else:
        write_text(path, _csv(rows))
    return path.as_posix()


def _summary_path(folder: Path) -> Path:
    return folder / f"{SUMMARY}.{'parquet' if is_installed('parquet') else 'csv'}"


def _csv(rows: Sequence[CaseSummary]) -> Iterator[str]:
    return csv_lines([CASES, *(row.row().values() for row in rows)])


def _notify_warnings(done: Sequence[Done]) -> None:
    """Report each warning once, with the first deck that has it and the number of the others."""
    decks: dict[str, list[str]] = {}
    for result in done:
        for code, text in dict(result.warnings).items():
            decks.setdefault(code, []).append(text)
    for texts in list(decks.values())[:SHOWN_ROWS]:
        more = f" ({counted(len(texts) - 1, 'more deck')})" if len(texts) > 1 else ""
        notify(f"warning: {texts[0]}{more}")
