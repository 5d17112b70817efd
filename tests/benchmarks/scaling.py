"""docs/scaling.md from the figures in docs/scaling.json: python -m tests.benchmarks.scaling

What was measured and what is extrapolated from it stand in sections of their own.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from typing import Any

from tests.benchmarks.cluster import FIGURES
from tests.benchmarks.schedule import Cluster, simulate

PAGE = FIGURES.with_suffix(".md")
PRICE = 0.05
"""Euro for a processor in an hour, as clouds ask for it; an assumption, not a measurement."""

WORKERS = (1, 10, 100, 300, 1000)
CHUNKS = (0.5, 1.0, 2.0, 30.0)
DECKS = 10**7
NODE_STEPS = 10**12
_ROW_BYTES = 300
"""Bytes of a deck's row among the finished ones, for what the client holds in memory in a second run."""


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table in Markdown, the first column to the left."""
    lines = [head, ["---", *["---:"] * (len(head) - 1)], *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)


def number(value: float) -> str:
    """Three significant digits without an exponent."""
    if value >= 100:
        return f"{round(value):,}".replace(",", " ")
    return f"{value:.3g}"


def duration(seconds: float) -> str:
    """A time in the unit that suits it."""
    for unit, size in (("d", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2 * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds:.3g} s"


def costs(figures: dict[str, Any]) -> tuple[float, float, float]:
    """Seconds of one processor for a deck that is linted, for a load case that is evaluated, and for a node-step."""
    lint, cases, series = figures["lint"], figures["evaluate"], figures["series"]
    steps = series["long node steps"] - series["short node steps"]
    node_step = (series["long seconds"] - series["short seconds"]) / steps
    return lint["alone"] / lint["decks"], cases["alone"] / cases["cases"], node_step


def measured(figures: dict[str, Any]) -> str:
    """The section of what was measured."""
    lint, cases, over = figures["lint"], figures["evaluate"], figures["overhead"]
    per_deck, per_case, per_step = costs(figures)
    rows = {(row["workers"], row["decks"]): row for row in figures["scaling"]}
    base, double = sorted({decks for _, decks in rows})
    one, two = rows[1, base]["seconds"], rows[2, base]["seconds"]
    weak = rows[2, double]["seconds"]
    return f"""## Measured

By `python -m tests.benchmarks.cluster` on {figures["machine"]}, with a load of {figures["load"]:.1f} from other
programs before it began. Client, scheduler and two workers share the two processors: two workers cannot be twice as
fast as one here, and what else the machine does shows. The parts were measured one after the other: only figures of
one row compare.

{
        table(
            ["cost of one processor", "s"],
            [
                [f"a deck of 41 lines, linted (of {lint['decks']})", number(per_deck)],
                [f"a load case, {figures['steps']} steps of {figures['nodes']} nodes, with files", number(per_case)],
                ["a node in a step of a long series, summary only", f"{per_step:.2e}"],
                ["a task without work, client and scheduler", f"{over['task']:.2g}"],
                ["a chunk without work, with its file of results written and read", f"{over['chunk']:.2g}"],
            ],
        )
    }

One of the two workers was killed half-way; standard output and all files of results were equal to those of the run
without a cluster.

{
        table(
            ["run", "without a cluster, s", "two workers, one killed, s", "rows when it was killed", "files of chunks"],
            [
                [f"lint, {lint['decks']} decks", number(lint["alone"]), number(lint["cluster"]), lint["killed at"],
                 lint["chunks"]],
                ["lint again, all taken over", "", number(lint["again"]), "", lint["chunks"]],
                [f"evaluate, {cases['cases']} load cases", number(cases["alone"]), number(cases["cluster"]),
                 cases["killed at"], cases["chunks"]],
            ],
        )
    }

{archived(figures)}The whole command, its start and that of the connection included, the best of three rounds:

{
        table(
            ["decks", "workers", "s", "slowest round, s"],
            [
                [decks, workers, number(row["seconds"]), number(row["slowest"])]
                for (workers, decks), row in sorted(rows.items(), key=lambda item: (item[0][1], item[0][0]))
            ],
        )
    }

Strong scaling, {base} decks on one worker and on two: {one / two:.2f} times as fast, {one / two / 2:.0%} of two.
Weak scaling, {base} decks on one worker and {double} on two: {one / weak:.0%} of the ideal, equal time.
"""  # fmt: skip


def archived(figures: dict[str, Any]) -> str:
    """What was measured of archives, if it was."""
    found = figures.get("index")
    if found is None:
        return ""
    head = ["archive", "without a cluster, s", "two workers, s", "again, nothing changed, s"]
    row = [f"index, {found['decks']} decks", *(number(found[name]) for name in ("alone", "cluster", "again"))]
    return f"{table(head, [row])}\n\nAll rows of all tables were equal to those of the run without a cluster.\n\n"


def extrapolated(figures: dict[str, Any]) -> str:
    """The section of what follows from the measured rates."""
    per_deck, _, per_step = costs(figures)
    over = figures["overhead"]["chunk"]
    jobs = (("10^7 decks linted", DECKS * per_deck), ("10^12 node-steps", NODE_STEPS * per_step))
    rows = []
    for name, work in jobs:
        for workers in WORKERS:
            chunk = max(1.0, work / 200_000)
            found = simulate(work, chunk, Cluster(workers, over))
            price = found.seconds * workers / 3600.0 * PRICE
            cells = [duration(found.seconds), f"{found.efficiency:.0%}", found.repeated, number(price)]
            rows.append([name, workers, f"{chunk:.3g}", *cells])
    work = jobs[0][1]
    sizes = []
    for chunk in CHUNKS:
        shares = [simulate(work, chunk, Cluster(workers, over)).efficiency for workers in WORKERS]
        sizes.append([f"{chunk:g}", *(f"{share:.0%}" for share in shares)])
    limit = 1.0 / over
    return f"""## Extrapolated

Nothing here was run. `tests/benchmarks/schedule.py` simulates a scheduler that needs the measured {over * 1e3:.2g} ms
for a chunk, one after the other, with these assumptions: processors as fast as the measured one, give or take 10 %; 1 %
of the chunks take five times as long; a worker dies once in 1000 hours, is missed after 30 s and replaced after 2
minutes; workers are there a minute after the start; {PRICE} EUR for a processor in an hour.

{table(["work", "workers", "chunk, s", "time", "efficiency", "chunks repeated", "EUR"], rows)}

The efficiency with 10^7 decks, by the length of a chunk and the number of workers:

{table(["chunk, s", *map(str, WORKERS)], sizes)}

## What breaks first

1. **The one client and scheduler.** At {over * 1e3:.2g} ms a chunk they serve {limit:.0f} chunks a second: with
   chunks of one second, {limit:.0f} workers. More workers need longer chunks (the chunks grow to 2000 decks at
   most) or several runs beside each other, each over a part of the decks.
2. **The client's list of what is done.** A second run reads all rows that are done: at {_ROW_BYTES} bytes a deck
   without findings, {DECKS * _ROW_BYTES / 1e9:.0f} GB for 10^7 decks. Run folder by folder from about a million.
3. **The store.** Chunks are few ({number(work)} files for 10^7 decks at a second each), decks are many: each is
   one request, and object stores bill and limit those. `evaluate -o` writes at least three files for each load case.
4. **One long series.** Workers share decks, not the steps of one: 10^12 node-steps have to come as many load
   cases. A series on one machine is bounded by its memory bandwidth.
"""


def page(figures: dict[str, Any]) -> str:
    """The whole page."""
    return f"""# Scaling

What a run costs, measured on one machine, and what larger ones would, extrapolated from that. How to start a cluster
is in [cluster.md](cluster.md). Made by `python -m tests.benchmarks.scaling` from [scaling.json](scaling.json).

{measured(figures)}
{extrapolated(figures)}"""


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(json.loads(FIGURES.read_text(encoding="utf-8"))), encoding="utf-8")


if __name__ == "__main__":
    main()
