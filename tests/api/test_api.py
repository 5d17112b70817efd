"""`import mudline`: the names of the contract do what it says."""

from __future__ import annotations

import copy
import dataclasses
import importlib
import inspect
import pickle
import re
from pathlib import Path
from typing import cast

import numpy as np
import pytest

import mudline
from mudline.language.deck.loading import load_path
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN, ILLEGAL

EMPTY = '{"format": "mudline-deck/1", "source": "", "units": "user", "sections": []}'
NAMES = [name for name in mudline.__all__ if name != "__version__"]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    file = tmp_path / "scr.keyxm"
    file.write_text(CLEAN, encoding="utf-8")
    return file


def changed(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


# --------------------------------------------------------------------------------------------------------------- names


@pytest.mark.parametrize("name", NAMES)
def test_public_name_resolves_and_is_documented(name: str) -> None:
    value = getattr(mudline, name)
    assert inspect.isclass(value) or inspect.isfunction(value)
    assert value.__doc__
    for member, attribute in vars(value).items():
        if not member.startswith("_") and callable(attribute):
            assert attribute.__doc__, f"{name}.{member}"


CONTRACT = "read lint from_keyword from_json from_yaml Deck DeckError Diagnostic Severity Scene ForceCurve CurveError"
CONTACT = "ContactModel ContactResult ContactState ContactWarning Plan PositionError contact_warnings"


COMMANDS = "backbone diff diff_matrix expand export fix format migrate report show study validate"


def test_names_are_those_of_the_contract() -> None:
    names = f"{CONTRACT} {CONTACT} {COMMANDS}".split()
    assert {*names, "read_positions", "Study", "__version__"} == set(mudline.__all__)
    assert dir(mudline) == sorted(mudline.__all__)
    assert mudline.__version__.count(".") == 2


def test_every_public_name_is_on_the_page_of_the_api() -> None:
    pages = sorted((Path(__file__).parents[2] / "docs/api").glob("*.md"))
    page = "\n".join(one.read_text(encoding="utf-8") for one in pages)
    assert sorted(re.findall(r"^::: mudline\.(\w+)$", page, re.MULTILINE)) == sorted(
        {*mudline.__all__} - {"__version__"}
    )


def test_unknown_name() -> None:
    with pytest.raises(AttributeError, match="module 'mudline' has no attribute 'nonsense'"):
        getattr(mudline, "nonsense")  # noqa: B009 - a name that no checker may know


# ------------------------------------------------------------------------------------------------------------- reading


def test_lint_stays_a_function_whatever_is_imported() -> None:
    for module in ("mudline.api", "mudline.cli.lint_command"):
        importlib.import_module(module)
    assert inspect.isfunction(mudline.lint)


def test_deck_is_read(path: Path) -> None:
    deck = mudline.read(path)
    assert isinstance(deck, mudline.Deck)
    assert (deck.source, deck.units, deck.file) == ("scr.keyxm", "metric", path.as_posix())
    assert [block.keyword for block in deck.sections[0].blocks][:3] == ["OCEAN", "NODE", "ELEMENT"]
    assert mudline.read(str(path)) == deck
    assert mudline.read(path, units="imperial").units == "imperial"


@pytest.mark.parametrize("form", ["json", "yaml"])
def test_deck_makes_the_round_trip(path: Path, form: str) -> None:
    deck = mudline.read(path)
    text = deck.to_json() if form == "json" else deck.to_yaml()
    again = mudline.from_json(text) if form == "json" else mudline.from_yaml(text)
    assert isinstance(again, mudline.Deck)
    assert again.sections == deck.sections
    assert (again.source, again.units) == (deck.source, deck.units)
    assert again.to_keyword() == deck.to_keyword()
    document = path.with_suffix(f".{form}")
    assert mudline.read(changed(document, text)).sections == deck.sections
    assert mudline.read(document, units="user").units == "user"


def test_what_cannot_be_read(path: Path) -> None:
    with pytest.raises(mudline.DeckError, match="'ten' is not a number") as caught:
        mudline.read(changed(path, BAD_NUMBER))
    (found,) = caught.value.diagnostics
    assert isinstance(found, mudline.Diagnostic)
    assert (found.file, found.line, found.column) == (path.as_posix(), 6, 11)
    assert (found.code, found.severity) == ("SYN002", mudline.Severity.ERROR)
    assert isinstance(caught.value, ValueError)


def test_file_that_is_missing(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        mudline.read(tmp_path / "nowhere.keyxm")
    with pytest.raises(FileNotFoundError):
        mudline.lint(tmp_path / "nowhere.keyxm")


def test_every_deck_is_of_one_class(path: Path) -> None:
    deck = mudline.read(path)
    texts = [mudline.from_keyword(CLEAN), mudline.from_json(deck.to_json()), mudline.from_yaml(deck.to_yaml())]
    copies = [copy.deepcopy(deck), dataclasses.replace(deck, units="user"), pickle.loads(pickle.dumps(deck))]  # noqa: S301 - our own bytes
    made: list[object] = [deck, *texts, *copies, deck.scene().deck]
    assert [type(each) for each in made] == [mudline.Deck] * len(made)
    assert isinstance(deck, type(load_path(path)))
    assert copies[::2] == [deck, deck]


def test_keyword_text(path: Path) -> None:
    deck = mudline.from_keyword(CLEAN)
    assert deck.sections == mudline.read(path).sections
    assert (deck.file, deck.source, deck.folder) == ("<keyword>", "", None)
    assert mudline.from_keyword(CLEAN.encode()) == deck
    assert mudline.from_keyword(CLEAN, units="imperial").units == "imperial"
    with pytest.raises(mudline.DeckError, match="<keyword>:6:11: SYN002 'ten' is not a number"):
        mudline.from_keyword(BAD_NUMBER)
    with pytest.raises(mudline.DeckError, match="SYN012"):
        mudline.from_keyword(CLEAN.encode("utf-16"))


TEXTS = {
    CLEAN: "from_keyword",
    CLEAN.encode(): "from_keyword",
    "$MODEL": "from_keyword",
    "\ufeff$MODEL\r*NODE": "from_keyword",
    "C a comment\n---\n$MODEL\n": "from_keyword",
    "just\ntext": "from_keyword",
    EMPTY: "from_json",
    '{\n"format":': "from_json",
    b"\xef\xbb\xbf{}": "from_json",
    "# a comment\nformat: mudline-deck/1\nsections: []\n": "from_yaml",
}


@pytest.mark.parametrize(("text", "function"), TEXTS.items())
def test_text_in_place_of_a_path(text: object, function: str) -> None:
    with pytest.raises(
        ValueError, match=rf"^expected a path, found the text of a deck: use mudline\.{function}\(text\)$"
    ):
        mudline.read(cast("str", text))
    with pytest.raises(ValueError, match=r"^expected a path, found the text of a deck: save it to a file$"):
        mudline.lint(cast("str", text))
    assert callable(getattr(mudline, function))


# ------------------------------------------------------------------------------------------------------------- linting


def test_lint_never_raises_for_content(path: Path) -> None:
    assert [found.code for found in mudline.lint(changed(path, BAD_NUMBER))] == ["SYN002"]
    path.write_bytes(b"\x00\x01\x02" * 100)
    assert [found.code for found in mudline.lint(path)] == ["SYN012"]
    assert [found.code for found in mudline.lint(changed(path.with_suffix(".json"), "{"))] == ["DOC001"]


# --------------------------------------------------------------------------------------------------- scene and contact


def test_scene(path: Path) -> None:
    scene = mudline.read(path).scene()
    curve = scene.curves["Clay"]
    assert isinstance(curve, mudline.ForceCurve)
    force, slope = curve.evaluate([[0.2], [0.6]])
    assert force.tolist() == [[1500.0], [3500.0]]
    assert slope.dtype == np.float64
    into = np.empty(2), np.empty(2)
    curve.evaluate(np.array([0.0, 0.1]), out=into)
    assert into[0].tolist() == [0.0, 1000.0]
    assert scene.sets["Pipe"].tolist() == [1, 2]
    assert scene.diameter.tolist() == [0.5, 0.5]


def test_contact(path: Path) -> None:
    contact = mudline.read(path).scene().contact()
    result = contact.evaluate()
    assert result.force.tolist() == [1500.0, 0.0]
    moved = np.repeat(contact.input.coordinates[np.newaxis], 4, axis=0) - [0.1, 0.0, 0.0]
    assert contact.evaluate(moved).force.shape == (4, 2)
    assert contact.evaluate(moved[0]).ratio[0] == pytest.approx(0.4)
    assert ",".join(stage.stage for stage in contact.plan) == (
        "seabed surface,normal law,smoothing,unloading,suction,friction,lateral,trench,assembly"
    )


def test_positions_of_a_scene(path: Path, tmp_path: Path) -> None:
    scene = mudline.read(path).scene()
    file = tmp_path / "positions.csv"
    file.write_text("time,node,x,y,z\n0,1,-0.5,0,0\n0,2,-0.5,5,0\n2.5,1,0.5,0,0\n2.5,2,0.5,5,0\n", encoding="utf-8")
    positions = mudline.read_positions(str(file), scene)
    assert positions.present.tolist() == [number in {1, 2} for number in scene.node_ids]
    result = scene.contact().evaluate(positions.values, present=positions.present, times=positions.time)
    assert result.contact.any(axis=1).tolist() == [True, False]
    assert [line.time for line in result.summary()] == [0.0, 2.5]
    plain = tmp_path / "positions.npy"
    np.save(plain, np.stack([scene.coordinates, np.add(scene.coordinates, [5.0, 0.0, 0.0])]))
    read = mudline.read_positions(plain, scene)
    moved = scene.contact().evaluate(read.values, present=read.present, times=read.time)
    assert np.array_equal(moved.force[0], scene.contact().evaluate().force)
    assert not moved.contact[1].any()
    file.write_text("node,x,y,z\n99,0,0,0\n", encoding="utf-8")
    with pytest.raises(mudline.DeckError, match="99"):
        mudline.read_positions(file, scene)


def test_scene_of_a_deck_with_errors(path: Path) -> None:
    deck = mudline.read(changed(path, ILLEGAL))
    with pytest.raises(mudline.DeckError, match="REF001") as caught:
        deck.scene()
    assert caught.value.diagnostics[0].line == 20


def test_a_key_file_of_a_password_manager_is_no_deck_of_a_folder(tmp_path: Path) -> None:
    (tmp_path / "vault.keyx").write_text('<?xml version="1.0"?>\n<KeyFile>\n</KeyFile>\n', encoding="utf-8")
    (tmp_path / "deck.keyxm").write_text("$MODEL\n*OCEAN\n 100.0, x, 9.81\n", encoding="utf-8")
    assert {one.file.rpartition("/")[2] for one in mudline.lint(tmp_path)} == {"deck.keyxm"}
