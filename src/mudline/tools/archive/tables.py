"""Tables of an archive, each a list of columns with types and meanings.

The first column of each table is `file`, by which tables are joined. Numbers are in the units of their deck.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, NamedTuple, get_args, get_type_hints


class DeckRow(NamedTuple):
    """A deck."""

    units: Annotated[str, "unit system of all its numbers: metric, imperial or user"]
    ok: Annotated[bool, "true if no rule of severity error finds anything"]
    errors: Annotated[int, "findings of severity error"] = 0
    warnings: Annotated[int, "findings of severity warning"] = 0
    infos: Annotated[int, "findings of severity info"] = 0
    sections: Annotated[int, "sections"] = 0
    keywords: Annotated[int, "keyword blocks"] = 0
    read: Annotated[int, "keyword blocks that were read completely"] = 0
    partly: Annotated[int, "keyword blocks of which a line or a part was not read"] = 0
    unread: Annotated[int, "keyword blocks whose lines were not read"] = 0
    nodes: Annotated[int, "nodes"] = 0
    elements: Annotated[int, "elements"] = 0
    sets: Annotated[int, "element sets, without ALL"] = 0
    curves: Annotated[int, "curves of the seabed"] = 0
    length: Annotated[float | None, "total length of the elements"] = None
    depth: Annotated[float | None, "water depth of the last *OCEAN"] = None
    content: Annotated[int | None, "digest of its values; equal where only layout and comments differ"] = None
    key: Annotated[str, "digest of its bytes, its form, and the program and the settings that read it"] = ""


class KeywordRow(NamedTuple):
    """A keyword block."""

    number: Annotated[int, "place among the blocks of the deck, from 1"]
    section: Annotated[str, "section, without $"]
    keyword: Annotated[str, "keyword, without *"]
    line: Annotated[int | None, "line of the keyword"]
    is_read: Annotated[bool, "true if its lines are read; otherwise they are passed through unchanged"]
    partly: Annotated[bool, "true if a line or a part of it was not read"]
    superseded: Annotated[bool, "true if a newer keyword supersedes it"]
    extension: Annotated[bool, "true if it is an extension of mudline"]
    content: Annotated[int, "digest of its values; equal for equal blocks"]
    others: Annotated[int, "digest of all other blocks; equal where decks differ in this block only"]


class SetRow(NamedTuple):
    """An element set, without the predefined ALL."""

    name: Annotated[str, "name"]
    elements: Annotated[int, "number of its elements"]
    first: Annotated[int | None, "smallest element number"]
    last: Annotated[int | None, "largest element number"]
    complete: Annotated[bool, "true if the deck lists all its elements"]
    used: Annotated[bool, "true if anything in the deck names it"]
    line: Annotated[int | None, "line of its definition"]


class CurveRow(NamedTuple):
    """A curve: those of a seabed first, then all others."""

    curve: Annotated[int, "place among the curves of the deck, from 1"]
    name: Annotated[str, "name; of *EMBEDMENT that of its set"]
    kind: Annotated[str, "kind of curve, such as force-embedment curve"]
    keyword: Annotated[str, "keyword that gives it"]
    legacy: Annotated[bool, "true for a curve of *EMBEDMENT"]
    ratios: Annotated[
        list[float],
        "embedment ratios of its points, sorted: penetration / external diameter; for others the abscissa",
    ]
    forces: Annotated[list[float], "forces per unit length at these points; for others the ordinate"]
    first_ratio: Annotated[float | None, "smallest embedment ratio"]
    last_ratio: Annotated[float | None, "largest embedment ratio"]
    largest_force: Annotated[float | None, "largest force per unit length at a point"]
    steepest: Annotated[float | None, "largest d force / d ratio of a segment"]
    elements: Annotated[int, "elements that follow it"]
    shape: Annotated[int, "digest of its sorted points; equal for equal curves"]
    line: Annotated[int | None, "line of its name"]


class LawRow(NamedTuple):
    """A seabed stiffness or curve that the deck assigns to a set."""

    law: Annotated[int, "place among the laws of the deck, from 1"]
    keyword: Annotated[str, "keyword that gives it"]
    family: Annotated[str, "legacy or new"]
    kind: Annotated[str, "curve, linear, rigid or none"]
    set: Annotated[str, "set to which it is assigned"]
    curve: Annotated[int | None, "number of its curve"]
    stiffness: Annotated[float | None, "linear stiffness per unit length"]
    set_elements: Annotated[int, "elements of the set"]
    elements: Annotated[int, "elements that follow it"]
    line: Annotated[int | None, "line of the assignment"]


class ParameterRow(NamedTuple):
    """A parameter of *PARAMETERS."""

    name: Annotated[str, "name"]
    value: Annotated[float | None, "value, if it is a number"]
    text: Annotated[str | None, "value, if it is a text"]
    equation: Annotated[str | None, "equation, if one gives the value"]
    used: Annotated[bool | None, "true if an equation names it; none in a deck with variations"]
    line: Annotated[int | None, "line of its value"]


class FindingRow(NamedTuple):
    """A finding of mudline lint, under the configuration of the deck."""

    code: Annotated[str, "code of the rule"]
    slug: Annotated[str, "name of the rule"]
    severity: Annotated[str, "error, warning or info"]
    message: Annotated[str, "message"]
    line: Annotated[int | None, "line, from 1"]
    start_column: Annotated[int | None, "column, from 1"]
    end_line: Annotated[int | None, "line of the end"]
    end_column: Annotated[int | None, "column of the end, exclusive"]
    fix: Annotated[str | None, "safe or unsafe, if it can be fixed"]
    blocks: Annotated[bool, "true if it prevents evaluation of the deck"]


TABLES: dict[str, type[Any]] = {
    f"{row.__name__.removesuffix('Row').lower()}s": row
    for row in (DeckRow, KeywordRow, SetRow, CurveRow, LawRow, ParameterRow, FindingRow)
}
"""Class of the rows of each table, by the name of its file and view."""


def columns_of(table: str) -> Iterator[tuple[Any, ...]]:
    """Yield name, Python type and meaning of the columns of a table."""
    yield "file", str, "path of the deck from the folder that holds the archive"
    for name, hint in get_type_hints(TABLES[table], include_extras=True).items():
        yield name, *get_args(hint)
