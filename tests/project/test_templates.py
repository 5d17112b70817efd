"""What a stranger fills in and copies: the forms of issues, and how the project is cited."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

import mudline
from tests.cli.runner import Json

ROOT = Path(__file__).parents[2]
FORMS = sorted(path for path in (ROOT / ".github/ISSUE_TEMPLATE").glob("*.yml") if path.name != "config.yml")
TYPES = {"markdown", "textarea", "input", "dropdown", "checkboxes"}


def form(path: Path) -> Json:
    return yaml.safe_load(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("path", FORMS, ids=lambda path: path.stem)
def test_a_form_has_what_the_host_asks_for(path: Path) -> None:
    found = form(path)
    assert {"name", "description", "body"} <= found.keys()
    fields = [each for each in found["body"] if each["type"] != "markdown"]
    assert {each["type"] for each in found["body"]} <= TYPES
    assert len({each["id"] for each in fields}) == len(fields) > 1
    assert all(each["attributes"]["label"] for each in fields)
    assert all(each["attributes"]["options"] for each in fields if each["type"] == "dropdown")


def test_the_citation_is_of_this_version() -> None:
    assert form(ROOT / "CITATION.cff")["version"] == mudline.__version__
