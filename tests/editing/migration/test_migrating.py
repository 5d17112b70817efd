"""Legacy decks become decks of the new family that mean the same."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.checks.context import LintContext
from mudline.checks.engine import lint_context
from mudline.checks.registry import rules
from mudline.editing.comparison.comparing import compare
from mudline.editing.comparison.decks import without_spelling
from mudline.editing.migration.migrating import Migration, legacy_blocks, migrate, verify
from mudline.language.deck.forms.json import to_json
from mudline.language.deck.forms.yaml import to_yaml
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck
from mudline.model.scene.model import resolve
from tests.helpers.builders.decks import PIPE_WITH_SETS
from tests.helpers.builders.scenes import deck_of

SAMPLE = (
    PIPE_WITH_SETS
    + """\
C the old seabed
*ELASTIC SURFACE
C stiffness first
 5.0D4, 0.3, , 200, 100.0, 0.25, , , 12, 0.05
C sloping
 2.5
*EMBEDMENT
 SET=East Bank
 0.0, 0.0
C the point of rev B
 0.5, 4000.0
 SET=7
 0.0, 0.0
 1.0, 100.0
"""
)

MIGRATED = (
    PIPE_WITH_SETS
    + """\
C the old seabed
*SEABED PROPERTIES
C stiffness first
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS=5.0D4
 FRICTION=0.3, 0, 0.05, , 12
 LATERAL=200
 SUCTION=100.0, 0.25
 SET=East Bank
 STIFFNESS=East Bank
 FRICTION=0.3, 0, 0.05, , 12
 LATERAL=200
 SUCTION=100.0, 0.25
 SET=7
 STIFFNESS=7 curve
 FRICTION=0.3, 0, 0.05, , 12
 LATERAL=200
 SUCTION=100.0, 0.25
*SEABED PROFILE
C sloping
 TYPE=SLOPING
 SLOPE=2.5
*SEABED STIFFNESS
 CURVE=East Bank
 0.0, 0.0
C the point of rev B
 0.5, 4000.0
 CURVE=7 curve
 0.0, 0.0
 1.0, 100.0
"""
)

# ------------------------------------------------------------------------------------------------------------ many more

SETS = ("ALL", "West", "East Bank", "7", "west")
numbers = st.floats(min_value=1e-3, max_value=1e6).map(repr)
coefficients = st.sampled_from(["", "0", "0.0", "0.3", " 0.55 ", "1E-3"])
lengths = st.sampled_from(["", "0.05", "2.5e-2"])
characteristic = st.sampled_from(["", "3.048"])
comments = st.sampled_from(["", "C from the survey\n", "C\n", "C--- rev B ---\n"])


@st.composite
def points(draw: st.DrawFn) -> str:
    """The rows of a curve, in any order."""
    ratios = draw(st.lists(st.integers(-20, 400), min_size=2, max_size=6, unique=True))
    written = st.floats(-1e4, 1e6).map(lambda force: round(force, 6))  # slopes below float64 are refused (CRV011)
    forces = draw(st.lists(written, min_size=len(ratios), max_size=len(ratios)))
    rows = [f" {ratio / 100!r}, {force!r}\n" for ratio, force in zip(ratios, forces, strict=True)]
    return "".join(draw(comments) + row for row in rows)


@st.composite
def embedment(draw: st.DrawFn, first: bool = True) -> str:
    names = draw(st.lists(st.sampled_from(SETS), min_size=1, max_size=4))
    curves = [f" SET={name}\n{draw(points())}" for name in names]
    if first and draw(st.booleans()):
        curves.insert(0, draw(points()))
    return "*EMBEDMENT\n" + "".join(draw(comments) + curve for curve in curves)


@st.composite
def elastic(draw: st.DrawFn) -> str:
    fields = [
        draw(st.one_of(st.just("1e4"), numbers)),
        draw(coefficients),
        draw(coefficients),
        draw(st.sampled_from(["", "0", "250.0"])),
        draw(st.sampled_from(["", "300.5"])),
        draw(st.sampled_from(["", "0.1"])),
        draw(characteristic),
        draw(characteristic),
        draw(st.sampled_from(["", "12.5"])),
        draw(lengths),
        draw(lengths),
    ]
    row = f" {', '.join(fields[: draw(st.integers(1, 11))])}\n"
    return "*ELASTIC SURFACE\n" + draw(comments) + row + draw(beds())


@st.composite
def rigid(draw: st.DrawFn) -> str:
    fields = [
        draw(st.sampled_from(["0.3", "0"])),
        draw(coefficients),
        draw(characteristic),
        draw(characteristic),
        draw(st.sampled_from(["", "12.5"])),
        draw(lengths),
        draw(lengths),
    ]
    row = f" {', '.join(fields[: draw(st.integers(1, 7))])}\n"
    return "*RIGID SURFACE\n" + draw(comments) + row + draw(beds())


@st.composite
def beds(draw: st.DrawFn) -> str:
    """Nothing, a slope, or a profile."""
    kind = draw(st.integers(0, 2))
    if kind == 0:
        return ""
    if kind == 1:
        return draw(comments) + f" {draw(st.floats(-20, 20))!r}\n"
    across = draw(st.lists(st.integers(-500, 500), min_size=2, max_size=5, unique=True))
    return "".join(f"{draw(comments)} {float(y)!r}, {draw(st.floats(-30, 30))!r}\n" for y in across)


@st.composite
def legacy_decks(draw: st.DrawFn) -> str:
    """A model with a legacy seabed; blocks in any order."""
    if draw(st.booleans()):
        blocks = [draw(elastic()), *draw(st.lists(embedment(first=False), max_size=2))]
        if draw(st.booleans()):
            blocks.append(draw(embedment()))
        blocks = draw(st.permutations(blocks))
    else:
        blocks = [draw(rigid())]
    hidden = draw(st.sampled_from(["", "", "*LINES\n LINE=Riser\n SECTION=West, 10\n"]))
    existing = hidden + draw(st.sampled_from(["", "*SEABED STIFFNESS\n CURVE=WEST\n 0, 0\n 1, 1\n"]))
    indent = draw(st.sampled_from([" ", "", "    "]))
    seabed = "".join(draw(comments) + block for block in blocks)
    text = PIPE_WITH_SETS + existing + seabed.replace("\n ", f"\n{indent}")
    text += draw(st.sampled_from(["", "$LOAD CASE\n*ANALYSIS TYPE\n TYPE=STATIC\n"]))
    end = draw(st.sampled_from(["\n", "\r\n", "\r"]))
    return text.replace("\n", end)


# ---------------------------------------------------------------------------------------------------------------- tests


def migrated(text: str | bytes, name: str = "deck.keyxm") -> Migration:
    return migrate(deck_of(text, name))


def comments_of(deck: Deck) -> list[str]:
    return sorted(re.findall(r'"text": "(.*)"', to_json(deck)))


def test_every_field_goes_to_its_place() -> None:
    found = migrated(SAMPLE)
    assert found.content.decode() == MIGRATED
    assert found.files == {}
    assert dict(found.replaced) == {"ELASTIC SURFACE": 1, "EMBEDMENT": 1}
    assert verify(found).differences == ()


@pytest.mark.parametrize("end", ["\r\n", "\r"])
def test_line_ends_and_encoding_stay(end: str) -> None:
    text = SAMPLE.replace("the old seabed", "Böschung").replace("\n", end)
    found = migrated(text.encode("cp1252"))
    assert found.content == MIGRATED.replace("the old seabed", "Böschung").replace("\n", end).encode("cp1252")


@pytest.mark.parametrize("form", ["json", "yaml"])
def test_documents_are_migrated_in_their_own_form(form: str) -> None:
    text = (to_json if form == "json" else to_yaml)(deck_of(SAMPLE))
    found = migrated(text, f"deck.{form}")
    again = load_bytes(found.content, f"deck.{form}")
    assert again.sections == deck_of(MIGRATED).sections
    assert verify(found).differences == ()


def test_points_before_any_set_mean_all() -> None:
    found = migrated(PIPE_WITH_SETS + "*ELASTIC SURFACE\n 1e4\n*EMBEDMENT\n0, 0\n 1, 5\n SET=West\n 0, 0\n 1, 7\n")
    text = found.content.decode()
    assert " CURVE=ALL\n0, 0\n" in text
    assert "C stiffness 1e4 left out, as every element is on a curve\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=ALL\n" in text
    assert text.index("STIFFNESS=ALL") < text.index("STIFFNESS=West")
    assert verify(found).differences == ()


def test_keys_in_column_one_stay_clear_of_comments() -> None:
    """CURVE= in column 1 begins with C; tools that drop such lines as comments must not meet one."""
    found = migrated(PIPE_WITH_SETS + "*ELASTIC SURFACE\n1e4, 0.3\n*EMBEDMENT\nSET=West\n0, 0\n1, 5\n")
    assert b"\n CURVE=West\n0, 0\n" in found.content
    assert b"\n TYPE=ELASTIC\n SET=ALL\n" in found.content


def test_equations_are_carried_as_written() -> None:
    head = "$PREPROCESSOR\n*PARAMETERS\n k, 2e4\n"
    found = migrated(head + PIPE_WITH_SETS + "*ELASTIC SURFACE\n =[k * 2], =[if(k > 1, 0.3, 0)]\n =[k/1e4]\n")
    text = found.content.decode()
    assert " STIFFNESS==[k * 2]\n FRICTION==[if(k > 1, 0.3, 0)], 0\n" in text
    assert " SLOPE==[k/1e4]\n" in text
    assert verify(found).differences == ()


def test_a_profile_goes_to_a_file_beside_the_deck() -> None:
    deck = PIPE_WITH_SETS + "*RIGID SURFACE\n 0.3\n 100.0, 30.0\nC shore\n 0.0, 0.1D0\n"
    found = migrated(deck, "Pipe 7 (rev B).keyxm")
    assert b"TYPE=2D\n INTERPOLATION=LINEAR\n FILE=Pipe-7-rev-B-profile.txt\nC shore\n" in found.content
    head = b"C Y, elevation: profile of *RIGID SURFACE of Pipe 7 (rev B).keyxm\n"
    assert found.files == {"Pipe-7-rev-B-profile.txt": head + b"100.0, 30.0\n0.0, 0.1\n"}
    assert verify(found).differences == ()


def test_a_profile_overwrites_no_file_beside_the_deck(tmp_path: Path) -> None:
    deck = PIPE_WITH_SETS + "*RIGID SURFACE\n 0.3\n 100.0, 30.0\n 0.0, 0.0"
    for name in ("deck-profile.txt", "deck-profile-2.txt", "deck-profile-3.txt"):
        found = migrate(deck_of(deck, folder=tmp_path))
        assert list(found.files) == [name]
        assert found.content.endswith(f" TYPE=2D\n INTERPOLATION=LINEAR\n FILE={name}\n".encode())
        (tmp_path / name).write_text("")


def test_largest_characteristic_lengths_without_effect_are_left_in_a_comment() -> None:
    found = migrated(PIPE_WITH_SETS + "*ELASTIC SURFACE\n 1e4, 0.3, 0.5, , , , 3.048, 9.0, , , 0.1\n")
    listed = b"C largest characteristic lengths (longitudinal 3.048, transverse 9.0) left out: the default, or without"
    assert listed in found.content
    assert b" FRICTION=0.3, 0.5, , 0.1\n" in found.content


@given(legacy_decks())
def test_any_legacy_deck_means_the_same_afterwards(text: str) -> None:
    deck = deck_of(text)
    found = migrate(deck)
    assert verify(found).differences == ()
    assert not legacy_blocks(found.deck)
    lines = Counter(found.content.decode().splitlines())  # behind *LINES, a comment is a line of that block
    assert Counter(f"C{comment}" for comment in comments_of(deck)) <= lines


def codes_of(deck: Deck) -> set[str]:
    return {one.code for one in lint_context(LintContext(deck), rules())}


@given(legacy_decks(), st.sampled_from(["keyword", "json", "yaml"]))
def test_any_migrated_deck_lints_as_before_and_is_equivalent(text: str, form: str) -> None:
    deck = deck_of(text)
    if form != "keyword":
        deck = deck_of((to_json if form == "json" else to_yaml)(deck), f"deck.{form}")
    with TemporaryDirectory() as name:
        deck.folder = Path(name)
        found = migrate(deck)
        for file, data in found.files.items():
            (deck.folder / file).write_bytes(data)
        again = deck_of(found.content, deck.file, folder=deck.folder)
        assert codes_of(again) <= codes_of(deck) - {"LEG001"}
        before, after = resolve(deck), resolve(again)
        comparison = without_spelling(before, after, compare(before, after))
    assert comparison.differences == []
    assert comparison.spelling


@given(legacy_decks())
def test_bytes_outside_the_legacy_blocks_stay(text: str) -> None:
    content = migrate(deck_of(text)).content.decode()
    before = re.split(r"\*(?:ELASTIC|RIGID|EMBEDMENT|SEABED)", text)[0]
    assert content.startswith(before)
    assert content.endswith(text[text.index("$LOAD CASE") :] if "$LOAD CASE" in text else "")
    ends = {"\r\n", "\r", "\n"} - {"\r\n" if "\r\n" in text else "\r" if "\r" in text else "\n"}
    assert not any(re.search(f"(?<!\r){end}(?!\n)" if len(end) == 1 else end, content) for end in ends)
