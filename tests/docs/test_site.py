"""The site of docs/: built strictly, every link leads somewhere, a browser shows it without network or fault."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import unquote

import pytest

from hatch_build import description
from mudline.cli.main import COMMANDS
from tests.docs.make import ROOT
from tests.helpers.processes import TIMEOUT
from tests.helpers.shared import shared

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = pytest.mark.slow

VISITED = (
    *("index.html", "install.html", "commands/mudline-evaluate.html", "tutorials/first-deck.html"),
    *("tutorials/touchdown-zone-in-waves.html", "keywords/seabed-stiffness.html", "api/contact.html"),
    "rules/CRV003.html",
)
"""A page of each kind."""

FOUND = {"NODE": "*NODE", "SEABED STIFFNESS": "*SEABED STIFFNESS", "install": "Install mudline"}
"""What a search finds first."""

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
NO_OTHER_HOST = "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"
SLOW = 120_000
"""Milliseconds: the index of a search is read beside other tests."""
PHONE = 390
"""Pixels across."""

_LINK = re.compile(r'<(?:a|img|link|script)\b[^>]*?\s(?:href|src)="([^"]*)"')
_ANCHOR = re.compile(r'\s(?:id|name)="([^"]+)"')


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    for module in ("mkdocs", "material", "mkdocstrings", "latex2mathml"):
        pytest.importorskip(module)
    return shared(tmp_path_factory, "site", build_site)


def build_site(folder: Path) -> None:
    from tests.docs.site import write  # noqa: PLC0415 - needs what builds the site

    source = folder.with_name("source")
    write(source)
    # Beside what is said of a page, MkDocs prints a note of its theme's makers on the future of both.
    environment = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    settings = ["--config-file", str(source / "mkdocs.yml"), "--site-dir", str(folder)]
    build = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", *settings]
    ran = subprocess.run(build, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=TIMEOUT, check=False)
    assert (ran.returncode, ran.stdout + ran.stderr) == (0, "")


@pytest.fixture(scope="module")
def address(site: Path) -> Iterator[str]:
    class Quiet(SimpleHTTPRequestHandler):
        def log_message(self, format: str, *args: object) -> None:  # noqa: A002 - so named in the library
            del format, args

    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(site))) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()
        thread.join()


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    api = pytest.importorskip("playwright.sync_api")
    program = next((found for name in BROWSERS if (found := shutil.which(name))), None)
    if program is None:
        pytest.skip("Chromium is not installed")
    with api.sync_playwright() as playwright:
        yield playwright.chromium.launch(executable_path=program, args=[NO_OTHER_HOST])


def links(site: Path) -> tuple[int, list[str]]:
    """How many links within a site its pages have, and those that lead nowhere."""
    texts = {site / name: (site / name).read_text(encoding="utf-8") for name in pages(site)}
    anchors = {path: set(_ANCHOR.findall(text)) for path, text in texts.items()}
    followed = 0
    broken = []
    for path, text in texts.items():
        for link in sorted(set(_LINK.findall(text))):
            if re.match(r"https?:|mailto:|data:", link):
                continue
            followed += 1
            file, _, anchor = unquote(link).partition("#")
            target = Path(os.path.normpath(path.parent / file)) if file else path
            target = target / "index.html" if target.is_dir() else target
            if not target.is_file() or (anchor and anchor not in anchors.get(target, ())):
                broken.append(f"{path.relative_to(site)}: {link}")
    return followed, broken


def pages(site: Path) -> list[str]:
    """The built pages but that of missing ones, whose links begin at the root of a server."""
    return sorted(path.relative_to(site).as_posix() for path in site.rglob("*.html") if path.name != "404.html")


def test_every_page_is_built(site: Path) -> None:
    built = pages(site)
    assert set(VISITED) <= set(built)
    of_docs = {path.relative_to(ROOT / "docs").with_suffix(".html") for path in ROOT.glob("docs/**/*.md")}
    wanted = {path.with_name("index.html") if path.stem == "README" else path for path in of_docs}
    assert {path.as_posix() for path in wanted} <= set(built)
    assert {f"commands/mudline-{name}.html" for name in COMMANDS} <= set(built)


def test_links_of_built_pages_lead_somewhere(site: Path) -> None:
    followed, broken = links(site)
    assert followed > 5000
    assert broken == []


def test_links_of_the_description_on_an_index_lead_somewhere(site: Path) -> None:
    text = description((ROOT / "README.md").read_text(encoding="utf-8"), "https://mudline.example")
    addresses = re.findall(r"\]\(https://mudline\.example/([^)#]*)", text)
    assert len(addresses) > 20
    assert [name for name in addresses if not (site / name).is_file()] == []


def test_a_browser_shows_pages_without_errors_and_without_other_hosts(address: str, browser: Browser) -> None:
    expect = pytest.importorskip("playwright.sync_api").expect
    requests: list[str] = []
    faults: list[str] = []
    with browser.new_context(viewport={"width": PHONE, "height": 844}, color_scheme="dark") as context:
        context.on("request", lambda request: requests.append(request.url))
        context.on("console", lambda message: faults.append(f"{message.type}: {message.text}"))
        context.on("weberror", lambda error: faults.append(str(error.error)))
        page = context.new_page()
        page.set_default_timeout(SLOW)
        for name in VISITED:
            page.goto(address + name)
            assert page.evaluate("document.documentElement.scrollWidth") == PHONE, name
            assert page.locator("article h1").count() == 1, name
        assert page.locator("body").get_attribute("data-md-color-scheme") == "slate"
        page.locator("[data-clipboard-target], .md-code__button").first.wait_for()
        page.locator("label.md-header__button[for=__search]").click()
        page.locator("input.md-search__input").press_sequentially("suction")  # the page listens to keys, not to `fill`
        page.locator(".md-search-result__item").first.wait_for()
        for words, first in FOUND.items():
            page.goto(address + "index.html")
            page.locator("label.md-header__button[for=__search]").click()
            page.locator("input.md-search__input").press_sequentially(words)
            # Results of the first letters are replaced by those of all.
            page.locator(".md-search-result__meta", has_text="matching").wait_for()
            expect(page.locator(".md-search-result__item h1").first).to_have_text(first, timeout=SLOW)
    assert faults == []
    assert [url for url in requests if not url.startswith((address, "data:", "blob:"))] == []
    assert len(requests) > len(VISITED)
