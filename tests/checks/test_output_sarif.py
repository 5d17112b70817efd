"""SARIF: what is written, and held against the schema of the standard, from the command line as users run it."""

from __future__ import annotations

import json
import os
import re
import sys
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import pytest

from mudline.checks.output import form_module
from mudline.language.diagnostics import Diagnostic
from tests.checks.made_rules import finding, plugin_lint
from tests.cli.runner import Json, Outcome, run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN

DATA = Path(__file__).parents[1] / "data"
SCHEMA = json.loads((DATA / "sarif-schema-2.1.0.json").read_text(encoding="utf-8"))
Draft202012Validator = pytest.importorskip("jsonschema").Draft202012Validator
VALIDATOR = Draft202012Validator(SCHEMA, format_checker=Draft202012Validator.FORMAT_CHECKER)
NAMES = BAD_NUMBER.replace("SET=Pipe", "SET=Rør-管")

DECKS = {
    "clean": ("deck.keyxm", CLEAN, 0),
    "finding": ("deck.keyxm", BAD_NUMBER, 1),
    "no ASCII": ("dæk-管.keyxm", NAMES, 1),
    "BOM": ("deck.keyxm", f"\ufeff{NAMES}", 1),
    "no JSON": ("deck.json", '{"a": ', 1),
    "signs": ("50%20#1&é+;=.keyxm", BAD_NUMBER, 1),
}


def run_of(*found: Diagnostic) -> dict[str, Any]:
    log = json.loads("".join(form_module("sarif").write(found, [])))
    assert log["version"] == "2.1.0"
    (run,) = log["runs"]
    assert isinstance(run, dict)
    return run


def test_a_result_names_its_rule_place_fix_and_fingerprint() -> None:
    run = run_of(finding(code="DOC001", fix=None), finding(message="wrong"))
    rules, result = run["tool"]["driver"]["rules"], run["results"][1]
    assert rules[result["ruleIndex"]]["id"] == result["ruleId"] == "LEG001"
    assert (result["level"], result["message"]) == ("warning", {"text": "wrong"})
    region = {"startLine": 3, "startColumn": 2, "endLine": 3, "endColumn": 6}
    location = {"uri": "decks/scr.keyxm", "uriBaseId": "ROOT"}
    assert result["locations"] == [{"physicalLocation": {"artifactLocation": location, "region": region}}]
    replacement = {"deletedRegion": region, "insertedContent": {"text": "a\tb"}}
    (fix,) = result["fixes"]
    assert fix["description"] == {"text": "write it so"}
    assert fix["artifactChanges"] == [{"artifactLocation": location, "replacements": [replacement]}]
    assert (run["columnKind"], run["newlineSequences"]) == ("unicodeCodePoints", ["\r\n", "\r", "\n"])
    assert location["uriBaseId"] in run["originalUriBaseIds"]
    assert "fixes" not in run["results"][0]


def test_a_rule_brings_its_help() -> None:
    (rule,) = run_of(finding())["tool"]["driver"]["rules"]
    assert rule["name"] == "SupersededKeyword"
    assert rule["help"]["markdown"].startswith(f"# {rule['shortDescription']['text']}")
    assert rule["help"]["text"].endswith(rule["fullDescription"]["text"])
    assert rule["defaultConfiguration"]["level"] in {"error", "warning", "note"}


def test_a_code_without_a_rule_is_described_by_its_name() -> None:
    (rule,) = run_of(finding(code="XXX999", slug="no-such-rule"))["tool"]["driver"]["rules"]
    assert (rule["id"], rule["name"], rule["shortDescription"]["text"]) == ("XXX999", "NoSuchRule", "No such rule.")
    assert rule["defaultConfiguration"] == {"level": "warning", "enabled": True}
    assert rule["help"]["text"].endswith(rule["fullDescription"]["text"])
    assert "markdown" not in rule["help"]


def test_fingerprints_do_not_depend_on_lines() -> None:
    one, other = run_of(finding(line=3), finding(line=8)), run_of(finding(line=4), finding(line=9))
    prints = [[result["partialFingerprints"] for result in run["results"]] for run in (one, other)]
    assert prints[0] == prints[1]
    assert prints[0][0] != prints[0][1]


@pytest.mark.parametrize(
    ("file", "uri"),
    [
        ("./a b/ü#.keyxm", "a%20b/%C3%BC%23.keyxm"),
        ("/abs/a.keyxm", "file:///abs/a.keyxm"),
        ("C:/abs/a.keyxm", "file:///C:/abs/a.keyxm"),
        ("c:deck.keyxm", "c%3Adeck.keyxm"),
        ("\ud800.keyxm", "%5Cud800.keyxm"),
        ("<stdin>", "%3Cstdin%3E"),
    ],
)
def test_paths_are_written_as_addresses(file: str, uri: str) -> None:
    (result,) = run_of(finding(file=file))["results"]
    assert result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == uri


def log_of(outcome: Outcome) -> Json:
    log = outcome.json()
    assert [f"{error.json_path}: {error.message}" for error in VALIDATOR.iter_errors(log)] == []
    return log["runs"][0]


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(("name", "text", "count"), DECKS.values(), ids=DECKS)
def test_what_lint_prints_is_sarif(here: Path, name: str, text: str, count: int) -> None:
    path = here / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text.encode())
    outcome = run("lint", name, "--output-format", "sarif", "--isolated", "--fail-on", "info")
    assert (outcome.code, outcome.err) == (min(count, 1), "")
    results = log_of(outcome)["results"]
    assert len(results) == count
    for result in results:
        location = result["locations"][0]["physicalLocation"]["artifactLocation"]
        assert unquote(location["uri"]) == name
        assert re.fullmatch(r"[A-Za-z0-9._~%/-]+", location["uri"])


def test_a_rule_of_a_plugin_has_the_address_that_its_package_tells(tmp_path: Path) -> None:
    told = plugin_lint(tmp_path, "sarif", "Documentation, https://acme.example/rules")
    (rule,) = log_of(told)["tool"]["driver"]["rules"]
    assert (rule["id"], rule["helpUri"]) == ("ACM001", "https://acme.example/rules")
    (found,) = plugin_lint(tmp_path, "json", "Documentation, https://acme.example/rules").json()
    assert found["url"] == "https://acme.example/rules"


def test_a_page_among_the_installed_files_is_no_address_of_a_report(here: Path) -> None:
    (here / "deck.keyxm").write_text(BAD_NUMBER, encoding="utf-8")
    (rule,) = log_of(run("lint", "deck.keyxm", "--output-format", "sarif"))["tool"]["driver"]["rules"]
    assert rule["id"] == "SYN002"
    assert "helpUri" not in rule


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have no file names in odd bytes")
@pytest.mark.parametrize(("name", "uri"), [(b"deck-\xff.keyxm", "deck-%FF.keyxm"), (b"<a:?>.das", "%3Ca%3A%3F%3E.das")])
def test_a_name_in_odd_bytes_is_its_bytes(here: Path, name: bytes, uri: str) -> None:
    (here / os.fsdecode(name)).write_text(BAD_NUMBER, encoding="utf-8")
    (result,) = log_of(run("lint", ".", "--output-format", "sarif"))["results"]
    assert result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == uri
