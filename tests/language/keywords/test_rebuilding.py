"""A part with other values: what is asked for is changed, what stays is the same object."""

from __future__ import annotations

import gc
from typing import Any

from mudline.language.keywords.library.loads import Boundary
from mudline.language.keywords.model import FieldSpec, Path
from mudline.language.keywords.rebuilding import rebuilt
from mudline.language.keywords.table import Table
from mudline.language.keywords.values import Equation
from tests.helpers.builders.scenes import deck_of

BLOCKS = """\
$MODEL
*NODE
 1, 0.0, 0.0
*ELEMENT SETS
 SET=A
 1, 2
C inside
 GEN=4, 8, 2
$LOAD CASE
*BOUNDARY
 TYPE=VESSEL
C of the vessel
 12, Semi
 TYPE=CONSTANT
 1, =[dof]
"""


def test_what_does_not_change_is_the_same_object() -> None:
    block = deck_of(BLOCKS).sections[1].blocks[0]
    assert isinstance(block, Boundary)

    other = rebuilt(block, lambda *_: 6, (Equation,))
    assert other.types[1].entries[0].dof == 6  # type: ignore[union-attr]  # a node, no range
    assert other.types[0] is block.types[0]
    assert rebuilt(other, lambda *_: 6, (Equation,)) is other
    assert block.types[1].entries[0].dof == "=[dof]"  # type: ignore[union-attr]


def test_values_come_with_their_paths_items_one_by_one_and_tables_whole() -> None:
    found: list[tuple[Path, Any]] = []

    def noted(value: object, _slot: FieldSpec, path: Path) -> object:
        found.append((path, value))
        return value

    nodes, sets = deck_of(BLOCKS).sections[0].blocks
    rebuilt(nodes, noted)
    assert [(path, type(value)) for path, value in found] == [(("entries", 0, "nodes"), Table)]
    found.clear()
    rebuilt(sets, noted, (int,))
    members = ("sets", 0, "members")
    of_list = [((*members, 0, "elements", 0), 1), ((*members, 0, "elements", 1), 2)]
    of_range = [((*members, 1, "generate", index), value) for index, value in enumerate((4, 8, 2))]
    assert found == of_list + of_range


def test_a_bare_part_has_neither_comments_nor_kept_lines() -> None:
    for section in deck_of(BLOCKS).sections:
        for block in section.blocks:
            bare = rebuilt(block, lambda value, _slot, _path: value, bare=True)
            assert "inside" not in repr(bare.model_dump())
            assert "Semi" not in repr(bare.model_dump())
            assert "vessel" not in repr(bare.model_dump())
    assert "inside" in repr(deck_of(BLOCKS).sections[0].blocks[1].model_dump())


def test_nothing_is_left_for_a_search_of_memory() -> None:
    """In a run over many decks Python does not search for cycles of objects: each would stay to the end."""
    block = deck_of(BLOCKS).sections[1].blocks[0]
    gc.collect()
    gc.disable()
    try:
        rebuilt(block, lambda *_: 6, (Equation,))
        assert gc.collect() == 0
    finally:
        gc.enable()
