"""Commands and conversions of large tables."""

from __future__ import annotations

import shutil
from dataclasses import replace

from tests.benchmarks.bench import Bench, Work
from tests.benchmarks.reading import ROWS
from tests.benchmarks.runner import cpu, figure, ratio

_OURS = {
    "json write": ("", "return deck.to_json()"),
    "json read": ("; text = deck.to_json()", "return mudline.from_json(text)"),
    "yaml write": ("", "return deck.to_yaml()"),
    "yaml read": ("; text = deck.to_yaml()", "return mudline.from_yaml(text)"),
    "keyword write": ("", "return deck.to_keyword()"),
}
_YAML = "yaml.dump(array[::100].tolist(), Dumper=yaml.CSafeDumper, default_flow_style=None)"
_THEIRS = {
    "json write": ("rows = array.tolist()", "return json.dumps(rows)"),
    "json read": (
        "text = json.dumps(array.tolist())",
        "return np.array(json.loads(text))",
    ),
    "yaml write": ("pass", f"return {_YAML}"),
    "yaml read": (
        f"text = {_YAML}",
        "return np.array(yaml.load(text, Loader=yaml.CSafeLoader))",
    ),
    "keyword write": ("text = io.StringIO()", "np.savetxt(text, array, fmt='%.17g', delimiter=', ')"),
}
"""What each step of ours and of Python's own tools is made from, and what is timed; YAML of one row in 100."""


def run(bench: Bench) -> None:
    """Measure all of it."""
    _format(bench)
    _conversions(bench)


def _format(bench: Bench) -> None:
    """The whole command, on a copy that is not in canonical layout."""
    source, copy = bench.table("curve", bench.size(ROWS)), bench.folder / "format.keyxm"

    def again() -> None:
        shutil.copyfile(source, copy)

    job = replace(bench.mudline("format", copy), before=again)
    bench.results.figures["format"] = figure(cpu(bench.costs({"format": job}, 5)["format"]))


def _conversions(bench: Bench) -> None:
    """Every form of a deck beside what Python's own tools take for the same numbers."""
    count = bench.size(ROWS)
    array = "array = np.loadtxt(path, delimiter=',', skiprows=2)"
    for step, (made, work) in _OURS.items():
        prepare, their_work = _THEIRS[step]
        ours = Work("import mudline", work, f"deck = mudline.read(path){made}")
        theirs = Work("import io, json, yaml, numpy as np", their_work, f"{array}; {prepare}")
        jobs = {"mudline": bench.timed(ours, "nodes", count), "peer": bench.timed(theirs, "nodes", count)}
        found = bench.costs(jobs, 3, warm=False)
        times = 100 if step.startswith("yaml") else 1
        bench.results.figures[step] = ratio([times * seconds for seconds in cpu(found["peer"])], cpu(found["mudline"]))
