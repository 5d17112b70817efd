"""What the fixes of single rules make of decks, and where they leave them alone."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.checks.engine import Fixing, LintSettings, lint_bytes
from mudline.checks.fixing import fix_bytes
from mudline.checks.registry import select
from mudline.editing.migration.migrating import Migration, legacy_blocks, migrate
from mudline.language.deck.forms.json import to_json
from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import DeckError, Diagnostic
from tests.checks import corpus
from tests.checks.findings import CURVES, PIPE, PROPERTIES

SURFACE = "*ELASTIC SURFACE\n 50000.0, 0.3, 0.5\n"
CLAY = f"$MODEL\n{PROPERTIES} STIFFNESS=Clay\n*SEABED STIFFNESS\n CURVE=Clay\n"


def fixed(text: str, *codes: str, fixing: Fixing = Fixing.UNSAFE) -> str | None:
    """The deck with the fixes of some rules; None if there are none that can be made."""
    changed = fix_bytes(text.encode(), "deck.keyxm", LintSettings(tuple(select(codes)), fixing=fixing)).changed
    return None if changed is None else changed.decode()


def findings(text: str, code: str, name: str = "deck.keyxm") -> list[Diagnostic]:
    return lint_bytes(text.encode(), name, select([code]))


# ------------------------------------------------------------------------------------------------------------ words


@pytest.mark.parametrize(
    ("code", "wrong", "right"),
    [
        ("SYN004", " TYPE=ELASTIC\n STIFNESS =1.0\n", " TYPE=ELASTIC\n STIFFNESS =1.0\n"),
        ("SYN004", " TYPE=ELASTIC\n stifness=1.0\n", " TYPE=ELASTIC\n STIFFNESS=1.0\n"),
        ("SYN005", " TYPE=Elstic\n", " TYPE=ELASTIC\n"),
    ],
)
def test_a_misspelt_word_of_a_block_is_written_as_it_was_meant(code: str, wrong: str, right: str) -> None:
    head = "$MODEL\n*SEABED PROPERTIES\n"
    assert fixed(head + wrong + " SET=ALL\n", code) == head + right + " SET=ALL\n"


def test_a_key_on_a_line_of_several_is_written_as_it_was_meant() -> None:
    text = "$MODEL\n*LINES\n LINE=Flowline\n*LINE PATH SECTIONS\n LINE=Flowline\n SECTION=Pipe, 0, 1, REPAT =Joints\n"
    assert fixed(text, "SYN004") == text.replace("REPAT", "REPEAT")


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("$MODEL\n*SEABED PROPERTIES\n COLOUR=1\n TYPE=ELASTIC\n", "SYN004"),
        ("$MODEL\n*SEABED PROPERTIES\n TYPE=SOFT\n", "SYN005"),
        ("$MODEL\n*WIND TURBINE ROTOR\n 1, 2\n", "SYN009"),
        ("$WHATEVER\n", "SYN010"),
        ("$MODEL\n*LINE PATH SECTIONS\n LINE=Flowline\n SECTION=Pipe, 0, 1, COLOUR=3\n", "SYN004"),
    ],
)
def test_a_word_like_no_other_has_no_fix(text: str, code: str) -> None:
    found = findings(text, code)
    assert len(found) == 1
    assert "did you mean" not in found[0].message
    assert found[0].fix is None


def test_the_names_of_sections_and_keywords_are_corrected_whole() -> None:
    text = "$MODEL\n  *seabed  properteis  \n TYPE=ELASTIC\n SET=ALL\n$ loadcase\n*ANALYSIS TYPE\n TYPE=STATIC\n"
    wanted = "$MODEL\n  *SEABED PROPERTIES  \n TYPE=ELASTIC\n SET=ALL\n$LOAD CASE\n*ANALYSIS TYPE\n TYPE=STATIC\n"
    assert fixed(text, "SYN009", "SYN010") == wanted


def test_labels_get_braces_in_rows_lists_and_tables() -> None:
    text = (
        "$MODEL\n*LINES\n LINE=Flowline\n*ELEMENT SETS\n SET=Tie-in\n 1, Seabed End, 4\n*NODE\n 1, 0.0, 0.0\n"
        "*ELEMENT\n 1, 1, Seabed End\n 4, Top, 1\n"
    )
    wanted = text.replace("Seabed End", "{Seabed End}").replace("Top", "{Top}")
    assert fixed(text, "SYN016") == wanted


# ------------------------------------------------------------------------------------------------------------ points


def test_points_are_sorted_with_their_lines() -> None:
    text = f"{CLAY} 0.50, 4.0E3\n  0.0,0.0\n 0.1,\t1200.\n"
    assert fixed(text, "CRV002", fixing=Fixing.SAFE) == f"{CLAY}  0.0,0.0\n 0.1,\t1200.\n 0.50, 4.0E3\n"


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_the_last_line_may_lack_its_end(end: str) -> None:
    text = f"{CLAY} 0.5, 4000.0\n 0.0, 0.0".replace("\n", end)
    assert fixed(text, "CRV002") == f"{CLAY} 0.0, 0.0\n 0.5, 4000.0".replace("\n", end)


@pytest.mark.parametrize(
    ("rows", "wanted"),
    [
        ("C all of it [N/m]\n 0.5, 4000\n 0, 0\n", "C all of it [N/m]\n 0, 0\n 0.5, 4000\n"),
        (" 0, 0\n 0.5, 4000\n\n 0.2, 900\n", " 0, 0\n 0.2, 900\n\n 0.5, 4000\n"),
        (" 0, 0\nC deep\n 0.2, 900\n 0.6, 4900\n 0.5, 4000\n", " 0, 0\nC deep\n 0.2, 900\n 0.5, 4000\n 0.6, 4900\n"),
    ],
)
def test_comments_that_keep_their_rows_do_not_hinder(rows: str, wanted: str) -> None:
    assert fixed(CLAY + rows, "CRV002") == CLAY + wanted


@pytest.mark.parametrize(
    "rows",
    [
        " 0, 0\n 0.5, 4000\nC measured\n 0.2, 900\n",
        " 0.5, 4000\n 0.2, 900\nC measured\n 0, 0\n",
        " 0.2, 900\n 0, 0\nC measured\n 0.5, 4000\n",
        "C mudline: ignore CRV005\n 0.5, 4000\n 0, 0\n",
        " 0.5, 4000\n =[0], 0\n",
        " 0.5, 4000\n 0, 0\n 0, 1\n",
    ],
    ids=["row-passes", "others-pass", "row-before-it-moves", "suppression", "equation", "clash"],
)
def test_points_stay_where_their_order_is_not_all(rows: str) -> None:
    found = findings(CLAY + rows, "CRV002")
    assert [one.fix for one in found] == [None]


@given(st.lists(st.integers(0, 99), min_size=2, max_size=12, unique=True))
def test_sorting_is_done_at_once(ratios: list[int]) -> None:
    rows = [f" 0.{ratio:02d}, {100 * ratio}.0\n" for ratio in ratios]
    changed = fixed(CLAY + "".join(rows), "CRV002")
    assert (changed or CLAY + "".join(rows)) == CLAY + "".join(sorted(rows))


@pytest.mark.parametrize(
    ("rows", "wanted"),
    [
        (" 0, 0\n 0.5, 4000\nC measured\n 0.50, 4.0E3\n", " 0, 0\n 0.5, 4000\nC measured\n"),
        (" 0, 0\n 0.5, 4000\n 0.5, 4000\n 0.5, 4000", " 0, 0\n 0.5, 4000\n"),
        (" 0, 0\n 0, 0\n 0.5, 4000\n", " 0, 0\n 0.5, 4000\n"),
    ],
)
def test_a_point_that_stands_there_again_is_removed(rows: str, wanted: str) -> None:
    assert fixed(CLAY + rows, "CRV004", fixing=Fixing.SAFE) == CLAY + wanted


@pytest.mark.parametrize("used", ["Clay", "Sand"])
def test_no_fix_removes_the_first_point_of_a_curve_whose_name_is_missing(used: str) -> None:
    text = f"{CLAY} 0, 0\n 0.5, 4000\n 0, 0\n 0.5, 9000\n".replace("STIFFNESS=Clay", f"STIFFNESS={used}")
    assert fixed(text, fixing=Fixing.SAFE) is None


# ------------------------------------------------------------------------------------------------------------ curves


def test_a_point_that_is_equal_by_an_equation_is_kept() -> None:
    found = findings(f"{CLAY} 0, 0\n 0.5, 4000\n 0.5, =[2 * 2000]\n", "CRV004")
    assert [one.fix for one in found] == [None]


def test_points_in_json_have_no_fix() -> None:
    deck = to_json(load_bytes(f"{CLAY} 0.5, 4000\n 0, 0\n 0, 0\n".encode(), "deck.keyxm"))
    found = [*findings(deck, "CRV002", "deck.json"), *findings(deck, "CRV004", "deck.json")]
    assert [(one.code, one.fix) for one in found] == [("CRV002", None), ("CRV004", None)]


OTHER = f"{PROPERTIES} STIFFNESS=Clay\n"


def test_an_unused_curve_goes_without_its_comments() -> None:
    kept = " CURVE=Clay\n 0, 0\n 0.5, 4000\n"
    text = f"{CURVES}C one\nCURVE=Backfill\nC two\n 0, 0\n\nCarried over\n 0.1, 300\nC three\n{kept}{OTHER}"
    assert fixed(text, "REF003") == f"{CURVES}C one\nC two\n\nCarried over\nC three\n{kept}{OTHER}"


def test_a_keyword_without_another_curve_goes_with_its_last() -> None:
    kept = "*SEABED STIFFNESS\n CURVE=Clay\n 0, 0\n 0.5, 4000\n"
    unused = "*SEABED STIFFNESS\nC one\n CURVE=Sand\n 0, 0\n 0.1, 300\n CURVE=Silt\n 0, 0\n 0.1, 200"
    assert fixed(f"$MODEL\n{OTHER}{kept}{unused}", "REF003") == f"$MODEL\n{OTHER}{kept}C one\n"


def test_a_curve_that_a_comment_keeps_keeps_its_block() -> None:
    kept = "C mudline: ignore REF003 -- for the next survey\n CURVE=Silt\n 0, 0\n 0.1, 200\n"
    text = f"{CURVES} CURVE=Sand\n 0, 0\n 0.1, 300\n{kept}{PROPERTIES} STIFFNESS=1000.0\n"
    assert fixed(text, "REF003") == f"{CURVES}{kept}{PROPERTIES} STIFFNESS=1000.0\n"


@pytest.mark.parametrize("line", [" SET=ALL STIFFNESS=Clay\n", " SET=ALL\nC STIFFNESS=Clay\n", " SET=ALL\n SET=B\n"])
def test_a_curve_stays_where_the_line_that_names_it_is_faulty(line: str) -> None:
    text = f"{CURVES} CURVE=Clay\n 0, 0\n 0.1, 300\n{PROPERTIES}".replace(" SET=ALL\n", line)
    assert findings(text, "REF003")
    assert fixed(text, "REF003") is None


# ------------------------------------------------------------------------------------------------------------ legacy

EMBEDMENT = "*EMBEDMENT\n SET=ALL\n 0.0, 0.0\n 0.5, 4000.0\n"


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_legacy_keywords_are_migrated_all_at_once(end: str) -> None:
    text = f"{PIPE}C curve\n{EMBEDMENT}C surface\n{SURFACE}".replace("\n", end)
    found = findings(text, "LEG001")
    assert [bool(one.fix) for one in found] == [True, False]
    assert fixed(text, "LEG001") == migrate(load_bytes(text.encode(), "deck.keyxm")).content.decode()


@pytest.mark.parametrize(
    "text",
    [
        f"{PIPE}{SURFACE}{SURFACE}",
        f"{PIPE}*RIGID SURFACE\n 0.3, 0.5\n 0, 0.0\n 100, -2.0\n",
        f"{PIPE}{SURFACE} 1, 2\n",
        f"{PIPE}{EMBEDMENT} 0.5, 5000.0\n{SURFACE}",
    ],
    ids=["two-surfaces", "profile", "unreadable", "error"],
)
def test_a_deck_that_cannot_be_migrated_within_itself_has_no_fix(text: str) -> None:
    found = findings(text, "LEG001")
    assert found
    assert not any(one.fix for one in found)


CHILD = "$MODEL\n*EMBEDMENT\n SET=ALL\n 0, 0\n 1, 300\n$LOAD CASE\n*RESTART\n LAST=base\n"
MORE = "$MODEL\n*ELEMENT\n 99, 1, 2\n$LOAD CASE\n*RESTART\n LAST=base\n"


@pytest.mark.parametrize(("child", "kept"), [(CHILD, True), (MORE, False), ("", False)])
def test_the_fix_knows_the_decks_that_continue_this_one(child: str, kept: bool, tmp_path: Path) -> None:
    text = f"{PIPE}{EMBEDMENT}{SURFACE}"
    (tmp_path / "base.keyxm").write_text(text, encoding="utf-8")
    (tmp_path / "child.keyxm").write_text(child, encoding="utf-8")
    settings = LintSettings(tuple(select(["LEG001"])), fixing=Fixing.UNSAFE)
    changed = fix_bytes(text.encode(), "base.keyxm", settings, tmp_path).changed
    made = migrate(load_bytes(text.encode(), "base.keyxm", folder=tmp_path), extended=child == MORE)
    assert changed == (None if kept else made.content)


def migrated(path: Path) -> Migration | None:
    deck = load_bytes(path.read_bytes(), path.name, folder=path.parent)
    try:
        return migrate(deck)
    except DeckError:
        return None


LEGACY = [
    path
    for path in corpus.decks()
    if path.suffix.startswith(".key")
    and b"ignore-file LEG001" not in path.read_bytes()
    and legacy_blocks(load_bytes(path.read_bytes(), path.name))
]


@pytest.mark.parametrize("path", LEGACY, ids=corpus.name_of)
def test_the_fix_does_what_migration_does(path: Path) -> None:
    settings = LintSettings(tuple(select(["LEG001"])), fixing=Fixing.UNSAFE)
    changed = fix_bytes(path.read_bytes(), path.name, settings, path.parent).changed
    made = migrated(path)
    assert changed == (made.content if made is not None and not made.files else None)
