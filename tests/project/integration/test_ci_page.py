"""The examples of docs/ci.md: the YAML is read, the scripts are run."""

from __future__ import annotations

import json
import re
import shlex
import sys
from pathlib import Path

import pytest
import yaml

from tests.cli.runner import Json
from tests.docs.blocks import Page
from tests.project.integration.recipes import ROOT, checkout, installed, shell

PAGE = Page.read(ROOT / "docs" / "ci.md")
EXAMPLES = [yaml.safe_load(block.text) for block in PAGE.blocks if block.language == "yaml"]


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
    assert installed(folder) == "pip install --quiet mudline\n"
    assert "| error | decks/bad.keyxm:3:9 | SYN002 " in (folder / "mudline.md").read_text(encoding="utf-8")
    report = folder / job["artifacts"]["reports"]["codequality"]
    (issue,) = json.loads(report.read_text(encoding="utf-8"))
    assert issue["location"] == {"path": "decks/bad.keyxm", "lines": {"begin": 3, "end": 3}}
    assert job["artifacts"]["when"] == "always"  # the report of a failed job is the one that is wanted


def test_a_note_is_sent_only_where_there_is_a_token_and_a_merge_request(folder: Path) -> None:
    (script,) = example("mudline")["after_script"]
    sent = folder.parent / "programs" / "curl"
    sent.write_text('#!/bin/sh\nprintf "%s\\n" "$@" >sent\n')
    sent.chmod(0o755)
    assert (shell(script, folder).returncode, (folder / "sent").exists()) == (0, False)
    given = {"CI_API_V4_URL": "https://git.example/api/v4", "CI_PROJECT_ID": "7", "CI_MERGE_REQUEST_IID": "3"}
    assert shell(script, folder, MUDLINE_TOKEN="t", **given).returncode == 0  # noqa: S106 - of nobody
    *_, body, address = (folder / "sent").read_text().splitlines()
    assert (body, address) == ("body=<mudline.md", "https://git.example/api/v4/projects/7/merge_requests/3/notes")


def test_the_steps_of_github_install_and_lint(folder: Path, tmp_path: Path) -> None:
    steps = [step["run"] for step in example("steps") if "run" in step]
    summary = tmp_path / "summary.md"
    done = shell("\n".join(steps), folder, GITHUB_STEP_SUMMARY=str(summary))
    assert done.returncode == 1
    assert done.stdout.startswith("::error file=decks/bad.keyxm,line=3,")
    assert installed(folder) == "pip install mudline\n"
    assert summary.read_text(encoding="utf-8").startswith("### mudline: 1 error in 2 files\n")


def test_the_workflow_of_github_gives_inputs_that_the_action_has() -> None:
    action = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
    given = [step["with"] for step in example("action") if step["uses"].startswith("./")]
    assert len(given) == 1
    assert all(inputs.keys() <= action["inputs"].keys() for inputs in given)


def test_every_action_has_one_version_everywhere() -> None:
    files = [ROOT / "action.yml", *(ROOT / ".github/workflows").glob("*.yml"), *(ROOT / "docs").rglob("*.md")]
    used: dict[str, set[str]] = {}
    for path in files:
        for name, version in re.findall(r"uses: ([\w./-]+)@(\S+)", path.read_text(encoding="utf-8")):
            used.setdefault(name, set()).add(version)
    assert {name: versions for name, versions in used.items() if len(versions) > 1} == {}
    assert "actions/checkout" in used


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


# --------------------------------------- The steps of action.yml, run one after the other with the inputs of a workflow


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


def test_the_summary_of_a_run_has_the_findings(folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(tmp_path / "summary.md"))
    (_, (code, _)) = steps(folder)
    assert code == 1
    assert "| error | decks/bad.keyxm:3:9 | SYN002 " in (tmp_path / "summary.md").read_text(encoding="utf-8")


def test_findings_are_annotations_and_fail_the_job(folder: Path) -> None:
    (install, _), (code, printed) = steps(folder)
    assert (install, code) == (0, 1)
    assert printed.startswith("::error file=decks/bad.keyxm,line=3,endLine=3,col=9,endColumn=14,title=SYN002 ")
    assert installed(folder) == f"pip install --quiet --disable-pip-version-check {ROOT}\n"


def test_no_module_of_the_checkout_is_imported(folder: Path) -> None:
    for name in ("click", "pip", "multiprocessing", "pickle"):
        (folder / f"{name}.py").write_text("from pathlib import Path\nPath('run').touch()\n")
    given = {"MUDLINE_PYTHON": sys.executable, "PIP_NO_INDEX": "1", "MUDLINE_VERSION": "1.2.0", "MUDLINE_PATHS": "."}
    install = shell(f"bash {shlex.quote(str(ROOT / '.github' / 'install.sh'))}", folder, **given)
    assert "No matching distribution found for mudline==1.2.0" in install.stderr
    lint = shell(f"bash {shlex.quote(str(ROOT / '.github' / 'lint.sh'))}", folder, **given)
    assert (lint.returncode, lint.stdout.count("::error ")) == (1, 1)
    assert not (folder / "run").exists()


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
