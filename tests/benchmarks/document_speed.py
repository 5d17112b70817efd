"""Seconds to write and read a deck with a table of a million rows: python tests/benchmarks/document_speed.py

Each table goes through every form of a deck, beside what Python's own tools take for the same numbers in the same run:
json.dumps and json.loads of the rows as lists, numpy.savetxt and numpy.loadtxt of the array, and PyYAML's C library for
nested lists, on fewer rows as it would take minutes. Printed are seconds for all rows, and how many times the time of
mudline the peer takes.
"""

from __future__ import annotations

import argparse
import io
import json
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray

from mudline.deck.loading import dump, load_bytes
from mudline.deck.model import Deck, Section
from mudline.keywords.library.element import ElementRows, Elements
from mudline.keywords.library.node import NodeRows, Nodes
from mudline.keywords.library.seabed_stiffness import SeabedStiffness, StiffnessCurve
from mudline.keywords.model import Block
from mudline.keywords.table import Table

Floats = NDArray[np.float64]


def blocks(count: int) -> dict[str, tuple[Block, Floats]]:
    """A block of each kind, and the numbers of its table."""
    rng = np.random.default_rng(1)
    numbers = np.arange(1.0, count + 1)
    curve = np.cumsum(rng.random((count, 2)) + 1e-3, axis=0)
    nodes = np.column_stack((numbers, curve, rng.random(count)))
    elements = np.column_stack((numbers, numbers, numbers + 1))
    return {
        "curve": (SeabedStiffness(curves=[StiffnessCurve(name="clay", points=Table(curve))]), curve),
        "nodes": (Nodes(entries=[NodeRows(nodes=Table(nodes))]), nodes),
        "elements": (Elements(entries=[ElementRows(elements=Table(elements))]), elements),
    }


def timed(function: Callable[[], Any]) -> tuple[float, Any]:
    """Seconds that a call takes, and what it returns."""
    start = time.perf_counter()
    result = function()
    return time.perf_counter() - start, result


def peers(array: Floats, share: int) -> dict[str, tuple[str, float]]:
    """Name and seconds of the peer of each step; YAML on one row in `share`, multiplied."""
    rows = array.tolist()
    text = io.StringIO()
    dumped, as_json = timed(lambda: json.dumps(rows))
    loaded, _ = timed(lambda: np.array(json.loads(as_json)))
    saved, _ = timed(lambda: np.savetxt(text, array, fmt="%.17g", delimiter=", "))
    text.seek(0)
    read, _ = timed(lambda: np.loadtxt(text, delimiter=","))
    few = rows[:: max(share, 1)]
    emitted, as_yaml = timed(lambda: yaml.dump(few, Dumper=yaml.CSafeDumper, default_flow_style=None))
    parsed, _ = timed(lambda: np.array(yaml.load(as_yaml, Loader=yaml.CSafeLoader)))
    scale = len(rows) / len(few)
    return {
        "json write": ("json.dumps", dumped),
        "json read": ("json.loads", loaded),
        "yaml write": ("yaml.dump", emitted * scale),
        "yaml read": ("yaml.load", parsed * scale),
        "keyword write": ("np.savetxt", saved),
        "keyword read": ("np.loadtxt", read),
    }


def main() -> None:
    """Time each table in each form."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rows", type=int, default=10**6, help="rows of each table (default 10^6)")
    parser.add_argument("--share", type=int, default=100, help="one row in so many for the YAML peer (default 100)")
    arguments = parser.parse_args()
    print(f"{'table':>10} {'step':>14} {'seconds':>8} {'MB':>6}  peer")
    for name, (block, array) in blocks(arguments.rows).items():
        deck = Deck("a", sections=[Section("MODEL", [block])])
        others = peers(array, arguments.share)
        for form in ("json", "yaml", "keyword"):
            written, text = timed(partial(dump, deck, form))
            data = text.encode()
            read, again = timed(partial(load_bytes, data, "a", form=form))
            assert again.sections == deck.sections
            for step, seconds in (("write", written), ("read", read)):
                peer, other = others[f"{form} {step}"]
                ratio = f"{peer} {other:.2f} s (x {other / seconds:.1f})"
                print(f"{name:>10} {form + ' ' + step:>14} {seconds:>8.2f} {len(data) / 1e6:>6.1f}  {ratio}")


if __name__ == "__main__":
    main()
