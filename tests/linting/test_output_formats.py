"""A form of findings is a module in its package: by being there it is offered, written and documented."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import click
import pytest

from mudline.cli.lint_report import complete
from mudline.linting import output
from mudline.linting.output import form_module, form_names
from tests.builders.decks import BAD_NUMBER
from tests.docs.form_table import form_table
from tests.processes import TIMEOUT

TOY = """
SUMMARY = "a toy"


def write(diagnostics, run):
    for found in diagnostics:
        yield f"toy {found.code} of {len(run.files)} with {run.version[:1]}\\n"
"""
WITH_TOY = """
import sys
from mudline.linting import output
output.__path__.append({folder!r})
from mudline.__main__ import main
code = main(sys.argv[1:])
names = [name.rpartition(".")[2] for name in sys.modules if name.startswith(output.__name__ + ".")]
print(*sorted(names), file=sys.stderr)
sys.exit(code)
"""


@pytest.fixture
def toy(tmp_path: Path) -> Path:
    """A folder with a form of its own."""
    folder = tmp_path / "forms"
    folder.mkdir()
    (folder / "toy.py").write_text(TOY, encoding="utf-8")
    return folder


def run(toy: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", WITH_TOY.format(folder=str(toy)), *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT, check=False, cwd=toy.parent)


def test_a_module_is_a_form(toy: Path) -> None:
    (toy.parent / "bad.keyxm").write_text(BAD_NUMBER, encoding="utf-8")
    done = run(toy, "lint", "bad.keyxm", "--output-format", "toy", "--output-format", "toy=toy.txt")
    imported = done.stderr.split()
    assert (imported, done.stdout, done.returncode) == (["toy"], "toy SYN002 of 1 with 0\n", 1)
    assert (toy.parent / "toy.txt").read_text(encoding="utf-8") == done.stdout


def test_it_is_offered(toy: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    names = sorted([*form_names(), "toy"])
    assert f"text (default), {', '.join(names)};" in " ".join(run(toy, "lint", "--help").stdout.split())
    refused = run(toy, "lint", ".", "--output-format", "tot")
    assert f"'tot' is not one of text, {', '.join(names)}" in refused.stderr
    monkeypatch.setattr(output, "__path__", [*output.__path__, str(toy)])
    context = click.Context(click.Command("lint"))
    assert complete(context, click.Option(["--output-format"]), "to") == ["toy"]
    try:
        assert "| `toy` | a toy |" in form_table().splitlines()
    finally:
        sys.modules.pop(f"{output.__name__}.toy", None)


@pytest.mark.parametrize("name", form_names())
def test_every_form_says_what_it_is(name: str) -> None:
    assert form_module(name).SUMMARY
