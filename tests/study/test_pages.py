"""Pages of studies: those of the documentation are made of the CSV files beside them, and of nothing else."""

from __future__ import annotations

import math
import re
from importlib import import_module
from pathlib import Path

import pytest

import mudline.study
from mudline.cli.study_command import STUDIES
from mudline.study.pages import (
    DOWN,
    UP,
    MissingTableError,
    Tables,
    filled,
    grouped_digits,
    listed,
    markdown_table,
    percent,
    rounded,
    span,
    time,
)

DOCS = Path(__file__).parents[2] / "docs" / "studies"
TEMPLATES = {name: Path(mudline.study.__file__).with_name(name) / "page.md" for name in STUDIES}
GENERATED = [name for name, template in TEMPLATES.items() if template.exists()]


@pytest.mark.parametrize("name", GENERATED)
def test_the_page_is_made_of_the_csv_files(name: str) -> None:
    study = import_module(f"mudline.study.{name}").STUDY
    assert study.page(Tables.read(DOCS, name)) == (DOCS / f"{name}.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", GENERATED)
def test_the_prose_has_no_numbers(name: str) -> None:
    text = TEMPLATES[name].read_text(encoding="utf-8")
    for left in (r"```.*?```", r"`[^`]*`", r"\{\w+\}", r"\]\([^)]*\)", r"\((?:19|20)\d\d\)", r"\b[\w-]*[A-Za-z][\w-]*"):
        text = re.sub(left, "", text, flags=re.DOTALL)
    assert [line for line in text.splitlines() if re.search(r"\d", line)] == []


def test_tables_are_read_as_csv_has_them(tmp_path: Path) -> None:
    (tmp_path / "precision-steps.csv").write_text('scheme,step [s],ok\n"a,\nb",0.5,true\nc,,false\n', encoding="utf-8")
    (tmp_path / "pruning-steps.csv").write_text("scheme\n", encoding="utf-8")
    tables = Tables.read(tmp_path, "precision")
    first, second = tables.rows("steps")
    assert (first.text("scheme"), first.number("step [s]"), first.flag("ok")) == ("a,\nb", 0.5, True)
    assert math.isnan(second.number("step [s]"))
    assert tables.row("steps", scheme="c") == second
    assert tables.rows("steps", scheme="d") == []
    with pytest.raises(MissingTableError, match="table landings is not there"):
        tables.rows("landings")
    with pytest.raises(MissingTableError, match="no row with"):
        tables.row("steps", scheme="d")
    with pytest.raises(MissingTableError, match="no column 'error': it has scheme"):
        first.number("error")


@pytest.mark.parametrize(
    ("value", "text"),
    [
        *((0.034999, "0.035"), (1.4e-16, "1.4e-16"), (1284.0, "1300"), (99.6, "100"), (123456.0, "120 000")),
        *((0.0, "0"), (-2.5, "-2.5"), (math.nan, "none"), (math.inf, "inf"), (3e9, "3e9"), (9.99, "10")),
    ],
)
def test_numbers_are_rounded(value: float, text: str) -> None:
    assert rounded(value) == text


def test_limits_are_rounded_down_and_bounds_up() -> None:
    assert [rounded(value, 3, DOWN) for value in (0.29643, 0.000309616, 8.0**0.5, 0.3)] == [
        "0.296",
        "0.000309",
        "2.82",
        "0.3",
    ]
    assert [rounded(value, 2, UP) for value in (0.0100001, 0.01, 0.1 + 0.2, math.inf)] == [
        "0.011",
        "0.01",
        "0.3",
        "inf",
    ]
    assert [percent(value, 2, UP) for value in (0.015022, 0.004740, math.nan)] == ["1.6 %", "0.48 %", "none"]


def test_numbers_have_their_units() -> None:
    assert [grouped_digits(value) for value in (4096, 100_000)] == ["4096", "100 000"]
    assert [percent(value) for value in (0.0066, 1.17, math.nan)] == ["0.66 %", "120 %", "none"]
    assert [time(value) for value in (74.2, 0.0304, 2.5e-5, 4.2e-9, math.nan)] == [
        "74 s",
        "30 ms",
        "25 us",
        "4.2 ns",
        "none",
    ]
    assert span([3.4, math.nan, 1.71], unit="ns") == "1.7 to 3.4 ns"
    assert [span([1.001, 1.002]), span([])] == ["1", "none"]
    assert [listed("abc"), listed("ab", "or"), listed("a"), listed([])] == ["a, b and c", "a or b", "a", "none"]


def test_markdown_tables_keep_their_cells() -> None:
    assert (
        markdown_table(("a", "b"), [("1|2", ""), ("x\ny", "z")]) == "| a | b |\n| --- | --- |\n| 1\\|2 | |\n| x y | z |"
    )


def test_a_template_and_its_fields_agree(tmp_path: Path) -> None:
    template = tmp_path / "page.md"
    template.write_text("{one} and {two}, {{as it is}}\n", encoding="utf-8")
    assert filled(template, {"one": "1", "two": "{2}"}) == "1 and {2}, {as it is}\n"
    with pytest.raises(ValueError, match="fields differ: three, two"):
        filled(template, {"one": "1", "three": "3"})
