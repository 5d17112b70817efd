"""The picture of docs/architecture.md: packages, and which of them import which, read from the source."""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator
from functools import cache
from graphlib import TopologicalSorter
from itertools import pairwise
from pathlib import Path

ROOT = Path(__file__).parents[2] / "src" / "mudline"

LAYERS = ("language", "model", "editing", "tools")
"""The layers whose packages have a box each; each of the others is a box."""
BASE = "codes, diagnostics, rules"
API = ("api", "keywords", "plugins")
_COLOURS = {"language": "#e8f0f7", "model": "#e6f4e6", "editing": "#fdf1d8", "tools": "#f3e8f5", "": "#f2f2f2"}

_WIDTH, _ROW, _BOX = 880, 74, (118, 34)
_GAP, _CROSSING = 10, 16
"""Least distance of two boxes, and the width that an arrow takes in a row that it crosses."""
_STYLE = "font-family:sans-serif;font-size:13px"

Graph = dict[str, set[str]]


def packages() -> Graph:
    """Return for each package of a layer the packages that it imports; small modules beside each other are one."""
    graph: Graph = {}
    for path in ROOT.rglob("*.py"):
        importer = _package(path.relative_to(ROOT).with_suffix("").parts)
        if importer:
            imported = {_package(parts) for parts in _imported(path)} - {importer, ""}
            graph.setdefault(importer, set()).update(imported)
    return graph


def _package(parts: tuple[str, ...]) -> str:
    """The box that a module belongs to, by the parts of its path; "" for the package mudline itself."""
    if parts[0] in API:
        return ", ".join(API)
    if parts[0] not in LAYERS:
        return "" if parts[0] in {"__init__", "__main__"} else parts[0]
    name = parts[1] if len(parts) > 1 else "__init__"
    return "" if name == "__init__" else BASE if name in BASE.split(", ") else name


def _imported(path: Path) -> Iterator[tuple[str, ...]]:
    """The modules of mudline that a module imports, types and lazy imports included."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.partition(".")[0] == "mudline":
            parts = tuple(node.module.split(".")[1:])
            if not parts or parts in {(layer,) for layer in LAYERS}:
                yield from ((*parts, alias.name) for alias in node.names if alias.name != "__version__")
            else:
                yield parts


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


def _layer(name: str) -> str:
    """The layer of a box, "" for one that is a layer of its own."""
    first = name.split(", ", maxsplit=1)[0]
    return next((layer for layer in LAYERS if (ROOT / layer / first).exists()), "")


def _box(name: str, x: float, y: float) -> str:
    width, height = _box_width(name), _BOX[1]
    return (
        f'<rect x="{x - width / 2:.0f}" y="{y - height / 2:.0f}" width="{width}" height="{height}" rx="4"'
        f' fill="{_COLOURS[_layer(name)]}" stroke="#36648b"/>'
        f'<text x="{x:.0f}" y="{y + 4.5:.0f}" text-anchor="middle" style="{_STYLE}">{name}</text>\n'
    )
