"""Where a rule comes from, and the address of its page; no rule is imported for it."""

from __future__ import annotations

from functools import cache

from mudline.basics.installed import project_addresses
from mudline.basics.resources import rule_file

GROUP = "mudline.rules"
"""The entry points by which packages bring rules."""

ORIGINS: dict[str, str] = {}
"""The packages of the rules of plugins with their versions, by code, once they are loaded."""


def origin(code: str) -> str:
    """The package that a rule comes from, with its version: "mudline" for mudline's own."""
    return ORIGINS.get(code, "mudline")


@cache
def page(code: str) -> str | None:
    """The address of the page of a code, None where it has none.

    Mudline's own are on the site that its package names as its documentation, else among the installed files; of the
    code of a plugin, it is the documentation of its package.
    """
    package = origin(code)
    if package != "mudline":
        return _documentation(package.rpartition(" ")[0])
    if site := _documentation(package):
        return f"{site.rstrip('/')}/rules/{code}.html"
    file = rule_file(code)
    return file.as_uri() if file.exists() else None


@cache
def _documentation(name: str) -> str | None:
    """The address of the documentation of an installed package."""
    addresses = project_addresses(name)
    found = next((addresses[label] for label in ("documentation", "homepage") if label in addresses), "")
    return found if found.startswith(("https://", "http://")) else None
