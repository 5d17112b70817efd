"""`mudline batch`: a row for each deck, worst first, a result file each, and what a second run takes over."""

from __future__ import annotations

import csv
import io
import json
import multiprocessing
import signal
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest

from mudline.cli import batch_cases, batch_command
from mudline.cli.batch_cases import Order, named_cases
from mudline.cli.inputs import Input
from mudline.model.results.cases import CASES
from mudline.model.results.forms import TABLES
from mudline.model.results.series import SERIES
from mudline.tools.running import executors, remembered
from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, Json, Outcome, assert_fits, run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN, PULLING

DEEP = CLEAN.replace("-0.1,", "-0.2,")
"""Twice as deep as CLEAN: twice the force."""
HIGH = CLEAN.replace("-0.1,", "0.1,")
"""Nothing is in contact."""
STATE = "node,x,y,z\n1,-0.3,0,0\n2,-0.3,10,0\n3,0.3,20,0\n"
MEMORY = Path("out", batch_command._MEMORY)


@pytest.fixture
def eager(monkeypatch: pytest.MonkeyPatch) -> None:
    """Processes are used behind the first deck, whatever there is to do."""
    monkeypatch.setattr(executors, "PAYS", dict.fromkeys(executors.PAYS, 0.0))
    monkeypatch.setattr(executors, "TRIED", 0.0)


@pytest.fixture
def four(place: Place) -> str:
    for name, text in {"a": HIGH, "b": CLEAN, "c": BAD_NUMBER, "d": DEEP}.items():
        place(text, f"decks/{name}.keyxm")
    return "decks"


@pytest.fixture
def two(place: Place) -> str:
    for name in "ab":
        place(CLEAN, f"decks/{name}.keyxm")
    return "decks"


def batch(*arguments: str | Path) -> Outcome:
    return run("batch", "-o", "out", *arguments)


def rows(*arguments: str | Path, code: int = 0) -> Json:
    """The rows of a run in JSON, by the names of the decks; their order is kept."""
    outcome = batch(*arguments, "--output-format", "json")
    assert outcome.code == code, outcome.err
    found = outcome.json()
    assert_fits(found, "cases")
    return {Path(row["deck"]).stem: row for row in found}


def again(*options: str) -> Outcome:
    return batch("decks", "--form", "csv", "--output-format", "json", *options)


def taken(outcome: Outcome) -> int:
    """How many results a run has taken over."""
    (line,) = (line for line in outcome.err.splitlines() if "taken over" in line)
    return int(line.split(", ")[1].split()[0])


def files(folder: str = "out") -> dict[str, bytes]:
    found = sorted(path for path in Path(folder).rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in found}


# ----------------------------------------------------------------------------------------------------------- rows


def test_failed_decks_come_first_then_the_largest_force(four: str) -> None:
    outcome = batch(four)
    assert outcome.code == 1
    lines = outcome.out.splitlines()
    assert (lines[0], lines[1].split()) == ("Failed in decks", ["deck", "reason"])
    assert lines[3].startswith("c.keyxm  line 6: SYN002 'ten' is not a number: ")
    assert "Contact of 3 decks in decks" in lines
    assert [line[:7] for line in lines[-5:-2]] == ["d.keyxm", "b.keyxm", "a.keyxm"]
    assert lines[-1] == "4 decks: 3 evaluated, 3 with warnings, 1 failed"
    assert max(map(len, lines)) <= 100


def test_row_has_what_is_worst(four: str) -> None:
    found = rows(four, code=1)
    one = run("evaluate", "decks/d.keyxm", "--output-format", "json").json()
    element, line = one["elements"][0], one["summary"][0]
    row = found["d"]
    assert (row["deck"], row["verdict"], row["reason"]) == ("decks/d.keyxm", "evaluated", None)
    assert (row["steps"], row["elements"], row["in_contact"], row["positions"]) == (1, 2, 1, "deck")
    assert (row["largest_force"], row["largest_force_element"]) == (element["force"], element["element"])
    assert row["touchdown_from"] == row["touchdown_to"] == line["touchdown"][0]["arc_length"]
    assert [row[name] for name in ("contact_length", "reaction", "ratio")] == [
        line[name] for name in ("contact_length", "reaction", "ratio")
    ]
    assert row["warnings"] == len(one["warnings"])
    assert row["warning_codes"].split() == sorted({each["code"] for each in one["warnings"]})
    assert (found["a"]["largest_force"], found["a"]["touchdown_from"], found["a"]["in_contact"]) == (None, None, 0)
    assert {name for name, value in found["c"].items() if value is not None} == {"deck", "verdict", "reason"}
    table = list(csv.DictReader(io.StringIO(batch(four, "--output-format", "csv").out)))
    assert list(table[0]) == list(CASES)
    assert [row["deck"][-7:-6] for row in table] == ["c", "d", "b", "a"]
    assert float(table[1]["largest_force"]) == row["largest_force"]


def test_series_and_pulls(place: Place, folder: Path) -> None:
    place(PULLING, "decks/pulling.keyxm")
    place(CLEAN, "decks/clean.keyxm")
    steps = np.array([[[-down, 0.0, 0.0], [-down, 10.0, 0.0], [0.3, 20.0, 0.0]] for down in (0.1, 0.3, 0.2)])
    np.savez(folder / "steps.npz", positions=steps, time=np.array([0.0, 0.5, 1.0]))
    found = rows("decks", "--positions", "steps.npz")
    pulled, pushed = found["pulling"], found["clean"]
    assert (pulled["steps"], pulled["positions"]) == (3, "file")
    assert (pushed["largest_force"], pushed["largest_force_time"], pushed["largest_uplift"]) == (3500.0, 0.5, None)
    assert pulled["largest_uplift"] < 0.0
    assert (pulled["largest_uplift_element"], pulled["largest_uplift_time"]) == (1, 0.0)
    assert pushed["touchdown_from"] < pushed["touchdown_to"]
    shown = batch("decks", "--positions", "steps.npz", "-q").out
    assert "steps" in shown
    assert "uplift" in shown


def test_summary_only_writes_what_evaluate_does(two: str, folder: Path) -> None:
    np.save(folder / "steps.npy", np.array([[[-0.1, 0.0, 0.0], [-0.1, 10.0, 0.0], [0.3, 20.0, 0.0]]] * 3))
    np.save(folder / "state.npy", np.array([[0.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 20.0, 0.0]]))
    options = ("--positions", "steps.npy", "--time-step", "0.5", "--summary-only")
    assert rows(two, *options, "--form", "json")["a"]["steps"] == 3
    assert run("evaluate", "decks/a.keyxm", *options, "-q", "-o", "one.json").code == 0
    assert Path("one.json").read_bytes() == Path("out/a.json").read_bytes()
    state = rows(two, "--positions", "state.npy", "--summary-only", "--form", "json")["a"]
    summary = json.loads(Path("out/a.json").read_text(encoding="utf-8"))
    assert_fits(summary, "series")
    assert (state["steps"], summary["steps"], summary["positions"]) == (1, 1, "file")
    assert (summary["summary"][0]["reaction_least"], state["reaction"]) == (state["reaction"],) * 2


# ------------------------------------------------------------------------------------------------------- exit codes


def test_gitignore_hides_decks(four: str, folder: Path) -> None:
    (folder / ".git").mkdir()
    (folder / ".gitignore").write_text("c.keyxm\n", encoding="utf-8")
    assert set(rows(four)) == {"a", "b", "d"}
    assert set(rows(four, "--no-gitignore", code=1)) == {"a", "b", "c", "d"}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-"], "- is one deck, from standard input: mudline evaluate takes it"),
        (["--positions", "{case}.csv"], "--positions: {case} is unknown: use {name} or {folder}"),
        (["--positions", "{name.csv"], "--positions {name.csv: not a pattern: expected '}' before end of string"),
        (["--positions", "nowhere.csv"], "nowhere.csv: no such file or directory"),
        (["--time-step", "0"], "--time-step is 0.0: it must be greater than 0"),
        (["-o", "decks/a.keyxm"], "decks/a.keyxm: cannot be created: file exists"),
        (["--form", "xlsx"], "Invalid value for '--form': 'xlsx' is not one of 'csv', 'json', 'npz', 'parquet'."),
    ],
)
def test_options_that_do_not_fit(four: str, arguments: list[str], message: str) -> None:
    outcome = batch(four, *arguments)
    assert (outcome.code, outcome.out) == (2, "")
    assert f"mudline: {message}" in outcome.err
    missing = run("batch", four)
    assert (missing.code, "Missing option '-o'" in missing.err) == (2, True)


# -------------------------------------------------------------------------------------------------------- positions


def test_positions_from_one_file(two: str, folder: Path) -> None:
    (folder / "all.csv").write_text(STATE, encoding="utf-8")
    assert [row["largest_force"] for row in rows(two, "--positions", "all.csv").values()] == [3500.0] * 2
    (folder / "all.csv").write_text(STATE + "9,0,0,0\n", encoding="utf-8")
    found = rows(two, "--positions", "all.csv", code=1)
    assert found["a"]["reason"] == "all.csv:5: DAT001 node 9 is not defined in the deck"


# ------------------------------------------------------------------------------------------------------------ names


@pytest.mark.parametrize("given", ["{folder}/{name}.csv", "at/{name}.csv", "at"])
def test_positions_by_name(two: str, folder: Path, given: str) -> None:
    where = folder / ("decks" if "{folder}" in given else "at")
    where.mkdir(exist_ok=True)
    (where / "a.csv").write_text(STATE, encoding="utf-8")
    found = rows(two, "--positions", given, code=1)
    assert found["a"]["largest_force"] == 3500.0
    assert found["b"]["reason"].startswith("its positions were not found: ")


def test_folder_of_positions_is_as_that_of_the_decks(place: Place, folder: Path) -> None:
    for where, depth in {"near": "-0.3", "far": "-0.2"}.items():
        place(CLEAN, f"decks/{where}/case.keyxm")
        (folder / "at" / where).mkdir(parents=True)
        (folder / "at" / where / "case.csv").write_text(STATE.replace("-0.3", depth), encoding="utf-8")
    (folder / "at" / "case.csv").write_text(STATE.replace("-0.3", "-0.25"), encoding="utf-8")
    found = batch("decks", "--positions", "at", "--output-format", "json").json()
    assert [(row["deck"], row["largest_force"]) for row in found] == [
        ("decks/near/case.keyxm", 3500.0),
        ("decks/far/case.keyxm", 2500.0),
    ]
    (folder / "at" / "far" / "case.npz").touch()
    message = "several files of positions: at/far/case.csv, at/far/case.npz"
    assert rows("decks/far", "decks/near", "--positions", "at", code=1)["case"]["reason"] in (message, None)


def results(*paths: str, form: str = "npz", tables: Sequence[str] = TABLES) -> list[str]:
    return [case.results[0] for case in named_cases([Input(path, path) for path in paths], form, tables)[1]]


def test_results_are_named_as_the_decks_below_their_common_folder() -> None:
    assert results("a/b/c.keyxm", "a/d.keyxm") == ["b/c.npz", "d.npz"]
    assert results("a/b/c.d.keyxm") == ["c.d.npz"]
    assert results("c.keyxm", "C.keyx", "d.keyxm") == ["c.keyxm.npz", "C.keyx.npz", "d.npz"]
    assert results("c.keyxm", "c-nodes.keyxm", form="csv") == ["c.keyxm.csv", "c-nodes.keyxm.csv"]
    assert results("c.keyxm", "c-nodes.keyxm") == ["c.npz", "c-nodes.npz"]
    assert results("c.keyxm", "c-totals.keyxm", form="csv") == ["c.csv", "c-totals.csv"]
    assert results("c.keyxm", "c-totals.keyxm", form="csv", tables=SERIES) == ["c.keyxm.csv", "c-totals.keyxm.csv"]
    assert results("summary.keyxm", "e/summary.keyxm") == ["summary.keyxm.npz", "e/summary.npz"]


def test_results_do_not_replace_what_they_are_made_from(two: str, folder: Path) -> None:
    (folder / "decks" / "a.csv").write_text(STATE, encoding="utf-8")
    arguments = ("batch", two, "-o", "decks", "--form", "csv", "--positions", "{folder}/{name}.csv")
    outcome = run(*arguments)
    assert (outcome.code, "decks/a.csv would replace decks/a.csv, which this run reads" in outcome.err) == (2, True)
    assert (folder / "decks" / "a.csv").read_text(encoding="utf-8") == STATE


def test_summary_is_parquet_or_csv(two: str, monkeypatch: pytest.MonkeyPatch) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    found = batch(two, "--output-format", "json").json()
    assert {"a.parquet", "a-nodes.parquet", "a-summary.parquet", "summary.parquet"} < set(files())
    assert parquet.read_table("out/summary.parquet").to_pylist() == found
    monkeypatch.setattr(batch_command, "is_installed", lambda _: False)
    assert run("batch", two, "-o", "bare").code == 0
    assert Path("bare/summary.csv").read_text(encoding="utf-8").startswith("deck,verdict,")
    assert Path("bare/a.npz").exists()


# ------------------------------------------------------------------------------------------------------- taken over


@pytest.mark.usefixtures("two")
def test_second_run_takes_over_what_has_not_changed(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    first = again()
    before = files()
    assert taken(first) == 0
    with monkeypatch.context() as patch:
        patch.setattr(batch_cases, "load_bytes", None)  # nothing is read again
        second = again()
    assert (taken(second), second.out) == (2, first.out)
    assert files() == before
    assert taken(again("--no-cache")) == 0
    place(CLEAN.replace("-0.1, 0.0", "-0.12, 0.0"), "decks/b.keyxm")
    changed = again()
    assert taken(changed) == 1
    assert changed.out != first.out


def spoil(path: str) -> Callable[[], object]:
    return lambda: Path(path).write_bytes(Path(path).read_bytes()[:-5])


DAMAGE: dict[str, tuple[Callable[[], object], int]] = {
    "file": (spoil("out/a.csv"), 1),
    "missing": (lambda: Path("out/a-summary.csv").unlink(), 1),
    "memory": (spoil(str(MEMORY)), 0),
}


@pytest.mark.usefixtures("two")
@pytest.mark.parametrize(("damage", "left"), DAMAGE.values(), ids=DAMAGE)
def test_what_is_damaged_is_evaluated_anew(damage: Callable[[], object], left: int) -> None:
    first = again()
    good = Path("out/a.csv").read_bytes()
    damage()
    second = again()
    assert (second.code, second.out, taken(second)) == (0, first.out, left)
    assert Path("out/a.csv").read_bytes() == good
    assert taken(again()) == 2


@pytest.mark.usefixtures("two")
@pytest.mark.parametrize(
    "options", [("--tension", "cut"), ("--units", "user"), ("--form", "npz"), ("--positions", "state.csv")]
)
def test_other_options_are_other_results(
    folder: Path, options: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(remembered, "changed_since", lambda *_: False)
    (folder / "state.csv").write_text(STATE, encoding="utf-8")
    again()
    assert taken(again(*options)) == 0
    assert taken(again(*options)) == 2
    (folder / "state.csv").write_text(STATE.replace("-0.3", "-0.2"), encoding="utf-8")
    assert taken(again(*options)) == (0 if "state.csv" in options else 2)


def test_deck_that_another_one_names_is_looked_at(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(remembered, "changed_since", lambda *_: False)
    for name in ("scr-dynamic.keyxm", "scr-touchdown.keyxm"):
        place((SAMPLES / name).read_bytes(), f"decks/{name}")
    again()
    assert taken(again()) == 2
    place((SAMPLES / "scr-touchdown.keyxm").read_bytes() + b"C\n", "decks/scr-touchdown.keyxm")
    assert taken(again()) == 0


@pytest.mark.usefixtures("two")
def test_deck_that_fails_now_has_no_old_results(place: Place) -> None:
    again()
    place(BAD_NUMBER, "decks/a.keyxm")
    outcome = again()
    assert (outcome.code, taken(outcome)) == (1, 1)
    assert not [name for name in files() if name.startswith("a")]


def test_deck_that_fails_now_has_no_old_totals(place: Place, folder: Path) -> None:
    place(CLEAN, "decks/a.keyxm")
    np.save(folder / "steps.npy", np.array([[[-0.1, 0.0, 0.0], [-0.1, 10.0, 0.0], [0.3, 20.0, 0.0]]] * 3))
    options = ("decks", "--positions", "steps.npy", "--time-step", "0.5", "--summary-only", "--form", "csv")
    assert batch(*options).code == 0
    assert "a-totals.csv" in files()
    place(BAD_NUMBER, "decks/a.keyxm")
    assert batch(*options).code == 1
    assert not [name for name in files() if name.startswith("a")]


# ------------------------------------------------------------------------------------------- processes, interruption


@pytest.mark.usefixtures("two")
def test_other_decks_stay_known(place: Place) -> None:
    again()
    place(CLEAN, "decks/c.keyxm")
    assert batch("decks/c.keyxm", "decks/b.keyxm", "--form", "csv").code == 0
    assert taken(again()) == 3


@pytest.mark.usefixtures("eager")
def test_output_is_the_same_whatever_the_number_of_processes(four: str, place: Place, folder: Path) -> None:
    for number in range(8):
        place((CLEAN, BAD_NUMBER, DEEP)[number % 3], f"{four}/more/{number}.keyxm")
    outcomes = []
    for jobs in ("1", "2"):
        outcome = run("batch", four, "--jobs", jobs, "-o", f"out{jobs}", "--form", "csv", "--output-format", "json")
        written = {name: data for name, data in files(f"out{jobs}").items() if name != MEMORY.name}
        outcomes.append((outcome.code, outcome.out, outcome.err.replace(f"out{jobs}", "out"), written))
    assert outcomes[0] == outcomes[1]
    assert multiprocessing.active_children() == []
    assert len(outcomes[0][3]) == 3 * 8 + 1
    assert not list(folder.rglob("*.mudline"))


@pytest.mark.usefixtures("two")
def test_interrupted_run_keeps_what_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    work = batch_cases._evaluated

    def second_is_interrupted(order: Order) -> object:
        if order.case.name == "b":
            signal.raise_signal(signal.SIGINT)
        return work(order)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # it may be ignored in the background
    with monkeypatch.context() as patch:
        patch.setattr(batch_cases, "_evaluated", second_is_interrupted)
        outcome = again("--jobs", "1")  # a slow machine would start processes, which the patch does not reach
    signal.signal(signal.SIGINT, before)
    assert (outcome.code, outcome.out) == (130, "")
    assert set(files()) == {"a.csv", "a-nodes.csv", "a-summary.csv", MEMORY.name}
    assert taken(again()) == 1
