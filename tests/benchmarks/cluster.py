"""Runs on a cluster of two workers on loopback: python -m tests.benchmarks.cluster [--decks N] [--cases N]

10^4 decks and 10^3 load cases of one deck with positions, one of the workers killed half-way, and an archive of 10^4
decks, compared with a run without a cluster; strong and weak scaling; what a chunk costs beside its work. Writes
docs/scaling.json, from which `python -m tests.benchmarks.scaling` makes docs/scaling.md. Takes some minutes.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from hashlib import blake2b
from pathlib import Path
from statistics import median

import numpy as np

from mudline.cluster.running import Item, Job, Made, Run, Store
from mudline.cluster.scheduler import Scheduler, connected
from tests.archive.trial import contents
from tests.benchmarks.decks import apart
from tests.cluster.processes import ROOT, Processes, running, wait_until

FIGURES = ROOT / "docs" / "scaling.json"
NODES = 101
STEPS = 200
_ROUNDS = 2
_CHUNKS = 400


class Timed:
    """A command as a process of its own: how long it took, and what it printed."""

    def __init__(self, folder: Path, *words: str) -> None:
        path = os.pathsep.join([str(ROOT / "src"), str(ROOT)])
        environment = {**os.environ, "PYTHONPATH": path, "MUDLINE_CACHE_DIR": str(folder / "cache")}
        start = time.perf_counter()
        done = subprocess.run(
            [sys.executable, "-m", "mudline", *words], env=environment, cwd=folder, capture_output=True, check=False
        )
        self.seconds = time.perf_counter() - start
        self.code, self.out, self.err = done.returncode, done.stdout, done.stderr.decode()
        assert self.code in (0, 1), self.err


def write_decks(folder: Path, count: int) -> None:
    """Decks that differ from each other."""
    folder.mkdir()
    for number in range(count):
        (folder / f"{number:05}.keyxm").write_text(apart(number), encoding="utf-8")


def write_cases(folder: Path, count: int) -> None:
    """Copies of a deck of one pipe, each with positions of its nodes in time steps."""
    folder.mkdir()
    nodes = "".join(f" {i}, -0.05, {2.0 * (i - 1)}\n" for i in range(1, NODES + 1))
    elements = "".join(f" {i}, {i}, {i + 1}\n" for i in range(1, NODES))
    deck = (
        f"$MODEL\n*OCEAN\n 100.0, 1025.0, 9.81\n*NODE\n{nodes}*ELEMENT\n{elements}"
        "*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0.5, 0.46, 7850.0\n"
        "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n"
        "*SEABED STIFFNESS\n CURVE=Clay\n 0.0, 0.0\n 0.1, 1200.0\n 0.5, 3000.0\n"
    )
    shape = np.zeros((STEPS, NODES, 3))
    shape[:, :, 1] = 2.0 * np.arange(NODES)
    wave = np.sin(np.linspace(0.0, 20.0, STEPS))[:, None]
    for number in range(count):
        shape[:, :, 0] = -0.05 + 0.05 * wave * np.linspace(0.0, 1.0 + number / count, NODES)
        (folder / f"{number:04}.keyxm").write_text(deck, encoding="utf-8")
        np.savez(folder / f"{number:04}.npz", positions=shape, time=0.1 * np.arange(STEPS))


def results_in(folder: Path) -> dict[str, str]:
    """A digest of each file of results."""
    files = sorted(path for path in folder.rglob("*.parquet"))
    return {path.relative_to(folder).as_posix(): blake2b(path.read_bytes()).hexdigest() for path in files}


def killed(cluster: Processes, chunks: Path, half: int, *words: str) -> tuple[Timed, int]:
    """A command with `-o`, one of whose workers is killed when half of its rows are there; and how many were."""
    found = 0

    def rows() -> int:
        return sum(path.read_bytes().count(b"\n") for path in chunks.glob("*.jsonl"))

    def kill() -> None:
        nonlocal found
        wait_until(lambda: rows() >= half, "no rows", 3600)
        found = rows()
        cluster.kill_worker()

    thread = threading.Thread(target=kill)
    thread.start()
    done = Timed(chunks.parents[1], *words, "--scheduler", cluster.address)
    thread.join()
    cluster.start_workers(2)
    return done, found


def nothing(_: object) -> Made:
    """Work that takes no time."""
    return Made(None)


def overhead(folder: Path) -> dict[str, float]:
    """Seconds for each chunk beside its work: of the client and the scheduler, and of writing and reading a file."""
    store = Store(str(folder / "empty"))
    (folder / "logs").mkdir()
    with running(folder / "logs", 2) as cluster, connected(Scheduler(cluster.address)) as client:
        figures = []
        for round_ in range(_ROUNDS):
            futures_start = time.perf_counter()
            client.gather([client.submit(time.sleep, 0, pure=False) for _ in range(_CHUNKS)])
            bare = (time.perf_counter() - futures_start) / _CHUNKS
            start = time.perf_counter()
            items = [Item(f"{round_} {number}", None) for number in range(_CHUNKS)]
            run = Run(lambda: client, Job("empty", nothing, items, len(items), store, fresh=True), cluster.address)
            run._pace.took(1, 1e6)  # one item makes a chunk
            run._pace.took = lambda *_: None  # type: ignore[method-assign]
            assert len(list(run.rows())) == _CHUNKS
            figures.append((bare, (time.perf_counter() - start) / _CHUNKS))
    return {"task": median(one for one, _ in figures), "chunk": median(one for _, one in figures)}


def series(folder: Path) -> dict[str, float | int]:
    """Seconds of evaluating a short and a long series of one deck in one process, for the cost of a node in a step."""
    found: dict[str, float | int] = {}
    write_cases(folder / "series", 1)
    positions = np.load(folder / "series" / "0000.npz")["positions"]
    for name, times in (("short", 1), ("long", 400)):
        path = folder / f"{name}.npz"
        np.savez(path, positions=np.tile(positions, (times, 1, 1)), time=0.1 * np.arange(times * STEPS))
        words = ("evaluate", "series", "--positions", str(path), "--jobs", "1", "-q")
        found[f"{name} node steps"] = times * STEPS * NODES
        found[f"{name} seconds"] = min(Timed(folder, *words).seconds for _ in range(1 + _ROUNDS))
    return found


def scaling(folder: Path, base: int) -> list[dict[str, float | int]]:
    """The same decks on one worker and on two, and twice as many on two: seconds of the whole command, in turn."""
    sizes = {"one": base, "two": 2 * base}
    for name, count in sizes.items():
        write_decks(folder / name, count)
    times: dict[tuple[int, int], list[float]] = {}
    for workers in (1, 2):
        (folder / f"logs-{workers}").mkdir()
    with running(folder / "logs-1", 1) as alone, running(folder / "logs-2", 2) as both:
        for round_ in range(2 + _ROUNDS):  # in the first one, the workers import what they need
            for name, count in sizes.items():
                for workers, cluster in ((1, alone), (2, both)):
                    taken = Timed(folder, "lint", name, "-q", "--scheduler", cluster.address).seconds
                    if round_:
                        times.setdefault((workers, count), []).append(taken)
    return [
        {"workers": workers, "decks": count, "seconds": min(found), "slowest": max(found)}
        for (workers, count), found in times.items()
    ]


def linted(folder: Path, count: int) -> dict[str, float | int]:
    """The decks with a killed worker, again with all that is done, and without a cluster; all print the same."""
    write_decks(folder / "decks", count)
    (folder / "logs").mkdir()
    words = ("lint", "decks", "--output-format", "json")
    with running(folder / "logs", 2) as cluster:
        alone = Timed(folder, *words, "--no-cache", "--jobs", "1")
        both, at = killed(cluster, folder / "out" / "chunks", count // 2, *words, "-o", "out/chunks")
        again = Timed(folder, *words, "-o", "out/chunks", "--scheduler", cluster.address)
    assert (both.out, both.code) == (again.out, again.code) == (alone.out, alone.code), "lint prints something else"
    files = len(list((folder / "out" / "chunks").iterdir()))
    times = {"alone": alone.seconds, "cluster": both.seconds, "again": again.seconds}
    return {"decks": count, **times, "killed at": at, "chunks": files}


def evaluated(folder: Path, count: int) -> dict[str, float | int]:
    """The load cases with a killed worker and without a cluster; both print and write the same."""
    write_cases(folder / "cases", count)
    (folder / "logs").mkdir()
    words = ("evaluate", "cases", "--positions", "cases", "--output-format", "json", "--form", "parquet")
    chunks = folder / "both" / ".mudline-chunks"
    with running(folder / "logs", 2) as cluster:
        alone = Timed(folder, *words, "-o", "alone", "--jobs", "1")
        both, at = killed(cluster, chunks, count // 2, *words, "-o", "both")
    assert (both.out, both.code) == (alone.out, alone.code), "evaluate prints something else"
    assert results_in(folder / "both") == results_in(folder / "alone"), "evaluate writes something else"
    times = {"alone": alone.seconds, "cluster": both.seconds}
    steps = count * NODES * STEPS
    return {"cases": count, "node steps": steps, **times, "killed at": at, "chunks": len(list(chunks.iterdir()))}


def indexed(folder: Path, count: int) -> dict[str, float | int]:
    """The decks into an archive, again with nothing to do, and without a cluster; all rows of all tables are equal."""
    write_decks(folder / "decks", count)
    (folder / "logs").mkdir()
    words = ("index", "decks", "--isolated", "-o")
    with running(folder / "logs", 2) as cluster:
        alone = Timed(folder, *words, "alone", "--jobs", "1")
        both = Timed(folder, *words, "both", "--scheduler", cluster.address)
        again = Timed(folder, *words, "both", "--scheduler", cluster.address)
    assert both.err == alone.err.replace("alone", "both"), "index reports something else"
    assert f"{count} unchanged" in again.err, again.err
    assert contents(folder / "both") == contents(folder / "alone"), "the archive holds something else"
    return {"decks": count, "alone": alone.seconds, "cluster": both.seconds, "again": again.seconds}


def main() -> None:
    """Measure and write the figures; parts that are left out keep theirs."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--decks", type=int, default=10_000, metavar="N")
    parser.add_argument("--cases", type=int, default=1000, metavar="N")
    parser.add_argument("--output", type=Path, default=FIGURES)
    parts: dict[str, Callable[[Path], object]] = {
        "lint": lambda folder: linted(folder, given.decks),
        "evaluate": lambda folder: evaluated(folder, given.cases),
        "index": lambda folder: indexed(folder, given.decks),
        "overhead": overhead,
        "series": series,
        "scaling": lambda folder: scaling(folder, max(2 * given.decks // 5, 10)),
    }
    parser.add_argument("--only", nargs="+", choices=parts, default=list(parts), help="measure these parts only")
    given = parser.parse_args()
    output: Path = given.output
    figures = json.loads(output.read_text(encoding="utf-8")) if output.exists() else {}
    figures["machine"] = f"{platform.machine()}, {os.cpu_count()} processors, Python {platform.python_version()}"
    figures |= {"load": os.getloadavg()[0], "steps": STEPS, "nodes": NODES}
    for part in given.only:
        with tempfile.TemporaryDirectory() as name:
            figures[part] = parts[part](Path(name))
        print(part, figures[part], flush=True)
        output.write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
