"""Dataclasses whose methods are made later are like those of Python."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from dataclasses import KW_ONLY, FrozenInstanceError, asdict, dataclass, field, fields, replace
from typing import Any, cast

import pytest

from mudline.lean import dataclass as lean

Decorator = Callable[..., Any]
BOTH = pytest.mark.parametrize("made", [dataclass, lean])
SLOTS = pytest.mark.parametrize("slots", [False, True])


@lean(frozen=True, slots=True)
class Point:
    """A place."""

    x: int
    y: int = 2
    names: tuple[str, ...] = field(default=(), compare=False, repr=False)


def some(made: Decorator, *, frozen: bool, slots: bool) -> type[Any]:
    @made(frozen=frozen, slots=slots)
    class Some:
        a: int
        b: list[int] = field(default_factory=list)
        c: int = field(default=3, init=False)
        d: list[int] = field(default_factory=lambda: [4], init=False)
        _: KW_ONLY
        e: str = "five"
        f: int

        def __post_init__(self) -> None:
            self.b.append(self.a)

    return cast("type[Any]", Some)


@BOTH
@SLOTS
@pytest.mark.parametrize("frozen", [False, True])
def test_methods(made: Decorator, slots: bool, frozen: bool) -> None:
    kind = some(made, frozen=frozen, slots=slots)
    one = kind(1, f=6)
    assert repr(one).endswith("Some(a=1, b=[1], c=3, d=[4], e='five', f=6)")
    assert one == kind(a=1, b=[], f=6) != kind(1, [1], f=6)
    assert one.d is not kind(1, f=6).d
    assert asdict(one) == {"a": 1, "b": [1], "c": 3, "d": [4], "e": "five", "f": 6}
    assert [each.name for each in fields(kind)] == list("abcdef")
    assert replace(one, e="x").e == "x"
    assert copy.copy(one) == one
    assert kind.__match_args__ == ("a", "b")
    assert hasattr(one, "__dict__") != slots
    with pytest.raises(TypeError, match="missing 1 required keyword-only argument: 'f'"):
        kind(1)
    with pytest.raises(TypeError):
        kind(1, [], "five", f=6)
    if frozen:
        with pytest.raises(FrozenInstanceError, match="cannot assign to field 'a'"):
            one.a = 2
        with pytest.raises(FrozenInstanceError):
            del one.a
    else:
        one.a = 2
        assert one.a == 2
        with pytest.raises(TypeError, match="unhashable"):
            hash(one)


def test_frozen_ones_are_hashed_and_pickled() -> None:
    one = Point(1, names=("a",))
    assert hash(one) == hash(Point(1, 2)) != hash(Point(2, 2))
    assert (again := pickle.loads(pickle.dumps(one))) == one  # noqa: S301 - made here
    assert again.names == ("a",)
    assert one.__doc__ == "A place."


def test_what_a_class_declares_itself_stays() -> None:
    @lean(eq=False, repr=False)
    class Own:
        a: int = 1

        def __repr__(self) -> str:
            return "own"

    assert repr(Own()) == "own"
    assert Own() != Own()
    assert len({Own(), Own()}) == 2


def test_children() -> None:
    @lean(frozen=True)
    class Child(Point):
        b: int = 2

    assert Child(1) == Child(1, 2)
    assert Child(1) != Point(1)
    assert repr(Child(1)).endswith("Child(x=1, y=2, b=2)")
    assert hash(Child(1)) == hash(Child(1, 2))
