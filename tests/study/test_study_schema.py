"""The JSON of a study has the form that is described, and so have the ones that the documentation shows."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from mudline.study.report import Column, Omission, StudyReport, StudyTable
from tests.cli.runner import assert_fits

STUDIES = Path(__file__).parents[2] / "docs" / "studies"


def test_a_report_of_every_kind_of_value_fits() -> None:
    table = StudyTable("all", "All", (Column("a", "m"), Column("b")), [("x", 1), (True, math.inf), (None, 0.5)])
    report = StudyReport("pruning", "A study", (table,), notes=("so",), omissions=(Omission("this", "too slow"),))
    read = json.loads(report.json())
    assert_fits(read, "study")
    assert read["tables"][0]["rows"] == [["x", 1], [True, None], [None, 0.5]]


@pytest.mark.parametrize("name", ["precision", "stability", "pruning"])
def test_the_studies_of_the_documentation_fit(name: str) -> None:
    read = json.loads((STUDIES / f"{name}.json").read_text(encoding="utf-8"))
    assert_fits(read, "study")
    assert read["study"] == name
    for table in read["tables"]:
        assert {len(row) for row in table["rows"]} == {len(table["columns"])}
        assert (STUDIES / f"{name}-{table['name']}.csv").exists()
    for picture in read["pictures"]:
        assert (STUDIES / f"{name}-{picture['name']}.png").exists()
