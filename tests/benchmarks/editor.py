"""Typing in an open deck: from a change that an editor sends to the findings that the server publishes for it.

`python -m tests.benchmarks.editor DECK CHANGES` prints the median of so many changes of a number, in seconds by the
clock, with the server's pause after a key in it.
"""

from __future__ import annotations

import re
import statistics
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Timer
from typing import TYPE_CHECKING

from tests.benchmarks.bench import Bench
from tests.benchmarks.decks import ALIKE
from tests.benchmarks.runner import ROOT, Job, cpu, figure

if TYPE_CHECKING:
    from tests.tools.lsp.raw import RawClient

LINES = (240, 20_000)
LONG = 800_000
PATIENCE = 120.0
"""Seconds by the clock in which the findings of a change have to come; a check that crashes publishes none."""
SLIPS = {
    " 9, -0.05, 40.0\n": " 9, -0.05, 4O.0\n",
    " 20, 20, 21\n": " 20, 20, 9021\n",
    "*GEOMETRIC SETS": "*GEOMETRC SETS",
    "*SEABED STIFFNESS": "SEABED STIFFNESS",
    "STIFFNESS=Clay": "STIFFNESS=Caly",
}
"""Five faults of `deck`: a letter in a number, a node that is not there, two misspelt names, a missing star."""


def deck(lines: int) -> str:
    """A line of elements on the seabed, with sets and a curve, of about so many lines."""
    count = (lines - len(ALIKE.splitlines()) - 5) // 2
    nodes = "".join(f" {i}, -0.05, {5 * (i - 1)}.0\n" for i in range(1, count + 2))
    elements = "".join(f" {i}, {i}, {i + 1}\n" for i in range(1, count + 1))
    return f"$MODEL\n*OCEAN\n 500.0, 1025.0, 9.81\n*NODE\n{nodes}*ELEMENT\n{elements}{ALIKE}"


def faulty(lines: int) -> str:
    """The same with five faults."""
    text = deck(lines)
    for right, wrong in SLIPS.items():
        text = text.replace(right, wrong, 1)
    return text


def run(bench: Bench) -> None:
    """Measure a change in decks of two lengths, in one with faults, and in a long one."""
    broken = (ROOT / "samples" / "broken.keyxm").read_text(encoding="utf-8")
    short = {f"typing {lines}": deck(lines) for lines in LINES}
    for name, text in {**short, "typing faults": faulty(LINES[0]), "typing broken": broken}.items():
        bench.results.figures[name] = figure(_seconds(bench, text, 20, 5), 1000)
    bench.results.figures["typing long"] = figure(_seconds(bench, deck(bench.size(LONG)), 3, 3))


def _seconds(bench: Bench, text: str, changes: int, rounds: int) -> list[float]:
    """Seconds of a change by the clock, in each round."""
    path: Path = bench.folder / "typed.keyxm"
    path.write_text(text, encoding="utf-8")
    words: list[str | Path] = [sys.executable, "-m", "tests.benchmarks.editor", path, str(changes)]
    return cpu(bench.costs({"typing": Job(words, own_clock=True)}, rounds)["typing"])


def waits(path: Path, changes: int) -> list[float]:
    """Seconds from each change to its findings: digits are written behind the first number with a fraction."""
    from tests.tools.lsp.raw import raw_client  # noqa: PLC0415 - what compares figures needs no library of the server

    text, uri = path.read_text(encoding="utf-8"), path.absolute().as_uri()
    found = re.search(r"^ .*?\d\.\d", text, re.MULTILINE)
    assert found
    place = {"line": text.count("\n", 0, found.end()), "character": found.end() - found.start()}
    taken: list[float] = []
    with raw_client() as client:
        client.begin()
        with _bounded(client, path):
            client.open(uri, text)
            client.findings(uri)
        for version in range(2, changes + 4):
            end = {**place, "character": place["character"] + (3 if version > 2 else 0)}
            change = {"range": {"start": place, "end": end}, "text": f"{version:03}"}
            identifier = {"uri": uri, "version": version}
            with _bounded(client, path):
                begun = time.perf_counter()
                client.notify("textDocument/didChange", {"textDocument": identifier, "contentChanges": [change]})
                client.findings(uri)
                taken.append(time.perf_counter() - begun)
    return taken[2:]


@contextmanager
def _bounded(client: RawClient, path: Path) -> Iterator[None]:
    """Wait for findings no longer than `PATIENCE`, and say what the server said if none came."""
    timer = Timer(PATIENCE, client.process.kill)
    timer.start()
    try:
        yield
    except (AssertionError, BrokenPipeError) as error:
        said = client.process.communicate()[1].decode(errors="replace")
        raise SystemExit(
            f"{path}: no findings within {PATIENCE:.0f} s, or the server ended; it said:\n{said}"
        ) from error
    finally:
        timer.cancel()


if __name__ == "__main__":
    print(statistics.median(waits(Path(sys.argv[1]), int(sys.argv[2]))))
