"""The tables of an archive: their columns, what these mean, and what they hold."""

from __future__ import annotations

from typing import Literal, NamedTuple

Kind = Literal["text", "whole", "number", "numbers", "flag"]
"""What a column holds: text, whole numbers, one or a list of numbers in the deck's own units, true or false."""


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


DECK = Column("deck", "whole", "number of the content that the row belongs to")
FILE = Column("file", "text", "path of the deck from the folder that holds the archive")

TABLES = (
    Table(
        "decks",
        "a deck",
        (
            Column("units", "text", "unit system of all its numbers: metric, imperial or user"),
            Column("verdict", "text", "legal, legal as far as read, illegal, or empty for a file without any section"),
            Column("errors", "whole", "findings of severity error"),
            Column("warnings", "whole", "findings of severity warning"),
            Column("infos", "whole", "findings of severity info"),
            Column("sections", "whole", "sections"),
            Column("keywords", "whole", "keyword blocks"),
            Column("read", "whole", "keyword blocks of which all was read"),
            Column("partly", "whole", "keyword blocks of which a line or part was passed over"),
            Column("unread", "whole", "keyword blocks whose lines were passed over"),
            Column("nodes", "whole", "nodes"),
            Column("elements", "whole", "elements"),
            Column("sets", "whole", "element sets, without ALL"),
            Column("curves", "whole", "curves of the seabed"),
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
            Column("partly", "flag", "whether a line or part of it was passed over"),
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
        "curves",
        "a curve: those of a seabed first, then all others",
        (
            Column("curve", "whole", "place among the curves of the deck, from 1"),
            Column("name", "text", "name; of *EMBEDMENT that of its set"),
            Column("kind", "text", "what kind of curve it is, such as force-embedment curve"),
            Column("keyword", "text", "keyword that gives it"),
            Column("legacy", "flag", "whether it is one of *EMBEDMENT"),
            Column(
                "ratios",
                "numbers",
                "embedment ratios of its points, sorted: penetration / external diameter; of others the abscissa",
            ),
            Column("forces", "numbers", "forces per unit length at these points; of others the ordinate"),
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
)

FILES = Table(
    "files",
    "the file of a deck as it was when it was read",
    (
        FILE,
        Column("bytes", "whole", "size"),
        Column("modified", "whole", "its last change in ns since 1970; -1 where that was too new to trust"),
        Column("digest", "text", "digest of its bytes"),
        Column("key", "text", "digest of its bytes, form, and the settings and program of the run"),
        Column("depends", "text", "JSON: files that its rows depend on, from the deck's folder, with digests"),
    ),
)

STORED = (FILES, *TABLES)
"""The tables of Parquet files; each also has `deck`, in front of the other columns."""
