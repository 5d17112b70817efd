"""CRV015 and CRV016: soil springs."""

from __future__ import annotations

import pytest

from tests.checks.findings import PIPE, found

SPRING = "*P-Y\n SET=ALL\n DEPTH=5.0\n"


def springs(*rows: tuple[float, float]) -> str:
    return PIPE + SPRING + "".join(f" {resistance}, {displacement}\n" for resistance, displacement in rows)


@pytest.mark.parametrize(
    ("rows", "row"),
    [
        ([(0.0, 0.0), (9000.0, 0.01), (4000.0, 0.05), (12000.0, 0.2)], 2),
        ([(12000.0, 0.2), (0.0, 0.0), (4000.0, 0.05), (9000.0, 0.01)], 2),  # in any order
        ([(-12000.0, -0.2), (-4000.0, -0.05), (-9000.0, -0.01), (0.0, 0.0), (9000.0, 0.01)], 1),
        ([(0.0, 0.0), (9000.0, 0.01), (4000.0, 0.05), (4000.0, 0.2)], None),  # a residual resistance
        ([(-9000.0, -0.01), (0.0, 0.0), (9000.0, 0.01), (4000.0, 0.05)], None),
    ],
)
def test_resistance_that_falls_and_rises_again(rows: list[tuple[float, float]], row: int | None) -> None:
    first = (PIPE + SPRING).count("\n") + 1
    assert found(springs(*rows), "CRV016") == ([] if row is None else [("CRV016", first + row, 2)])


def test_rows_that_are_too_short_have_no_order() -> None:
    assert found(PIPE + SPRING + " 9000.0\n 4000.0\n 12000.0\n", "CRV016") == []


@pytest.mark.parametrize(("depth", "codes"), [("5.0", ["CRV015"]), ("4.0", ["CRV015"]), ("6.0", [])])
def test_depths_go_down(depth: str, codes: list[str]) -> None:
    curve = " 0.0, 0.0\n 9000.0, 0.01\n"
    assert [one[0] for one in found(f"{PIPE}{SPRING}{curve} DEPTH={depth}\n{curve}", "CRV015")] == codes
