"""What forms of findings share: a finding as a JSON object, its page, and its fingerprint from run to run."""

from __future__ import annotations

from collections import Counter
from functools import cache
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, metadata
from typing import Any

from mudline.diagnostics import Diagnostic, Fix
from mudline.linting.plugins import origin

_PAGE = "docs/rules/{code}.md"
_LABELS = ("documentation", "homepage")


def as_object(found: Diagnostic) -> dict[str, Any]:
    """A finding as a dict."""
    return {
        "file": found.file,
        "code": found.code,
        "slug": found.slug,
        "severity": found.severity.value,
        "message": found.message,
        "line": found.line,
        "column": found.column,
        "end_line": found.end_line,
        "end_column": found.end_column,
        "fix": None if found.fix is None else _fix(found.fix),
        "url": page(found.code),
    }


def _fix(fix: Fix) -> dict[str, Any]:
    edits = [{"start": list(edit.start), "end": list(edit.end), "text": edit.text} for edit in fix.edits]
    return {"applicability": fix.applicability, "message": fix.message, "edits": edits}


def page(code: str) -> str | None:
    """The page of a code of mudline, in its repository; the documentation of the package of a plugin, if it tells one.

    The first is a path, the second an address on the web.
    """
    package = origin(code)
    return _PAGE.format(code=code) if package == "mudline" else _documentation(package)


def address(code: str) -> str | None:
    """The same, where it is an address on the web."""
    found = page(code)
    return found if found and found.startswith(("https://", "http://")) else None


@cache
def _documentation(package: str) -> str | None:
    """The address of the documentation of an installed package, given as "name version"."""
    name, _, _ = package.rpartition(" ")
    try:
        given = metadata(name).get_all("Project-URL") or []
    except (PackageNotFoundError, ValueError):  # a plugin that is no installed package has no name
        return None
    pairs = (text.partition(",") for text in given)
    addresses = {label.strip().lower(): url.strip() for label, _, url in pairs}
    found = next((addresses[label] for label in _LABELS if label in addresses), "")
    return found if found.startswith(("https://", "http://")) else None


class Fingerprints:
    """Hashes of path, code and message, not of the line number; the same thing found again is counted."""

    def __init__(self) -> None:
        self._met: Counter[tuple[str, str, str]] = Counter()

    def of(self, found: Diagnostic) -> str:
        """The hash of a finding, in the order of the findings; no two of a run are equal."""
        known = (found.file, found.code, found.message)
        self._met[known] += 1
        text = "\0".join([*known, str(self._met[known])])
        return sha256(text.encode("utf-8", "backslashreplace")).hexdigest()
