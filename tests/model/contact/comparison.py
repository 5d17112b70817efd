"""Whether both drivers, and all ways to take a series in parts, give the same bits for a scene, or the same error."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import fields, is_dataclass
from typing import Any, NamedTuple
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray

from mudline.model.contact import ContactInput, ContactModel, ContactResult, numpy_driver
from mudline.model.contact.arrays import BoolArray, FloatArray
from mudline.model.contact.compiled import driver as compiled_driver
from mudline.model.contact.compiled.functions import Loop
from mudline.model.contact.plan import Backend
from mudline.model.contact.tables import ContactState


class Sizes(NamedTuple):
    """How much the drivers do at a time, and on how many threads."""

    block: int
    batch: int
    threads: int


class Scene(NamedTuple):
    """An input with a motion of its nodes."""

    inputs: ContactInput
    positions: FloatArray
    velocities: FloatArray | None
    times: FloatArray | None
    present: BoolArray | None
    sizes: Sizes


@contextmanager
def plain_loops() -> Iterator[None]:
    """The loops of compiled drivers are plain Python."""

    def loop(make: Callable[..., Loop], _wrap: object, *options: object) -> Loop:
        return make(lambda function: function, *options)

    with patch.object(compiled_driver, "_loop", loop):
        yield


@contextmanager
def divided(sizes: Sizes) -> Iterator[None]:
    """The drivers do so much at a time, and use threads for the smallest series."""
    with (
        patch.object(numpy_driver, "BLOCK", sizes.block),
        patch.multiple(
            compiled_driver,
            _STEPS=sizes.batch,
            _BATCH=sizes.block,
            _WORTH_THREADS=0,
        ),
    ):
        yield


Outcome = ContactResult | str
"""A result, or the text of an error."""


def _evaluated(scene: Scene, contact: ContactModel) -> Outcome:
    try:
        return contact.evaluate(scene.positions, present=scene.present, velocities=scene.velocities, times=scene.times)
    except ValueError as error:
        return f"{type(error).__name__}: {error}"


def _streamed(scene: Scene, contact: ContactModel) -> list[Outcome]:
    """The parts of a series, and what ended it."""
    found: list[Outcome] = []
    try:
        for part in contact.stream(
            scene.positions, present=scene.present, velocities=scene.velocities, times=scene.times
        ):
            found.append(part.result)  # noqa: PERF401 - what came before an error counts too
    except ValueError as error:
        found.append(f"{type(error).__name__}: {error}")
    return found


def _stepped(scene: Scene, contacts: Sequence[ContactModel]) -> Iterator[list[tuple[Outcome, ContactState | None]]]:
    """The steps of several models, each behind the state of the next model."""
    states = [contact.initial_state() for contact in contacts]
    for number, place in enumerate(scene.positions):
        rate = None if scene.velocities is None else scene.velocities[number]
        dt = None
        if scene.times is not None and number:
            dt = float(scene.times[number] - scene.times[number - 1])
        found: list[tuple[Outcome, ContactState | None]] = []
        for contact, state in zip(contacts, states, strict=True):
            try:
                found.append(contact.step(place, rate, state, dt))
            except ValueError as error:
                text = str(error).replace(" at step 0:", f" at step {number}:")
                found.append((f"{type(error).__name__}: {text}", None))
        yield found
        after = [state for _, state in found if state is not None]
        if len(after) < len(contacts):
            return
        states = [*after[1:], after[0]]


def compare(scene: Scene, *, plain: bool = False) -> list[str]:
    """Return what differs between the drivers, or between a series and its steps; nothing where all is the same.

    `plain`: the loops are not compiled, and run on one thread, where numpy's warnings are off.
    """
    if plain:
        with plain_loops():
            return compare(scene._replace(sizes=scene.sizes._replace(threads=1)))
    backends: tuple[Backend, ...] = ("numpy", "fast")
    try:
        usual = [ContactModel(scene.inputs, backend=backend, threads=1) for backend in backends]
        with divided(scene.sizes):
            small = [ContactModel(scene.inputs, backend=backend, threads=scene.sizes.threads) for backend in backends]
            divided_results = [_evaluated(scene, contact) for contact in small]
    except ValueError as error:
        wanted = ("locks itself", "the resistance of its trench overflows")
        return [] if any(why in str(error) for why in wanted) else [f"the scene is refused: {error}"]
    whole = _evaluated(scene, usual[0])
    found = _told("loops", whole, _evaluated(scene, usual[1]))
    for name, result in zip(("numpy in blocks", "loops in ranges"), divided_results, strict=True):
        found += _told(name, whole, result)
    for name, contact in zip(("numpy streams", "loops stream"), small, strict=True):
        with divided(scene.sizes):
            found += _told_parts(name, whole, _streamed(scene, contact))
    if scene.present is None:
        for number, ((one, state), (other, second)) in enumerate(_stepped(scene, usual)):
            found += _told(f"loops, step {number}", one, other)
            if state is not None and second is not None:
                found += [f"loops, state {number}: {text}" for text in differences(state, second)]
            alone = whole.step(number) if isinstance(whole, ContactResult) else whole
            if isinstance(one, str) or isinstance(alone, ContactResult):
                found += _told(f"numpy, step {number}", alone, one)
    return found


def _told(name: str, one: Outcome, other: Outcome) -> list[str]:
    """What differs between two outcomes."""
    if isinstance(one, str) or isinstance(other, str):
        texts = [each if isinstance(each, str) else "a result" for each in (one, other)]
        return [] if texts[0] == texts[1] else [f"{name}: {texts[0]!r}, and {texts[1]!r}"]
    return [f"{name}: {text}" for text in differences(one, other)]


def _told_parts(name: str, whole: Outcome, parts: list[Outcome]) -> list[str]:
    """What differs between a series and its parts."""
    if isinstance(whole, str):
        return _told(name, whole, parts[-1])
    found, start = [], 0
    for part in parts:
        stop = start + (len(part.depth) if isinstance(part, ContactResult) else 0)
        found += _told(f"{name}, from step {start}", whole.steps(start, stop), part)
        start = stop
    return found


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
