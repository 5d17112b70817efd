"""What a command does not need is not imported."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from tests.cli.conftest import Place
from tests.helpers.processes import TIMEOUT

HEAVY = frozenset({"click", "lark", "matplotlib", "numpy", "pydantic", "rich", "yaml", "numba", "scipy", "pyarrow"})
PROGRAM = """\
import json, sys
from mudline.__main__ import main
code = main(json.loads(sys.argv[1]))
sys.stderr.write(json.dumps([code, sorted(sys.modules)]))
"""


def modules(*arguments: str, code: int = 0) -> set[str]:
    words = [sys.executable, "-c", PROGRAM, json.dumps(arguments)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=TIMEOUT, check=True)
    found, names = json.loads(done.stderr.splitlines()[-1])
    assert found == code
    return set(names)


def heavy(names: set[str]) -> set[str]:
    return names & HEAVY


def test_version_needs_nothing() -> None:
    names = modules("--version")
    assert heavy(names) == set()
    assert "mudline.cli.main" not in names


def test_import_of_the_package_needs_nothing() -> None:
    program = "import sys, mudline; print(mudline.__version__, dir(mudline)); print(*sys.modules, file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=TIMEOUT, check=True)
    assert heavy(set(done.stderr.split())) == set()


@pytest.mark.parametrize("form", ["json", "text"])
def test_clean_lint_needs_no_rich(place: Place, form: str) -> None:
    names = modules("lint", place(), "--output-format", form)
    assert heavy(names) == {"click", "lark", "numpy", "pydantic"}


@pytest.mark.parametrize("other", ["", "*COATINGS\n SET=ALL\n 0.05, 900.0\n"])
def test_keywords_that_a_deck_lacks_are_not_loaded(place: Place, other: str) -> None:
    names = modules("lint", place(f"$MODEL\n*OCEAN\n 100.0, 1025.0, 9.81\n{other}"), "--output-format", "json")
    assert {name for name in names if name.startswith("mudline.language.keywords.library.")} == {
        "mudline.language.keywords.library.ocean"
    }


def test_evaluation_loads_only_what_the_deck_needs(place: Place) -> None:
    names = modules("evaluate", place(), "--output-format", "json")
    assert not names & {"rich", "matplotlib", "yaml", "scipy", "numba", "multiprocessing", "pyarrow"}
    assert "mudline.model.contact.laws.linear" in names
    assert "mudline.model.contact.laws.suction" not in names


def test_names_of_the_api_are_loaded_when_used() -> None:
    program = "import sys, mudline; mudline.ForceCurve([(0, 0), (1, 1)]); print(*sys.modules, file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=TIMEOUT, check=True)
    assert heavy(set(done.stderr.split())) == {"numpy"}
