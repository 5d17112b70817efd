"""Nodes for position files to be read against."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mudline.language.diagnostics import DeckError, Diagnostic, Where
from mudline.model.contact.arrays import Positions
from mudline.model.scene.numbering import DefinitionBatch, Definitions, Numbered
from mudline.model.scene.positions import read_positions


def numbered(ids: list[int]) -> Numbered:
    """Nodes of these numbers at the origin, in this order."""
    gathered = Definitions()
    gathered.add(DefinitionBatch(np.array(ids, dtype=np.int64), np.zeros((len(ids), 3)), Where(0, 0)))
    return gathered.resolve(3)


NODES: Numbered = numbered([10, 20, 30])
"""Three nodes; 20 is the second."""


def refusal(path: Path, nodes: Numbered = NODES) -> Diagnostic:
    """Why a file of positions is refused."""
    with pytest.raises(DeckError) as caught:
        read_positions(path, nodes)
    (found,) = caught.value.diagnostics
    assert found.code == "DAT001"
    assert found.file == path.as_posix()
    return found


def assert_same(found: Positions, expected: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> None:
    assert found.values.shape == expected.shape
    assert np.array_equal(found.whole, expected, equal_nan=True)
