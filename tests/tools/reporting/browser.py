"""The page to sign in Chromium: what it looks like, what it asks for, how accessible it is.

`python -m tests.tools.reporting.browser` takes the pictures of docs/report.md.
"""

from __future__ import annotations

import shutil
import tempfile
from contextlib import chdir
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple

from tests.cli.runner import run
from tests.helpers.samples import SAMPLES

if TYPE_CHECKING:
    from playwright.sync_api import Browser

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
Scheme = Literal["light", "dark"]
IMAGES = Path(__file__).parents[3] / "docs" / "images"


class Seen(NamedTuple):
    """What a browser says of a page: its width in pixels, messages, requests, faults of accessibility."""

    width: int
    messages: list[str]
    requests: list[str]
    faults: list[str]


def program() -> str | None:
    """The path of a Chromium."""
    return next((found for name in BROWSERS if (found := shutil.which(name))), None)


def seen(browser: Browser, path: Path, width: int, scheme: Scheme) -> Seen:
    """Open a page, once as it is and once for the checker, which is a script and needs the policy switched off."""
    axe = import_module("axe_playwright_python.sync_playwright").Axe()  # it has no types
    messages: list[str] = []
    requests: list[str] = []
    with browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme) as context:
        page = context.new_page()
        page.on("console", lambda message: messages.append(message.text))
        page.on("pageerror", lambda error: messages.append(str(error)))
        page.on("request", lambda request: requests.append(request.url))
        page.goto(path.as_uri())
        found = page.evaluate("document.documentElement.scrollWidth")
    with browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme, bypass_csp=True) as context:
        page = context.new_page()
        page.goto(path.as_uri())
        violations = axe.run(page).response["violations"]
    faults = [f"{one['id']}: {one['nodes'][0]['html'][:200]}" for one in violations]
    return Seen(found, messages, [one for one in requests if not one.startswith("data:")], faults)


def take_pictures() -> None:
    """Write the pictures of the documentation."""
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - where it is installed

    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright, chdir(SAMPLES.parent):
        target = Path(folder) / "scr-vessel.html"
        block = ("--title", "Riser in the extreme sea", "--document", "RP-0042", "--revision", "B")
        words = ("-o", str(target), *block)
        run("report", f"{SAMPLES.name}/scr-vessel.keyxm", *words)
        browser = playwright.chromium.launch(executable_path=program(), args=["--no-sandbox"])
        sizes: tuple[tuple[Scheme, int, int], ...] = (("light", 900, 1500), ("dark", 360, 900))
        for scheme, width, height in sizes:
            with browser.new_context(viewport={"width": width, "height": height}, color_scheme=scheme) as context:
                page = context.new_page()
                page.goto(target.as_uri())
                page.screenshot(path=IMAGES / f"report-{scheme}.png")


if __name__ == "__main__":
    take_pictures()
