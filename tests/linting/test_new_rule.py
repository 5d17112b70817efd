"""A new rule is one file: it is listed, explained, run and given a page, and no other file knows of it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

import mudline
from tests.processes import TIMEOUT

ROOT = Path(__file__).parents[2]
SOURCE = Path(mudline.__file__).parents[1]

PAGE = """
    A deck has a model.

    It is left to others to say why not, in ten words or more.

    Example:
        -$MODEL
        +$PREPROCESSOR
         *OCEAN
          500.0, 1025.0, 9.81

    Finds: 1:1
"""
HEAD = '''"""A new module."""

from mudline.diagnostics import Code, Problem, Severity, Where
from mudline.linting.rule import rule
from mudline.scene.checks import check

NEW001 = Code("NEW001", "deck-with-model", Severity.WARNING)
'''
FUNCTION = f'''{HEAD}

@{{decorator}}(NEW001)
def deck_with_model({{seen}}):
    """{PAGE.strip()}
    """
    yield Problem(NEW001, "write no model", where=Where(0))
'''
ADVICE = FUNCTION.format(decorator="rule", seen="context")
CHECK = FUNCTION.format(decorator="check", seen="scene")
SCRIPT = """
import sys
from importlib import import_module

package, folder = sys.argv[1:]
import_module(package).__path__.append(folder)

from mudline.__main__ import main
from mudline.linting.registry import find
from tests.docs.rule_pages import rule_index, rule_page

for words in (["rules"], ["rules", "NEW001"], "lint --select NEW --output-format concise deck.keyxm".split()):
    main(words)
    print(end="\\0", flush=True)
print(rule_index(find("NEW001")), rule_page(*find("NEW001")), sep="", end="")
"""


class Shown(NamedTuple):
    """What the program and its documentation show of a new module."""

    rules: str
    page: str
    findings: str
    document: str


@pytest.fixture(
    scope="module",
    params=[
        ("mudline.linting.rules", "new_family/new_subject.py", ADVICE),
        ("mudline.scene.checks", "new_subject.py", CHECK),
    ],
    ids=["rule", "check"],
)
def shown(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Shown:
    """What is shown, in a folder with a deck, where a package has one more module."""
    package, file, text = request.param
    folder = tmp_path_factory.mktemp("new")
    module = folder / "more" / file
    module.parent.mkdir(parents=True)
    (module.parent / "__init__.py").write_text('"""New."""\n')
    module.write_text(text)
    (folder / "deck.keyxm").write_text("$MODEL\n*OCEAN\n 500.0, 1025.0, 9.81\n")
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, package, str(folder / "more")],
        capture_output=True,
        text=True,
        check=False,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(SOURCE), str(ROOT)])},
        timeout=TIMEOUT,
    )
    assert done.stderr == ""
    return Shown(*done.stdout.split("\0"))


def test_a_new_module_is_listed_and_explained(shown: Shown) -> None:
    assert "NEW001 warning deck-with-model A deck has a model." in " ".join(shown.rules.split())
    bad, good = shown.page.partition("Bad (found at line 1, column 1):")[2].split("Good:")
    assert [line.strip() for line in bad.split("\n") if line] == ["$MODEL", "*OCEAN", "500.0, 1025.0, 9.81"]
    assert [line.strip() for line in good.split("\n") if line] == ["$PREPROCESSOR", "*OCEAN", "500.0, 1025.0, 9.81"]
    assert "It is left to others to say why not, in ten words or more." in shown.page


def test_a_new_module_finds_and_has_a_page(shown: Shown) -> None:
    finding = "deck.keyxm:1:1: NEW001 write no model\n"
    assert shown.findings == finding
    pages = shown.document
    assert "\n| [NEW001](NEW001.md) | `deck-with-model` | warning |  | A deck has a model. |\n" in pages
    assert "\n# NEW001 deck-with-model\n\nA deck has a model.\n\nSeverity: warning." in pages
    assert "\nBad:\n\n```mudline\n$MODEL\n*OCEAN\n 500.0, 1025.0, 9.81\n```\n" in pages
    assert f"```text\n{finding}```\n\nGood:\n\n```mudline\n$PREPROCESSOR\n*OCEAN\n" in pages
