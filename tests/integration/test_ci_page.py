"""The examples of docs/ci.md: the YAML is read, the scripts are run."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
import yaml

from tests.cli.runner import Json
from tests.docs.blocks import Page
from tests.integration.recipes import CLEAN, ROOT, checkout, installed, shell

PAGE = Page.read(ROOT / "docs" / "ci.md")
EXAMPLES = [yaml.safe_load(block.text) for block in PAGE.blocks if block.language == "yaml"]
HOOKS = {hook["id"] for hook in yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))}


def example(key: str) -> Json:
    """The one example with a key at its top."""
    (found,) = (each[key] for each in EXAMPLES if key in each)
    return found


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return checkout(tmp_path)


def test_the_job_of_gitlab_leaves_a_report_and_fails(folder: Path) -> None:
    job = example("mudline")
    assert job["image"].startswith("python:3")
    done = shell("\n".join(job["script"]), folder)
    assert (done.returncode, done.stderr) == (1, "")
    assert done.stdout.startswith("decks/bad.keyxm:3:9: error SYN002 ")
    assert installed(folder) == "pip install mudline\n"
    report = folder / job["artifacts"]["reports"]["codequality"]
    (issue,) = json.loads(report.read_text(encoding="utf-8"))
    assert issue["location"] == {"path": "decks/bad.keyxm", "lines": {"begin": 3, "end": 3}}
    assert job["artifacts"]["when"] == "always"  # the report of a failed job is the one that is wanted


def test_the_job_of_gitlab_passes_for_clean_decks(folder: Path) -> None:
    (folder / "decks" / "bad.keyxm").write_text(CLEAN)
    done = shell("\n".join(example("mudline")["script"]), folder)
    assert (done.returncode, done.stdout) == (0, "No findings in 2 files.\n")
    assert json.loads((folder / "gl-code-quality.json").read_text(encoding="utf-8")) == []


def test_the_workflow_of_github_gives_inputs_that_the_action_has() -> None:
    action = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
    steps = [*example("steps"), *example("jobs")["decks"]["steps"]]
    given = [step["with"] for step in steps if step["uses"].startswith("OWNER/mudline@")]
    assert len(given) == 2
    assert all(inputs.keys() <= action["inputs"].keys() for inputs in given)


def test_the_sarif_that_is_uploaded_is_the_one_that_is_written() -> None:
    _, lint, upload = example("jobs")["decks"]["steps"]
    assert lint["with"]["args"] == f"--output-format sarif={upload['with']['sarif_file']}"
    assert upload["if"] == "always()"


def test_the_hooks_that_are_named_are_there() -> None:
    assert {hook["id"] for repo in example("repos") for hook in repo["hooks"]} == HOOKS


def test_the_other_commands_of_the_page_run(folder: Path) -> None:
    """In the order of the page: a baseline is written before it is used."""
    blocks = [line for block in PAGE.blocks if block.language == "text" for line in block.text.splitlines()]
    inline = [command for command in re.findall(r"`(mudline lint [^`]+)`", PAGE.prose) if " decks" in command]
    codes = {command: shell(command, folder).returncode for command in (*inline, *blocks)}
    assert inline
    assert [codes[command] for command in inline] == [1] * len(inline)
    assert [codes[command] for command in blocks] == [0] * len(blocks)
    assert (folder / "mudline.xml").exists()
    assert (folder / "known.json").exists()
