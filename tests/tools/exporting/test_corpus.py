"""Decks of the corpus with their ends held: every target writes them whole, or refuses them with a line."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from mudline.language.deck.loading import load_bytes, load_path
from mudline.language.diagnostics import DeckError
from mudline.model.scene.model import resolve
from mudline.tools.exporting import moordyn, orcaflex
from mudline.tools.exporting.line_model import build
from tests.helpers.shared import ALL
from tests.tools.exporting.test_orcaflex import checked

CORPUS = Path(__file__).parents[2] / "data" / "corpus"
DECKS = [path for path in sorted(CORPUS.rglob("*")) if path.suffix in {".keyxm", ".keyxi", ".keyx", ".das"}][
    :: 1 if ALL else 4
]
REST = "\n$MODEL\n*OCEAN\n 100.0, 1025.0, 9.81\n*GEOMETRIC SETS\n OPTION=MOORING\n SET=ALL\n 1.0E8, 90.0, 0.3\n"


def held(path: Path) -> bytes:
    """A deck with what export needs: an ocean, sections, and its ends held. Raises DeckError."""
    scene = resolve(load_path(path).require())
    known = scene.element_nodes[scene.element_nodes >= 0]
    ends = scene.node_ids[np.bincount(known, minlength=len(scene.node_ids)) == 1]
    rows = "".join(f" {node}, {freedom}\n" for node in ends for freedom in (1, 2, 3))
    boundary = f"$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n{rows}" if rows else ""
    return path.read_bytes() + REST.encode() + boundary.encode()


@pytest.mark.slow
def test_decks_are_written_whole_or_refused() -> None:
    written = 0
    for path in DECKS:
        for target in (moordyn, orcaflex):
            try:
                deck = load_bytes(held(path), path.name, units="metric", folder=path.parent).require()
                model = build(resolve(deck).require_evaluable())
                files = target.write(model, "a.txt")
            except DeckError:
                continue
            written += 1
            assert all(entry.line > 0 for entry in model.report.entries)
            numbers = "\n".join(files.values()).partition("--- LINE TYPES" if target is moordyn else "\n---\n")[2]
            assert not re.search(r"\b(nan|inf)\b", numbers), path.name
            if target is orcaflex:
                checked(files["a.txt"])
    assert written > (200 if ALL else 50)
