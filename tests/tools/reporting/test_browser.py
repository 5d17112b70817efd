"""The page to sign, as a browser shows it: no request, no message, no fault of accessibility, as wide as the screen."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.cli.runner import run
from tests.helpers.samples import SAMPLES
from tests.helpers.shared import shared
from tests.tools.reporting.browser import program, seen
from tests.tools.reporting.pages import long_deck

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = [pytest.mark.slow, pytest.mark.covered]


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    api = pytest.importorskip("playwright.sync_api")
    pytest.importorskip("axe_playwright_python")
    found = program()
    if found is None:
        pytest.skip("Chromium is not installed")
    with api.sync_playwright() as playwright:
        yield playwright.chromium.launch(executable_path=found, args=["--no-sandbox"])


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    decks = [str(SAMPLES / name) for name in ("broken.keyxm", "scr-vessel.keyxm")]
    folder = shared(tmp_path_factory, "pages", lambda folder: run("report", *decks, "-o", str(folder), "-q"))
    return sorted(folder.glob("*.html"))


def test_pages_are_shown_as_they_are_meant(browser: Browser, pages: list[Path], tmp_path: Path) -> None:
    assert len(pages) == 3
    for path in pages:
        for width, scheme in ((1280, "light"), (360, "dark"))[path != pages[-1] :]:
            found = seen(browser, path, width, "light" if scheme == "light" else "dark")
            assert (found.width, found.messages, found.faults) == (width, [], []), (path.name, scheme)
            assert found.requests == [path.as_uri()]
    page = browser.new_page()
    page.goto(pages[-1].as_uri())
    assert page.pdf(path=tmp_path / "page.pdf", format="A4").startswith(b"%PDF")


def test_a_page_is_short_before_its_appendix(browser: Browser, pages: list[Path], tmp_path: Path) -> None:
    (tmp_path / "long.keyxm").write_text(long_deck(), encoding="utf-8")
    run("report", str(tmp_path / "long.keyxm"), "-o", str(tmp_path / "long.html"), "-q")
    for path in (pages[-1], tmp_path / "long.html"):
        page = browser.new_page()
        page.goto(path.as_uri())
        page.add_style_tag(content="#appendix { display: none }")
        assert len(re.findall(rb"/Type\s*/Page\b", page.pdf(prefer_css_page_size=True))) <= 6


def test_the_index_shows_the_decks_of_a_verdict(browser: Browser, pages: list[Path]) -> None:
    page = browser.new_page()
    page.goto(next(path for path in pages if path.name == "index.html").as_uri())
    assert page.locator("tbody tr:visible").count() == 2
    for words, deck in (("errors (1)", "broken"), ("no errors (1)", "scr-vessel")):
        page.get_by_text(words, exact=True).click()
        assert page.locator("tbody tr:visible").count() == 1
        assert deck in page.locator("tbody tr:visible").inner_text()
