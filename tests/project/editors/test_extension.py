"""The extension for VS Code: its grammar, its client against a stub of the editor, and the package unpacked."""

from __future__ import annotations

import json
import re
import shutil
import sys
import zipfile
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

import mudline
from mudline.language.deck.forms import SUFFIXES
from tests.cli.runner import ROOT, process
from tests.helpers.builders.decks import BAD_NUMBER
from tests.project.editors.extension import EXTENSION, needs_node, node
from tests.project.editors.snippets import snippets_text

ABOUT: dict[str, Any] = json.loads((EXTENSION / "package.json").read_text(encoding="utf-8"))

needs_npm = pytest.mark.skipif(
    shutil.which("npm") is None or not (EXTENSION / "node_modules" / "@vscode" / "vsce").is_dir(),
    reason="npm, or editors/vscode/node_modules, is missing: npm install --prefix editors/vscode",
)
needs_server = pytest.mark.skipif(
    find_spec("mudline.tools.lsp") is None or find_spec("pygls") is None,
    reason="mudline lsp, or its extra lsp, is missing",
)


def test_the_version_and_the_suffixes_are_those_of_mudline() -> None:
    assert ABOUT["version"] == mudline.__version__
    (language,) = ABOUT["contributes"]["languages"]
    assert set(language["extensions"]) == set(SUFFIXES)


def test_every_named_file_is_there() -> None:
    (language,) = ABOUT["contributes"]["languages"]
    (grammar,) = ABOUT["contributes"]["grammars"]
    (snippets,) = ABOUT["contributes"]["snippets"]
    names = [language["configuration"], *language["icon"].values(), grammar["path"], snippets["path"], ABOUT["icon"]]
    assert [name for name in names if not (EXTENSION / name).is_file()] == []
    assert json.loads((EXTENSION / language["configuration"]).read_text(encoding="utf-8"))["comments"]


def test_it_can_be_published() -> None:
    assert "private" not in ABOUT
    icon = (EXTENSION / ABOUT["icon"]).read_bytes()
    assert icon.startswith(b"\x89PNG")
    assert [int.from_bytes(icon[at : at + 4], "big") for at in (16, 20)] == [128, 128]
    assert "](images/findings.png)" in (EXTENSION / "README.md").read_text(encoding="utf-8")


def test_the_snippets_are_fresh_and_their_blocks_are_legal() -> None:
    text = (EXTENSION / "snippets/mudline.json").read_text(encoding="utf-8")
    assert text == snippets_text(), "run make docs"
    given = json.loads(text)
    assert len(given) > 90
    body = "\n".join(given["*SEABED STIFFNESS"]["body"])
    filled = re.sub(r"\$\{\d+:([^}]*)\}|\$0", r"\1", body)
    deck = mudline.from_keyword(f"$MODEL\n{filled}", units="metric")
    assert [block.keyword for block in deck.sections[0].blocks] == ["SEABED STIFFNESS"]


def test_the_problem_matcher_takes_what_the_task_prints(tmp_path: Path) -> None:
    (matcher,) = ABOUT["contributes"]["problemMatchers"]
    (tmp_path / "decks").mkdir()
    (tmp_path / "decks/a b.keyxm").write_text(BAD_NUMBER, encoding="utf-8")
    outcome = process("lint", "--color", "never", ".", cwd=tmp_path)
    pattern = matcher["pattern"]
    found = [match for line in outcome.out.splitlines() if (match := re.fullmatch(pattern["regexp"][1:-1], line))]
    keys = ("file", "line", "column", "severity", "code")
    assert [tuple(match[pattern[key]] for key in keys) for match in found] == [
        ("decks/a b.keyxm", "6", "11", "error", "SYN002")
    ]


def test_no_file_names_a_host_for_packages() -> None:
    assert not (EXTENSION / "package-lock.json").exists()
    assert "registry" not in (EXTENSION / ".npmrc").read_text(encoding="utf-8")


@needs_node
def test_the_grammar_gives_the_scopes_that_are_written_down() -> None:
    node(
        "node",
        "node_modules/vscode-tmgrammar-test/dist/unit.js",
        "-g",
        "syntaxes/mudline.tmLanguage.json",
        "test/*.keyx",
    )


@needs_node
def test_the_client_with_a_server_of_its_own() -> None:
    assert "# pass 8\n" in node("node", "--test", "--test-reporter=tap", "test/client.test.js")


@needs_npm
def test_the_package_unpacked(tmp_path: Path) -> None:
    node("npm", "run", "--silent", "package", "--", "--out", tmp_path / "mudline.vsix")
    with zipfile.ZipFile(tmp_path / "mudline.vsix") as archive:
        archive.extractall(tmp_path)
    files = {path.relative_to(tmp_path).as_posix() for path in (tmp_path / "extension").rglob("*") if path.is_file()}
    assert files == {
        f"extension/{name}"
        for name in (
            *("LICENSE.txt", "dist/LICENSES.txt", "dist/extension.js", "icons/deck-dark.svg"),
            *("icons/deck-light.svg", "icons/mudline.png", "images/findings.png", "images/help.png"),
            *("language-configuration.json", "package.json", "readme.md", "snippets/mudline.json"),
            "syntaxes/mudline.tmLanguage.json",
        )
    }
    unpacked = tmp_path / "extension"
    assert (unpacked / "LICENSE.txt").read_text(encoding="utf-8") == (ROOT / "LICENSE").read_text(encoding="utf-8")
    assert "vscode-languageclient" in (unpacked / "dist/LICENSES.txt").read_text(encoding="utf-8")
    manifest = (tmp_path / "extension.vsixmanifest").read_text(encoding="utf-8")
    assert f'Id="mudline" Version="{mudline.__version__}"' in manifest
    shown = ("--test-name-pattern", "findings of an open deck")
    client = str(unpacked / "dist/extension.js")
    assert "# pass 1\n" in node(
        "node", "--test", "--test-reporter=tap", *shown, "test/client.test.js", MUDLINE_CLIENT=client
    )


@needs_node
@needs_server
def test_the_client_with_mudline_lsp() -> None:
    server = json.dumps([sys.executable, "-m", "mudline", "lsp"])
    shown = ("--test-name-pattern", "findings of an open deck")
    assert "# pass 1\n" in node(
        "node", "--test", "--test-reporter=tap", *shown, "test/client.test.js", MUDLINE_SERVER=server
    )
