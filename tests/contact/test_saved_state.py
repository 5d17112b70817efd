"""A run that goes on from a saved state gives the same bits as one without a stop."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from mudline.contact import ContactModel, ContactState
from mudline.contact.plan import Backend
from mudline.contact.tables import restored_state, state_arrays
from tests.builders.contact import CURVE, chain, everything, journey
from tests.contact.bits import same_bits
from tests.contact.comparison import plain_loops


def saved(state: ContactState) -> dict[str, np.ndarray[Any, Any]]:
    file = io.BytesIO()
    np.savez(file, **state_arrays(state))  # type: ignore[arg-type] # no array is called allow_pickle
    file.seek(0)
    with np.load(file, allow_pickle=False) as arrays:
        return {name: arrays[name] for name in arrays}


@pytest.fixture
def loops() -> Iterator[None]:
    """Loops as plain Python, which take no time to compile."""
    with plain_loops():
        yield


@pytest.mark.usefixtures("loops")
@pytest.mark.parametrize("backend", ["numpy", "fast"])
def test_every_law_goes_on_where_it_stopped(backend: Backend) -> None:
    inputs = everything(40, seed=18)
    contact = ContactModel(inputs, backend=backend)
    positions, _, times = journey(40, 200, seed=18)
    whole = contact.evaluate(positions, times=times)
    assert contact.batch == 64
    state: ContactState | None = None
    for start in range(0, 200, 64):
        other = ContactModel(inputs, backend=backend)
        ((part, behind),) = other.resume(positions, range(start, start + 64), state, times=times)
        assert same_bits(part.result, whole.steps(start, start + 64))
        state = restored_state(saved(behind), other.initial_state(), len(inputs.node_ids))


def test_states_of_other_models_are_refused() -> None:
    inputs = everything(40, seed=18)
    contact = ContactModel(inputs)
    positions, _, times = journey(40, 4, seed=18)
    _, behind = next(contact.resume(positions, range(4), times=times))
    arrays = saved(behind)
    with pytest.raises(ValueError, match=r"the state holds .*, expected"):
        restored_state(arrays, ContactModel(everything(30, seed=18)).initial_state(), 31)
    del arrays["positions"]
    with pytest.raises(ValueError, match="expected"):
        restored_state(arrays, contact.initial_state(), len(inputs.node_ids))


def test_runs_begin_at_whole_batches() -> None:
    contact = ContactModel(chain([CURVE]))
    with pytest.raises(ValueError, match="multiples of 64 steps, not at step 3"):
        list(contact.resume(np.zeros((9, 2, 3)), range(3, 9)))
