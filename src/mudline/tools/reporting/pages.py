"""Pages about decks: their content, their files, and the index of many."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from mudline.basics.paths import relative_path
from mudline.basics.version import __version__
from mudline.checks.engine import LintSettings
from mudline.tools.reporting.content import DeckFile, Look, LookError, PageHead, report_on

Made = tuple[dict[str, Any], str | LookError | None]
"""Content of a page, and its HTML, None if not requested, or the fault of its look."""
Wanted = tuple[tuple[str, ...], PageHead, Look | None, bool]
"""Sections of a page, its head, its look (None for JSON), and True for contact at the resting shape."""


def make_page(given: DeckFile, settings: LintSettings, wanted: Wanted) -> Made:
    """Make the page about a deck, in any process."""
    sections, document, look, rest_shape = wanted
    report = report_on(given, settings, sections, document, rest_shape=rest_shape)
    if look is None:
        return report.json, None
    from mudline.tools.reporting.page import page  # noqa: PLC0415 - needs jinja2 and matplotlib

    try:
        return report.json, page(report, look)
    except LookError as error:
        return report.json, error


class Pages:
    """Files of pages: one file, or the `index` with a folder next to it, which has its name without the suffix.

    `rows` are those of the index, one for each deck. Without a path no page is written.
    """

    def __init__(self, path: Path | None, write: Callable[[Path, str], None], *, several: bool) -> None:
        self.index, self.folder = path, None
        if path is not None and several:
            is_index = path.suffix.lower() in {".html", ".htm"}
            self.index, self.folder = (path, path.with_suffix("")) if is_index else (path / "index.html", path)
        self.rows: list[dict[str, Any]] = []
        self._write = write
        self._names: set[str] = set()

    @property
    def faulty(self) -> int:
        """Number of decks with errors."""
        return sum(row["errors"] > 0 for row in self.rows)

    def add(self, result: Made, name: str) -> None:
        """Write the page about a deck; raises LookError."""
        content, html = result
        if isinstance(html, LookError):
            raise html
        page = None if html is None else self._page(name)
        if page is not None and html is not None:
            self._write(page, html)
        self.rows.append(self._row(content, name, page))

    def finish(self, look: Look) -> None:
        """Write the index, if there is one; raises LookError."""
        if self.folder is not None and self.index is not None:
            from mudline.tools.reporting.page import rendered  # noqa: PLC0415 - needs jinja2

            plain = look._replace(template=None)
            self._write(self.index, rendered(plain, "index.html", rows=self.rows, version=__version__))

    def _page(self, deck: str) -> Path | None:
        """Return the file of the page about a deck, different for each page of a run."""
        if self.folder is None:
            return self.index
        self.folder.mkdir(parents=True, exist_ok=True)
        stem = re.sub(r"[^\w.-]+", "-", deck).strip("-.")[-100:] or "deck"
        name, count = f"{stem}.html", 1
        while name.lower() in self._names or name.lower() == "index.html":
            count += 1
            name = f"{stem}-{count}.html"
        self._names.add(name.lower())
        return self.folder / name

    def _row(self, content: dict[str, Any], name: str, page: Path | None) -> dict[str, Any]:
        """Return a row of the index; decks below the working folder have paths relative to it."""
        verdict = content["verdict"]
        words = verdict["verdict"].partition(" (")[0]
        kind = "errors" if verdict["errors"] else words
        address = "" if page is None or self.index is None else relative_path(page, self.index.parent)
        counts = {name: verdict[name] for name in ("errors", "warnings")}
        counts |= {name: verdict["keywords"][name] for name in ("read", "total")}
        deck = content["deck"] if os.path.isabs(name) else name  # noqa: PTH117 - Path raises for a long name
        return {"deck": deck, "page": address, "verdict": words, "kind": kind, **counts}
