"""The files of many decks: their common folder, and names of results that keep apart."""

from __future__ import annotations

import os
from collections.abc import Sequence

import pytest

from mudline.cli.cases import named_cases
from mudline.cli.inputs import Input


def results(*paths: str, form: str = "npz") -> list[str]:
    return [case.result for case in named_cases([Input(path, path) for path in paths], form)[1]]


def test_names_are_those_below_the_common_folder() -> None:
    assert results("a/b/c.keyxm", "a/d.keyxm") == ["b/c.npz", "d.npz"]
    assert results("a/b/c.keyxm") == ["c.npz"]
    assert results("a/b/c.d.keyxm") == ["c.d.npz"]


@pytest.mark.parametrize("other", ["C.keyx", "c.das"])
def test_decks_that_differ_in_case_or_suffix_keep_it(other: str) -> None:
    assert results("c.keyxm", other, "d.keyxm") == ["c.keyxm.npz", f"{other}.npz", "d.npz"]


def test_tables_beside_keep_apart_too() -> None:
    assert results("c.keyxm", "c-nodes.keyxm", form="csv") == ["c.keyxm.csv", "c-nodes.keyxm.csv"]
    assert results("c.keyxm", "c-nodes.keyxm") == ["c.npz", "c-nodes.npz"]
    assert results("summary.keyxm", "e/summary.keyxm") == ["summary.keyxm.npz", "e/summary.npz"]


def test_decks_of_several_drives(monkeypatch: pytest.MonkeyPatch) -> None:
    def no_common(paths: Sequence[str]) -> str:
        raise ValueError(f"{len(paths)} paths on different drives")

    monkeypatch.setattr(os.path, "commonpath", no_common)
    common, (case,) = named_cases([Input("c.keyxm", os.path.abspath("/e/c.keyxm"))], "npz")  # noqa: PTH100 - with a drive
    assert common == ""
    assert case.result.endswith("/e/c.npz")
    assert not os.path.isabs(case.result)  # noqa: PTH117 - as above
