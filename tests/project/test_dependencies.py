"""The page of dependencies has each of those that pyproject.toml has, once, and no other."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]
_NAME = re.compile(r"[A-Za-z0-9._-]+")
_ROW = re.compile(r"^\| ([^|]+) \| ([^|]+) \| ([^|]+) \| ([^|]+) \| ([^|]+) \|$", re.MULTILINE)


def declared() -> dict[str, set[str]]:
    """Names of dependencies by what needs them: `core`, `build`, an extra, or a group."""
    held = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    project = held["project"]
    lists = {"core": project["dependencies"], "build": held["build-system"]["requires"]}
    lists |= project["optional-dependencies"] | held["dependency-groups"]
    found: dict[str, set[str]] = {}
    for part, lines in lists.items():
        for line in lines:
            if isinstance(line, str) and not line.startswith("mudline[") and (name := _NAME.match(line)):
                found.setdefault(name[0], set()).add(part)
    return found


def described() -> list[list[str]]:
    page = (ROOT / "docs/dependencies.md").read_text(encoding="utf-8")
    rows = [[cell.strip() for cell in row] for row in _ROW.findall(page)]
    return [row for row in rows if row[0] != "Library" and set(row[0]) != {"-"}]


def test_the_page_has_exactly_the_dependencies_of_the_project() -> None:
    rows = described()
    names = [row[0].strip("`") for row in rows]
    assert len(names) == len(set(names))
    page = {name: set(row[1].split(", ")) for name, row in zip(names, rows, strict=True)}
    assert page == declared()


def test_each_has_its_licence_its_health_and_what_would_replace_it() -> None:
    for name, _, purpose, licence, health in described():
        assert len(purpose) > 10, name
        assert "; else " in purpose or "; without it " in purpose, name
        assert licence, name
        assert re.fullmatch(r"[0-9][0-9a-z.]* of [0-9]{4}-[0-9]{2}-[0-9]{2}", health), name
