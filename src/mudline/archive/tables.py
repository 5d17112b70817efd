"""The tables of an archive: columns, what these mean, types in Parquet; and the ready questions about them, in SQL."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from textwrap import dedent
from types import MappingProxyType
from typing import Literal, NamedTuple

from mudline.scene.deck_values import FOOT, POUND

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


# ------------------------------------------------------------------------------------------------------ ready questions

_PER_LENGTH = POUND / FOOT
"""N/m of an imperial force per unit length."""
_LIMIT: Mapping[str, object] = MappingProxyType({"limit": 20})


@dataclass(frozen=True, slots=True)
class Question:
    """A question by its name: what it answers, its SQL, and the values that its parameters have unless given."""

    name: str
    answers: str
    sql: str
    parameters: Mapping[str, object] = field(default_factory=lambda: _LIMIT)


_ALL = (
    Question(
        "stiffest-curves",
        "The curves with the steepest segments, compared in N/m; values in the deck's units.",
        """
        SELECT c.file, c.name, c.steepest, c.largest_force, c.last_ratio, c.elements, d.units, c.line
        FROM curves AS c JOIN decks AS d USING (file)
        WHERE c.steepest IS NOT NULL
        ORDER BY c.steepest * CASE d.units WHEN 'imperial' THEN CAST($imperial AS DOUBLE) ELSE 1 END DESC,
            c.file, c.curve
        LIMIT $limit
        """,
        MappingProxyType({"limit": 20, "imperial": _PER_LENGTH}),
    ),
    Question(
        "same-curve",
        "Curves with the same points in the same units, in several places, whatever their names are.",
        """
        SELECT count(*) AS curves, count(DISTINCT c.file) AS decks, any_value(c.points) AS points, d.units,
            string_agg(DISTINCT c.name, ', ' ORDER BY c.name) AS names, min(c.file) AS first_file
        FROM curves AS c JOIN decks AS d USING (file)
        WHERE c.points > 0
        GROUP BY c.shape, d.units
        HAVING count(*) > 1
        ORDER BY curves DESC, first_file, names
        LIMIT $limit
        """,
    ),
    Question(
        "unused",
        "Curves that no element follows, sets that nothing names, parameters that no equation uses.",
        """
        SELECT file, thing, name, line FROM (
            SELECT file, 'curve' AS thing, name, line FROM curves WHERE elements = 0
            UNION ALL SELECT file, 'set', name, line FROM sets WHERE NOT used
            UNION ALL SELECT file, 'parameter', name, line FROM parameters WHERE NOT used
        )
        ORDER BY file, line, thing, name
        LIMIT $limit
        """,
    ),
    Question(
        "legacy",
        "Decks with superseded keywords: which, how many, and the line of the first.",
        """
        SELECT file, count(*) AS blocks, string_agg(DISTINCT keyword, ', ' ORDER BY keyword) AS keywords,
            min(line) AS first_line
        FROM keywords
        WHERE superseded
        GROUP BY file
        ORDER BY blocks DESC, file
        LIMIT $limit
        """,
    ),
    Question(
        "no-friction",
        "Decks with elements on the seabed that have no friction in any direction, or with *NO FRICTION.",
        """
        SELECT e.file, count(*) AS elements,
            CASE WHEN any_value(n.file) IS NULL THEN 0 ELSE 1 END AS no_friction_keyword,
            count(*) FILTER (coalesce(e.axial_friction, 0) = 0 AND coalesce(e.lateral_friction, 0) = 0)
                AS without_friction
        FROM elements AS e LEFT JOIN
            (SELECT DISTINCT file FROM keywords WHERE keyword = 'NO FRICTION') AS n USING (file)
        WHERE e.law <> 'none'
        GROUP BY e.file
        HAVING without_friction > 0 OR no_friction_keyword > 0
        ORDER BY without_friction DESC, e.file
        LIMIT $limit
        """,
    ),
    Question(
        "findings-by-rule",
        "How often each rule finds something, and in how many decks.",
        """
        SELECT code, slug, severity, count(*) AS findings, count(DISTINCT file) AS decks, min(file) AS first_file
        FROM findings
        GROUP BY code, slug, severity
        ORDER BY findings DESC, code, severity
        LIMIT $limit
        """,
    ),
    Question(
        "near-duplicates",
        "Decks that are the same but for one block, or but for layout and comments.",
        """
        SELECT decks, differ_in, first_file, second_file FROM (
            SELECT count(DISTINCT file) AS decks, '*' || keyword AS differ_in, min(file) AS first_file,
                min_by(file, file, 2)[2] AS second_file
            FROM keywords
            GROUP BY others, section, keyword
            HAVING count(DISTINCT content) > 1
            UNION ALL
            SELECT count(*), 'layout and comments', min(file), min_by(file, file, 2)[2]
            FROM decks
            WHERE keywords > 0
            GROUP BY content
            HAVING count(*) > 1
        )
        ORDER BY decks DESC, differ_in, first_file
        LIMIT $limit
        """,
    ),
)

QUESTIONS = {one.name: Question(one.name, one.answers, dedent(one.sql).strip(), one.parameters) for one in _ALL}
"""The questions by name."""
