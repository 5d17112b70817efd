"""`mudline evaluate` writes long series as they come: Parquet, no half-written file, a bar for who looks on."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mudline.model.results.forms import parquet
from tests.cli.conftest import Place
from tests.cli.runner import run

pq = pytest.importorskip("pyarrow.parquet")
OUTPUTS = ("out.csv", "out.json", "out.npz", "out.parquet", pytest.param("out.xlsx", marks=pytest.mark.nightly))


@pytest.fixture
def long(folder: Path) -> str:
    steps = np.zeros((12_000, 3, 3))
    steps[:, :, 0] = -0.1 + 0.2 * np.sin(np.arange(12_000))[:, np.newaxis]
    steps[:, :, 1] = [0.0, 10.0, 20.0]
    np.save(folder / "long.npy", steps)
    return "long.npy"


def test_parquet_has_groups_of_rows(place: Place, long: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parquet, "GROUP", 10_000)
    assert run("evaluate", place(), "--positions", long, "-o", "out.parquet", "-q").code == 0
    file = pq.ParquetFile(folder / "out.parquet")
    assert file.metadata.num_rows == 24_000
    assert file.num_row_groups > 1
    times = file.read()["time"].to_numpy()
    assert (np.diff(times) >= 0.0).all()


@pytest.mark.parametrize("name", OUTPUTS)
def test_fault_in_a_late_step_leaves_no_file(place: Place, long: str, folder: Path, name: str) -> None:
    steps = np.load(folder / long)
    steps[-1, 1, 0] = np.inf
    np.save(folder / long, steps)
    deck = place()
    before = sorted(folder.iterdir())
    outcome = run("evaluate", deck, "--positions", long, "-o", name)
    assert (outcome.code, outcome.out) == (1, "")
    assert "node 2 at step 11999" in outcome.err
    assert sorted(folder.iterdir()) == before


def test_bar_on_a_terminal(place: Place, long: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.cli.view.DELAY", 0.0)
    monkeypatch.delenv("CI", raising=False)
    options = ("evaluate", place(), "--positions", long, "-o", "out.npz")
    assert "/12000" in run(*options, terminal=True).err
    assert "/12000" not in run(*options, "-q", terminal=True).err
    assert "/12000" not in run(*options).err
