"""Origin of a rule, and the address of its page; no rule is imported for them."""

from __future__ import annotations

from functools import cache

from mudline.basics.installed import project_addresses
from mudline.basics.resources import rule_file

GROUP = "mudline.rules"
"""Group of entry points through which packages provide rules."""

ORIGINS: dict[str, str] = {}
"""Packages of plugin rules with their versions, by code, once they are loaded."""


def origin(code: str) -> str:
    """Return the package of a rule, with its version: "mudline" for mudline's own."""
    return ORIGINS.get(code, "mudline")


@cache
def page(code: str) -> str | None:
    """Return the address of the page of a code, None if it has none.

    Mudline's own pages are on the documentation site that its package names, or else among the installed files. For the
    code of a plugin it is the documentation of its package.
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
    """Return the address of the documentation of an installed package."""
    addresses = project_addresses(name)
    address = next((addresses[label] for label in ("documentation", "homepage") if label in addresses), "")
    return address if address.startswith(("https://", "http://")) else None
