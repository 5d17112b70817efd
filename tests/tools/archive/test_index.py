"""Bringing decks into an archive: what is read, what is known, and what is dropped."""

from __future__ import annotations

import shutil
import time
from pathlib import Path

import pytest

from mudline.cli import index_command
from mudline.tools.archive.rows import TABLES
from mudline.tools.running import executors
from tests.cli.runner import run
from tests.tools.archive.trial import ask, contents, deck, index, summary, write


@pytest.fixture
def decks(tmp_path: Path) -> Path:
    return write(tmp_path / "decks", a=deck("a"), b=deck("b", depth=600.0), c=deck("c", curve="Sand", force=900.0))


@pytest.fixture
def archive(tmp_path: Path) -> Path:
    return tmp_path / "archive"


def files(archive: Path) -> list[str]:
    return [row["file"] for row in ask(archive, "SELECT file FROM decks ORDER BY file")]


def test_values_of_a_deck(decks: Path, archive: Path) -> None:
    assert summary(index(decks, archive=archive)) == "3 decks: 3 new"
    row = ask(archive, "SELECT * FROM decks WHERE file = 'decks/a.keyxm'")[0]
    expected = {
        "ok": True,
        "units": "metric",
        "nodes": 3,
        "elements": 2,
        "sets": 1,
        "curves": 1,
        "depth": 500.0,
    }
    assert {name: row[name] for name in expected} == expected
    assert (row["keywords"], row["sections"], row["length"]) == (7, 1, 10.0)


def test_curves_and_laws(decks: Path, archive: Path) -> None:
    index(decks, archive=archive)
    where = "WHERE file = 'decks/a.keyxm'"
    curve = ask(archive, f"SELECT name, ratios, forces, steepest, elements, line FROM curves {where}")  # noqa: S608
    points = {"ratios": [0.0, 0.1, 0.5], "forces": [0.0, 1200.0, 3000.0]}
    assert curve == [{"name": "Clay", **points, "steepest": 12000.0, "elements": 1, "line": 20}]
    laws = ask(archive, f'SELECT kind, family, "set", elements, stiffness, line FROM laws {where} ORDER BY law')  # noqa: S608
    assert laws[0] == {"kind": "linear", "family": "new", "set": "ALL", "elements": 1, "stiffness": 50000.0, "line": 27}
    assert (laws[1]["kind"], laws[1]["set"], laws[1]["elements"], laws[1]["stiffness"]) == ("curve", "TDZ", 1, None)


def test_findings_are_those_of_lint(tmp_path: Path, archive: Path) -> None:
    folder = write(tmp_path / "decks", bad=deck().replace("1025.0", "1O25.0"), warned=deck(force=-5.0))
    index(folder, archive=archive)
    order = "ORDER BY file, line, start_column, code"
    found = ask(archive, f"SELECT file, code, severity, message, line, start_column FROM findings {order}")  # noqa: S608
    linted = run("lint", folder, "--isolated", "--output-format", "json").json()
    assert len(linted) > 1
    assert [(Path(one["file"]).name, *list(one.values())[1:]) for one in found] == [
        (Path(one["file"]).name, *(one[key] for key in ("code", "severity", "message", "line", "column")))
        for one in linted
    ]
    verdicts = {row["file"]: row["ok"] for row in ask(archive, "SELECT file, ok FROM decks")}
    assert verdicts == {"decks/bad.keyxm": False, "decks/warned.keyxm": True}


def test_parameters_and_sets(tmp_path: Path, archive: Path) -> None:
    head = "$PREPROCESSOR\n*PARAMETERS\n sea, 400.0\n idle, 3.0\n twice, =[2*sea]\n"
    folder = write(tmp_path / "decks", a=head + deck().replace("500.0,", "=[twice],"))
    index(folder, archive=archive)
    rows = ask(archive, "SELECT name, value, equation, used FROM parameters ORDER BY line")
    assert [tuple(row.values()) for row in rows] == [
        ("sea", 400.0, None, True),
        ("idle", 3.0, None, False),
        ("twice", 800.0, "=[2*sea]", True),
    ]
    assert ask(archive, "SELECT depth FROM decks") == [{"depth": 800.0}]
    (row,) = ask(archive, "SELECT * FROM sets")
    assert row == {
        "file": "decks/a.keyxm",
        "name": "TDZ",
        "elements": 1,
        "first": 1,
        "last": 1,
        "complete": True,
        "used": True,
        "line": 18,
    }


def test_unchanged_decks_are_not_read(decks: Path, archive: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    index(decks, archive=archive)
    before = {path: path.stat().st_mtime_ns for path in archive.glob("*.parquet")}
    assert len(before) == len(TABLES)
    monkeypatch.setattr(index_command, "read_deck", None)
    (decks / "a.keyxm").touch()
    assert summary(index(decks, decks.parent / "decks" / ".." / "decks", archive=archive)) == "3 decks: 3 unchanged"
    assert {path: path.stat().st_mtime_ns for path in archive.glob("*.parquet")} == before


def test_changed_renamed_copied_and_gone_decks(decks: Path, archive: Path) -> None:
    index(decks, archive=archive)
    write(decks, a=deck("a", depth=700.0))
    (decks / "b.keyxm").rename(decks / "moved.keyxm")
    assert summary(index(decks, archive=archive)) == "3 decks: 1 new, 1 changed, 1 unchanged, 1 gone"
    assert files(archive) == ["decks/a.keyxm", "decks/c.keyxm", "decks/moved.keyxm"]
    assert ask(archive, "SELECT depth FROM decks ORDER BY file") == [
        {"depth": 700.0},
        {"depth": 500.0},
        {"depth": 600.0},
    ]
    shutil.copy(decks / "c.keyxm", decks / "copy.keyxm")
    (decks / "a.keyxm").unlink()
    assert summary(index(decks, archive=archive)) == "3 decks: 1 new, 2 unchanged, 1 gone"
    assert files(archive) == ["decks/c.keyxm", "decks/copy.keyxm", "decks/moved.keyxm"]
    assert len(ask(archive, "SELECT * FROM curves WHERE name = 'Sand'")) == 2


def test_a_deck_that_is_continued_counts(tmp_path: Path, archive: Path) -> None:
    folder = write(tmp_path / "decks", base=deck())
    write(folder, next="$LOAD CASE\n*RESTART\n LAST=base\n*NO FRICTION\n")
    index(folder, archive=archive)
    time.sleep(0.1)  # what has changed since a run began is not certain
    index(folder, archive=archive)
    assert summary(index(folder, archive=archive)) == "2 decks: 2 unchanged"
    write(folder, base=deck(depth=900.0))
    found = summary(index(folder, archive=archive))
    assert found == "2 decks: 2 changed"


def test_only_what_lies_below_the_paths_is_dropped(decks: Path, tmp_path: Path, archive: Path) -> None:
    other = write(tmp_path / "other", x=deck("x"))
    index(decks, other, archive=archive)
    (decks / "a.keyxm").unlink()
    (other / "x.keyxm").unlink()
    write(other, y=deck("y", depth=1.0))
    assert summary(index(decks, archive=archive)) == "2 decks: 2 unchanged, 1 gone"
    assert "other/x.keyxm" in files(archive)
    assert summary(index(decks, "--prune", archive=archive)) == "2 decks: 2 unchanged, 1 gone"
    assert files(archive) == ["decks/b.keyxm", "decks/c.keyxm"]


def test_other_settings_read_the_decks_again(decks: Path, archive: Path) -> None:
    index(decks, archive=archive)
    assert summary(index(decks, "--units", "imperial", archive=archive)) == "3 decks: 3 changed"
    assert ask(archive, "SELECT DISTINCT units FROM decks") == [{"units": "imperial"}]


def test_decks_that_cannot_be_read_stay_and_set_the_exit_code(decks: Path, archive: Path) -> None:
    index(decks, archive=archive)
    outcome = index(decks, decks / "nothing.keyxm", archive=archive)
    assert outcome.code == 2
    assert "nothing.keyxm: no such file" in outcome.err
    assert len(files(archive)) == 3


def test_json_and_what_is_no_deck_at_all(decks: Path, archive: Path) -> None:
    run("convert", decks / "a.keyxm", "-o", decks / "d.json")
    (decks / "e.json").write_text('{"format": "mudline-deck/1", "sections": 3}', encoding="utf-8")
    assert summary(index(decks, archive=archive)) == "5 decks: 5 new"
    rows = ask(archive, "SELECT file, ok, curves FROM decks WHERE file LIKE '%.json' ORDER BY file")
    assert [tuple(row.values()) for row in rows] == [("decks/d.json", True, 1), ("decks/e.json", False, 0)]
    assert ask(archive, "SELECT code FROM findings WHERE file = 'decks/e.json'") == [{"code": "DOC002"}]
    same = ask(
        archive, "SELECT count(DISTINCT content) AS n FROM decks WHERE file IN ('decks/a.keyxm', 'decks/d.json')"
    )
    assert same == [{"n": 1}]


def test_the_content_is_the_same_whatever_the_comments_and_the_layout(tmp_path: Path) -> None:
    """In blocks that are read, and in those whose lines are kept, where only a word with C is taken for data."""
    kept = "*PLANAR PIPE CONTACT\n SET=TDZ,  1.0\n"
    comments = ("C", "C water", "C--- water", "C***", "c low", "c...")
    texts = {"plain": deck() + kept, "word": deck().replace("*OCEAN\n", "*OCEAN\nComment\n") + kept}
    for number, comment in enumerate(comments):
        text = deck().replace("*OCEAN\n 500.0,", f"*OCEAN\n{comment}\n  500,").replace("CURVE=Clay", "CURVE=CLAY")
        texts[f"comment{number}"] = text + kept.replace("T\n", f"T\n{comment}\n\n").replace("TDZ,  1.0", "tdz, 1.0")
    texts["other"] = deck() + kept.replace("1.0", "2.0")
    archive = tmp_path / "archive"
    index(write(tmp_path / "decks", **texts), archive=archive)
    found = ask(archive, "SELECT count(*) AS n FROM decks GROUP BY content ORDER BY n")
    assert [row["n"] for row in found] == [1, len(comments) + 2]
    unread = ask(archive, "SELECT count(*) AS n FROM keywords WHERE NOT is_read")
    assert unread == [{"n": len(texts)}]


def test_an_archive_is_a_folder_of_its_own(decks: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither a folder of decks becomes one, nor is one indexed; below a folder that is searched it is left out."""
    before = sorted(decks.parent.rglob("*"))
    monkeypatch.chdir(decks)
    for target, path in ((decks, decks), (Path(), Path()), (decks.parent, decks), (decks, decks / "a.keyxm")):
        outcome = index(path, archive=target)
        assert outcome.code == 2
        assert "the decks lie in this folder: give the archive a folder of its own" in outcome.err
    outcome = index(write(decks.parent / "x", x=deck()), archive=decks)
    assert outcome.code == 2
    assert "has other files and is not an archive: give a new or empty folder" in outcome.err
    assert sorted(decks.parent.rglob("*")) == sorted([*before, decks.parent / "x", decks.parent / "x" / "x.keyxm"])
    inside = decks / "archive"
    assert summary(index(decks, archive=inside)) == "3 decks: 3 new"
    write(inside, mine=deck("mine"))
    assert summary(index(decks, archive=inside)) == "3 decks: 3 unchanged"


def test_other_processes_give_the_same(
    decks: Path, archive: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(executors, "PAYS", dict.fromkeys(executors.PAYS, 0.0))
    monkeypatch.setattr(executors, "TRIED", 0.0)
    write(decks, odd="$LOAD CASE\n*RESTART\n LAST=a\n")
    index(decks, archive=archive)
    assert summary(run("index", decks, "-o", tmp_path / "two", "--isolated", "--jobs", "2")) == "4 decks: 4 new"
    assert contents(tmp_path / "two") == contents(archive)
