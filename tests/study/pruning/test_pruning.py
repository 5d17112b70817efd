"""The pruning study: measuring, fits, tables and the command, with small scenes."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest

from mudline.study import SAMPLE_TEXT, pruning, sample_scene, timing
from mudline.study.pruning import calls as ways
from mudline.study.pruning import cost as costs
from mudline.study.pruning import growth, imports
from mudline.study.pruning.calls import EVALUATE, STEP, STREAM, Measured, call_row
from mudline.study.pruning.cost import cost, curve_alone, plain_cost
from mudline.study.pruning.features import study_features
from mudline.study.pruning.growth import (
    GrowthRow,
    deck_with_sets,
    exponent,
    fits,
    growth_picture,
    per_unit,
    spread,
    upper_half,
)
from mudline.study.pruning.imports import import_rows
from mudline.study.pruning.plain import Plain
from mudline.study.pruning.scenes import CURVE, STEPS, Pipe, Variant, line, repeated, variants, with_curve
from mudline.study.report import Omission, StudyOptions, StudyReport
from mudline.study.timing import Spread, paired, ratios
from tests.builders.contact import CLAY, everything
from tests.builders.scenes import legal_scene
from tests.cli.runner import run
from tests.growth import calls

SAMPLES = Path(__file__).parents[3] / "samples"
ELEMENTS, LONGEST = growth.ELEMENTS, growth.LADDERS["sets"].sizes[-1]
PIPE = Pipe(CLAY, 6.0e4, 0.3, 2.0)
PLAIN = Variant(CURVE, lambda nodes: line(PIPE, nodes))


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(costs, "LADDER", (20, 60))
    monkeypatch.setattr(costs, "MOST", 100)
    monkeypatch.setattr(ways, "LADDER", (20, 60))
    monkeypatch.setattr(ways, "SERIES", (1, 3))
    monkeypatch.setattr(growth, "LADDERS", {what: one._replace(sizes=(2, 4)) for what, one in growth.LADDERS.items()})
    monkeypatch.setattr(growth, "NODES", 51)
    monkeypatch.setattr(growth, "FEW_NODES", 21)
    monkeypatch.setattr(growth, "ELEMENTS", 16)
    monkeypatch.setattr(timing, "REPEATS", 2)


@pytest.fixture
def hasty(monkeypatch: pytest.MonkeyPatch) -> None:
    """Figures that nobody looks at."""
    monkeypatch.setattr(timing, "_LEAST", 0.0)
    monkeypatch.setattr(timing, "_TICKS", 0.0)
    monkeypatch.setattr(timing, "REPEATS", 1)


@pytest.fixture
def without_interpreters(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(imports, "_asked", lambda data: (0.01 + 1e-9 * len(data), ["mudline.contact.model"], 8))


def report(text: str = SAMPLE_TEXT, *, full: bool = False) -> StudyReport:
    return pruning.run(legal_scene(text), StudyOptions(full))


def test_fits_find_power_laws() -> None:
    sizes = [1.0, 2.0, 4.0, 8.0]
    assert exponent(sizes, [3.0 * size**1.5 for size in sizes]) == pytest.approx(1.5)
    assert upper_half(sizes, [9.0, 9.0, 4.0, 8.0]) == pytest.approx(1.0)
    assert per_unit(sizes, [1.0, 1.0, 4.0, 8.0]) == 1.0
    assert np.isnan([exponent([2.0], [1.0]), upper_half([2.0], [1.0]), per_unit([2.0], [1.0])]).all()
    rows = [GrowthRow("planes", size, 0.5, 0.7, float(size), 9.0) for size in (1, 2, 4, 8)]
    (found,) = fits(rows)
    assert found[:3] == ("planes", 1, 8)
    assert found[3:] == pytest.approx((1.0, 1.0, 8.0, 1.0, 8.0))


def test_one_more_costs_the_difference_of_the_last_two() -> None:
    assert per_unit([1.0, 2.0, 4.0], [5.0, 6.0, 9.0]) == 1.5


def test_a_fit_of_one_size_is_not_drawn() -> None:
    rows = [GrowthRow("planes", 2, 0.1, 0.1, 0.1, 0.1)]
    assert growth_picture(rows, list(fits(rows))).png().startswith(b"\x89PNG")


def test_the_clock_counts_work() -> None:
    values = np.random.default_rng(1).random(200_000)
    short, long = paired([lambda: np.sort(values[:20_000]), lambda: np.sort(values)], 4)
    assert [len(short), len(long)] == [4, 4]
    assert ratios(long, short).median > 3.0


def test_calls_are_paired_in_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[str] = []
    monkeypatch.setattr(timing, "_LEAST", 0.0)
    monkeypatch.setattr(timing, "_TICKS", 0.0)
    paired([lambda: made.append("a"), lambda: made.append("b")], 3)
    assert "".join(made) == "ab" + "ab" + "ba" + "ab"


def test_a_spread_has_quartiles() -> None:
    assert Spread.of([5.0, 1.0, 2.0, 3.0, 4.0]) == (1.0, 2.0, 3.0, 4.0)
    assert Spread.of([2.0]).times(3.0) == (6.0, 6.0, 6.0, 6.0)
    assert ratios([2.0, 9.0, 4.0], [1.0, 3.0, 1.0]).median == 3.0


def test_cost_of_a_scene() -> None:
    plain = cost(PLAIN, PLAIN.make(2000), PIPE)
    assert (plain.scene, plain.nodes, plain.touching, plain.history) == (CURVE, 2000, 1.0, False)
    assert 0.0 < plain.nanoseconds <= plain.lower <= plain.median <= plain.upper
    assert plain.prepare > 0.0
    assert 84.0 < plain.peak < 400.0  # the result alone has 84 bytes a node
    everywhere = variants(everything(9, 1), PIPE)[-1]
    dear = cost(everywhere, everywhere.make(2000), PIPE)
    assert dear.history
    assert dear.ratio > 3.0
    assert dear.peak > 2.0 * plain.peak
    bare = plain_cost(PLAIN.make(2000), PIPE)
    assert (bare.scene, bare.touching, bare.history) == ("plain numpy", 1.0, False)
    assert bare.peak < plain.peak


def test_times_are_of_a_node_and_a_step(monkeypatch: pytest.MonkeyPatch) -> None:
    """A run through the series takes 6 us in all, 2 us to prepare."""
    monkeypatch.setattr(costs, "paired", lambda timed: [[6e-6] * 3] * 2 if len(timed) > 1 else [[2e-6] * 3])
    row = cost(PLAIN, PLAIN.make(20), PIPE)
    assert row.median == pytest.approx(6e3 / (20 * STEPS))
    assert row.prepare == pytest.approx(2e3 / 20)
    assert row.ratio == 1.0


def test_the_curve_is_a_part_of_the_scene(monkeypatch: pytest.MonkeyPatch) -> None:
    def counted(made: Sequence[Callable[[], object]]) -> list[list[float]]:
        return [[float(calls(call))] for call in made]

    monkeypatch.setattr("mudline.study.pruning.cost.paired", counted)
    row = curve_alone(PIPE, 5000)
    assert row.curve < row.bare
    assert row.over_curve > 1.0
    assert row.over_bare == pytest.approx(row.scene / row.bare)
    assert row.equal


@pytest.mark.parametrize("call", [EVALUATE, STREAM, STEP])
def test_calls_are_compared_with_plain_numpy(call: str) -> None:
    copies = repeated(sample_scene().contact_input(), 3)
    for inputs in (line(PIPE, 30), with_curve(copies, PIPE)):
        row = call_row(Measured("s", inputs, lies=False, plain=Plain.of(inputs)), PIPE, call, 4)
        assert (row.call, row.nodes, row.steps, row.equal) == (call, len(inputs.node_ids), 4, True)
        assert row.ratio_lower <= row.ratio <= row.ratio_upper
        assert min(row.plain, row.peak, row.plain_peak) > 0.0
    alone = call_row(Measured("s", copies, lies=True, plain=None), PIPE, call, 4)
    assert alone.equal is None
    assert alone.time > 0.0
    assert np.isnan([alone.plain, alone.ratio, alone.plain_peak]).all()


def test_features_have_their_lines() -> None:
    rows = study_features(sample_scene()).tables[0].rows
    lines = SAMPLE_TEXT.splitlines()
    found = {str(row[0]): lines[int(str(row[1])) - 1].strip() for row in rows}
    assert found == {
        "friction": "FRICTION=0.35, 0.60, 0.003, 0.150",
        "smoothing or nodal springs": "SET=Sand",
        "suction": "SET=Clay",
    }
    assert [row[2:] for row in rows] == [(10, True, ""), (3, False, ""), (7, True, "")]


def test_imports_are_distinguished(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(timing, "REPEATS", 1)
    found = {one.name: one for one in variants(everything(9, 1), PIPE)}
    chosen = [found[name] for name in ("curve", "linear law", "curve, unloading")]
    omissions: list[Omission] = []
    plain, linear, unloading = import_rows(chosen, CURVE, StudyOptions(), omissions)
    assert omissions == []
    assert plain.beyond == ()
    assert plain.seconds.least > 0.0
    assert linear.beyond == ("laws.linear",)
    assert linear.modules < plain.modules
    assert unloading.beyond == ("laws.unloading",)
    assert unloading.modules == plain.modules + 1


def test_loads_are_repeated_in_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    times = iter([0.3, 2.0, 0.1, 2.2])
    monkeypatch.setattr(imports, "_asked", lambda data: (next(times), ["mudline.contact.model"], len(data) * 0))
    rows = list(import_rows([PLAIN, Variant("slow", PLAIN.make)], CURVE, StudyOptions(), []))
    assert [(row.seconds.least, row.seconds.median) for row in rows] == [(0.1, 0.2), (2.0, 2.1)]


def test_an_interpreter_that_fails_is_an_omission(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(data: bytes) -> tuple[float, list[str], int]:
        raise subprocess.TimeoutExpired("python", len(data))

    monkeypatch.setattr(imports, "_asked", fails)
    omissions: list[Omission] = []
    assert list(import_rows([PLAIN], CURVE, StudyOptions(), omissions)) == []
    assert omissions[0].what == "imports of curve"
    assert "timed out" in omissions[0].reason


@pytest.mark.parametrize("sets", [1, 3, 16])
def test_decks_with_sets_share_out_the_elements(sets: int) -> None:
    scene = legal_scene(deck_with_sets(sets, 16))
    inputs = scene.contact_input()
    assert len(scene.element_ids) == 16
    assert len(set(inputs.assigned["linear"]["stiffness"])) == sets


def test_the_longest_ladder_has_an_element_for_each_set() -> None:
    assert 4 * LONGEST <= ELEMENTS


def test_spread_curves_have_their_points() -> None:
    assert [len(spread(points, 1000.0).ratios) for points in (2, 5, 4096)] == [2, 5, 4096]


@pytest.mark.usefixtures("hasty", "without_interpreters")
def test_report() -> None:
    found = report()
    assert [table.name for table in found.tables] == [
        *("curve", "stages", "imports", "growth", "calls", "nodes", "sizes", "modules", "features", "machine"),
    ]
    assert [picture.name for picture in found.pictures] == ["nodes", "stages", "plain", "growth"]
    assert [row[0] for row in found.tables[0].rows] == [20, 60, 100]
    assert len(found.tables[1].rows) == 17
    assert len(found.tables[4].rows) == 2 * 3 * 6
    assert len(found.tables[5].rows) == 34
    assert {row[0] for row in found.tables[3].rows} == set(growth.LADDERS)
    assert [omission.what for omission in found.omissions] == ["100 nodes with stages on"]


@pytest.mark.usefixtures("hasty", "without_interpreters")
def test_full_report_has_the_largest_scenes_too() -> None:
    progress: list[str] = []
    found = pruning.run(sample_scene(), StudyOptions(full=True, progress=progress.append))
    assert max(row[1] for row in found.tables[5].rows if isinstance(row[1], int)) == 100
    assert found.omissions == ()
    assert "100 nodes: everything" in progress
    assert "planes: up to 16" in progress


@pytest.mark.usefixtures("hasty", "without_interpreters")
def test_a_deck_without_curves_is_studied_with_the_usual_one() -> None:
    found = report(SAMPLE_TEXT.replace("STIFFNESS=Soft Clay", "STIFFNESS=50.0E3"))
    assert found.notes[-1].startswith("The deck's elements have no curve")


def test_a_deck_without_elements_has_nothing_to_time() -> None:
    outcome = run("study", "pruning", SAMPLES / "lines-deck.keyxm", "-q")
    assert outcome.code == 1
    assert "lines-deck.keyxm: the deck has no elements of its own, so there is nothing to study" in outcome.err


@pytest.mark.usefixtures("hasty", "without_interpreters")
def test_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    deck = SAMPLES / "scr-touchdown.keyxm"
    outcome = run("study", "pruning", deck, "-o", tmp_path, "--output-format", "json", "-q")
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.json()["study"] == "pruning"
    page = (tmp_path / "pruning.md").read_text(encoding="utf-8")
    assert "friction (deck line 297)" in page.splitlines()[2]
    assert json.loads((tmp_path / "pruning.json").read_text(encoding="utf-8"))["title"].endswith("touchdown.keyxm")
    assert len(list(tmp_path.glob("pruning-*.csv"))) == 10
    pictures = list(tmp_path.glob("pruning-*.png"))
    assert len(pictures) == 4
    assert all(picture.read_bytes().startswith(b"\x89PNG") for picture in pictures)
    made = report()
    monkeypatch.setattr(pruning, "run", lambda scene, options: options.progress(scene.units) or made)
    text = run("study", "pruning", deck)
    assert "A scene with nothing but a curve" in text.out
    assert text.err == "mudline: pruning: metric\n"
    table = run("study", "pruning", deck, "--output-format", "csv", "-q").out
    assert table.startswith("nodes,curve alone [ns/node],")
