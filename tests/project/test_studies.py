"""The studies of the method: their pages show their tables, and pieces of the tables come out again."""

from __future__ import annotations

import numpy as np
import pytest

from tests.benchmarks.studies import release
from tests.benchmarks.studies.__main__ import PAGES, TABLES
from tests.benchmarks.studies.curves import BACKBONES, backbones
from tests.benchmarks.studies.landings import LIMITS, LINEAR, PHASES, rebounds
from tests.benchmarks.studies.schemes import SCHEMES
from tests.benchmarks.tables import FOLDER, inserted, load


@pytest.mark.parametrize("page", PAGES)
def test_the_tables_of_a_page_are_those_of_its_files(page: str) -> None:
    text = (FOLDER / f"{page}.md").read_text(encoding="utf-8")
    assert inserted(text, TABLES) == text
    assert text.count("<!-- table ") == text.count("<!-- end -->") > 0


def test_landings_come_out_as_in_the_table() -> None:
    for row in (row for row in load(LIMITS) if row["seabed"] == "linear"):
        scheme = next(scheme for scheme in SCHEMES.values() if scheme.title == row["scheme"])
        speeds = rebounds(scheme, LINEAR, np.array([float(row["at omega dt [-]"])]), PHASES)
        assert speeds.max() == pytest.approx(float(row["largest [-]"]), abs=1e-9)


def test_tables_come_out_again() -> None:
    for found, kept in ((backbones(), load(BACKBONES)), (release.counted(), load(release.RELEASE))):
        for numbers, row in zip(found, kept, strict=True):
            assert numbers[-2:] == pytest.approx([float(cell) for cell in list(row.values())[-2:]], rel=1e-9)
