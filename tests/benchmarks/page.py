"""docs/benchmarks.md: the goals beside what was measured, and everything else that a run found."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from itertools import groupby
from math import log
from pathlib import Path

from tests.benchmarks.bench import Results
from tests.benchmarks.goals import GOALS, SPELLINGS_BEFORE, Goal
from tests.benchmarks.peers import Environment
from tests.benchmarks.runner import Figure

PICTURE = "images/benchmarks.svg"
_OURS = ("mudline", "numpy", "pydantic", "lark", "pyyaml", "pyarrow", "numba")

_TEXT = """\
# Benchmarks

`make bench` measures all of this on your machine and writes this page and its picture; it takes about 25 minutes and a
gigabyte or two of disk. `make bench ARGS=--quick` tries all of it on small inputs, in `.bench/quick`; with
`ARGS="--only reading start"` the other subjects keep what they had. The programs are in `tests/benchmarks`.

Times are processor time, user and system, of a process and those that it started and waited for, unless "by the clock"
is said. What is compared runs in turn, once in each round, after a round that does not count; a ratio is that of two
times of one round. Given are the median over the rounds, the lowest and the highest value, and the same quantity from
the least times of all rounds. A goal is met if the median meets it.

Times of reading are those of the reading alone, in a process that has read a table of 200 rows before: imports and the
making of grammars do not count, for any program. `mudline.read` runs without pyarrow unless it is named. Times of
commands are those of whole processes. Byte code is compiled before. "Cold" is a start with an empty cache folder. MB
are 10^6 bytes; peak memory is that of the whole process.
"""
_OF_SUBJECT = {
    "Spellings of numbers": SPELLINGS_BEFORE,
    "Many decks": (
        "Decks have 41 lines and no findings. Those that share nothing differ in names, numbers and layout; those\n"
        "that share blocks differ in a comment and the depth. yamllint reads as many lines of YAML with the same\n"
        "contents, in its default configuration. By the clock, mudline uses as many processes as it likes and no\n"
        "cache; the other rows are those of one process."
    ),
}


QUICK = "a quick run"
"""What `Results.runs` has for a subject that was measured on small inputs."""


def page(results: Results, environments: Iterable[Environment]) -> str:
    """The text of the page."""
    parts = [_TEXT, *_goals(results), *_growth(results), *_tables(results), *_circumstances(results, environments)]
    return "\n".join(parts)


def _goals(results: Results) -> Iterator[str]:
    measured = [goal for goal in GOALS if goal.key in results.figures]
    met = sum(goal.met(results.figures[goal.key].median) for goal in measured)
    missing = len(GOALS) - len(measured)
    yield f"## Goals\n\nOf {len(GOALS)} goals {met} are met, {len(measured) - met} missed, {missing} not measured.\n"
    if QUICK in results.runs.values():
        yield "This was a quick run: the inputs were small, and no goal can be judged by it.\n"
    for subject, goals in groupby(GOALS, key=lambda goal: goal.subject):
        yield f"### {subject}\n"
        yield from (f"{text}\n" for name, text in _OF_SUBJECT.items() if subject.startswith(name))
        head = ["what", "goal", "median", "lowest to highest", "of the least times", "met"]
        yield _table(head, [_row(goal, results.figures.get(goal.key)) for goal in goals])


def _row(goal: Goal, found: Figure | None) -> list[str]:
    unit = f" {goal.unit}" if goal.unit else ""
    wanted = f"{goal.direction} {goal.limit:g}{unit}" + (f", aim {goal.aim:g}" if goal.aim else "")
    if found is None:
        return [goal.what, wanted, "not measured", "", "", ""]
    spread = f"{_short(min(found.values))} to {_short(max(found.values))}" if len(found.values) > 1 else "one run"
    verdict = "yes" if goal.met(found.median) else "**missed**"
    return [goal.what, wanted, f"{_short(found.median)}{unit}", spread, _short(found.least), verdict]


def _growth(results: Results) -> Iterator[str]:
    if not results.series:
        return
    yield f"## Time against size\n\n![Time against size, in logarithmic scales]({PICTURE})\n"
    yield "The exponent p of a fit of n^p: least squares on logarithmic scales, at sizes from a hundred times the"
    yield "smallest, after the time of the smallest was taken off, which is mostly a start. A series ends where a run"
    yield "would take minutes. Times of decks are by the clock.\n"
    rows = [
        [panel, name, f"{sizes[0][0]:,} to {sizes[-1][0]:,}", f"{sizes[-1][1]:.3g}", _exponent_cell(sizes)]
        for panel, series in results.series.items()
        for name, sizes in series.items()
    ]
    yield _table(["size", "program", "sizes", "s at the largest", "exponent"], rows)


def exponent(points: Sequence[tuple[int, float]]) -> float | None:
    """The power of the size with which time grows; None where there are too few sizes to say."""
    size, start = min(points)
    kept = [(log(n), log(t - start)) for n, t in points if n >= 100 * size and t > start]
    if len(kept) < 2:
        return None
    x = sum(x for x, _ in kept) / len(kept)
    y = sum(y for _, y in kept) / len(kept)
    return sum((a - x) * (b - y) for a, b in kept) / sum((a - x) ** 2 for a, _ in kept)


def _exponent_cell(points: Sequence[tuple[int, float]]) -> str:
    found = exponent(points)
    return "" if found is None else f"{found:.2f}"


def _tables(results: Results) -> Iterator[str]:
    if results.tables:
        yield "## Other figures\n"
    for title, (head, rows) in results.tables.items():
        yield f"### {title}\n"
        yield _table(head, rows)


def _circumstances(results: Results, environments: Iterable[Environment]) -> Iterator[str]:
    yield "## Machine and versions\n"
    yield f"{_processor()}, {os.cpu_count()} cores; {platform.system()}; {platform.python_implementation()}"
    yield f"{platform.python_version()}; {', '.join(_versions(_OURS))}.\n"
    yield _table(["subject", "measured in"], [[subject, run] for subject, run in results.runs.items()])
    yield "The other programs, each in an environment of its own:\n"
    rows = [[place.peer.name, _state(place, results), place.peer.compared] for place in environments]
    yield _table(["program", "versions", "what it reads"], rows)


def _state(place: Environment, results: Results) -> str:
    """The versions of a peer, and why it was not measured if it was not."""
    if place.reason:
        return f"not installed: {place.reason}"
    return ", ".join(place.peer.requirements) + (": ended in an error" if place.peer.name in results.failed else "")


def _processor() -> str:
    """The model of the processor."""
    information = Path("/proc/cpuinfo")
    if information.exists():
        for line in information.read_text(encoding="utf-8").splitlines():
            name, _, value = line.partition(":")
            if name.strip() == "model name":
                return value.strip()
    return platform.processor() or platform.machine()


def _versions(names: Iterable[str]) -> Iterator[str]:
    for name in names:
        try:
            yield f"{name} {version(name)}"
        except PackageNotFoundError:
            yield f"without {name}"


def _short(value: float) -> str:
    """Three digits."""
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


def write(results: Results, environments: Mapping[str, Environment], folder: Path) -> None:
    """Write the page, and its picture if matplotlib is there."""
    from tests.benchmarks.picture import draw  # noqa: PLC0415 large, and not before all is measured

    (folder / PICTURE).parent.mkdir(parents=True, exist_ok=True)
    (folder / "benchmarks.md").write_text(page(results, environments.values()), encoding="utf-8", newline="\n")
    if results.series:
        draw(results.series, folder / PICTURE)
