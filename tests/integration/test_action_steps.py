"""The steps of action.yml, run one after the other with the inputs of a workflow."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import yaml

from tests.integration.recipes import ROOT, checkout, installed, shell

ACTION = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))


def steps(folder: Path, **inputs: str) -> list[tuple[int, str]]:
    """Exit code and standard output of each `run` step, up to the first that fails."""
    given = {name: about["default"] for name, about in ACTION["inputs"].items()} | inputs
    done: list[tuple[int, str]] = []
    for step in ACTION["runs"]["steps"]:
        if "run" not in step or any(code for code, _ in done):
            continue
        assert step["shell"] == "bash"
        env = {name: filled(text, given) for name, text in step["env"].items()}
        ran = shell(step["run"], folder, GITHUB_ACTION_PATH=str(ROOT), **env)
        assert "Traceback" not in ran.stderr
        done.append((ran.returncode, ran.stdout))
    return done


def filled(text: str, given: dict[str, str]) -> str:
    """An expression of the workflow with the value of the input; an unknown input is a KeyError."""
    return re.sub(r"\$\{\{ inputs\.([a-z-]+) \}\}", lambda match: given[match[1]], text)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return checkout(tmp_path)


def test_findings_are_annotations_and_fail_the_job(folder: Path) -> None:
    (install, _), (code, printed) = steps(folder)
    assert (install, code) == (0, 1)
    assert printed.startswith("::error file=decks/bad.keyxm,line=3,endLine=3,col=9,endColumn=14,title=SYN002 ")
    assert installed(folder) == f"pip install --quiet --disable-pip-version-check {ROOT}\n"


def test_the_inputs_of_the_page_pass(folder: Path) -> None:
    inputs = {"paths": "decks/good.keyxm\ndecks\n", "args": "--fail-on error --baseline known.json"}
    assert steps(folder, **inputs, version="1.2.0")[1][0] == 2  # there is no such baseline yet
    assert installed(folder).endswith(" mudline==1.2.0\n")
    steps(folder, paths="decks", args="--baseline known.json --write-baseline")
    assert steps(folder, **inputs)[1] == (0, "")


def test_sarif_is_written_besides(folder: Path) -> None:
    more = "--output-format sarif=mudline.sarif --exit-zero"
    (_, (code, printed)) = steps(folder, args=more)
    assert (code, printed.count("::error ")) == (0, 1)
    assert '"version": "2.1.0"' in (folder / "mudline.sarif").read_text(encoding="utf-8")


def test_an_input_is_never_run(folder: Path) -> None:
    bad = "$(touch run);`touch run`;touch run *"
    assert steps(folder, paths=bad, args=bad, format=bad)[1][0] == 2
    assert not list(folder.rglob("run*"))


def test_wrong_usage_is_told_and_fails(folder: Path) -> None:
    assert [code for code, _ in steps(folder, format="xml")] == [0, 2]


def test_the_action_names_what_a_workflow_needs() -> None:
    assert ACTION["runs"]["using"] == "composite"
    assert all(about["description"] and "default" in about for about in ACTION["inputs"].values())
    page = (ROOT / "docs" / "ci.md").read_text(encoding="utf-8")
    assert all(f"| `{name}` |" in page for name in ACTION["inputs"])
    assert all(f"inputs.{name}" in str(ACTION["runs"]["steps"]) for name in ACTION["inputs"])
    assert not any("${{" in step.get("run", "") for step in ACTION["runs"]["steps"])
