"""Faults of copying, renaming, renumbering and deleting: what was changed in one place and not in the other."""

from __future__ import annotations

from tests.faults.changes import elements_of, typo
from tests.faults.draft import Draft, Row, plain


def curve_copied(draft: Draft) -> None:
    points = draft.curve()
    head = draft.keyed_above(points[0])
    copy = draft.insert(points[-1], head.text, *(row.text for row in points), mark=False)
    draft.mark(copy[0])


def curve_added_and_not_used(draft: Draft) -> None:
    points = draft.curve()
    draft.needs("*SEABED STIFFNESS" in draft.text)
    copy = draft.insert(points[-1], " CURVE=Sand Rev B", *(row.text for row in points), mark=False)
    draft.mark(copy[0])


def curve_name_misspelt(draft: Draft) -> None:
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    draft.needs(not row.text.partition("=")[2][:1].isdigit())
    typo(draft, row)


def curve_renamed(draft: Draft) -> None:
    used = {row.text.partition("=")[2]: row for row in draft.settings("*SEABED PROPERTIES", "STIFFNESS")}
    row = draft.first(each for each in draft.settings("*SEABED STIFFNESS", "CURVE") if each.text[7:] in used)
    draft.mark(used[row.text[7:]])
    row.text = " CURVE=Soft Soil"


def curves_deleted(draft: Draft) -> None:
    block = draft.block("*SEABED STIFFNESS")
    names = {row.text.partition("=")[2] for row in block if "CURVE=" in row.text}
    used = [row for row in draft.settings("*SEABED PROPERTIES", "STIFFNESS") if row.text.partition("=")[2] in names]
    draft.mark(*used)
    draft.remove(block)


def set_misspelt_in_extension(draft: Draft) -> None:
    keyword = next((each for each in ("*SEABED TRENCH", "*SEABED SUCTION") if each in draft.text), "*SEABED TRENCH")
    typo(draft, draft.setting(keyword, "SET"))


def set_renamed(draft: Draft) -> None:
    row = draft.setting("*ELEMENT SETS", "SET")
    name = row.text.strip()
    uses = [each for each in draft.rows if each is not row and each.text.strip() == name]
    draft.needs(uses)
    row.text = " SET=Line KP 0 to 12"
    draft.mark(*uses)


def sets_deleted(draft: Draft) -> None:
    block = draft.block("*ELEMENT SETS")
    names = {row.text.strip() for row in block if "SET=" in row.text}
    draft.remove(block)
    uses = [row for row in draft.rows if row.text.strip() in names]
    draft.needs(uses)
    draft.mark(*uses)


def set_copied(draft: Draft) -> None:
    rows = draft.data("*ELEMENT SETS")
    copy = draft.insert(rows[-1], rows[0].text, " GEN=2, 4", mark=False)
    draft.mark(copy[0])


def set_called_all(draft: Draft) -> None:
    draft.insert(draft.data("*ELEMENT SETS")[-1], " SET=ALL", mark=True)
    draft.insert(draft.data("*ELEMENT SETS")[-1], " GEN=1, 4", mark=False)


def subset_misspelt(draft: Draft) -> None:
    rows = draft.data("*ELEMENT SETS")
    name = rows[0].text.partition("=")[2]
    draft.insert(rows[-1], " SET=Whole Line", mark=False)
    _subset(draft, name[:-1] + "s")


def subset_of_itself(draft: Draft) -> None:
    draft.insert(draft.data("*ELEMENT SETS")[-1], " SET=Whole Line", mark=False)
    _subset(draft, "Whole Line")


def _subset(draft: Draft, name: str) -> None:
    head = draft.data("*ELEMENT SETS")[-1]
    draft.mark(head)
    draft.insert(head, f" SUBSET={name}")


def long_list(draft: Draft) -> None:
    rows = draft.data("*ELEMENT SETS")
    draft.needs(len(draft.numbers("*ELEMENT")) >= 24)
    labels = [draft.field(row, 0) for row in draft.numbers("*ELEMENT")][:24]
    draft.insert(rows[-1], " SET=Hot Spot", mark=False)
    draft.insert(draft.data("*ELEMENT SETS")[-1], f" {', '.join(labels)}")


def section_copied_and_not_renamed(draft: Draft) -> None:
    rows = draft.settings("*GEOMETRIC SETS", "SET")
    draft.needs(len(rows) == 2 and "ALL" not in draft.text.partition("*GEOMETRIC")[2].partition("*HYDRO")[0])
    draft.write(rows[1], rows[0].text.strip())
    draft.mark(rows[0])


def section_deleted(draft: Draft) -> None:
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


def sections_deleted(draft: Draft) -> None:
    draft.needs(draft.curve())
    draft.remove(draft.block("*GEOMETRIC SETS"))
    keyword = "*SEABED PROPERTIES" if "*SEABED PROPERTIES" in draft.text else "*EMBEDMENT"
    draft.mark(*(row for row in draft.data(keyword) if "SET=" in row.text or "STIFFNESS=" in row.text))


def law_copied(draft: Draft) -> None:
    rows = draft.data("*SEABED PROPERTIES")
    sets = [row for row in rows if "SET=" in row.text]
    draft.needs(len(sets) == 2 and "ALL" not in draft.text.partition("*SEABED P")[2][:60])
    copy = draft.insert(rows[-1], sets[0].text, " STIFFNESS=98000.0", mark=False)
    draft.mark(copy[0], copy[1], sets[0], rows[rows.index(sets[0]) + 1])


def block_of_nodes_pasted_twice(draft: Draft) -> None:
    block = draft.block("*NODE")
    copy = draft.insert(block[-1], *(row.text for row in block), mark=False)
    draft.mark(copy[0], copy[1])


def whole_model_pasted_twice(draft: Draft) -> None:
    draft.needs("*LINES" not in draft.text and draft.rows[0].text == "$MODEL")
    copy = draft.insert(draft.rows[-1], *(row.text for row in draft.rows), mark=False)
    nodes = next(i for i, row in enumerate(copy) if row.text == "*NODE")
    draft.mark(copy[nodes], copy[nodes + 1])


def _listed(draft: Draft, keyword: str) -> list[Row]:
    """The rows of a block that lists its nodes or elements one by one."""
    rows = draft.numbers(keyword)
    draft.needs(len(rows) > 12 and not any("GEN=" in row.text for row in draft.data(keyword)))
    return rows


def node_renumbered(draft: Draft) -> None:
    row = _listed(draft, "*NODE")[6]
    label = draft.field(row, 0)
    row.text = row.text.replace(label, "907", 1)
    draft.mark(*elements_of(draft, label))


def node_deleted(draft: Draft) -> None:
    row = _listed(draft, "*NODE")[6]
    label = draft.field(row, 0)
    draft.remove([row])
    draft.mark(*elements_of(draft, label))


def wrong_node_in_element(draft: Draft) -> None:
    draft.retyped(draft.numbers("*ELEMENT")[-1], 2, lambda text: f"{text}0")
    draft.mark(*(row for row in draft.data("*ELEMENT") if "GEN=" in row.text))


def element_deleted(draft: Draft) -> None:
    rows = _listed(draft, "*ELEMENT")
    label = draft.field(rows[-1], 0)
    draft.remove([rows[-1]])
    uses = [row for row in draft.data("*ELEMENT SETS") if row.text.strip().endswith(f", {label}")]
    draft.needs(uses)
    draft.mark(*uses)


def set_runs_backwards(draft: Draft) -> None:
    row = draft.settings("*ELEMENT SETS", "GEN")[-1]
    first, last = row.text.strip()[4:].split(", ")
    draft.write(row, f"GEN={last}, {first}")


def node_copied(draft: Draft) -> None:
    rows = _listed(draft, "*NODE")
    fields = draft.fields(rows[6])
    draft.insert(rows[7], f" {fields[0]}, {fields[1]}, {draft.field(rows[7], 2)}")


def element_copied(draft: Draft) -> None:
    rows = _listed(draft, "*ELEMENT")
    draft.insert(rows[7], rows[6].text)


def number_used_twice(draft: Draft) -> None:
    rows = _listed(draft, "*NODE")
    old = draft.field(rows[7], 0)
    draft.retyped(rows[7], 0, lambda _: draft.field(rows[6], 0))
    draft.mark(*elements_of(draft, old))


def element_of_one_node(draft: Draft) -> None:
    row = _listed(draft, "*ELEMENT")[5]
    fields = draft.fields(row)
    draft.write(row, f"{fields[0]}, {fields[1]}, {fields[1]}")


def nodes_at_one_place(draft: Draft) -> None:
    rows = _listed(draft, "*NODE")
    fields = draft.fields(rows[6])
    label = draft.field(rows[7], 0)
    draft.write(rows[7], ", ".join([label, *fields[1:]]))
    draft.mark(draft.numbers("*ELEMENT")[6])


def element_leaves_out_a_node(draft: Draft) -> None:
    rows = _listed(draft, "*ELEMENT")
    behind = draft.field(rows[6], 2)
    draft.needs(draft.field(rows[5], 2) == draft.field(rows[6], 1))
    draft.put(rows[5], 2, behind)


def digits_of_coordinate_exchanged(draft: Draft) -> None:
    rows = _listed(draft, "*NODE")[3:6]
    before, here, behind = (draft.value(row, 2) for row in rows)
    draft.needs(before < here < behind)
    draft.put(rows[1], 2, plain(1.5 * behind - 0.5 * here))
    draft.mark(rows[2])
