from __future__ import annotations

import json
from typing import Any

import pytest

from mudline.diagnostics import Diagnostic, Severity
from mudline.linting.output.formats import form
from tests.lint.outputs import finding


def run_of(*found: Diagnostic) -> dict[str, Any]:
    log = json.loads("".join(form("sarif", [], "1.2.3")(found)))
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


def test_nothing_found_is_a_run_without_results() -> None:
    run = run_of()
    assert run["results"] == []
    assert run["tool"]["driver"]["rules"] == []


def test_levels() -> None:
    run = run_of(*(finding(severity=severity) for severity in Severity))
    assert [result["level"] for result in run["results"]] == ["note", "warning", "error"]
