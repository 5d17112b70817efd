"""Whether results and states are the same to the last bit: the sign of zero counts, and NaN is equal to NaN."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mudline.contact import ContactResult

AnyArray = NDArray[Any]


EVALUATED = {"given", "positions", "times"}
"""What a result says of its evaluation, which is no part of what came out of it."""


def arrays_of(part: object, name: str = "") -> Iterator[tuple[str, AnyArray | None]]:
    """All arrays of a result or a state by name, those of its parts too; None for what it does not have."""
    if isinstance(part, np.ndarray):
        yield name, part
    elif is_dataclass(part):
        for field in fields(part):
            if field.name in EVALUATED and isinstance(part, ContactResult):
                continue
            yield from arrays_of(getattr(part, field.name), f"{name}.{field.name}".lstrip("."))
    else:
        assert part is None
        yield name, None


def equal_bits(one: AnyArray, other: AnyArray) -> AnyArray:
    """Where two arrays of one shape and type are equal."""
    if one.dtype.kind != "f":
        return np.asarray(one == other)
    kind = np.dtype(f"i{one.dtype.itemsize}")
    same = np.ascontiguousarray(one).view(kind) == np.ascontiguousarray(other).view(kind)
    return np.asarray(same | (np.isnan(one) & np.isnan(other)))


def differences(one: object, other: object) -> list[str]:
    """What is not the same in two results, or in two states: the name, the place and both values."""
    here, there = dict(arrays_of(one)), dict(arrays_of(other))
    found = [f"{name} is in one only" for name in sorted(here.keys() ^ there.keys())]
    for name in here.keys() & there.keys():
        left, right = here[name], there[name]
        if left is None or right is None:
            if left is not right:
                found.append(f"{name} is in one only")
        elif left.shape != right.shape or left.dtype != right.dtype:
            found.append(f"{name} is {left.dtype} {left.shape}, and {right.dtype} {right.shape}")
        elif not (same := equal_bits(left, right)).all():
            place = tuple(np.argwhere(~same)[0].tolist())
            found.append(f"{name}{list(place)} is {left[place]!r}, and {right[place]!r}; {int((~same).sum())} differ")
    return found


def same_bits(one: object, other: object) -> bool:
    """Whether two results, or two states, are the same to the last bit."""
    return not differences(one, other)
