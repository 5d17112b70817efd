"""The tables of docs/benchmarks.md: the goals beside what was measured, growth, the machine.

The text of the page is written by hand.
"""

from __future__ import annotations

import os
import platform
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from itertools import groupby
from math import log
from pathlib import Path

from tests.benchmarks.bench import Results
from tests.benchmarks.goals import GOALS, Goal
from tests.benchmarks.peers import Environment
from tests.benchmarks.runner import ROOT, Figure
from tests.benchmarks.tables import inserted, table

PAGE = ROOT / "docs" / "benchmarks.md"
_OURS = ("mudline", "numpy", "pydantic", "lark", "pyyaml", "pyarrow", "numba")

QUICK = "a quick run"
"""What `Results.runs` has for a subject that was measured on small inputs."""


def page(results: Results, environments: Iterable[Environment]) -> str:
    """The page with its tables made again."""
    found = {
        "goals": lambda: _goals(results),
        "growth": lambda: _growth(results),
        "machine": lambda: _machine(results, environments),
    }
    return inserted(PAGE.read_text(encoding="utf-8"), found)


def _goals(results: Results) -> str:
    measured = [goal for goal in GOALS if goal.key in results.figures]
    met = sum(goal.met(results.figures[goal.key].median) for goal in measured)
    missing = len(GOALS) - len(measured)
    parts = [f"Of {len(GOALS)} goals {met} are met, {len(measured) - met} missed, {missing} not measured.\n"]
    if QUICK in results.runs.values():
        parts.append("This was a quick run: the inputs were small, and no goal can be judged by it.\n")
    for subject, goals in groupby(GOALS, key=lambda goal: goal.subject):
        head = ["what", "goal", "median", "lowest to highest", "of the least times", "met"]
        parts += [f"### {subject}\n", table(head, [_row(goal, results.figures.get(goal.key)) for goal in goals])]
    return "\n".join(parts)


def _row(goal: Goal, found: Figure | None) -> list[str]:
    unit = f" {goal.unit}" if goal.unit else ""
    wanted = f"{goal.direction} {goal.limit:g}{unit}" + (f", aim {goal.aim:g}" if goal.aim else "")
    if found is None:
        return [goal.what, wanted, "not measured", "", "", ""]
    spread = f"{_short(min(found.values))} to {_short(max(found.values))}" if len(found.values) > 1 else "one run"
    verdict = "yes" if goal.met(found.median) else "**missed**"
    return [goal.what, wanted, f"{_short(found.median)}{unit}", spread, _short(found.least), verdict]


def _growth(results: Results) -> str:
    rows = [
        [panel, name, f"{sizes[0][0]:,} to {sizes[-1][0]:,}", f"{sizes[-1][1]:.3g}", _exponent_cell(sizes)]
        for panel, series in results.series.items()
        for name, sizes in series.items()
    ]
    return table(["size", "program", "sizes", "s at the largest", "exponent"], rows)


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


def _machine(results: Results, environments: Iterable[Environment]) -> str:
    rows = [[place.peer.name, _state(place, results), place.peer.compared] for place in environments]
    return "\n".join(
        [
            f"{_processor()}, {os.cpu_count()} cores; {platform.system()}; {platform.python_implementation()}",
            f"{platform.python_version()}; {', '.join(_versions(_OURS))}.\n",
            table(["subject", "measured in"], [[subject, run] for subject, run in results.runs.items()]),
            "The other programs, each in an environment of its own:\n",
            table(["program", "versions", "what it reads"], rows),
        ]
    )


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


def write(results: Results, environments: Mapping[str, Environment], folder: Path) -> None:
    """Write the page."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "benchmarks.md").write_text(page(results, environments.values()), encoding="utf-8", newline="\n")
