"""The tables of an archive: their columns, what these mean, and their types in Parquet."""

from __future__ import annotations

from typing import Literal, NamedTuple

Kind = Literal["text", "whole", "number", "flag", "time"]
"""What a column holds: text, whole numbers, numbers in the deck's own units, true or false, times in UTC."""


class Column(NamedTuple):
    """A column: its name, what it holds, and what that means."""

    name: str
    kind: Kind
    meaning: str


class Table(NamedTuple):
    """A table: its name, what a row is, and its columns behind `deck`, which joins the tables."""

    name: str
    row: str
    columns: tuple[Column, ...]


DECK = Column("deck", "whole", "number of the content that the row belongs to; joins the tables")
FILE = Column("file", "text", "path of the deck from the folder that holds the archive")

TABLES = (
    Table(
        "decks",
        "a deck",
        (
            Column("units", "text", "unit system of all its numbers: metric, imperial or user"),
            Column("verdict", "text", "legal, illegal, or empty for a file without any section"),
            Column("errors", "whole", "findings of severity error"),
            Column("warnings", "whole", "findings of severity warning"),
            Column("infos", "whole", "findings of severity info"),
            Column("sections", "whole", "sections"),
            Column("keywords", "whole", "keyword blocks"),
            Column("nodes", "whole", "nodes"),
            Column("elements", "whole", "elements"),
            Column("sets", "whole", "element sets, without ALL"),
            Column("curves", "whole", "force-embedment curves"),
            Column("length", "number", "total length of the elements"),
            Column("depth", "number", "water depth of the last *OCEAN"),
            Column("content", "whole", "digest of its values; equal where only layout and comments differ"),
        ),
    ),
    Table(
        "keywords",
        "a keyword block",
        (
            Column("number", "whole", "place among the blocks of the deck, from 1"),
            Column("section", "text", "section, without $"),
            Column("keyword", "text", "keyword, without *"),
            Column("line", "whole", "line of the keyword"),
            Column("is_read", "flag", "whether its lines are read; those of others are passed through"),
            Column("superseded", "flag", "whether a newer keyword supersedes it"),
            Column("extension", "flag", "whether it is an extension of mudline"),
            Column("content", "whole", "digest of its values; equal for equal blocks"),
            Column("others", "whole", "digest of all other blocks; equal where decks differ in this block only"),
        ),
    ),
    Table(
        "sets",
        "an element set, without the predefined ALL",
        (
            Column("name", "text", "name"),
            Column("elements", "whole", "number of its elements"),
            Column("first", "whole", "smallest element number"),
            Column("last", "whole", "largest element number"),
            Column("complete", "flag", "whether the deck shows all its elements"),
            Column("used", "flag", "whether anything in the deck names it"),
            Column("line", "whole", "line of its definition"),
        ),
    ),
    Table(
        "elements",
        "an element",
        (
            Column("element", "whole", "element number"),
            Column("node1", "whole", "number of its first node"),
            Column("node2", "whole", "number of its second node"),
            Column("x", "number", "middle of its nodes, upwards"),
            Column("y", "number", "middle of its nodes"),
            Column("z", "number", "middle of its nodes"),
            Column("length", "number", "length between its nodes"),
            Column("diameter", "number", "external diameter"),
            Column("submerged_weight", "number", "weight less buoyancy per unit length"),
            Column("law", "text", "normal law: curve, linear, nodal, rigid or none"),
            Column("set", "text", "set through which it has that law"),
            Column("curve", "whole", "number of its curve"),
            Column("stiffness", "number", "linear stiffness per unit length"),
            Column("axial_friction", "number", "longitudinal friction coefficient"),
            Column("lateral_friction", "number", "transverse friction coefficient"),
        ),
    ),
    Table(
        "curves",
        "a force-embedment curve",
        (
            Column("curve", "whole", "place among the curves of the deck, from 1"),
            Column("name", "text", "name; of *EMBEDMENT that of its set"),
            Column("legacy", "flag", "whether it is one of *EMBEDMENT"),
            Column("points", "whole", "number of its points"),
            Column("first_ratio", "number", "smallest embedment ratio"),
            Column("last_ratio", "number", "largest embedment ratio"),
            Column("largest_force", "number", "largest force per unit length at a point"),
            Column("steepest", "number", "largest d force / d ratio of a segment"),
            Column("elements", "whole", "elements that follow it"),
            Column("shape", "whole", "digest of its sorted points; equal for equal curves"),
            Column("line", "whole", "line of its name"),
        ),
    ),
    Table(
        "points",
        "a point of a curve, sorted by ratio",
        (
            Column("curve", "whole", "number of its curve"),
            Column("point", "whole", "place among the points, from 1"),
            Column("ratio", "number", "embedment ratio: penetration / external diameter"),
            Column("force", "number", "force per unit length"),
            Column("slope", "number", "d force / d ratio behind it; none where the points make no curve"),
        ),
    ),
    Table(
        "laws",
        "a seabed stiffness or curve that a place of the deck gives to a set",
        (
            Column("law", "whole", "place among the laws of the deck, from 1"),
            Column("keyword", "text", "keyword that gives it"),
            Column("family", "text", "legacy or new"),
            Column("kind", "text", "curve, linear, rigid or none"),
            Column("set", "text", "set that it is given to"),
            Column("curve", "whole", "number of its curve"),
            Column("stiffness", "number", "linear stiffness per unit length"),
            Column("set_elements", "whole", "elements of the set"),
            Column("elements", "whole", "elements that follow it"),
            Column("line", "whole", "line in which it stands"),
        ),
    ),
    Table(
        "parameters",
        "a parameter of *PARAMETERS",
        (
            Column("name", "text", "name"),
            Column("value", "number", "value, if it is a number"),
            Column("text", "text", "value, if it is a text"),
            Column("equation", "text", "equation, if one gives the value"),
            Column("used", "flag", "whether an equation names it; none in a deck with variations"),
            Column("line", "whole", "line of its value"),
        ),
    ),
    Table(
        "findings",
        "a finding of mudline lint, under the configuration of the deck",
        (
            Column("code", "text", "code of the rule"),
            Column("slug", "text", "name of the rule"),
            Column("severity", "text", "error, warning or info"),
            Column("message", "text", "message"),
            Column("line", "whole", "line, from 1"),
            Column("start_column", "whole", "column, from 1"),
            Column("end_line", "whole", "line of the end"),
            Column("end_column", "whole", "column of the end, exclusive"),
            Column("fix", "text", "safe or unsafe, if it can be fixed"),
            Column("blocks", "flag", "whether it keeps the deck from being evaluated"),
        ),
    ),
    Table(
        "results",
        "the contact of a deck at its own coordinates, as mudline evaluate gives it",
        (
            Column("verdict", "text", "evaluated or failed"),
            Column("reason", "text", "why it failed"),
            Column("elements", "whole", "elements evaluated"),
            Column("in_contact", "whole", "elements in contact"),
            Column("touchdown_from", "number", "smallest arc length in contact"),
            Column("touchdown_to", "number", "largest arc length in contact"),
            Column("contact_length", "number", "length in contact"),
            Column("largest_force", "number", "largest normal force per unit length"),
            Column("largest_force_element", "whole", "element that has it"),
            Column("largest_uplift", "number", "largest pull per unit length, negative"),
            Column("largest_uplift_element", "whole", "element that has it"),
            Column("reaction", "number", "total reaction"),
            Column("ratio", "number", "total reaction / submerged weight"),
        ),
    ),
)

FILES = Table(
    "files",
    "a deck's file as it was when it was read; the newest row of a file holds",
    (
        FILE,
        Column("bytes", "whole", "size; none for a file that is gone"),
        Column("modified", "whole", "its last change in ns since 1970; -1 where that is too new to trust"),
        Column("content", "text", "digest of its bytes"),
        Column("key", "text", "digest of its bytes, form, units and the settings of the run"),
        Column("depends", "text", "JSON: files that the rows depend on, from the deck's folder, with digests"),
        Column("written", "whole", "time of the row in nanoseconds since 1970"),
    ),
)

STORED = (FILES, *TABLES)
"""The tables of Parquet files; each also has `deck`, which is none in `files` for a file that is gone."""

FILE_COLUMNS = (
    FILE,
    Column("bytes", "whole", "size of the file"),
    Column("modified", "time", "time of its last change; none where it was too new to trust"),
    Column("digest", "text", "digest of its bytes"),
)
"""What the view of decks has of the file of each."""
