"""The notebooks of docs/tutorials run, and show what a run shows."""

from __future__ import annotations

import re
from pathlib import Path

import nbformat
import pytest

from tests.docs.blocks import Page
from tests.docs.tutorials import TUTORIALS, executed, read, shown, text


def prose(path: Path) -> Page:
    return Page(path, "\n\n".join(cell.source for cell in read(path).cells if cell.cell_type == "markdown"))


def test_the_tutorials_are_listed() -> None:
    assert [path.name for path in TUTORIALS] == [
        "from-soil-data-to-a-curve.ipynb",
        "touchdown-zone-in-waves.ipynb",
        "validate-and-mend-an-archive.ipynb",
    ]
    index = Page.read(TUTORIALS[0].parent / "README.md")
    assert {path.name for path in TUTORIALS} <= set(index.links())


@pytest.mark.slow
@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_a_run_shows_what_the_notebook_shows(path: Path) -> None:
    assert shown(executed(path)) == shown(read(path)), "run make tutorials"


@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_a_notebook_is_complete_and_in_its_canonical_form(path: Path) -> None:
    notebook = read(path)
    nbformat.validate(notebook)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in code] == list(range(1, len(code) + 1))
    names = [output.get("name", "") for cell in code for output in cell.outputs]
    assert "stderr" not in names
    assert path.read_text(encoding="utf-8") == text(notebook), "run make tutorials"
    assert re.search(r"/tmp|/home|\\Users", path.read_text(encoding="utf-8")) is None  # noqa: S108 - places of one run


@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_links_of_a_notebook_lead_somewhere(path: Path) -> None:
    links = list(prose(path).links())
    assert links
    for target in links:
        file, _, heading = target.partition("#")
        other = (path.parent / file).resolve()
        assert other.exists(), target
        assert not heading or heading in Page.read(other).anchors, target
