"""Faults of the two families of seabed keywords, and of the law that a set gets."""

from __future__ import annotations

from tests.faults.draft import Draft, plain


def stiffness_left_out(draft: Draft) -> None:
    rows = draft.data("*SEABED PROPERTIES")
    draft.needs("STIFFNESS=" in rows[2].text and len(rows) > 3 and "FRICTION=" in rows[3].text)
    draft.remove([rows[2]])
    draft.mark(rows[1], rows[3])


def one_friction_coefficient(draft: Draft) -> None:
    row = draft.setting("*SEABED PROPERTIES", "FRICTION")
    fields = draft.fields(row)
    draft.needs(len(fields) == 2 and fields[1] not in ("0.0", "0"))
    draft.write(row, fields[0])


def law_of_one_set_deleted(draft: Draft) -> None:
    rows = draft.data("*SEABED PROPERTIES")
    sets = [row for row in rows if "SET=" in row.text]
    draft.needs(len(sets) == 2 and sets[0].text.strip() != "SET=ALL" and "*LINES" not in draft.text)
    draft.remove(rows[rows.index(sets[0]) : rows.index(sets[1])])
    name = sets[0].text.strip()
    draft.mark(*draft.block("*SEABED PROPERTIES"), *(row for row in draft.rows if row.text.strip() == name))
    draft.mark(*draft.numbers("*ELEMENT"))


def seabed_on_the_wrong_set(draft: Draft) -> None:
    row = draft.setting("*SEABED PROPERTIES", "SET")
    names = [each.text.strip() for each in draft.settings("*ELEMENT SETS", "SET")]
    draft.needs(row.text.strip() == "SET=ALL" and len(names) >= 2)
    draft.needs(len(draft.settings("*SEABED PROPERTIES", "SET")) == 1)
    draft.write(row, names[-1])
    draft.mark(*draft.block("*SEABED PROPERTIES"), *draft.numbers("*ELEMENT"))


def lateral_with_friction(draft: Draft) -> None:
    row = draft.setting("*SEABED PROPERTIES", "FRICTION")
    draft.needs("LATERAL" not in draft.text and draft.units == "metric" and not draft.field(row, 1).startswith("0.0"))
    draft.insert(row, " LATERAL=20000.0")
    draft.mark(row)


def extent_without_stiffness(draft: Draft) -> None:
    row = draft.setting("*SEABED PROPERTIES", "SUCTION")
    draft.write(row, f"SUCTION=, {draft.field(row, 1)}")


def rigid_type_over_curves(draft: Draft) -> None:
    row = draft.setting("*SEABED PROPERTIES", "TYPE")
    draft.swap(row, "ELASTIC", "RIGID")
    draft.mark(
        *(each for each in draft.data("*SEABED PROPERTIES") if each.text.strip()[:4] in ("STIF", "LATE", "SUCT"))
    )


def legacy_curve_in_new_deck(draft: Draft) -> None:
    block = draft.block("*SEABED PROPERTIES")
    draft.needs("TYPE=ELASTIC" in block[1].text)
    name = draft.setting("*SEABED PROPERTIES", "SET").text.strip()
    factor = 0.0685 if draft.units == "imperial" else 0.001 if draft.units == "user" else 1.0
    points = [f" {ratio}, {plain(force * factor)}" for ratio, force in ((0.1, 700.0), (0.2, 900.0), (0.5, 1300.0))]
    draft.insert(block[-1], "*EMBEDMENT", f" {name}", " 0.0, 0.0", *points)
    draft.mark(*block)


def rigid_for_elastic_surface(draft: Draft) -> None:
    draft.mark(*(row for row in draft.data("*EMBEDMENT") if "SET=" in row.text), draft.block("*EMBEDMENT")[0])
    rows = draft.block("*ELASTIC SURFACE")
    draft.write(rows[0], "*RIGID SURFACE")
    draft.write(rows[1], "0.35, 0.6")


def surface_deleted(draft: Draft) -> None:
    draft.mark(*(row for row in draft.data("*EMBEDMENT") if "SET=" in row.text), draft.block("*EMBEDMENT")[0])
    draft.remove(draft.block("*ELASTIC SURFACE"))


def embedment_deleted(draft: Draft) -> None:
    rows = draft.block("*ELASTIC SURFACE")
    draft.needs(rows[1].text.strip().startswith(","))
    draft.remove(draft.block("*EMBEDMENT"))
    draft.mark(*rows)


def surface_stiffness_left_out(draft: Draft) -> None:
    draft.needs("*EMBEDMENT" not in draft.text)
    rows = draft.block("*ELASTIC SURFACE")
    draft.write(rows[1], ", " + ", ".join(draft.fields(rows[1])[1:]))
    draft.mark(rows[0])


def legacy_order_in_friction(draft: Draft) -> None:
    row = draft.setting("*SEABED PROPERTIES", "FRICTION")
    fields = draft.fields(row)
    draft.needs(len(fields) == 2 and draft.units in ("metric", "imperial"))
    length = "3.048" if draft.units == "metric" else "10.0"
    draft.write(row, ", ".join([*fields, length, length]))


def legacy_row_in_new_block(draft: Draft) -> None:
    rows = draft.data("*SEABED PROPERTIES")
    draft.needs("TYPE=ELASTIC" in rows[0].text)
    draft.remove(rows[1:])
    draft.insert(rows[0], " 40000.0, 0.35, 0.6")


def seabed_in_load_case(draft: Draft) -> None:
    block = draft.block("*SEABED PROPERTIES")
    texts = [row.text for row in block]
    case = draft.block("$LOAD CASE")[0]
    draft.needs(draft.rows.index(case) > draft.rows.index(block[0]))
    draft.remove(block)
    draft.mark(draft.insert(case, *texts, mark=False)[0])


def boundary_in_model(draft: Draft) -> None:
    block = draft.block("*BOUNDARY")
    head = draft.block("$MODEL")[0]
    draft.needs(draft.rows.index(head) < draft.rows.index(block[0]) and "*RESTART" not in draft.text)
    texts = [row.text for row in block if row.text.strip()]
    draft.remove(block)
    draft.mark(draft.insert(head, *texts, mark=False)[0])


def section_of_other_option(draft: Draft) -> None:
    draft.mark(draft.sections("MOORING")[0])
    row = draft.setting("*GEOMETRIC SETS", "OPTION")
    draft.needs("MOORING" in row.text)
    row.text = " OPTION=RIGID"


def number_beside_curve(draft: Draft) -> None:
    row = draft.sections("FLEXIBLE")[0]
    head = draft.previous(row)
    draft.needs(", EI=" in head.text)
    draft.write(row, ", ".join(["90000.0", "90000.0", *draft.fields(row)[2:]]))
    draft.mark(head)


def extension_on_rigid_seabed(draft: Draft) -> None:
    name = next((each for each in ("CONTACT", "SUCTION", "TRENCH", "UNLOADING") if f"*SEABED {each}" in draft.text), "")
    head = draft.block(f"*SEABED {name}")
    draft.swap(draft.setting("*SEABED PROPERTIES", "TYPE"), "ELASTIC", "RIGID")
    draft.mark(*head, *draft.settings("*SEABED PROPERTIES", "STIFFNESS"))


def three_dimensional_rigid(draft: Draft) -> None:
    row = draft.setting("*SEABED PROFILE", "TYPE")
    draft.needs("TYPE=RIGID" in draft.text)
    draft.write(row, "TYPE=3D")
    draft.write(draft.setting("*SEABED PROFILE", "SLOPE"), "FILE=bed.fcsbd")
    draft.mark(draft.setting("*SEABED PROPERTIES", "TYPE"), draft.block("*SEABED PROFILE")[0])


def ocean_deleted(draft: Draft) -> None:
    waves = [row for row in draft.rows if row.text.startswith(("*WAVE", "*CURRENT"))]
    draft.needs(waves)
    draft.mark(draft.rows[0], *waves)
    draft.remove(draft.block("*OCEAN"))


def columns_exchanged(draft: Draft) -> None:
    points = draft.curve()
    draft.needs(all(draft.value(row, 1) > 10.0 for row in points[1:]))
    for row in points[1:]:
        draft.exchange(row, 0, 1)
    draft.mark(points[0], draft.keyed_above(points[0]))


def forces_in_falling_order(draft: Draft) -> None:
    points = draft.curve()
    forces = [draft.field(row, 1) for row in points]
    for row, force in zip(points, reversed(forces), strict=True):
        draft.write(row, f"{draft.field(row, 0)}, {force}")


def ratio_twice(draft: Draft) -> None:
    points = draft.curve()
    draft.put(points[3], 0, draft.field(points[2], 0))


def single_point(draft: Draft) -> None:
    points = draft.curve()
    draft.remove(points[1:])
    draft.mark(draft.keyed_above(points[0]), points[0])


def no_points(draft: Draft) -> None:
    points = draft.curve()
    head = draft.keyed_above(points[0])
    draft.remove(points)
    draft.mark(head)


def force_at_zero(draft: Draft) -> None:
    points = draft.curve()
    draft.put(points[0], 1, plain(draft.value(points[1], 1) * 0.6))
    draft.mark(draft.keyed_above(points[0]))


def plateau_at_the_end(draft: Draft) -> None:
    points = draft.curve()
    draft.put(points[-1], 1, draft.field(points[-2], 1))
    draft.mark(points[-2])


def points_in_wrong_order(draft: Draft) -> None:
    points = draft.curve()
    one, other = (draft.fields(points[i]) for i in (3, 4))
    draft.write(points[3], f"{other[0]}, {one[1]}")
    draft.write(points[4], f"{one[0]}, {other[1]}")


def curve_called_a_number(draft: Draft) -> None:
    row = draft.setting("*SEABED PROPERTIES", "STIFFNESS")
    name = row.text.partition("=")[2]
    head = draft.first(each for each in draft.settings("*SEABED STIFFNESS", "CURVE") if each.text[7:] == name)
    draft.write(head, "CURVE=1200")
    draft.write(row, "STIFFNESS=1200")
