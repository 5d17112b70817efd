"""The picture of docs/architecture.md: packages, and which of them import which, read from the source."""

from __future__ import annotations

import ast
import tomllib
from collections.abc import Collection, Iterator
from functools import cache
from graphlib import TopologicalSorter
from itertools import pairwise
from pathlib import Path

ROOT = Path(__file__).parents[2] / "src" / "mudline"

BASE = "diagnostics, files, ..."
API = ("api", "plugins")

_WIDTH, _ROW, _BOX = 880, 74, (118, 34)
_GAP, _CROSSING = 10, 16
"""Least distance of two boxes, and the width that an arrow takes in a row that it crosses."""
_STYLE = "font-family:sans-serif;font-size:13px"

Graph = dict[str, set[str]]


def upwards() -> set[tuple[str, str]]:
    """The packages of imports that the order of the layers leaves out, as its contract in pyproject.toml lists them."""
    settings = tomllib.loads((ROOT.parents[1] / "pyproject.toml").read_text(encoding="utf-8"))
    (layers,) = (one for one in settings["tool"]["importlinter"]["contracts"] if one["id"] == "layers")
    pairs = (one.split(" -> ") for one in layers.get("ignore_imports", ()))
    return {(importer.split(".")[1], imported.split(".")[1]) for importer, imported in pairs}


def packages() -> Graph:
    """Return for each package the packages that it imports; the small modules beside them are one.

    The imports `upwards` are left out.
    """
    left_out = upwards()
    folders = {path.parent.name for path in ROOT.glob("*/__init__.py")}
    small = {path.stem for path in ROOT.glob("*.py")} - {"__init__", "__main__", *API} | {"codes"}
    names = {name: name for name in folders} | dict.fromkeys(small, BASE) | dict.fromkeys(API, ", ".join(API))
    graph: Graph = {name: set() for name in names.values()}
    for path in ROOT.rglob("*.py"):
        inside = path.relative_to(ROOT)
        importer = names.get(inside.parts[0].removesuffix(".py"))
        for imported in _imported(path):
            target = names.get(imported)
            if importer and target and importer != target and (importer, target) not in left_out:
                graph[importer].add(target)
    return graph


def _imported(path: Path) -> Iterator[str]:
    """The packages or modules of the top level that a module imports, types and lazy imports included."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module == "mudline":
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and node.module.startswith("mudline."):
            yield node.module.split(".")[1]


def direct(graph: Graph) -> Graph:
    """Return the graph without imports that a longer way implies. Raises graphlib.CycleError for a cycle."""
    below: Graph = {}
    for name in TopologicalSorter(graph).static_order():
        below[name] = graph[name].union(*(below[other] for other in graph[name]))
    return {name: {o for o in others if not any(o in below[way] for way in others)} for name, others in graph.items()}


@cache
def layer_picture() -> str:
    """Return the picture as SVG: a package stands above all that it imports."""
    graph = direct(packages())
    level: dict[str, int] = {}
    for name in TopologicalSorter(graph).static_order():
        level[name] = 1 + max((level[other] for other in graph[name]), default=-1)
    ways = {(name, other): _way(name, other, level) for name in sorted(graph) for other in sorted(graph[name])}
    places = _placed(level, ways.values())
    height = (max(level.values()) + 1) * _ROW
    arrows = [_arrow([places[step] for step in way]) for way in ways.values()]
    boxes = [_box(name, *places[name]) for name in sorted(graph)]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_WIDTH}" height="{height}" viewBox="0 0 {_WIDTH} {height}">\n'
        '<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        '<path d="M0 0 8 4 0 8z" fill="#555"/></marker></defs>\n'
        f'<rect width="{_WIDTH}" height="{height}" fill="#fff"/>\n' + "".join([*arrows, *boxes]) + "</svg>\n"
    )


def _way(name: str, other: str, level: dict[str, int]) -> list[str]:
    """A package, a place in each row that the arrow crosses, which gets a level too, and what it imports."""
    between = {f"{name} {other} {row}": row for row in range(level[name] - 1, level[other], -1)}
    level |= between
    return [name, *between, other]


def _placed(level: dict[str, int], ways: Collection[list[str]]) -> dict[str, tuple[float, float]]:
    """Places row by row from below, each above what it leads to, so that no boxes overlap."""
    crossings = {step for way in ways for step in way[1:-1]}
    below: Graph = {name: set() for name in level}
    for way in ways:
        for upper, lower in pairwise(way):
            below[upper].add(lower)
    places: dict[str, tuple[float, float]] = {}
    rows = max(level.values()) + 1
    for row in range(rows):
        wanted = {n: sum(places[o][0] for o in below[n]) / max(len(below[n]), 1) for n in level if level[n] == row}
        ordered = sorted(wanted, key=lambda name: (wanted[name], name))
        widths = [_CROSSING if name in crossings else _box_width(name) + _GAP for name in ordered]
        spare = (_WIDTH - sum(widths)) / len(ordered)
        left = 0.0
        for name, width in zip(ordered, widths, strict=True):
            places[name] = (left + (width + spare) / 2, (rows - row - 0.5) * _ROW)
            left += width + spare
    return places


def _arrow(places: list[tuple[float, float]]) -> str:
    (x, y), *inner, (end, bottom) = places
    text = f"M{x:.0f} {y + _BOX[1] / 2:.0f}"
    y += _BOX[1] / 2
    for to_x, to_y in [*inner, (end, bottom - _BOX[1] / 2)]:
        middle = (y + to_y) / 2
        text += f"C{x:.0f} {middle:.0f} {to_x:.0f} {middle:.0f} {to_x:.0f} {to_y:.0f}"
        x, y = to_x, to_y
    return f'<path d="{text}" fill="none" stroke="#555" marker-end="url(#head)"/>\n'


def _box_width(name: str) -> int:
    return max(_BOX[0], 8 * len(name) + 12)


def _box(name: str, x: float, y: float) -> str:
    width, height = _box_width(name), _BOX[1]
    return (
        f'<rect x="{x - width / 2:.0f}" y="{y - height / 2:.0f}" width="{width}" height="{height}" rx="4"'
        ' fill="#e8f0f7" stroke="#36648b"/>'
        f'<text x="{x:.0f}" y="{y + 4.5:.0f}" text-anchor="middle" style="{_STYLE}">{name}</text>\n'
    )
