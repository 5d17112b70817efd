"""Where more is said about the rule of a finding."""

from __future__ import annotations

from functools import cache
from importlib.metadata import PackageNotFoundError, metadata

from mudline.linting.plugins import origin

_PAGE = "docs/rules/{code}.md"
_LABELS = ("documentation", "homepage")


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
