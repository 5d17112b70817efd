"""Which decks of a folder continue another one, with a seabed or a model of their own."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from mudline.editing.migration import refusals
from mudline.editing.migration.refusals import Continuations, continuations_beside, misspelt
from mudline.language.deck.loading import dump
from tests.helpers.builders.decks import PIPE_WITH_SETS
from tests.helpers.builders.scenes import deck_of

BASE = PIPE_WITH_SETS + "*ELASTIC SURFACE\n 1e4, 0.3, 0.5\n"
GOES_ON = "$LOAD CASE\n*RESTART\n LAST=base\n"
CURVE = "*EMBEDMENT\n SET=7\n 0, 0\n 1, 300\n"
LAW = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=7\n STIFFNESS=5\n"


@pytest.mark.parametrize(
    ("text", "seabed", "model"),
    [
        (f"$MODEL\n{CURVE}{GOES_ON}", True, True),
        (f"$MODEL\n{LAW}{GOES_ON}", True, True),
        (f"$MODEL\n{CURVE}{GOES_ON}".lower(), True, True),
        (f"$MODEL\n*OCEAN\n 500.0, 1025.0, 9.81\n{GOES_ON}", False, True),
        (GOES_ON, False, False),
        (f"$MODEL\n{CURVE}", False, False),
        (f"$MODEL\n{CURVE}{GOES_ON.replace('base', 'other')}", False, False),
        (f"$MODEL\nC RESTART\n{CURVE}", False, False),
    ],
    ids=["legacy", "new family", "small letters", "model", "load case", "no restart", "of another", "in a comment"],
)
@pytest.mark.parametrize("name", ["child.keyxm", "child.KEYXM"])
def test_a_deck_that_continues_another(tmp_path: Path, name: str, text: str, seabed: bool, model: bool) -> None:
    base, child = tmp_path / "base.keyxm", tmp_path / name
    base.write_text(BASE)
    child.write_text(text)
    (tmp_path / "child.txt").write_text(f"$MODEL\n{CURVE}{GOES_ON}")
    for found in (Continuations(()), Continuations([child]), Continuations([base, child])):
        assert found.of(base) == ([child.as_posix()] if seabed else [])
        assert found.extend(base) is model
        assert (found.of(child), found.extend(child)) == ([], False)


@pytest.mark.parametrize("form", ["json", "yaml"])
def test_a_deck_in_another_form_continues_one(tmp_path: Path, form: str) -> None:
    child = tmp_path / f"child.{form}"
    child.write_text(dump(deck_of(f"$MODEL\n{CURVE}{GOES_ON}"), form), encoding="utf-8")
    (tmp_path / "base.keyxm").write_text(BASE)
    assert continuations_beside(deck_of(BASE, "base.keyxm", folder=tmp_path)) == ([child.as_posix()], True)


def test_decks_that_continue_one_are_named_in_order_and_wherever_they_are(tmp_path: Path) -> None:
    (tmp_path / "base.keyxm").write_text(BASE)
    (tmp_path / "runs").mkdir()
    children = [tmp_path / "b.keyxm", tmp_path / "a.keyxm", tmp_path / "runs" / "c.keyxm"]
    for child in children:
        goes_on = GOES_ON.replace("base", "../base" if child.parent.name == "runs" else "base")
        child.write_text(f"$MODEL\n{CURVE}{goes_on}")
    names = sorted(child.as_posix() for child in children)
    assert Continuations(children).of(tmp_path / "base.keyxm") == names
    assert Continuations(()).of(tmp_path / "base.keyxm") == names[:2]
    # a chain: the deck before the deck before is continued too
    (tmp_path / "last.keyxm").write_text(f"$MODEL\n{LAW}{GOES_ON.replace('base', 'a')}")
    assert (tmp_path / "last.keyxm").as_posix() in Continuations(()).of(tmp_path / "base.keyxm")


def test_what_cannot_be_read_or_is_too_large_continues_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    base, child = tmp_path / "base.keyxm", tmp_path / "child.keyxm"
    base.write_text(BASE)
    child.write_text(f"$MODEL\n{CURVE}{GOES_ON}")
    (tmp_path / "child.json").write_text("RESTART {")
    (tmp_path / "folder.keyxm").mkdir()
    os.mkfifo(tmp_path / "pipe.keyxm")  # to open it would wait for ever
    monkeypatch.setattr(refusals, "LARGEST_NEIGHBOUR", child.stat().st_size)
    assert Continuations(()).of(base) == [child.as_posix()]
    monkeypatch.setattr(refusals, "LARGEST_NEIGHBOUR", child.stat().st_size - 1)
    assert Continuations(()).of(base) == []


def test_decks_beside_a_deck_are_looked_for_in_its_folder(tmp_path: Path) -> None:
    (tmp_path / "base.keyxm").write_text(BASE)
    (tmp_path / "child.keyxm").write_text(f"$MODEL\n{CURVE}{GOES_ON}")
    name = (tmp_path / "child.keyxm").as_posix()
    assert continuations_beside(deck_of(BASE, "base.keyxm", folder=tmp_path)) == ([name], True)
    assert continuations_beside(deck_of(BASE, "elsewhere/base.keyxm", folder=tmp_path)) == ([name], True)
    assert continuations_beside(deck_of(BASE, "other.keyxm", folder=tmp_path)) == ([], False)
    assert continuations_beside(deck_of(BASE, "base.keyxm")) == ([], False)
    assert continuations_beside(deck_of(BASE, "base.keyxm", folder=tmp_path / "none")) == ([], False)


def test_decks_that_are_written_changed_and_removed_in_a_session_are_seen(tmp_path: Path) -> None:
    child, deck = tmp_path / "child.keyxm", deck_of(BASE, "base.keyxm", folder=tmp_path)
    (tmp_path / "base.keyxm").write_text(BASE)
    assert continuations_beside(deck) == ([], False)
    child.write_text(f"$MODEL\n{CURVE}{GOES_ON}")
    assert continuations_beside(deck) == ([child.as_posix()], True)
    child.write_text(f"$MODEL\n*OCEAN\n 500.0, 1025.0, 9.81\n{GOES_ON}")
    assert continuations_beside(deck) == ([], True)
    child.unlink()
    assert continuations_beside(deck) == ([], False)


def test_a_chain_whose_middle_deck_changes_in_a_session_is_followed_again(tmp_path: Path) -> None:
    deck, last = deck_of(BASE, "base.keyxm", folder=tmp_path), tmp_path / "last.keyxm"
    (tmp_path / "base.keyxm").write_text(BASE)
    last.write_text(f"$MODEL\n{CURVE}{GOES_ON.replace('base', 'middle')}")
    assert continuations_beside(deck) == ([], False)
    for name, found in (("base", [last.as_posix()]), ("other", []), ("base", [last.as_posix()])):
        (tmp_path / "middle.keyxm").write_text(GOES_ON.replace("base", name))
        assert continuations_beside(deck) == (found, bool(found)), name


def test_keywords_that_may_be_meant_as_legacy_ones() -> None:
    others = "*OCEAAN\n 1\n*WIND TURBINE ROTOR\n 1\n$LOAD CASE\n*EMBEDMNT\n 0, 0\n"
    deck = deck_of(f"$MODEL\n*OCEAN\n 1, 2, 3\n*EMBEDMNT\n 0, 0\n{others}")
    (one,) = deck.diagnose(list(misspelt(deck)))
    assert (one.code, one.line) == ("MIG001", 4)
    assert one.message == ("*EMBEDMNT, which is not known, may be meant as *EMBEDMENT: correct or remove it first")
