"""Reports: files, JSON, CSV, machine, run times, pictures."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from mudline.study.pictures import (
    Picture,
    draw_lines,
    drawn,
    label,
    legend_below,
    shortened,
    style,
    zero_place,
    zero_tick,
)
from mudline.study.report import Column, Omission, StudyReport, StudyTable
from mudline.study.schemes import SCHEMES, STYLES
from mudline.study.timing import _processor, machine, timed

TABLE = StudyTable(
    "errors",
    "Errors",
    (Column("method"), Column("error", "N/m"), Column("right")),
    [("a", 0.1, True), ("b", float("nan"), None)],
)


def draw(figure: Figure) -> None:
    axes = figure.add_subplot()
    for index in range(3):
        axes.plot([0, 1], [index, 1], label=f"line {index}", **style(index))
    label(axes, "Lines", "x [-]", "y [m]")
    legend_below(figure, axes)


REPORT = StudyReport(
    "precision",
    "A title",
    (TABLE,),
    (Picture("lines", "Some lines.", draw, (4.0, 3.0)),),
    ("a note",),
    (Omission("c", "too slow"),),
)


def test_files(tmp_path: Path) -> None:
    folder = tmp_path / "new" / "folder"
    files = REPORT.write(folder)
    assert sorted(path.name for path in files) == ["precision-errors.csv", "precision-lines.png", "precision.json"]
    assert (folder / "precision-lines.png").read_bytes().startswith(b"\x89PNG")
    with (folder / "precision-errors.csv").open(newline="", encoding="utf-8") as stream:
        assert list(csv.reader(stream)) == [["method", "error [N/m]", "right"], ["a", "0.1", "true"], ["b", "", ""]]


def test_json() -> None:
    whole = json.loads(REPORT.json())
    assert whole["study"] == "precision"
    assert whole["tables"][0]["columns"][1] == {"name": "error", "unit": "N/m"}
    assert whole["tables"][0]["rows"] == [["a", 0.1, True], ["b", None, None]]
    assert whole["omissions"] == [{"what": "c", "reason": "too slow"}]
    assert whole["pictures"] == [{"name": "lines", "caption": "Some lines."}]
    assert whole["machine"]["cores"]


def test_names_of_a_deck_are_drawn_as_they_are() -> None:
    names = ["a$", "$x_$", r"\$\frac{$", "_hidden", "\x1b[31m\u6c34"]

    def named(figure: Figure) -> None:
        axes = figure.add_subplot()
        for index, name in enumerate(names):
            axes.plot([0, 1], [index, 1], label=drawn(name), **style(index))
        label(axes, shortened(names[1] * 40), "x [-]", "y [m]")
        legend_below(figure, axes)
        figure.canvas.draw_idle()
        assert len(figure.legends[0].get_texts()) == len(names)

    assert Picture("names", "Names.", named, (4.0, 3.0)).png().startswith(b"\x89PNG")


def test_names_that_are_no_utf_8_are_written(tmp_path: Path) -> None:
    replace(REPORT, title="deck-\udcff.keyxm", pictures=()).write(tmp_path)
    assert json.loads((tmp_path / "precision.json").read_bytes())["title"] == "deck-\udcff.keyxm"


def test_machine_names_versions_and_no_place() -> None:
    found = machine()
    assert {"processor", "cores", "system", "Python", "mudline", "numpy"} <= set(found)
    assert not any("/" in value for name, value in found.items() if name != "processor")


def test_processor(tmp_path: Path) -> None:
    listing = tmp_path / "cpuinfo"
    listing.write_text("processor : 0\nmodel name\t: Some Chip 3000\nmodel name : other\n", encoding="utf-8")
    assert _processor(listing) == "Some Chip 3000"
    assert _processor(tmp_path / "missing")


def test_package_that_is_not_there_is_not_listed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.study.timing._PACKAGES", ("numpy", "no-such-package"))
    assert "no-such-package" not in machine()


def test_timing() -> None:
    calls: list[int] = []
    timing = timed(lambda: calls.append(1), runs=5)
    assert (timing.runs, len(calls)) == (5, 5)
    assert 0.0 <= timing.best <= timing.median
    readings = iter([0.0, 0.5, 1.0, 1.25, 2.0, 2.75])
    assert timed(lambda: calls.append(1), runs=1, at_least=1.0, clock=lambda: next(readings)) == (0.25, 0.5, 3)
    assert len(calls) == 8
    still = timed(lambda: None, runs=2, repeats=3, clock=lambda: 1.0)
    assert still.best == pytest.approx(1e-9)


def test_styles_differ() -> None:
    styles = [tuple(style(index).items()) for index in range(20)]
    assert len(set(styles)) == 20


def test_zero_has_its_own_tick() -> None:
    figure = Figure()
    axes = figure.add_subplot()
    widths = [0.0, 1e-4, 3e-3, 0.5]
    place = zero_place(widths)
    assert place == pytest.approx(1e-5)
    draw_lines(axes, {"a": [(width or place, 1.0 + width) for width in widths]}, "T", "h [m]", "y [-]")
    zero_tick(axes, place, "h = 0")
    figure.draw_without_rendering()
    texts = {tick.get_position()[0]: tick.get_text() for tick in axes.get_xticklabels()}
    assert texts[place] == "h = 0"
    assert "10^{-4}" in texts[1e-4]
    assert min(set(texts) - {place}) > 1e-5
    assert axes.get_xlim()[0] < place
    assert zero_place([0.0]) == 0.1


def test_schemes_have_one_style_each() -> None:
    looks = {(look["color"], look["marker"]) for look in STYLES.values()}
    assert set(STYLES) == {scheme.title for scheme in SCHEMES.values()}
    assert len(looks) == len(SCHEMES)
    figure = Figure()
    axes = figure.add_subplot()
    draw_lines(axes, {"Newmark": [(1.0, 1.0)], "other": [(1.0, 1.0)]}, "T", "x", "y", STYLES)
    assert [line.get_color() for line in axes.lines] == [STYLES["Newmark"]["color"], style(1)["color"]]
