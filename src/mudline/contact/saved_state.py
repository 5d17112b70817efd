"""The state of a run as plain arrays, so that it can be saved and taken up again: the same bits as without a stop."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mudline.contact.tables import ContactState

_PLAIN = ("positions", "laid", "touchdown")
_HISTORIES = ("unloading", "suction", "friction")


def state_arrays(state: ContactState) -> dict[str, NDArray[Any]]:
    """Return the arrays of a state by name; those that it does not have are left out.

    `np.save` keeps the order of their axes in memory, on which the speed of the next steps depends.
    """
    found = {name: getattr(state, name) for name in _PLAIN}
    for name in _HISTORIES:
        history = getattr(state, name)
        if history is not None:
            found |= {f"{name}.{each.name}": getattr(history, each.name) for each in fields(history)}
    return {name: array for name, array in found.items() if array is not None}


def restored_state(arrays: Mapping[str, NDArray[Any]], initial: ContactState, nodes: int) -> ContactState:
    """Return the state that `state_arrays` gave; `initial` is the state before the first step of the same model.

    Raises ValueError where the arrays are not those of a model like this, of so many nodes.
    """
    expected = {name: array.shape for name, array in state_arrays(initial).items()}
    expected |= dict.fromkeys(("positions", "laid"), (nodes, 3))
    found = {name: array.shape for name, array in arrays.items()}
    if found != expected:
        raise ValueError(f"the state holds {found}, expected {expected}")
    parts: dict[str, Any] = {name: np.array(arrays[name], np.float64, order="K") for name in _PLAIN if name in arrays}
    for name in _HISTORIES:
        history = getattr(initial, name)
        if history is not None:
            of_history = [(each.name, getattr(history, each.name).dtype) for each in fields(history)]
            parts[name] = type(history)(
                *(np.array(arrays[f"{name}.{each}"], kind, order="K") for each, kind in of_history)
            )
    return replace(initial, **parts)
