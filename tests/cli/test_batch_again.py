"""Results of many decks in a folder: their names, and what a second run takes over."""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Callable
from pathlib import Path

import pytest

from mudline.cli import cases, known_results
from mudline.results.cases import CaseSummary
from tests.builders.decks import BAD_NUMBER, CLEAN
from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, Outcome, run

LIST = Path("out", known_results.LIST)
STATE = "node,x,y,z\n1,-0.3,0,0\n2,-0.3,10,0\n3,0.3,20,0\n"


@pytest.fixture
def decks(place: Place) -> str:
    for name in "ab":
        place(CLEAN, f"decks/{name}.keyxm")
    return "decks"


def evaluated(*options: str) -> Outcome:
    return run("batch", "decks", "-o", "out", "--form", "csv", "--output-format", "json", *options)


def taken(outcome: Outcome) -> int:
    """How many results a run has taken over."""
    (line,) = (line for line in outcome.err.splitlines() if "taken over" in line)
    return int(line.split(", ")[1].split()[0])


def files() -> set[str]:
    return {path.relative_to("out").as_posix() for path in Path("out").rglob("*") if path.is_file()}


# ------------------------------------------------------------------------------------------------------------ names


def test_decks_of_one_name_keep_apart(place: Place) -> None:
    for name in ("near/case.keyxm", "far/case.keyxm", "far/case.keyx", "case-nodes.keyxm", "case.keyxm"):
        place(CLEAN, f"decks/{name}")
    place(CLEAN, "decks/summary.keyxm")
    outcome = evaluated()
    results = {row["deck"].removeprefix("decks/"): row["result"] for row in outcome.json()}
    assert results == {
        "near/case.keyxm": "near/case.csv",
        "far/case.keyxm": "far/case.keyxm.csv",
        "far/case.keyx": "far/case.keyx.csv",
        "case-nodes.keyxm": "case-nodes.keyxm.csv",
        "case.keyxm": "case.keyxm.csv",
        "summary.keyxm": "summary.keyxm.csv",
    }
    beside = {
        f"{Path(name).with_suffix('')}{end}.csv" for name in results.values() for end in ("", "-nodes", "-summary")
    }
    assert {name for name in files() if name.endswith(".csv")} - {"summary.csv"} == beside


def test_summary_is_parquet_or_csv(decks: str, monkeypatch: pytest.MonkeyPatch) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    found = run("batch", decks, "-o", "out", "--output-format", "json").json()
    assert {"a.parquet", "a-nodes.parquet", "a-summary.parquet", "summary.parquet"} < files()
    assert parquet.read_table("out/summary.parquet").to_pylist() == found
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)
    monkeypatch.delitem(__import__("sys").modules, "mudline.results.forms.parquet", raising=False)
    assert run("batch", decks, "-o", "bare").code == 0
    assert Path("bare/summary.csv").read_text(encoding="utf-8").startswith("deck,verdict,")
    assert Path("bare/a.npz").exists()
    outcome = run("batch", decks, "-o", "bare", "--form", "parquet")
    assert (outcome.code, outcome.err) == (1, "mudline: .parquet needs pyarrow: pip install 'mudline[parquet]'\n")


# ------------------------------------------------------------------------------------------------------- taken over


@pytest.mark.usefixtures("decks")
def test_second_run_takes_over_what_has_not_changed(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    first = evaluated()
    before = {name: Path("out", name).read_bytes() for name in files()}
    assert taken(first) == 0
    with monkeypatch.context() as patch:
        patch.setattr(cases, "load_bytes", None)  # nothing is read again
        second = evaluated()
    assert (taken(second), second.out) == (2, first.out)
    assert {name: Path("out", name).read_bytes() for name in files()} == before
    assert taken(evaluated("--no-cache")) == 0
    place(CLEAN.replace("-0.1, 0.0", "-0.12, 0.0"), "decks/b.keyxm")
    changed = evaluated()
    assert taken(changed) == 1
    assert changed.out != first.out


def spoil(path: str) -> Callable[[], object]:
    return lambda: Path(path).write_bytes(Path(path).read_bytes()[:-5])


def edited(change: Callable[[dict[str, object]], object]) -> Callable[[], object]:
    """Change the row of a deck in the list, with a digest that fits."""

    def edit() -> None:
        content = json.loads(LIST.read_bytes())
        change(content["results"]["a.csv"])
        content["digest"] = known_results._digest(content["results"])
        LIST.write_text(json.dumps(content), encoding="utf-8")

    return edit


DAMAGE: dict[str, tuple[Callable[[], object], int]] = {
    "file": (spoil("out/a.csv"), 1),
    "file beside": (spoil("out/a-nodes.csv"), 1),
    "missing": (lambda: Path("out/a-summary.csv").unlink(), 1),
    "list": (spoil(str(LIST)), 0),
    "no list": (LIST.unlink, 0),
    "digest": (lambda: LIST.write_text(LIST.read_text().replace('"steps": 1', '"steps": 2')), 0),
    "format": (lambda: LIST.write_text(LIST.read_text().replace("results/1", "results/0")), 0),
    "no object": (lambda: LIST.write_text("[]"), 0),
    "row": (edited(lambda entry: entry.update(row={})), 1),
    "type": (edited(lambda entry: entry.update(row=CaseSummary("a", "evaluated").row() | {"steps": "1"})), 1),
    "warnings": (edited(lambda entry: entry.update(warnings=[1])), 1),
    "written": (edited(lambda entry: entry.update(written=[])), 1),
    "nothing": (edited(lambda entry: entry.clear()), 1),
}


@pytest.mark.usefixtures("decks")
@pytest.mark.parametrize(("damage", "left"), DAMAGE.values(), ids=DAMAGE)
def test_what_is_damaged_is_evaluated_anew(damage: Callable[[], object], left: int) -> None:
    first = evaluated()
    good = Path("out/a.csv").read_bytes()
    damage()
    again = evaluated()
    assert (again.code, again.out, taken(again)) == (0, first.out, left)
    assert Path("out/a.csv").read_bytes() == good
    assert taken(evaluated()) == 2


@pytest.mark.usefixtures("decks")
@pytest.mark.parametrize(
    "options",
    [("--tension", "cut"), ("--units", "user"), ("--form", "npz"), ("--positions", "state.csv")],
)
def test_other_options_are_other_results(folder: Path, options: tuple[str, ...]) -> None:
    (folder / "state.csv").write_text(STATE, encoding="utf-8")
    evaluated()
    assert taken(evaluated(*options)) == 0
    assert taken(evaluated(*options)) == 2


@pytest.mark.usefixtures("decks")
def test_changed_positions_are_other_results(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    state = folder / "state.csv"
    state.write_text(STATE, encoding="utf-8")
    monkeypatch.setattr(known_results, "changed_since", lambda *_: False)
    options = ("--positions", "state.csv")
    evaluated(*options)
    assert taken(evaluated(*options)) == 2
    state.write_text(STATE.replace("-0.3", "-0.2"), encoding="utf-8")
    assert taken(evaluated(*options)) == 0


def test_deck_that_another_one_names_is_looked_at(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(known_results, "changed_since", lambda *_: False)
    for name in ("scr-dynamic.keyxm", "scr-touchdown.keyxm"):
        place((SAMPLES / name).read_bytes(), f"decks/{name}")
    evaluated()
    assert taken(evaluated()) == 2
    place((SAMPLES / "scr-touchdown.keyxm").read_bytes() + b"C\n", "decks/scr-touchdown.keyxm")
    assert taken(evaluated()) == 0


@pytest.mark.usefixtures("decks")
def test_file_that_changes_during_the_run_is_not_relied_on(folder: Path) -> None:
    (folder / "state.csv").write_text(STATE, encoding="utf-8")
    os.utime(folder / "state.csv", (2e9, 2e9))
    options = ("--positions", "state.csv")
    evaluated(*options)
    assert taken(evaluated(*options)) == 0


@pytest.mark.usefixtures("decks")
def test_deck_that_fails_now_has_no_old_results(place: Place) -> None:
    evaluated()
    place(BAD_NUMBER, "decks/a.keyxm")
    outcome = evaluated()
    assert (outcome.code, taken(outcome)) == (1, 1)
    assert not [name for name in files() if name.startswith("a")]
    place(CLEAN, "decks/a.keyxm")
    evaluated()
    Path("out/a.csv").write_text("of the user", encoding="utf-8")
    place(BAD_NUMBER, "decks/a.keyxm")
    evaluated()
    assert Path("out/a.csv").read_text(encoding="utf-8") == "of the user"


@pytest.mark.usefixtures("decks")
def test_other_decks_stay_known(place: Place) -> None:
    evaluated()
    place(CLEAN, "decks/c.keyxm")
    assert run("batch", "decks/c.keyxm", "decks/b.keyxm", "-o", "out", "--form", "csv").code == 0
    assert taken(evaluated()) == 3


# ------------------------------------------------------------------------------------------------------ interruption


@pytest.mark.usefixtures("decks")
def test_interrupted_run_keeps_what_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    work = cases._kept

    def second_is_interrupted(order: cases.Order, path: Path | None) -> known_results.Kept:
        if order.file.name.endswith("b.keyxm"):
            signal.raise_signal(signal.SIGINT)
        return work(order, path)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # it may be ignored in the background
    with monkeypatch.context() as patch:
        patch.setattr(cases, "_kept", second_is_interrupted)
        outcome = evaluated("--jobs", "1")  # a slow machine would start processes, which the patch does not reach
    signal.signal(signal.SIGINT, before)
    assert (outcome.code, outcome.out) == (130, "")
    assert files() == {"a.csv", "a-nodes.csv", "a-summary.csv", known_results.LIST}
    assert taken(evaluated()) == 1
