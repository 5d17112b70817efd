"""Faults of keyword lines and of files: misspelt, missing, commented in another program's way, cut off."""

from __future__ import annotations

from tests.faults.draft import Draft, Row
from tests.faults.kind import Group

KEYWORDS = Group("keyword lines and files")
kind = KEYWORDS.kind

STRAY = ("SYN001", "SYN002", "SYN003", "SYN004", "SYN011", "SYN015", "REF007")
"""What a row says that came under a keyword that is not its own: it is not read, or reads as something else."""


def _misspelt(draft: Draft, keyword: str, typed: str) -> None:
    draft.write(draft.block(keyword)[0], typed)


@kind("SYN009")
def misspelt_element(draft: Draft) -> None:
    """`*ELEMNT`."""
    _misspelt(draft, "*ELEMENT", "*ELEMNT")


@kind("SYN009")
def plural_element(draft: Draft) -> None:
    """`*ELEMENTS`."""
    _misspelt(draft, "*ELEMENT", "*ELEMENTS")


@kind("SYN009")
def plural_node(draft: Draft) -> None:
    """`*NODES`."""
    _misspelt(draft, "*NODE", "*NODES")


@kind("SYN009")
def misspelt_element_sets(draft: Draft) -> None:
    """`*ELEMENT SEST`."""
    _misspelt(draft, "*ELEMENT SETS", "*ELEMENT SEST")


@kind("SYN009")
def joined_element_sets(draft: Draft) -> None:
    """`*ELEMENTSETS`, without its blank."""
    _misspelt(draft, "*ELEMENT SETS", "*ELEMENTSETS")


@kind("SYN009")
def misspelt_geometric_sets(draft: Draft) -> None:
    """`*GEOMETRIC SET`."""
    _misspelt(draft, "*GEOMETRIC SETS", "*GEOMETRIC SET")


@kind("SYN009")
def misspelt_ocean(draft: Draft) -> None:
    """`*OCAEN`."""
    _misspelt(draft, "*OCEAN", "*OCAEN")


@kind("SYN009")
def misspelt_seabed_properties(draft: Draft) -> None:
    """`*SEABED PROPERTY`."""
    _misspelt(draft, "*SEABED PROPERTIES", "*SEABED PROPERTY")


@kind("SYN009")
def seabed_in_two_words(draft: Draft) -> None:
    """`*SEA BED PROPERTIES`."""
    _misspelt(draft, "*SEABED PROPERTIES", "*SEA BED PROPERTIES")


@kind("SYN009")
def misspelt_seabed_stiffness(draft: Draft) -> None:
    """`*SEABED STIFNESS`."""
    _misspelt(draft, "*SEABED STIFFNESS", "*SEABED STIFNESS")


@kind("SYN009")
def misspelt_embedment(draft: Draft) -> None:
    """`*EMBEDEMENT`."""
    _misspelt(draft, "*EMBEDMENT", "*EMBEDEMENT")


@kind("SYN009")
def misspelt_elastic_surface(draft: Draft) -> None:
    """`*ELASTIC SURFACES`."""
    _misspelt(draft, "*ELASTIC SURFACE", "*ELASTIC SURFACES")


@kind("SYN009")
def misspelt_profile(draft: Draft) -> None:
    """`*SEABED PROFIL`."""
    _misspelt(draft, "*SEABED PROFILE", "*SEABED PROFIL")


@kind("SYN009")
def misspelt_boundary(draft: Draft) -> None:
    """`*BOUNDARIES`."""
    _misspelt(draft, "*BOUNDARY", "*BOUNDARIES")


@kind("SYN009")
def underscore_in_keyword(draft: Draft) -> None:
    """`*SEABED_PROPERTIES`."""
    _misspelt(draft, "*SEABED PROPERTIES", "*SEABED_PROPERTIES")


@kind("SYN010")
def dollar_for_star(draft: Draft) -> None:
    """`$NODE` for `*NODE`."""
    _misspelt(draft, "*NODE", "$NODE")


@kind("SYN010")
def misspelt_model(draft: Draft) -> None:
    """`$MODLE`."""
    _misspelt(draft, "$MODEL", "$MODLE")


@kind("SYN010")
def misspelt_load_case(draft: Draft) -> None:
    """`$LOADCASE`."""
    _misspelt(draft, "$LOAD CASE", "$LOADCASE")


@kind("SYN007", "SYN009")
def star_for_dollar(draft: Draft) -> None:
    """`*MODEL` for `$MODEL`."""
    _misspelt(draft, "$MODEL", "*MODEL")


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


def _missing(draft: Draft, keyword: str) -> None:
    block = draft.block(keyword)
    draft.needs(draft.rows.index(block[0]) > 1)
    draft.mark(block[1])
    draft.remove([block[0]])


@kind(*STRAY)
def node_line_missing(draft: Draft) -> None:
    """The `*NODE` line is missing. Seen at the first row behind it."""
    _missing(draft, "*NODE")


@kind(*STRAY)
def element_line_missing(draft: Draft) -> None:
    """The `*ELEMENT` line is missing. Seen at the first row behind it."""
    _missing(draft, "*ELEMENT")


@kind(*STRAY)
def element_sets_line_missing(draft: Draft) -> None:
    """The `*ELEMENT SETS` line is missing. Seen at the first row behind it."""
    _missing(draft, "*ELEMENT SETS")


@kind(*STRAY)
def geometric_sets_line_missing(draft: Draft) -> None:
    """The `*GEOMETRIC SETS` line is missing. Seen at the first row behind it."""
    _missing(draft, "*GEOMETRIC SETS")


@kind(*STRAY, "SBD006")
def seabed_properties_line_missing(draft: Draft) -> None:
    """The `*SEABED PROPERTIES` line is missing. Seen at the first row behind it."""
    _missing(draft, "*SEABED PROPERTIES")


@kind(*STRAY)
def seabed_stiffness_line_missing(draft: Draft) -> None:
    """The `*SEABED STIFFNESS` line is missing. Seen at the first row behind it."""
    _missing(draft, "*SEABED STIFFNESS")


@kind(*STRAY)
def embedment_line_missing(draft: Draft) -> None:
    """The `*EMBEDMENT` line is missing. Seen at the first row behind it."""
    _missing(draft, "*EMBEDMENT")


@kind(*STRAY)
def star_missing(draft: Draft) -> None:
    """`ELEMENT` without its star."""
    _misspelt(draft, "*ELEMENT", "ELEMENT")


@kind(*STRAY)
def star_missing_at_seabed(draft: Draft) -> None:
    """`SEABED STIFFNESS` without its star."""
    _misspelt(draft, "*SEABED STIFFNESS", "SEABED STIFFNESS")


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


@kind(*STRAY, "SYN013")
def hash_comment(draft: Draft) -> None:
    """A comment with #."""
    _comment(draft, "*NODE", "# nodes of the flowline")


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
