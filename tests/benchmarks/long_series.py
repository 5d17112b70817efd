"""What `evaluate --summary-only` takes for very long series: python -m tests.benchmarks.long_series [-o FILE.csv]

Series of 10^7 and 10^8 node-steps are made (1.2 GB as float32, in a temporary folder), and summarised in a process of
its own each: of a scene without history by one process and by two, of a scene with friction by one. A row says what was
measured; the rows of 10^9 node-steps are extrapolated from those of 10^8, and say so.
"""

from __future__ import annotations

import argparse
import csv
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np

from mudline.deck.loading import load_path
from mudline.scene.model import resolve
from tests.benchmarks.runner import ROOT

DECK = ROOT / "samples" / "scr-touchdown.keyxm"
OUT = ROOT / "docs" / "studies" / "long-series.csv"
SIZES = (10**7, 10**8)
PLANNED = 10**9

_CASES = (("all steps at once", 1), ("all steps at once", 2), ("friction", 1))
"""Scenes and processes."""
_BLOCK = 1000
_PAUSE = 0.05
"""Seconds between two looks at the memory."""


class Row(NamedTuple):
    """What a run took.

    `peak_mb` is the memory of all its processes together, in 10^6 bytes, shared pages twice; `load` the mean number of
    processes that were running or waiting in the minute before, on a machine with `processors`.
    """

    scene: str
    processes: int
    node_steps: int
    nodes: int
    steps: int
    file_mb: float
    seconds: float
    cpu_seconds: float
    peak_mb: float
    load: float
    processors: int
    kind: str


def made(path: Path, node_steps: int) -> tuple[int, int]:
    """Write a series in which the line heaves and its touchdown point moves; return its nodes and steps."""
    places = resolve(load_path(DECK)).coordinates
    nodes = len(places)
    steps = node_steps // nodes
    series = np.lib.format.open_memmap(path, "w+", np.float32, (steps, nodes, 3))
    for start in range(0, steps, _BLOCK):
        step = np.arange(start, min(start + _BLOCK, steps))[:, np.newaxis]
        heave = 0.5 * np.sin(2.0 * np.pi * step / 97.3) * np.linspace(1.0, 0.0, nodes) + 0.1 * np.sin(step / 13.7)
        series[start : start + _BLOCK] = places
        series[start : start + _BLOCK, :, 0] += heave
    series.flush()
    return nodes, steps


def measured(deck: Path, series: Path, processes: int) -> tuple[float, float, float]:
    """Seconds by the clock, processor seconds, and peak memory in 10^6 bytes of a run."""
    options = ["--summary-only", "--jobs", str(processes), "--no-cache", "-q", "-o", str(series.with_suffix(".json"))]
    words = [sys.executable, "-m", "mudline", "evaluate", str(deck), "--positions", str(series), *options]
    start, peak = time.perf_counter(), 0.0
    before = os.times()
    with subprocess.Popen(words, start_new_session=True) as process:
        while process.poll() is None:
            peak = max(peak, sum(_resident(process.pid)))
            time.sleep(_PAUSE)
    after = os.times()
    if process.returncode not in {0, 1}:
        raise SystemExit(f"{' '.join(words[2:5])} ended with {process.returncode}")
    used = after.children_user + after.children_system - before.children_user - before.children_system
    return time.perf_counter() - start, used, peak / 1e6


def _resident(session: int) -> Iterator[float]:
    """The bytes of each process of a session that are in memory."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            fields = (folder / "stat").read_text().rpartition(")")[2].split()
        except OSError:  # it has ended
            continue
        if int(fields[3]) == session:
            yield int(fields[21]) * os.sysconf("SC_PAGE_SIZE")


def extrapolated(row: Row, node_steps: int) -> Row:
    """What so many node-steps would take at the rate of a run, with 8 bytes more in each process for each step more."""
    steps = node_steps // row.nodes
    times = steps / row.steps
    holders = row.processes if row.processes == 1 else row.processes + 1
    return row._replace(
        node_steps=steps * row.nodes,
        steps=steps,
        file_mb=row.file_mb * times,
        seconds=row.seconds * times,
        cpu_seconds=row.cpu_seconds * times,
        peak_mb=row.peak_mb + holders * 8e-6 * (steps - row.steps),
        kind="extrapolated",
    )


def rows_of(sizes: Sequence[int], folder: Path) -> list[Row]:
    """Measure all sizes of all scenes, and extrapolate."""
    text = DECK.read_text(encoding="utf-8")
    decks = {"friction": text, "all steps at once": "".join(_without_friction(text))}
    found: dict[tuple[str, int], list[Row]] = {case: [] for case in _CASES}
    for size in sizes:
        series = folder / f"{size}.npy"
        nodes, steps = made(series, size)
        for scene, processes in _CASES:
            deck = folder / f"{scene.replace(' ', '-')}.keyxm"
            deck.write_text(decks[scene], encoding="utf-8")
            busy = os.getloadavg()[0], os.cpu_count() or 1
            taken = measured(deck, series, processes)
            file = series.stat().st_size / 1e6
            found[scene, processes].append(
                Row(scene, processes, nodes * steps, nodes, steps, file, *taken, *busy, "measured")
            )
        series.unlink()
    return [row for rows in found.values() for row in (*rows, extrapolated(rows[-1], PLANNED))]


def _without_friction(text: str) -> Iterator[str]:
    return (line for line in text.splitlines(keepends=True) if "FRICTION=" not in line)


def main() -> None:
    """Measure, and write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("-o", "--output", type=Path, default=OUT)
    parser.add_argument("--sizes", type=float, nargs="+", default=SIZES, help="node-steps of the series")
    options = parser.parse_args()
    with TemporaryDirectory() as folder:
        rows = rows_of([int(size) for size in options.sizes], Path(folder))
    with options.output.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(Row._fields)
        writer.writerows([f"{value:.4g}" if isinstance(value, float) else value for value in row] for row in rows)


if __name__ == "__main__":
    main()
