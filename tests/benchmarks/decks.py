"""Many decks of 41 lines: beside yamllint on the same lines, from the cache, and memory."""

from __future__ import annotations

import random
import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from tests.benchmarks.bench import Bench
from tests.benchmarks.runner import Figure, Job, cpu, ratio

DECKS = 1000
MANY = 10_000
MOST = 40_000

Writer = Callable[[int], str]
"""What writes the deck of a number."""
_LETTERS = "abcdefghijklmnopqrstuvwxyz"
ALIKE = """\
*ELEMENT SETS
 SET=TDZ
 1, 2, 3
 SET=Riser
 GEN=4, 7
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.5, 0.46, 7850.0
*SEABED STIFFNESS
 CURVE=Clay
 0.0, 0.0
 0.1, 1200.0
 0.5, 3000.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS=50000.0
 SET=TDZ
 STIFFNESS=Clay
"""


def alike(number: int) -> str:
    """A deck that differs from the others in its comment and its depth."""
    nodes = "".join(f" {i}, -0.05, {5 * (i - 1)}.0\n" for i in range(1, 9))
    elements = "".join(f" {i}, {i}, {i + 1}\n" for i in range(1, 8))
    head = f"C deck {number}\n$MODEL\n*OCEAN\n {500 + number}.0, 1025.0, 9.81\n*NODE\n"
    return f"{head}{nodes}*ELEMENT\n{elements}{ALIKE}"


def apart(number: int) -> str:
    """A deck whose names, numbers and layout are its own."""
    rng = random.Random(number)  # noqa: S311 the same decks in every run
    indent = " " * rng.randint(1, 4)
    comma = rng.choice((",", ", ", ",  ", " , "))
    spelled = rng.choice(("{:.1f}", "{:.3f}", "{:.6G}", "{:.4E}")).format

    def row(*values: object) -> str:
        return indent + comma.join(map(str, values)) + "\n"

    def some(*limits: tuple[float, float]) -> str:
        return row(*(spelled(rng.uniform(*limit)) for limit in limits))

    zone, rest, curve, title = ("".join(rng.choices(_LETTERS, k=rng.randint(3, 8))) + str(number) for _ in range(4))
    node, element = rng.randint(1, 10**6), rng.randint(1, 10**6)
    length, stiffness = rng.uniform(1.0, 9.0), spelled(rng.uniform(4e4, 6e4))
    return "".join(
        [
            f"C {title}\n$MODEL\n*OCEAN\n",
            some((100.0, 3000.0), (1000.0, 1040.0), (9.78, 9.83)),
            "*NODE\n",
            *(row(node + i, spelled(-rng.uniform(0.01, 0.09)), spelled(length * i)) for i in range(8)),
            "*ELEMENT\n",
            *(row(element + i, node + i, node + i + 1) for i in range(7)),
            f"*ELEMENT SETS\n{indent}SET={zone}\n",
            row(element, element + 1, element + 2),
            f"{indent}SET={rest}\n{indent}GEN={element + 3}{comma}{element + 6}\n",
            f"*GEOMETRIC SETS\n{indent}OPTION=RIGID\n{indent}SET=ALL\n",
            some((2.0e11, 2.1e11), (7.0e10, 8.0e10), (0.46, 0.6), (0.3, 0.34), (7000.0, 8000.0)),
            f"*SEABED STIFFNESS\n{indent}CURVE={curve}\n",
            row(spelled(0.0), spelled(0.0)),
            some((0.06, 0.14), (500.0, 1500.0)),
            some((0.4, 0.6), (2000.0, 4000.0)),
            f"*SEABED PROPERTIES\n{indent}TYPE=ELASTIC\n{indent}SET=ALL\n{indent}STIFFNESS={stiffness}\n",
            f"{indent}SET={zone}\n{indent}STIFFNESS={curve}\n",
        ]
    )


def as_yaml(deck: str) -> str:
    """The lines of a deck as as many of YAML: a keyword is a key, a row a list."""
    lines = []
    for line in deck.splitlines():
        words = re.split(r"[ ]*,[ ]*", line.strip())
        if line.startswith("C "):
            lines.append(f"# {line}\n")
        elif line[0] in "$*":
            lines.append(f"{line[1:].replace(' ', '_')}:\n")
        else:
            text = ", ".join(words)
            lines.append(f"  - [{text}]\n" if len(words) > 1 and "=" not in line else f"  - {text}\n")
    return "".join(lines)


def folder_of(bench: Bench, count: int, write: Writer = apart, suffix: str = "keyxm") -> Path:
    """A folder with so many decks, as keyword text or as YAML."""
    folder = bench.folder / f"{write.__name__}-{suffix}-{count}"
    if not folder.exists():
        folder.mkdir()
        for number in range(count):
            text = write(number)
            path = folder / f"deck{number:06}.{suffix}"
            path.write_text(as_yaml(text) if suffix == "yaml" else text, encoding="utf-8")
    return folder


def linters(bench: Bench, count: int, write: Writer = apart) -> dict[str, Job]:
    """Mudline in one process and without its cache, and yamllint if it is there.

    The times of processes that a fork server starts are not in those of the children that were waited for.
    """
    jobs = {"mudline": bench.mudline("lint", "--no-cache", "--jobs", "1", folder_of(bench, count, write))}
    if bench.has("yamllint"):
        python = bench.environments["yamllint"].program("python")
        folder = folder_of(bench, count, write, "yaml")
        words: list[str | Path] = [python, "-I", "-m", "yamllint", "-d", "default", folder]
        jobs["yamllint"] = Job(words, codes=frozenset({0, 1}), peer="yamllint")
    return jobs


def run(bench: Bench) -> None:
    """Measure all of it."""
    count = bench.size(DECKS)
    for key, write in (("apart", apart), ("alike", alike)):
        found = bench.costs(linters(bench, count, write), 5)
        if "yamllint" in found:
            bench.results.figures[key] = ratio(cpu(found["yamllint"]), cpu(found["mudline"]))
    _alone(bench)
    _cached(bench)


def _alone(bench: Bench) -> None:
    """What each further deck costs a single process."""
    count = bench.size(DECKS)
    few = count // 5
    jobs = {size: bench.mudline("lint", "--no-cache", "--jobs", "1", folder_of(bench, size)) for size in (few, count)}
    found = bench.costs({str(size): job for size, job in jobs.items()}, 5)
    more, less = cpu(found[str(count)]), cpu(found[str(few)])
    each = [(a - b) / (count - few) for a, b in zip(more, less, strict=True)]
    least = (min(more) - min(less)) / (count - few)
    bench.results.figures["each"] = Figure([1e3 * value for value in each], 1e3 * least)


def _cached(bench: Bench) -> None:
    """Growth with the count, the cache, and memory, in a single process; these take long and are run few times."""

    def first(count: int) -> Job:
        job = bench.mudline("lint", "--jobs", "1", folder_of(bench, count), cache=f"many-{count}")
        cache = bench.folder / f"many-{count}"
        return replace(job, before=lambda: shutil.rmtree(cache, ignore_errors=True))

    few, many, most = (bench.size(count) for count in (DECKS, MANY, MOST))
    jobs = {"few": first(few), "many": first(many), "again": replace(first(many), before=None)}
    found = bench.costs(jobs, 3, warm=False)
    figures = bench.results.figures
    figures["linear"] = ratio([value * few / many for value in cpu(found["many"])], cpu(found["few"]))
    figures["cached"] = ratio(cpu(found["many"]), cpu(found["again"]))
    largest = bench.costs({"": first(most)}, 1, warm=False)[""][0].memory
    memory = max(cost.memory for cost in found["many"])
    figures["flat"] = ratio([largest], [memory])
    shutil.rmtree(folder_of(bench, most))
