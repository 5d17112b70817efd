"""Faults of copying, renaming, renumbering and deleting: what was changed in one place and not in the other."""

from __future__ import annotations

from tests.faults.draft import Draft, Row, plain
from tests.faults.kind import Group

COPIES = Group("copies and names")
kind = COPIES.kind

NUMBERS = Group("numbering")
numbering = NUMBERS.kind


def _typo(row: Row, draft: Draft) -> None:
    """Exchange the last two letters of the name of a setting."""
    text = row.text.rstrip()
    draft.needs(len(text) > 2 and text[-1] != text[-2] and text[-2:].isalpha())
    draft.needs("," not in text and not text.endswith("=ALL"))
    row.text = text[:-2] + text[-1] + text[-2]
    draft.mark(row)


@kind("REF004")
def curve_copied(draft: Draft) -> None:
    """A curve copied to be adapted, its name left as it was. Seen at the later CURVE= (SET=)."""
    points = draft.curve()
    head = draft.keyed_above(points[0])
    copy = draft.insert(points[-1], head.text, *(row.text for row in points), mark=False)
    draft.mark(copy[0])


@kind("REF003")
def curve_added_and_not_used(draft: Draft) -> None:
    """A curve added under a new name, and no STIFFNESS= changed."""
    points = draft.curve()
    draft.needs("*SEABED STIFFNESS" in draft.text)
    copy = draft.insert(points[-1], " CURVE=Sand Rev B", *(row.text for row in points), mark=False)
    draft.mark(copy[0])


@kind("REF002")
def curve_name_misspelt(draft: Draft) -> None:
    """The name of a curve misspelt in STIFFNESS=."""
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    draft.needs(not row.text.partition("=")[2][:1].isdigit())
    _typo(row, draft)


@kind("REF002")
def curve_renamed(draft: Draft) -> None:
    """A curve renamed where it is defined. Seen where it is used."""
    used = {row.text.partition("=")[2]: row for row in draft.settings("*SEABED PROPERTIES", "STIFFNESS")}
    row = next((each for each in draft.settings("*SEABED STIFFNESS", "CURVE") if each.text[7:] in used), None)
    draft.needs(row)
    if row:
        draft.mark(used[row.text[7:]])
        row.text = " CURVE=Soft Soil"


@kind("REF002")
def curves_deleted(draft: Draft) -> None:
    """The block `*SEABED STIFFNESS` deleted. Seen where a curve is used."""
    block = draft.block("*SEABED STIFFNESS")
    names = {row.text.partition("=")[2] for row in block if "CURVE=" in row.text}
    used = [row for row in draft.settings("*SEABED PROPERTIES", "STIFFNESS") if row.text.partition("=")[2] in names]
    draft.mark(*used)
    draft.remove(block)


@kind("REF001")
def set_misspelt_in_seabed(draft: Draft) -> None:
    """SET= misspelt in `*SEABED PROPERTIES`."""
    draft.needs("*LINES" not in draft.text)
    _typo(draft.settings("*SEABED PROPERTIES", "SET")[-1], draft)


@kind("REF001")
def set_misspelt_in_embedment(draft: Draft) -> None:
    """SET= misspelt in `*EMBEDMENT`."""
    _typo(draft.setting("*EMBEDMENT", "SET"), draft)


@kind("REF001")
def set_misspelt_in_sections(draft: Draft) -> None:
    """SET= misspelt in `*GEOMETRIC SETS`."""
    _typo(draft.settings("*GEOMETRIC SETS", "SET")[-1], draft)


@kind("REF001")
def set_misspelt_beside_lines(draft: Draft) -> None:
    """SET= misspelt in a deck whose sets come from `*LINES`."""
    draft.needs("*LINES" in draft.text)
    _typo(draft.settings("*GEOMETRIC SETS", "SET")[-1], draft)


@kind("REF001")
def set_misspelt_in_extension(draft: Draft) -> None:
    """SET= misspelt in an extension keyword."""
    keyword = next((each for each in ("*SEABED TRENCH", "*SEABED SUCTION") if each in draft.text), "*SEABED TRENCH")
    _typo(draft.setting(keyword, "SET"), draft)


@kind("REF001")
def set_renamed(draft: Draft) -> None:
    """A set renamed where it is defined. Seen where it is used."""
    row = draft.setting("*ELEMENT SETS", "SET")
    name = row.text.strip()
    uses = [each for each in draft.rows if each is not row and each.text.strip() == name]
    draft.needs(uses)
    row.text = " SET=Line KP 0 to 12"
    draft.mark(*uses)


@kind("REF001")
def sets_deleted(draft: Draft) -> None:
    """The block `*ELEMENT SETS` deleted. Seen where a set is used."""
    block = draft.block("*ELEMENT SETS")
    names = {row.text.strip() for row in block if "SET=" in row.text}
    draft.remove(block)
    uses = [row for row in draft.rows if row.text.strip() in names]
    draft.needs(uses)
    draft.mark(*uses)


@kind("REF016")
def set_copied(draft: Draft) -> None:
    """A set copied to be adapted, its name left as it was. Seen at the later SET=."""
    rows = draft.data("*ELEMENT SETS")
    copy = draft.insert(rows[-1], rows[0].text, " GEN=2, 4", mark=False)
    draft.mark(copy[0])


@kind("REF009")
def set_called_all(draft: Draft) -> None:
    """A set of the user's own called ALL."""
    draft.insert(draft.data("*ELEMENT SETS")[-1], " SET=ALL", mark=True)
    draft.insert(draft.data("*ELEMENT SETS")[-1], " GEN=1, 4", mark=False)


@kind("REF008")
def subset_misspelt(draft: Draft) -> None:
    """SUBSET= of a set that is spelt otherwise."""
    rows = draft.data("*ELEMENT SETS")
    name = rows[0].text.partition("=")[2]
    draft.insert(rows[-1], " SET=Whole Line", mark=False)
    _subset(draft, name[:-1] + "s")


@kind("REF008")
def subset_of_itself(draft: Draft) -> None:
    """SUBSET= of the set itself."""
    draft.insert(draft.data("*ELEMENT SETS")[-1], " SET=Whole Line", mark=False)
    _subset(draft, "Whole Line")


def _subset(draft: Draft, name: str) -> None:
    head = draft.data("*ELEMENT SETS")[-1]
    draft.mark(head)
    draft.insert(head, f" SUBSET={name}")


@kind("REF010")
def set_without_elements(draft: Draft) -> None:
    """A set whose elements were never filled in. Seen at its SET=."""
    draft.insert(draft.data("*ELEMENT SETS")[-1], " SET=Hot Spot")


@kind("REF012")
def long_list(draft: Draft) -> None:
    """24 elements on one line of a set, which takes 20."""
    rows = draft.data("*ELEMENT SETS")
    draft.needs(len(draft.numbers("*ELEMENT")) >= 24)
    labels = [draft.field(row, 0) for row in draft.numbers("*ELEMENT")][:24]
    draft.insert(rows[-1], " SET=Hot Spot", mark=False)
    draft.insert(draft.data("*ELEMENT SETS")[-1], f" {', '.join(labels)}")


@kind("GEO006")
def section_copied_and_not_renamed(draft: Draft) -> None:
    """Two sections for one set, the second set has none. Seen at either of the two."""
    rows = draft.settings("*GEOMETRIC SETS", "SET")
    draft.needs(len(rows) == 2 and "ALL" not in draft.text.partition("*GEOMETRIC")[2].partition("*HYDRO")[0])
    draft.write(rows[1], rows[0].text.strip())
    draft.mark(rows[0])


@kind("SBD009", "REF001", "GEO006", "SBD006")
def section_deleted(draft: Draft) -> None:
    """The section of one set deleted. Seen where the set is defined, or where its law or its curve is given."""
    rows = draft.data("*GEOMETRIC SETS")
    sets = [row for row in rows if "SET=" in row.text]
    draft.needs(len(sets) >= 2 and "SET=ALL" not in sets[0].text and draft.text.count("OPTION=") == 1)
    name = sets[0].text.strip()
    at = rows.index(sets[0])
    draft.remove(rows[at : at + 2])
    draft.mark(*(row for row in draft.rows if row.text.strip() == name))
    draft.mark(draft.block("*GEOMETRIC SETS")[0], *_laws(draft, name))


def _laws(draft: Draft, name: str) -> list[Row]:
    found = [i for i, row in enumerate(draft.rows) if row.text.strip() in {name, "SET=ALL"}]
    return [draft.rows[i + 1] for i in found if "STIFFNESS=" in draft.rows[i + 1].text]


@kind("SBD009")
def sections_deleted(draft: Draft) -> None:
    """The block `*GEOMETRIC SETS` deleted from a deck with curves. Seen where a curve is given or its set."""
    draft.needs(draft.curve())
    draft.remove(draft.block("*GEOMETRIC SETS"))
    keyword = "*SEABED PROPERTIES" if "*SEABED PROPERTIES" in draft.text else "*EMBEDMENT"
    draft.mark(*(row for row in draft.data(keyword) if "SET=" in row.text or "STIFFNESS=" in row.text))


@kind("SBD025", "SBD008")
def law_copied(draft: Draft) -> None:
    """The law of a set copied with a new stiffness, the old one left. Seen at either of the two blocks."""
    rows = draft.data("*SEABED PROPERTIES")
    sets = [row for row in rows if "SET=" in row.text]
    draft.needs(len(sets) == 2 and "ALL" not in draft.text.partition("*SEABED P")[2][:60])
    copy = draft.insert(rows[-1], sets[0].text, " STIFFNESS=98000.0", mark=False)
    draft.mark(copy[0], copy[1], sets[0], rows[rows.index(sets[0]) + 1])


@kind("REF015")
def file_not_there(draft: Draft) -> None:
    """The file of the profile was not copied with the deck."""
    row = draft.setting("*SEABED PROFILE", "FILE")
    draft.write(row, row.text.strip().replace("=", "=2024/"))


@kind("REF015")
def restart_not_there(draft: Draft) -> None:
    """The deck that `*RESTART` continues has another name."""
    draft.swap(draft.setting("*RESTART", "LAST"), "LAST=static", "LAST=static-rev2")


@kind("REF007")
def block_of_nodes_pasted_twice(draft: Draft) -> None:
    """The block of nodes pasted twice. Seen at the first node that is there already."""
    block = draft.block("*NODE")
    copy = draft.insert(block[-1], *(row.text for row in block), mark=False)
    draft.mark(copy[0], copy[1])


@kind("REF007")
def whole_model_pasted_twice(draft: Draft) -> None:
    """The whole deck pasted below itself. Seen at the first node that is there already."""
    draft.needs("*LINES" not in draft.text and draft.rows[0].text == "$MODEL")
    copy = draft.insert(draft.rows[-1], *(row.text for row in draft.rows), mark=False)
    nodes = next(i for i, row in enumerate(copy) if row.text == "*NODE")
    draft.mark(copy[nodes], copy[nodes + 1])


# ---------------------------------------------------------------------------------------------------------- numbering


def _listed(draft: Draft, keyword: str) -> list[Row]:
    """The rows of a block that lists its nodes or elements one by one."""
    rows = draft.numbers(keyword)
    draft.needs(len(rows) > 12 and not any("GEN=" in row.text for row in draft.data(keyword)))
    return rows


@numbering("REF006")
def node_renumbered(draft: Draft) -> None:
    """A node renumbered, its elements not. Seen at an element that uses the old number."""
    row = _listed(draft, "*NODE")[6]
    label = draft.field(row, 0)
    row.text = row.text.replace(label, "907", 1)
    draft.mark(*(each for each in draft.numbers("*ELEMENT") if label in draft.fields(each)[1:]))


@numbering("REF006")
def node_deleted(draft: Draft) -> None:
    """A gap: a node deleted. Seen at an element that uses it."""
    row = _listed(draft, "*NODE")[6]
    label = draft.field(row, 0)
    draft.remove([row])
    draft.mark(*(each for each in draft.numbers("*ELEMENT") if label in draft.fields(each)[1:]))


@numbering("REF006")
def wrong_node_in_element(draft: Draft) -> None:
    """A digit too many in a node number of an element. Seen there, or at a GEN= that steps it."""
    draft.retyped(draft.numbers("*ELEMENT")[-1], 2, lambda text: f"{text}0")
    draft.mark(*(row for row in draft.data("*ELEMENT") if "GEN=" in row.text))


@numbering("REF006")
def count_too_large(draft: Draft) -> None:
    """GEN= of `*ELEMENT` generates five elements more than there are nodes."""
    row = draft.setting("*ELEMENT", "GEN")
    head, _, count = row.text.strip().rpartition(", ")
    draft.needs(draft.text.count("GEN=") < 8)
    draft.write(row, f"{head}, {int(count) + 5}")


@numbering("REF006")
def end_node_missing(draft: Draft) -> None:
    """GEN= of `*NODE` up to a node that is not defined. Seen there."""
    row = draft.setting("*NODE", "GEN")
    head, _, last = row.text.strip().rpartition(", ")
    draft.write(row, f"{head}, {int(last) + 9}")


@numbering("REF006")
def boundary_at_old_node(draft: Draft) -> None:
    """A boundary condition at a node that was renumbered."""
    draft.needs("*RESTART" not in draft.text)
    draft.retyped(draft.numbers("*BOUNDARY")[-1], 0, lambda _: "9001")


@numbering("REF005")
def element_deleted(draft: Draft) -> None:
    """The last element deleted, a set still has it. Seen at the list or GEN= of the set."""
    rows = _listed(draft, "*ELEMENT")
    label = draft.field(rows[-1], 0)
    draft.remove([rows[-1]])
    uses = [row for row in draft.data("*ELEMENT SETS") if row.text.strip().endswith(f", {label}")]
    draft.needs(uses)
    draft.mark(*uses)


@numbering("REF005")
def set_beyond_the_last_element(draft: Draft) -> None:
    """GEN= of a set runs over the last element."""
    row = draft.settings("*ELEMENT SETS", "GEN")[-1]
    head, _, last = row.text.strip().rpartition(", ")
    draft.write(row, f"{head}, {int(last) + 30}")


@numbering("REF010")
def set_runs_backwards(draft: Draft) -> None:
    """GEN=12, 1 for GEN=1, 12."""
    row = draft.settings("*ELEMENT SETS", "GEN")[-1]
    first, last = row.text.strip()[4:].split(", ")
    draft.write(row, f"GEN={last}, {first}")


@numbering("REF007")
def node_copied(draft: Draft) -> None:
    """A node's row copied, its number left. Seen at the later one."""
    rows = _listed(draft, "*NODE")
    fields = draft.fields(rows[6])
    draft.insert(rows[7], f" {fields[0]}, {fields[1]}, {draft.field(rows[7], 2)}")


@numbering("REF007")
def element_copied(draft: Draft) -> None:
    """An element's row copied, its number left. Seen at the later one."""
    rows = _listed(draft, "*ELEMENT")
    draft.insert(rows[7], rows[6].text)


@numbering("REF007")
def number_used_twice(draft: Draft) -> None:
    """A node gets the number of the one before. Seen there, or at an element that uses the lost number."""
    rows = _listed(draft, "*NODE")
    old = draft.field(rows[7], 0)
    draft.retyped(rows[7], 0, lambda _: draft.field(rows[6], 0))
    draft.mark(*(each for each in draft.numbers("*ELEMENT") if old in draft.fields(each)[1:]))


@numbering("GEO004")
def element_of_one_node(draft: Draft) -> None:
    """An element from a node to itself."""
    row = _listed(draft, "*ELEMENT")[5]
    fields = draft.fields(row)
    draft.write(row, f"{fields[0]}, {fields[1]}, {fields[1]}")


@numbering("GEO004")
def nodes_at_one_place(draft: Draft) -> None:
    """A node with the coordinates of the one before. Seen there, or at the element between."""
    rows = _listed(draft, "*NODE")
    fields = draft.fields(rows[6])
    label = draft.field(rows[7], 0)
    draft.write(rows[7], ", ".join([label, *fields[1:]]))
    draft.mark(draft.numbers("*ELEMENT")[6])


@numbering("UNT006")
def element_leaves_out_a_node(draft: Draft) -> None:
    """An element that ends at the node behind the one where the next element begins."""
    rows = _listed(draft, "*ELEMENT")
    behind = draft.field(rows[6], 2)
    draft.needs(draft.field(rows[5], 2) == draft.field(rows[6], 1))
    draft.put(rows[5], 2, behind)


@numbering("UNT006")
def digits_of_coordinate_exchanged(draft: Draft) -> None:
    """A node that lies beyond the next one. Seen at it, or at the next one."""
    rows = _listed(draft, "*NODE")[3:6]
    before, here, behind = (draft.value(row, 2) for row in rows)
    draft.needs(before < here < behind)
    draft.put(rows[1], 2, plain(1.5 * behind - 0.5 * here))
    draft.mark(rows[2])


@numbering("SYN002", "SYN001")
def node_number_with_point(draft: Draft) -> None:
    """A node number with a decimal point, out of a spreadsheet."""
    draft.retyped(draft.numbers("*ELEMENT")[0], 1, lambda text: f"{text}.5")
