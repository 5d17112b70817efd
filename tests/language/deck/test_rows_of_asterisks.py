"""Rows in which a number too wide for its column became asterisks are no comments."""

from __future__ import annotations

import pytest

from tests.helpers.builders.scenes import faults

_CURVE = "$MODEL\n*SEABED STIFFNESS\n CURVE=Clay\n 0.0, 0.0\n{}\n 0.5, 1500.0\n"


@pytest.mark.parametrize("row", ["****, 700.0", "*****, *****", "*** 700.0"])
def test_a_row_that_begins_with_asterisks_is_an_error(row: str) -> None:
    told = [each for each in faults(_CURVE.format(row)) if "SYN009" in each]
    assert len(told) == 1
    assert "asterisks stand for a number too wide for its column" in told[0]


@pytest.mark.parametrize("row", ["*** upper layer, 2 m", "********", "** E 210"])
def test_a_remark_behind_asterisks_is_to_be_a_comment(row: str) -> None:
    told = [each for each in faults(_CURVE.format(row)) if "SYN009" in each]
    assert len(told) == 1
    assert "begin a comment with C and a space" in told[0]
