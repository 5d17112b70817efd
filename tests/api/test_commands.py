"""Commands as functions: what they return of a deck or its file, and what they refuse."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mudline
from mudline import keywords
from mudline.language.deck.writing import keyword_file
from tests.cli.runner import run
from tests.helpers.samples import SAMPLES

LEGACY = SAMPLES / "legacy-flowline.keyxm"
RISER = SAMPLES / "scr-touchdown.keyxm"
UNTIDY = "$MODEL\n*OCEAN\n500,1025\n*SEABED STIFFNESS\n CURVE=a\n 0,0\n 0.1,5\n 0.1,5\n"


def test_format_is_that_of_the_command(tmp_path: Path) -> None:
    file = tmp_path / "deck.keyxm"
    file.write_text(UNTIDY, encoding="utf-8")
    mudline.format(file).write(tmp_path / "other.keyxm")
    run("format", str(file))
    assert (tmp_path / "other.keyxm").read_bytes() == file.read_bytes() != UNTIDY.encode()
    changed = mudline.from_keyword(UNTIDY)
    changed.set("OCEAN.depth", 80)
    assert mudline.format(changed).block("OCEAN").depth == 80.0
    with pytest.raises(ValueError, match="cut off"):
        mudline.format(mudline.from_keyword(UNTIDY + "*SEABED STIFFNESS"))


def test_fix_is_that_of_the_command(tmp_path: Path) -> None:
    file = tmp_path / "deck.keyxm"
    file.write_text(UNTIDY, encoding="utf-8")
    found = mudline.fix(file, select=["repeated-point"])
    assert [one.slug for one in found.fixed] == ["repeated-point"]
    assert (found.left, found.note) == ([], "")
    assert len(found.deck.block("SEABED STIFFNESS").curves[0].points) == 2
    run("lint", "--fix", "--select", "repeated-point", str(file))
    found.write(tmp_path / "other.keyxm")
    assert (tmp_path / "other.keyxm").read_bytes() == file.read_bytes()
    assert mudline.fix(mudline.from_keyword(UNTIDY), ignore=["repeated-point"]).content == UNTIDY.encode()


def test_migrate_verifies_and_writes(tmp_path: Path) -> None:
    found = mudline.migrate(LEGACY, verify=True)
    assert found.replaced == {"ELASTIC SURFACE": 1, "EMBEDMENT": 1}
    assert found.verified is not None
    assert found.verified.elements > 0
    found.write(tmp_path / "new.keyxm")
    new = mudline.read(tmp_path / "new.keyxm")
    forces = [deck.scene().contact().evaluate().force for deck in (mudline.read(LEGACY), new, found.deck)]
    assert forces[0].tobytes() == forces[1].tobytes() == forces[2].tobytes()
    found.write(tmp_path / "new.json")
    assert mudline.diff(new, tmp_path / "new.json", strict=True).equivalent
    again = mudline.migrate(new)
    assert (again.replaced, again.content, again.verified) == ({}, keyword_file(new), None)


def test_expand_gives_the_decks_of_the_command(tmp_path: Path) -> None:
    run("expand", str(SAMPLES / "variations.keyxm"), "-o", str(tmp_path))
    for name, deck in mudline.expand(SAMPLES / "variations.keyxm"):
        assert keyword_file(deck) == (tmp_path / name).read_bytes()
        assert deck.scene().contact().evaluate().force.max() > 0.0
    with pytest.raises(mudline.DeckError, match="no \\*COMBINATIONS"):
        mudline.expand(RISER)


def test_validate_judges_files_and_folders(tmp_path: Path) -> None:
    (tmp_path / "good.keyxm").write_bytes(RISER.read_bytes())
    (tmp_path / "bad.json").write_text('{"format": "mudline-deck/1"}', encoding="utf-8")
    (tmp_path / "notes.txt").write_text("no deck", encoding="utf-8")
    found = mudline.validate(tmp_path)
    assert [(Path(one.verdict.file).name, one.verdict.ok) for one in found] == [
        ("bad.json", False),
        ("good.keyxm", True),
    ]
    assert [one.code for one in found[0].errors] == ["DOC002"]
    assert mudline.validate([tmp_path / "good.keyxm"])[0].warnings == found[1].warnings
    assert {Path(one.file).name for one in mudline.lint([tmp_path])} == {"bad.json", "good.keyxm"}
    for empty in (tmp_path / "nothing", tmp_path / "empty"):
        (tmp_path / "empty").mkdir(exist_ok=True)
        with pytest.raises(FileNotFoundError):
            mudline.validate(empty)
        with pytest.raises(FileNotFoundError):
            mudline.lint(empty)


def test_folders_are_searched_as_their_configuration_has_it(tmp_path: Path) -> None:
    for name in ("kept.keyxm", "old/left.keyxm", "more.txt"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("$MODEL\n*OCAEN\n", encoding="ascii")
    (tmp_path / "mudline.toml").write_text('exclude = ["old/"]\ninclude = ["*.txt"]\n', encoding="ascii")
    assert {Path(one.file).name for one in mudline.lint(tmp_path)} == {"kept.keyxm", "more.txt"}
    assert [Path(one.verdict.file).name for one in mudline.validate(tmp_path)] == ["kept.keyxm"]
    assert mudline.lint(tmp_path / "old" / "left.keyxm")  # a file that is named is taken
    (tmp_path / "mudline.toml").write_text("exclude = 1\n", encoding="ascii")
    with pytest.raises(ValueError, match=r"mudline\.toml:1: exclude"):
        mudline.lint(tmp_path)


def test_a_folder_that_cannot_be_searched_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "closed").mkdir()
    (tmp_path / "deck.keyxm").write_bytes(RISER.read_bytes())
    scan = os.scandir

    def refused(folder: str) -> object:
        if Path(folder).name == "closed":
            raise PermissionError(13, "Permission denied", folder)
        return scan(folder)

    monkeypatch.setattr(os, "scandir", refused)
    for judge in (mudline.validate, mudline.lint):
        with pytest.raises(PermissionError, match="closed"):
            judge(tmp_path)


@pytest.mark.parametrize("to", ["moordyn", "orcaflex"])
def test_export_is_that_of_the_command(to: str, tmp_path: Path) -> None:
    found = mudline.export(RISER, to=to, name="model.x")  # type: ignore[arg-type]  # one of both
    (tmp_path / "function").mkdir()
    found.write(tmp_path / "function")
    run("export", str(RISER), "--to", to, "-o", str(tmp_path / "model.x"))
    for name in found.files:
        assert (tmp_path / "function" / name).read_bytes() == (tmp_path / name).read_bytes()
    assert found.report.lost


@pytest.mark.parametrize("to", ["moordyn", "orcaflex"])
def test_export_of_the_resting_shape_is_that_of_the_command(to: str, tmp_path: Path) -> None:
    vessel = SAMPLES / "scr-vessel.keyxm"
    found = mudline.export(vessel, to=to, name="model.x", rest_shape=True)  # type: ignore[arg-type]  # one of both
    ran = run("export", str(vessel), "--to", to, "--rest-shape", "-o", str(tmp_path / "model.x"))
    assert {name: text.encode() for name, text in found.files.items()} == {
        file.name: file.read_bytes() for file in tmp_path.iterdir()
    }
    own = mudline.export(vessel, to=to, name="model.x")  # type: ignore[arg-type]  # as above
    assert (own.notes, own.files["model.x"] == found.files["model.x"]) == ((), False)
    assert [note for note in found.notes if note not in ran.err] == []
    assert found.notes[0].startswith("resting shape of line 1: horizontal tension")


def test_backbone_is_a_curve_and_its_block() -> None:
    curve, block = mudline.backbone("f114", diameter=0.3, strength=(5000.0, 1500.0), weight=6000.0, name="Clay")
    assert isinstance(block, keywords.SeabedStiffness)
    assert list(block.curves[0].points) == list(zip(curve.ratios.tolist(), curve.forces.tolist(), strict=True))
    deck = mudline.read(RISER)
    deck.add(block)
    assert deck.scene().curves["clay"] == curve
    deck = mudline.read(LEGACY)
    deck.add(mudline.backbone("skempton", diameter=0.3, strength=5000, legacy=True, name="TDZ").block)
    assert deck.keywords() >= {"EMBEDMENT"}


@pytest.mark.parametrize(
    ("argument", "value", "message"),
    [
        ("strength", 0, "strength must be a number above 0"),
        ("strength", (5000, -1), "strength must be a number of 0 or more"),
        ("diameter", np.inf, "diameter must be a number above 0"),
        ("depth", 9.0, "f114 ends at z/D = 0.5; extend=True goes on to 9"),
        ("tolerance", 0.5, "tolerance must be from 1e-5 to 0.1"),
        ("name", "a, b", "name 'a, b' is not what a deck reads as a name"),
        ("model", "clay", "model must be one of f114"),
    ],
)
def test_what_no_backbone_has(argument: str, value: object, message: str) -> None:
    given = {"model": "f114", "diameter": 0.3, "strength": 5000.0, argument: value}
    with pytest.raises(ValueError, match=message):
        mudline.backbone(**given)  # type: ignore[arg-type]  # it is what is tested


def test_study_takes_a_file_too() -> None:
    parts: list[Sequence[str]] = []

    def tracked(names: Sequence[str]) -> Sequence[str]:
        parts.append(names)
        return names

    text = mudline.study(LEGACY, only=["stability"], tracked=tracked).advice.text
    assert parts == [("stability",)]
    assert text == mudline.study(mudline.read(LEGACY), only=["stability"]).advice.text


def test_show_is_that_of_the_command() -> None:
    for name in ("scr-touchdown.keyxm", "broken.keyxm"):
        found = mudline.show(SAMPLES / name)
        ran = run("show", str(SAMPLES / name), "--output-format", "json")
        assert json.loads(json.dumps(found.summary)) == {**ran.json(), "file": found.summary["file"]}
        assert bool(found.errors) is (ran.code == 1)
    changed = mudline.read(RISER)
    changed.remove("ELEMENT SETS")
    assert len(mudline.show(changed).summary["sets"]) < len(mudline.show(RISER).summary["sets"])


def test_diff_and_its_matrix() -> None:
    riser = mudline.read(RISER)
    deeper, heavier = riser.copy(), riser.copy()
    deeper.set("OCEAN.depth", 1100)
    heavier.set("OCEAN.density", 1030)
    (one,) = mudline.diff(riser, deeper).differences
    assert (one.where, one.before, one.after) == ("*OCEAN/depth", 1000.0, 1100.0)
    assert mudline.diff(RISER, deeper, tolerance=0.1).differences == []
    rows = mudline.diff_matrix(riser, [deeper, heavier, RISER])
    assert [(row.where, list(row.values)) for row in rows] == [
        ("*OCEAN/depth", [1000.0, 1100.0, 1000.0, 1000.0]),
        ("*OCEAN/density", [1025.0, 1025.0, 1030.0, 1025.0]),
    ]
    migrated = mudline.migrate(LEGACY).deck
    assert mudline.diff(LEGACY, migrated).differences == []
    assert mudline.diff(LEGACY, migrated, strict=True).differences == mudline.diff(LEGACY, migrated).spelling != []
    with pytest.raises(ValueError, match="tolerance must be from 0 to 1"):
        mudline.diff(RISER, RISER, tolerance=2.0)


def test_diff_of_folders_is_that_of_the_command(tmp_path: Path) -> None:
    riser = mudline.read(RISER)
    deeper = riser.copy()
    deeper.set("OCEAN.depth", 1100)
    old, new = tmp_path / "old", tmp_path / "new"
    for folder in (old, new):
        (folder / "runs").mkdir(parents=True)
    with pytest.raises(FileNotFoundError):
        mudline.diff(old, new)
    for folder in (old, new):
        riser.write(folder / "same.keyxm")
    riser.write(old / "runs" / "a.keyxm")
    deeper.write(new / "runs" / "a.keyxm")
    assert (mudline.diff(old, new).equivalent, mudline.diff(old, old).equivalent) == (False, True)
    riser.write(new / "more.json")
    (old / "bad.keyxm").write_bytes((SAMPLES / "broken.keyxm").read_bytes())
    (new / "bad.keyxm").write_bytes((SAMPLES / "broken.keyxm").read_bytes())
    found = mudline.diff(old, new)
    ran = run("diff", str(old), str(new), "--output-format", "json").json()
    assert [(one.name, one.status.value, one.why or None) for one in found.decks] == [
        (one["deck"], one["status"], one["why"]) for one in ran["decks"]
    ]
    assert [(one.where, one.before, one.after) for one in found.differences] == [("*OCEAN/depth", 1000.0, 1100.0)]
    assert [one.name for one in found.decks if one.comparison.differences] == ["runs/a.keyxm"]
    assert mudline.diff(old / "runs", new / "runs", tolerance=0.1).equivalent
    with pytest.raises(ValueError, match="is a folder, and the other one is not"):
        mudline.diff(old, RISER)


def test_report_writes_the_pages_of_the_command(tmp_path: Path) -> None:
    pytest.importorskip("jinja2")
    (tmp_path / "decks").mkdir()
    for name in ("legacy-flowline.keyxm", "broken.keyxm"):
        (tmp_path / "decks" / name).write_bytes((SAMPLES / name).read_bytes())
    head: dict[str, Any] = {"title": "Field", "revision": "B", "date": "today"}
    rows = mudline.report(tmp_path / "decks", tmp_path / "one.html", fields={"Client": "Us"}, **head)
    assert [(Path(row["deck"]).name, row["kind"]) for row in rows] == [
        ("broken.keyxm", "errors"),
        ("legacy-flowline.keyxm", "no errors found"),
    ]
    options = [word for name, value in head.items() for word in (f"--{name}", value)]
    run("report", str(tmp_path / "decks"), "-o", str(tmp_path / "two.html"), "--field", "Client=Us", *options)
    first, second = ({file.name: file.read_bytes() for file in (tmp_path / name).iterdir()} for name in ("one", "two"))
    assert first == second
    deck = mudline.read(LEGACY)
    mudline.report(deck, tmp_path / "deck.html", sections=["verdict"])
    assert "legacy-flowline.keyxm" in (tmp_path / "deck.html").read_text(encoding="utf-8")
    with pytest.raises(ValueError, match="a logo is a"):
        mudline.report(deck, tmp_path / "deck.html", logo=RISER)
