"""Reports: files, JSON, CSV, machine, run times, pictures."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from mudline.study.pictures import Picture, drawn, label, legend_below, shortened, style
from mudline.study.report import Column, Omission, StudyReport, StudyTable
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
