"""The gate of speed: python -m tests.benchmarks --check [--store]

A row is what mudline takes in times of what a peer takes in the same run, both the least of several runs in turn:
processor time, for the editor time by the clock. ratios.json holds the rows as they were measured when it was last
stored. A row that is more than a quarter above is measured once more, and fails the check if it still is.
"""

from __future__ import annotations

import importlib.util
import json
import math
import re
import subprocess
import time
from collections.abc import Callable, Iterator
from functools import partial
from itertools import count
from pathlib import Path

from mudline.checks import registry
from mudline.checks.engine import lint_bytes
from tests.benchmarks import decks, reading, start
from tests.benchmarks.bench import Bench
from tests.benchmarks.contact import Work, all_laws, by_hand, one_curve, series, stepping, streaming
from tests.benchmarks.editor import deck, faulty, waits
from tests.benchmarks.runner import ROOT, cpu, elapsed

STORED = Path(__file__).with_name("ratios.json")
_WORSE = 1.25
_CLEAN, _BROKEN = (ROOT / "samples" / f"{name}.keyxm" for name in ("scr-touchdown", "broken"))
_NUMBERS = count()
_NODES, _MANY = 1000, 100_000


def _least(ours: Work, peer: Work, rounds: int) -> float:
    """Processor time of one in times of the other, after a round that does not count."""
    taken: list[list[float]] = [[], []]
    for _ in range(rounds + 1):
        for work, times in zip((ours, peer), taken, strict=True):
            begun = time.thread_time()
            work()
            times.append(time.thread_time() - begun)
    return min(taken[0][1:]) / min(taken[1][1:])


def _linting(data: bytes) -> Work:
    """Lints a deck that has no block in common with the last one: what was read before does not help."""
    rules = registry.select()
    return lambda: lint_bytes(re.sub(rb"(?m)^(\*.*)$", rb"\1\nC %d" % next(_NUMBERS), data), "deck.keyxm", rules)


def faults(_: Bench) -> Iterator[tuple[str, float]]:
    """Decks with faults beside clean ones, in this process."""
    clean, slipped = (_linting(text.encode()) for text in (deck(240), faulty(240)))
    yield "a deck of 240 lines with 5 faults / clean", _least(slipped, clean, 15)
    sample, broken = (_linting(path.read_bytes()) for path in (_CLEAN, _BROKEN))
    yield "samples/broken.keyxm / the clean sample", _least(broken, sample, 15)


def commands(bench: Bench) -> Iterator[tuple[str, float]]:
    """A command on one deck, and on many, in a process."""
    imports, cold, again = (cpu(costs) for costs in bench.costs(start.lints(bench), 7).values())
    yield "cold lint / bare imports", min(cold) / min(imports)
    yield "lint of an unchanged deck / bare imports", min(again) / min(imports)
    found = bench.costs(decks.linters(bench, decks.DECKS), 2, warm=False)
    if "yamllint" in found:
        yield "1000 different decks / yamllint", min(cpu(found["mudline"])) / min(cpu(found["yamllint"]))


def editor(bench: Bench) -> Iterator[tuple[str, float]]:
    """From a change to its findings, through the server, beside the start of a Python with the imports."""
    taken = waits(_BROKEN, 7)
    imports = bench.costs({"imports": start.IMPORTS}, 5)["imports"]
    yield "editor, by the clock: digit to findings of broken.keyxm / bare imports", min(taken) / min(elapsed(imports))


def rows(bench: Bench) -> Iterator[tuple[str, float]]:
    """Files of 10^6 rows; only meshio has no table of two columns."""
    for kinds, what in ((reading.CURVE, "a curve"), (reading.NODES, "nodes")):
        jobs = {name: maker(reading.ROWS) for name, maker in reading.readers(bench, kinds).items()}
        if kinds is reading.CURVE:
            jobs["checked"] = bench.timed(reading.LINT, "curve", reading.ROWS)
        found = {name: min(cpu(costs)) for name, costs in bench.costs(jobs, 3, warm=False).items()}
        for ours, peer in (("mudline", "meshio"), ("mudline", "opm"), ("checked", "np.loadtxt")):
            if ours in found and peer in found:
                yield f"10^6 rows of {what}{', checked' * (ours == 'checked')} / {peer}", found[ours] / found[peer]


def contact(_: Bench) -> Iterator[tuple[str, float]]:
    """Steps of contact with all laws, beside numpy code for one curve."""

    def hand(nodes: int, steps: int) -> Work:
        line = one_curve(nodes)
        return partial(by_hand, series(line, steps), line.diameter, 0.5 * line.length)

    laws = all_laws(_NODES)
    step = stepping(laws, series(laws, 2), "numpy")
    yield "contact step, numpy, 10^3 nodes, all laws / one curve by hand", _least(step, hand(_NODES, 1), 200)
    if importlib.util.find_spec("numba") is None:
        return
    for nodes, steps in ((_MANY, 8), (10 * _MANY, 4)):
        laws = all_laws(nodes)
        run = streaming(laws, series(laws, steps), "fast")
        ratio = _least(run, hand(_MANY, 8), 5) * 8 * _MANY / (nodes * steps)
        yield f"compiled contact, 10^{math.log10(nodes):.0f} nodes, all laws / one curve by hand, 10^5", ratio


MEASURES: tuple[Callable[[Bench], Iterator[tuple[str, float]]], ...] = (faults, commands, editor, rows, contact)


def run(bench: Bench, *, store: bool) -> int:
    """Measure all rows and compare them; the code to end with."""
    kept: dict[str, float] = json.loads(STORED.read_text(encoding="utf-8"))["ratios"]
    limits = {row: _WORSE * ratio for row, ratio in kept.items()}
    found: dict[str, float] = {}
    for measure in MEASURES:
        first = dict(measure(bench))
        if store or any(ratio > limits.get(row, math.inf) for row, ratio in first.items()):
            first |= {row: min(ratio, first[row]) for row, ratio in measure(bench)}
        found |= first
    bad = [row for row, ratio in found.items() if ratio > limits.get(row, math.inf)]
    for row in kept | found:
        stored, measured = (f"{one[row]:.3g}" if row in one else "not measured" for one in (kept, found))
        print(f"{row}: stored {stored}, measured {measured}" + (", MORE THAN 25 % WORSE" if row in bad else ""))
    if store:
        words = ["git", "rev-parse", "--short", "HEAD"]
        commit = subprocess.run(words, check=True, capture_output=True, text=True, cwd=ROOT).stdout.strip()
        ratios = kept | {row: float(f"{ratio:.3g}") for row, ratio in found.items()}
        STORED.write_text(json.dumps({"commit": commit, "ratios": ratios}, indent=1) + "\n", encoding="utf-8")
    return 0 if store else int(bool(bad))
