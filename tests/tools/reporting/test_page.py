"""The page to sign: what it says of a deck, that nothing of a deck becomes markup, and its size."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from mudline.cli import DONE, FOUND, WRONG_USAGE
from tests.cli.runner import run
from tests.helpers.samples import FAULTY, SAMPLES
from tests.tools.reporting.pages import CSP, NO_STUDY, ON_SOIL, Page, checked, content, long_deck, made, row_of

CHOSEN = ("broken.keyxm", "scr-vessel.keyxm", "scr-soil.keyxm", "lines-deck.keyxm", "imperial-riser.keyxi")


@pytest.mark.parametrize("name", CHOSEN)
def test_a_sample_has_a_page_that_stands_alone(tmp_path: Path, name: str) -> None:
    text = made(tmp_path, str(SAMPLES / name), code=FOUND if name in FAULTY else DONE)
    page = checked(text)
    assert len(text.encode()) < 1_500_000
    assert {*NO_STUDY.split(","), "interpretation", "sign", "appendix"} <= {*page.ids}
    assert all(role in page.text for role in ("Prepared", "Checked", "Approved"))
    assert name != "scr-vessel.keyxm" or {"law-1", "curve-1", "picture-model-1"} <= {*page.ids}
    assert "table" in page.tags


@pytest.mark.covered
def test_the_same_deck_gives_the_same_bytes(tmp_path: Path) -> None:
    deck = str(SAMPLES / "scr-vessel.keyxm")
    assert made(tmp_path, deck) == made(tmp_path, deck)


def test_the_content_is_what_the_other_commands_say() -> None:
    deck = str(SAMPLES / "scr-touchdown.keyxm")
    found = content(deck)
    evaluated = json.loads(run("evaluate", deck, "--output-format", "json").out)
    assert found["sections"]["contact"]["lines"] == evaluated["summary"]
    assert found["sections"]["curves"]["curves"] == json.loads(run("curves", deck, "--output-format", "json").out)
    (verdict,) = json.loads(run("validate", deck, "--output-format", "json").out)["decks"]
    assert {name: found["verdict"][name] for name in ("verdict", "errors", "warnings", "keywords")} == {
        name: verdict[name] for name in ("verdict", "errors", "warnings", "keywords")
    }
    reported = json.loads(run("lint", deck, "--output-format", "json").out)
    assert [(one["code"], one["line"]) for one in found["sections"]["findings"]["reported"]] == [
        (one["code"], one["line"]) for one in reported
    ]
    assert found["sections"]["contact"]["ratio"] == pytest.approx(1.0058074086334154, rel=1e-12)
    assert found["sections"]["contact"]["deepest"] == {"depth": pytest.approx(0.05965), "element": 91}
    assert {(one["law"], one["line"]) for one in found["sections"]["curves"]["laws"]} >= {
        ("curve:Flowline Clay", 296),
        ("resistance", 295),
    }
    assert any(one["keyword"] == "SEABED STIFFNESS" for one in found["inferred"])


def test_a_file_in_place_of_the_folder_of_pages_is_named(tmp_path: Path) -> None:
    folder = tmp_path / "all"
    folder.write_text("", encoding="utf-8")
    decks = [str(SAMPLES / name) for name in ("scr-soil.keyxm", "scr-touchdown.keyxm")]
    outcome = run("report", *decks, "-o", str(tmp_path / "all.html"), "--sections", "verdict")
    assert (outcome.code, outcome.err) == (2, f"mudline: {folder}: cannot be written: file exists\n")


def test_content_to_standard_output() -> None:
    words = ("report", str(SAMPLES / "scr-touchdown.keyxm"), "--sections", "verdict", "--output-format", "json")
    assert run(*words, "-o", "-").out == run(*words).out
    assert not Path("-").exists()


def test_values_are_written_for_people(tmp_path: Path) -> None:
    (tmp_path / "deck.keyxm").write_text(ON_SOIL, encoding="utf-8")
    text = made(tmp_path, str(tmp_path / "deck.keyxm"))
    law = (
        "COEFFICIENTS=first 0.4, second 0.7; STIFFNESS=first 40000 N/m, second 60000 N/m; LATERAL=PEAK-RESIDUAL; "
        "PEAK=factor 1.3, displacement 0.03 m; RESIDUAL=factor 0.6, displacement 0.5 m"
    )
    assert row_of(text, "*SEABED FRICTION").startswith(f"*SEABED FRICTION | Laid | 2 | {law} | line 31")
    assert ">force [N/m]</th>" in text
    assert ">slope to the next [N/m]</th>" in text
    assert '<td>seabed</td><td class="number">flat</td>' in text
    assert "curve:Clay | Free | 1 | 0 |  | 0" in re.sub('</td><td(?: class="number")?>', " | ", text)


def test_sets_of_lines_that_are_not_read_may_have_more_elements(tmp_path: Path) -> None:
    text = made(tmp_path, str(SAMPLES / "lines-deck.keyxm"))
    assert row_of(text, "Static Section").startswith("Static Section | 0+")
    assert row_of(text, "elements") == "elements | 0+"
    assert row_of(text, "curve:Clay").startswith("curve:Clay | Static Section | 0+")
    assert text.count("+ a block that is not read may add elements to this set") == 2


def test_a_study_is_on_the_page_only_where_it_is_asked_for(tmp_path: Path) -> None:
    deck = str(SAMPLES / "legacy-flowline.keyxm")
    page = checked(made(tmp_path, deck, sections="verdict,study"))
    assert "Not studied: nothing is lifted: no touchdown to study." in page.text
    assert "The evaluator itself: error " in page.text
    assert "What the deck needs: a step of" in page.text
    assert "model" not in page.ids


def test_a_faulty_deck_gets_a_page_that_says_what_is_missing(tmp_path: Path) -> None:
    page = checked(made(tmp_path, str(SAMPLES / "broken.keyxm"), code=FOUND))
    assert "27 errors" in page.text
    assert page.text.count("This could not be computed: line") == 4
    assert "The plan could not be computed: line" in page.text
    assert "No contact was computed: line" in page.text
    assert "finding-1" in page.ids
    assert "rule-SYN011" in page.ids


def test_a_file_that_holds_no_deck_gets_a_page(tmp_path: Path) -> None:
    (tmp_path / "deck.json").write_text('{"format": "mudline-deck/1", "sections": 5}', encoding="utf-8")
    page = checked(made(tmp_path, str(tmp_path / "deck.json"), code=FOUND))
    assert "the file holds no deck" in page.text


def test_suppressed_findings_stand_with_their_reason(tmp_path: Path) -> None:
    text = (SAMPLES / "scr-touchdown.keyxm").read_text(encoding="utf-8")
    marked = text.replace(
        "*NON LINEAR STATIC", "C mudline: ignore TIM005 -- kept <for> the old run\n*NON LINEAR STATIC"
    )
    deck = tmp_path / "deck.keyxm"
    deck.write_text(marked, encoding="utf-8")
    page = checked(made(tmp_path, str(deck)))
    assert "hidden-1" in page.ids
    assert "Reason given in the deck: kept <for> the old run" in page.text
    assert "1 finding." in page.text
    (hidden,) = content(str(deck))["sections"]["findings"]["hidden"]
    assert (hidden["code"], hidden["reason"]) == ("TIM005", "kept <for> the old run")


@pytest.mark.parametrize("form", ["keyword", "json", "yaml"])
def test_a_finding_stands_in_its_section_of_a_document_too(tmp_path: Path, form: str) -> None:
    deck = tmp_path / ("deck.keyxm" if form == "keyword" else f"deck.{form}")
    converted = run("convert", str(SAMPLES / "scr-touchdown.keyxm"), "--to", form).out
    deck.write_text(converted, encoding="utf-8")
    (found,) = content(str(deck), sections="findings")["sections"]["findings"]["reported"]
    assert (found["code"], found["section"]) == ("TIM005", "$LOAD CASE")


HOSTILE = (
    "<script>alert(1)</script>",
    "</style><script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "javascript:alert(1)",
    "&lt;b&gt;",
    "{{ 7*7 }}{% raw %}",
    "\u202egpj.exe",
    "a\x07b\x1b[31m",
    "]]>--><svg onload=alert(1)>",
    "$\\frac{1}{0}$",
)


@pytest.mark.covered
@pytest.mark.alike
@pytest.mark.parametrize("name", [" ".join(HOSTILE), *HOSTILE])
def test_nothing_of_a_deck_becomes_markup(tmp_path: Path, name: str) -> None:
    text = (SAMPLES / "scr-touchdown.keyxm").read_text(encoding="utf-8")
    for old in ("Flowline Clay", "Fatigue Hot Spot"):
        text = text.replace(old, f"{old[0]}{name}")
    deck = tmp_path / "deck.keyxm"
    deck.write_text(f"C {name}\n{text}\n*GUIDES {name}\n {name}, {name}\n", encoding="utf-8")
    outcome = run("report", str(deck), "-o", str(tmp_path / "out.html"), "--sections", NO_STUDY, "-q")
    assert outcome.code in {DONE, FOUND}
    written = (tmp_path / "out.html").read_text(encoding="utf-8")
    page = checked(written.replace("javascript:alert(1)", ""))
    assert not re.search("[\u202a-\u202e\u2066-\u2069\x00-\x08\x0b-\x1f]", written)
    assert "img" not in page.tags
    assert "F49" not in page.text


def test_what_is_long_stands_in_the_appendix_behind_a_summary(tmp_path: Path) -> None:
    (tmp_path / "deck.keyxm").write_text(long_deck(), encoding="utf-8")
    text = made(tmp_path, str(tmp_path / "deck.keyxm"))
    page = checked(text)
    first, _, appendix = text.partition('<section id="appendix">')
    at = long_deck().splitlines().index(" SET=zone 01") + 1
    lines = ", ".join(str(at + 4 * number) for number in range(4))
    rule = "A set is defined twice: it holds the elements of both definitions."
    assert row_of(first, "warning") == f"warning | REF016 | {rule} | 30 | {lines} ..."
    assert 'id="finding-1"' not in first
    assert 'id="finding-1"' in appendix
    for number, part in (("02", first), ("02", appendix), ("30", appendix)):
        assert row_of(part, f"curve:Clay {number}").split(" | ")[1] == f"Zone {number}"
    assert "Clay 30" not in first
    assert {"24 more sets", "11 more curves", "20 more rows", "10 more rows"} <= {*re.findall(r"\d+ more \w+", text)}
    assert {"#more-findings", "#more-inputs", "#more-model", "#more-curves", "#more-contact"} <= {*page.references}


@pytest.mark.covered
def test_very_many_findings_and_curves_are_cut_and_counted(tmp_path: Path) -> None:
    slips = "".join(f" CURVE=<b>{'n' * 200} {number}\n 0, 0\n x, {'y' * 900}\n" for number in range(520))
    deck = tmp_path / "deck.keyxm"
    deck.write_text(f"$MODEL\n*SEABED STIFFNESS\n{slips}", encoding="utf-8")
    text = made(tmp_path, str(deck), code=FOUND)
    page = checked(text)
    assert sum(one.startswith("finding-") for one in page.ids) == 500
    assert "the first 500 are shown" in " ".join(page.text.split())
    assert len(text.encode()) < 1_500_000
    curves = "".join(f" CURVE=c{number}\n 0, 0\n 1, {number + 1}\n" for number in range(100))
    deck.write_text(
        f"$MODEL\n*NODE\n 1, 0, 0\n 2, 0, 1\n*ELEMENT\n 1, 1, 2\n*SEABED STIFFNESS\n{curves}", encoding="utf-8"
    )
    outcome = run("report", str(deck), "-o", str(tmp_path / "out.html"), "--sections", "curves", "-q")
    text = (tmp_path / "out.html").read_text(encoding="utf-8")
    assert outcome.code in {DONE, FOUND}
    page = checked(text)
    assert sum(one.startswith("picture-") for one in page.ids) == 20
    assert "81 more pictures" in page.text
    assert "50 more curves" in page.text
    assert len(content(str(deck), sections="curves")["sections"]["curves"]["curves"]) == 100


def test_a_large_picture_becomes_an_image_of_data(tmp_path: Path) -> None:
    count = 6000
    nodes = "".join(f" {number}, {-0.02 + 0.01 * (number % 7)}, {number}\n" for number in range(1, count + 2))
    elements = "".join(f" {number}, {number}, {number + 1}\n" for number in range(1, count + 1))
    section = "*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0.3, 0.28, 7850.0\n"
    deck = tmp_path / "deck.keyxm"
    deck.write_text(
        f"$MODEL\n*NODE\n{nodes}*ELEMENT\n{elements}{section}*SEABED PROPERTIES\n TYPE=ELASTIC\n STIFFNESS=5000\n",
        encoding="utf-8",
    )
    text = made(tmp_path, str(deck))
    page = checked(text)
    assert any(one.startswith("data:image/png;base64,") for one in page.references)
    assert len(text.encode()) < 1_500_000


# ------------------------------------------------------------------------------------------------------------- command


def test_several_decks_have_an_index_and_a_page_each(tmp_path: Path) -> None:
    folder = tmp_path / "decks"
    for inside in ("a", "b"):
        (folder / inside).mkdir(parents=True)
    for name in ("a/x y.keyxm", "b/x_y.keyxm"):
        (folder / name).write_bytes((SAMPLES / "legacy-flowline.keyxm").read_bytes())
    (folder / "bad.keyxm").write_bytes((SAMPLES / "broken.keyxm").read_bytes())
    out = tmp_path / "all.html"
    outcome = run("report", str(folder), "-o", str(out), "--sections", "verdict", "--jobs", "2")
    assert (outcome.code, outcome.err) == (FOUND, f"mudline: report -> {out.as_posix()}, 1 of 3 decks with errors\n")
    index = Page(out.read_text(encoding="utf-8"))
    assert index.policy == CSP
    pages = sorted((tmp_path / "all").iterdir())
    assert len(pages) == 3
    assert sorted(index.references) == sorted(f"all/{one.name}" for one in pages)
    assert "errors (1)" in index.text
    for one in pages:
        checked(one.read_text(encoding="utf-8"))


def test_a_company_has_its_own_template_and_logo(tmp_path: Path) -> None:
    (tmp_path / "ours.html").write_text(
        '{% extends "page.html" %}{% block heading %}Check of {{ report.deck }}{% endblock %}', encoding="utf-8"
    )
    (tmp_path / "logo.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"/>', encoding="utf-8")
    deck = str(SAMPLES / "legacy-flowline.keyxm")
    words = ("--template", str(tmp_path / "ours.html"), "--logo", str(tmp_path / "logo.svg"), "--date", "1 May 2026")
    page = checked(made(tmp_path, deck, *words, sections="verdict"))
    assert "Check of legacy-flowline.keyxm" in page.text
    assert "1 May 2026" in page.text
    assert any(one.startswith("data:image/svg+xml;base64,") for one in page.references)


@pytest.mark.parametrize(
    ("option", "file", "text", "words"),
    [
        ("--template", "bad.html", "{% if %}", "the template cannot be used"),
        ("--template", "bad.html", "{{ nothing.at.all }}", "the template cannot be used"),
        ("--template", "bad.html", "{{ ''.__class__.__mro__ }}", "the template cannot be used"),
        ("--logo", "logo.png", "no image", "expected a PNG image"),
        ("--logo", "logo.gif", "GIF89a", "a logo is a .svg or .png file"),
    ],
)
def test_a_template_or_logo_that_cannot_be_used(tmp_path: Path, option: str, file: str, text: str, words: str) -> None:
    (tmp_path / file).write_text(text, encoding="utf-8")
    deck = str(SAMPLES / "legacy-flowline.keyxm")
    target = tmp_path / "out.html"
    outcome = run("report", deck, "-o", str(target), option, str(tmp_path / file), "--sections", "verdict")
    assert outcome.code == WRONG_USAGE
    assert words in outcome.err
    assert not target.exists()


def test_the_content_goes_into_a_file_too(tmp_path: Path) -> None:
    target = tmp_path / "out.json"
    deck = str(SAMPLES / "legacy-flowline.keyxm")
    run("report", deck, "-o", str(target), "--output-format", "json", "--sections", "verdict")
    (found,) = json.loads(target.read_text(encoding="utf-8"))["reports"]
    assert found["format"] == "mudline-report/1"
    assert found["shown"] == ["verdict"]
