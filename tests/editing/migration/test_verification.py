"""The proof finds what a wrong migration would change."""

from __future__ import annotations

import pytest

from mudline.editing.migration.migrating import Migration, migrate, verify
from mudline.language.deck.loading import load_bytes
from mudline.model.scene.model import resolve
from tests.editing.migration.test_migrating import MIGRATED, SAMPLE
from tests.helpers.builders.decks import PIPE_WITH_SETS
from tests.helpers.builders.scenes import deck_of

ULP = "4000.0000000000005"


def tampered(old: str, new: str, *, text: str = SAMPLE) -> Migration:
    """A migration whose new deck is not what it should be."""
    found = migrate(deck_of(text))
    content = found.content.decode()
    assert old in content
    changed = load_bytes(content.replace(old, new).encode(), "deck.keyxm")
    return found._replace(after=resolve(changed), content=content.replace(old, new).encode())


@pytest.mark.parametrize(
    ("old", "new", "name"),
    [
        ("STIFFNESS=5.0D4", "STIFFNESS=50000.000000000007", "force"),
        ("0.5, 4000.0", f"0.5, {ULP}", "force"),
        ("STIFFNESS=East Bank", "STIFFNESS=7 curve", "force"),
        ("STIFFNESS=East Bank", "STIFFNESS=5e4", "force"),
        ("TYPE=ELASTIC", "TYPE=RIGID", "law"),
        ("FRICTION=0.3,", "FRICTION=0.30000000000000004,", "friction"),
        ("0, 0.05, , 12", "0, , 0.05, 12", "mobilisation"),
        (", , 12", ", , 12.5", "constant"),
        ("LATERAL=200", "LATERAL=0", "lateral"),
        ("SUCTION=100.0, 0.25", "SUCTION=100.0", "extent"),
        ("SUCTION=100.0,", "SUCTION=100.00001,", "suction"),
        ("SLOPE=2.5", "SLOPE=-2.5", "slope"),
        ("TYPE=SLOPING", "TYPE=SLOPING\n DIRECTION=90", "direction"),
    ],
)
def test_every_value_counts(old: str, new: str, name: str) -> None:
    differences = verify(tampered(old, new)).differences
    assert differences
    assert any(name in difference.text for difference in differences)


def test_the_order_of_blocks_counts() -> None:
    """Element 9 lies in both sets: the later block wins."""
    east = MIGRATED[MIGRATED.index(" SET=East Bank\n STIFFNESS") : MIGRATED.index(" SET=7\n STIFFNESS")]
    seven = MIGRATED[MIGRATED.index(" SET=7\n STIFFNESS") : MIGRATED.index("*SEABED PROFILE")]
    differences = verify(tampered(east + seven, seven + east)).differences
    assert {difference.what for difference in differences} >= {"element 9"}


def test_only_elements_that_differ_are_named() -> None:
    """Of 12 the numbers 5 to 10 are on the curve, 5 and 6 of them with another diameter."""
    text = PIPE_WITH_SETS + "*ELASTIC SURFACE\n 1e4, 0.3, 0.5\n*EMBEDMENT\n SET=East Bank\n 0, 0\n 1, 5\n"
    group = " SET=East Bank\n STIFFNESS=East Bank\n FRICTION=0.3, 0.5"
    differences = verify(tampered(group, group.replace("0.5", "0.6"), text=text)).differences
    assert [(one.what, one.text) for one in differences] == [
        ("elements 5-10", "bed/transverse friction: 0.5 before, 0.6 after")
    ]
    differences = verify(tampered(" 1, 5\n", " 1, 7\n", text=text)).differences
    assert {one.what for one in differences} == {"elements 5-10", "element 5", "element 7"}
    forces = [one.text for one in differences if one.text.startswith("force")]
    assert forces[1] == "force at depth 1e-09: 2e-08 before, 2.8000000000000003e-08 after"


def test_a_peak_between_two_points_counts() -> None:
    """The depths are those of the points of both curves, for each diameter; elsewhere these are the same to the bit."""
    text = PIPE_WITH_SETS + "*ELASTIC SURFACE\n 1e4\n*EMBEDMENT\n SET=East Bank\n 0, 0\n 1, 4\n"
    peak = " 0, 0\n 0.499755859375, 1.9990234375\n 0.5, 9\n 0.500244140625, 2.0009765625\n 1, 4\n"
    differences = verify(tampered(" 0, 0\n 1, 4\n", peak, text=text)).differences
    assert {one.what for one in differences if one.text.startswith("force")} == {"element 5", "element 7"}


def test_elements_that_the_deck_does_not_show_are_represented() -> None:
    """With *LINES no element is known; the sets are, and so is which of two blocks wins."""
    lines = "$MODEL\n*LINES\n LINE=Riser\n SECTION=A, 10\n SECTION=B, 10\n"
    curves = "*EMBEDMENT\n SET=A\n 0, 0\n 1, 5\n SET=B\n 0, 0\n 1, 7\n"
    text = lines + "*ELASTIC SURFACE\n 1e4, 0.3\n" + curves
    assert verify(migrate(deck_of(text))).differences == ()
    blocks = [f" SET={name}\n STIFFNESS={name}\n FRICTION=0.3, 0\n" for name in "AB"]
    differences = verify(tampered("".join(blocks), "".join(reversed(blocks)), text=text)).differences
    assert {one.what for one in differences} == {"an element of A and B", "an element of B and A"}


def test_a_changed_profile_counts() -> None:
    found = migrate(deck_of(PIPE_WITH_SETS + "*RIGID SURFACE\n 0.3\n 100.0, 30.0\n 0.0, 0.0\n"))
    assert verify(found).differences == ()
    ((name, data),) = found.files.items()
    changed = found._replace(files={name: data.replace(b"30.0", b"30.000000000000004")})
    assert [difference.what for difference in verify(changed).differences] == ["seabed"]


@pytest.mark.parametrize(
    ("old", "new"),
    [(" SET=ALL\n 207.0E9", " SET=Riser\n 207.0E9"), (" 13, -0.05, 120.0\n GEN=1, 13\n", "")],
    ids=["no diameter", "no nodes"],
)
def test_elements_that_cannot_be_evaluated_are_verified_by_their_laws(old: str, new: str) -> None:
    lines = "*LINES\n LINE=Riser\n"  # may make what lacks, which is a warning then
    text = SAMPLE.replace(old, new) + lines
    assert verify(migrate(deck_of(text))).differences == ()
    assert verify(tampered("STIFFNESS=East Bank", "STIFFNESS=5e4", text=text)).differences
