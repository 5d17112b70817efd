"""Faults of keyword lines and of files: misspelt, missing, commented in another program's way, cut off."""

from __future__ import annotations

from tests.faults.draft import Draft, Row
from tests.faults.kind import Damage, Group, comment, head

KEYWORDS = Group("keyword lines and files")
kind = KEYWORDS.kind

STRAY = ("SYN001", "SYN002", "SYN003", "SYN004", "SYN011", "SYN015", "REF007")
"""What a row says that came under a keyword that is not its own: it is not read, or reads as something else."""


for _slug, _codes, _keyword, _typed, _how in (
    ("misspelt-element", "SYN009", "*ELEMENT", "*ELEMNT", ""),
    ("plural-element", "SYN009", "*ELEMENT", "*ELEMENTS", ""),
    ("plural-node", "SYN009", "*NODE", "*NODES", ""),
    ("misspelt-element-sets", "SYN009", "*ELEMENT SETS", "*ELEMENT SEST", ""),
    ("joined-element-sets", "SYN009", "*ELEMENT SETS", "*ELEMENTSETS", ", without its blank"),
    ("misspelt-geometric-sets", "SYN009", "*GEOMETRIC SETS", "*GEOMETRIC SET", ""),
    ("misspelt-ocean", "SYN009", "*OCEAN", "*OCAEN", ""),
    ("misspelt-seabed-properties", "SYN009", "*SEABED PROPERTIES", "*SEABED PROPERTY", ""),
    ("seabed-in-two-words", "SYN009", "*SEABED PROPERTIES", "*SEA BED PROPERTIES", ""),
    ("misspelt-seabed-stiffness", "SYN009", "*SEABED STIFFNESS", "*SEABED STIFNESS", ""),
    ("misspelt-embedment", "SYN009", "*EMBEDMENT", "*EMBEDEMENT", ""),
    ("misspelt-elastic-surface", "SYN009", "*ELASTIC SURFACE", "*ELASTIC SURFACES", ""),
    ("misspelt-profile", "SYN009", "*SEABED PROFILE", "*SEABED PROFIL", ""),
    ("misspelt-boundary", "SYN009", "*BOUNDARY", "*BOUNDARIES", ""),
    ("underscore-in-keyword", "SYN009", "*SEABED PROPERTIES", "*SEABED_PROPERTIES", ""),
    ("dollar-for-star", "SYN010", "*NODE", "$NODE", " for `*NODE`"),
    ("misspelt-model", "SYN010", "$MODEL", "$MODLE", ""),
    ("misspelt-load-case", "SYN010", "$LOAD CASE", "$LOADCASE", ""),
    ("star-for-dollar", "SYN007 SYN009", "$MODEL", "*MODEL", " for `$MODEL`"),
):
    KEYWORDS.row(_slug, _codes, f"`{_typed}`{_how}.", head(_keyword, _typed))


@kind("SYN007")
def model_line_missing(draft: Draft) -> None:
    """No `$MODEL` line. Seen at the first keyword."""
    head = draft.block("$MODEL")[0]
    draft.needs(draft.rows[0] is head)
    draft.remove([head])
    draft.mark(draft.rows[0])


@kind("SYN008", "SYN009")
def load_case_line_missing(draft: Draft) -> None:
    """No `$LOAD CASE` line. Seen at the first keyword that belongs there."""
    head = draft.block("$LOAD CASE")[0]
    draft.needs(draft.rows.index(head) > 0)
    draft.mark(draft.rows[draft.rows.index(head) + 1])
    draft.remove([head])


def _missing(keyword: str) -> Damage:
    def remove(draft: Draft) -> None:
        block = draft.block(keyword)
        draft.needs(draft.rows.index(block[0]) > 1)
        draft.mark(block[1])
        draft.remove([block[0]])

    return remove


for _keyword in (
    *("*NODE", "*ELEMENT", "*ELEMENT SETS", "*GEOMETRIC SETS"),
    *("*SEABED PROPERTIES", "*SEABED STIFFNESS", "*EMBEDMENT"),
):
    KEYWORDS.row(
        f"{_keyword[1:].lower().replace(' ', '-')}-line-missing",
        (*STRAY, "SBD006") if _keyword == "*SEABED PROPERTIES" else STRAY,
        f"The `{_keyword}` line is missing. Seen at the first row behind it.",
        _missing(_keyword),
    )
KEYWORDS.row("star-missing", STRAY, "`ELEMENT` without its star.", head("*ELEMENT", "ELEMENT"))


KEYWORDS.row(
    "star-missing-at-seabed",
    STRAY,
    "`SEABED STIFFNESS` without its star.",
    head("*SEABED STIFFNESS", "SEABED STIFFNESS"),
)


@kind(*STRAY, "SBD003")
def points_before_set(draft: Draft) -> None:
    """The points of `*EMBEDMENT` come before their SET=."""
    rows = draft.data("*EMBEDMENT")
    draft.needs(len([row for row in rows if "SET=" in row.text]) == 2)
    draft.mark(rows[1])
    draft.rows.remove(rows[0])


@kind(*STRAY)
def points_before_curve(draft: Draft) -> None:
    """The points of `*SEABED STIFFNESS` come before their CURVE=."""
    rows = draft.data("*SEABED STIFFNESS")
    draft.mark(rows[1])
    at = draft.rows.index(rows[0])
    draft.rows.remove(rows[0])
    draft.rows.insert(at + 2, rows[0])


# ------------------------------------------------------------------------------------------------------------ comments


def _comment(draft: Draft, keyword: str, text: str) -> None:
    draft.insert(draft.block(keyword)[0], text)


KEYWORDS.row("hash-comment", (*STRAY, "SYN013"), "A comment with #.", comment("*NODE", "# nodes of the flowline"))


@kind(*STRAY, "SYN013")
def exclamation_comment(draft: Draft) -> None:
    """A comment with !."""
    _comment(draft, "*GEOMETRIC SETS", "! 10.75 in x 0.719 in, X65")


@kind(*STRAY, "SYN013")
def slashes_comment(draft: Draft) -> None:
    """A comment with //."""
    _comment(draft, "*SEABED PROPERTIES", "// soft clay, see the survey")


@kind(*STRAY, "SYN013")
def hash_in_curve(draft: Draft) -> None:
    """A comment with # among the points of a curve."""
    draft.insert(draft.curve()[1], " # from the boreholes")


@kind("SYN009", "SYN011", "SYN001")
def stars_comment(draft: Draft) -> None:
    """A comment with **, as in Abaqus, which cuts a block in two."""
    draft.insert(draft.numbers("*NODE")[1], "** upper part")


@kind("STY002")
def lower_case_comment(draft: Draft) -> None:
    """A comment with a lower-case c."""
    _comment(draft, "*OCEAN", "c depth, density, gravity")


@kind("STY009", *STRAY)
def indented_comment(draft: Draft) -> None:
    """A comment that begins in column 2."""
    _comment(draft, "*NODE", " C nodes of the flowline")


@kind("SYN013", *STRAY)
def comment_without_blank(draft: Draft) -> None:
    """A row switched off by a C before its first letter, without a blank."""
    row = draft.setting("*SEABED PROPERTIES", "FRICTION")
    draft.write(row, f"C{row.text.strip()}")
    row.text = row.text.strip()


@kind(*STRAY)
def table_of_the_interface(draft: Draft) -> None:
    """The table of the graphical interface typed into `*EMBEDMENT`: set, ratio, force. Seen at any of its rows."""
    rows = draft.data("*EMBEDMENT")
    name = rows[0].text.partition("=")[2]
    draft.needs(len([row for row in rows if "SET=" in row.text]) == 1 or "SET=" in rows[8].text)
    for row in rows[1:8]:
        draft.write(row, f"{name}, {row.text.strip()}")
    draft.remove(rows[:1])


@kind(*STRAY)
def header_line_pasted(draft: Draft) -> None:
    """The heads of the columns pasted with the points of a curve."""
    first = draft.curve()[0]
    draft.insert(draft.previous(first), " z/D, F (N/m)")


@kind(*STRAY)
def header_line_of_nodes(draft: Draft) -> None:
    """The heads of the columns pasted with the nodes."""
    draft.insert(draft.block("*NODE")[0], " Node, X, Y, Z")


@kind(*STRAY)
def row_numbers_pasted(draft: Draft) -> None:
    """A curve pasted with the row numbers of the spreadsheet. Seen at any of its points."""
    for i, row in enumerate(draft.curve(), 1):
        draft.write(row, f"{i}, {row.text.strip()}")


# ------------------------------------------------------------------------------------------------------ truncated files


def _cut(draft: Draft, last: Row, text: str) -> None:
    """End the file inside a line."""
    at = draft.rows.index(last)
    del draft.rows[at + 1 :]
    draft.write(last, text)


@kind("SYN014")
def cut_behind_comma(draft: Draft) -> None:
    """The file ends behind a comma of the last point."""
    row = draft.curve()[-1]
    draft.needs("$LOAD" in draft.text)
    _cut(draft, row, f"{draft.field(row, 0)},")


@kind("SYN014")
def cut_in_exponent(draft: Draft) -> None:
    """The file ends inside an exponent."""
    _cut(draft, draft.sections("RIGID")[0], "2.07E")


@kind("SYN014", "CRV001")
def cut_behind_curve_line(draft: Draft) -> None:
    """The file ends behind CURVE=."""
    row = draft.keyed_above(draft.curve()[0])
    del draft.rows[draft.rows.index(row) + 1 :]
    draft.mark(row)


@kind("SYN014", "SYN006")
def cut_in_equation(draft: Draft) -> None:
    """The file ends inside an equation."""
    row = next((each for each in draft.data("*SEABED STIFFNESS") if "=[" in each.text), None)
    draft.needs(row)
    if row:
        _cut(draft, row, row.text.partition("*")[0].strip())


@kind("SYN014")
def cut_behind_keyword(draft: Draft) -> None:
    """The file ends behind `*SEABED STIFFNESS`."""
    row = draft.block("*SEABED STIFFNESS")[0]
    del draft.rows[draft.rows.index(row) + 1 :]
    draft.mark(row)


@kind("SYN012", "SYN001", "SYN002")
def nul_bytes(draft: Draft) -> None:
    """NUL bytes in a row, left by a damaged disk."""
    row = draft.numbers("*NODE")[-1]
    draft.write(row, row.text.strip()[:-1] + "\0")
