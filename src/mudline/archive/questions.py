"""The ready questions to an archive: SQL with parameters, and what each answers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from textwrap import dedent
from types import MappingProxyType

from mudline.scene.deck_values import FOOT, POUND

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
