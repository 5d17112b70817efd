"""A mass on a contact of the scene, pressed to where the law is steepest: a system for the schemes to step."""

from __future__ import annotations

import numpy as np

from mudline.contact import ContactInput, ContactModel, LawAssignment, LawKind
from mudline.contact.arrays import FloatArray
from mudline.scene.model import Scene
from mudline.study.motion import Forces, History
from mudline.study.stability.contacts import Contact

_FAR = 10.0
"""Times the reach of the segment: a motion that comes so far has grown, and has no force any more."""


class Pressed:
    """`runs` copies of an element of the scene, under a load that holds them at the depth of the contact.

    Positions are heights above there, forces are per unit length: those of the evaluator, less the load.

    Attributes:
        mass: (k,) per unit length.
        load: per unit length.
    """

    def __init__(self, scene: Scene, contact: Contact, runs: int) -> None:
        self._model = ContactModel(_copies(scene, contact, runs))
        self._depth = contact.depth
        self._far = _FAR * contact.reach
        self._points = np.zeros((runs, 2, 3))
        self._points[:, 1, 1] = 1.0
        self.mass: FloatArray = np.full(runs, contact.mass)
        self.load = 0.0
        self.load = float(self.forces(np.zeros(runs), np.zeros(runs), None).force[0])

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`."""
        usable = np.abs(position) < self._far
        self._points[:, :, 0] = (np.where(usable, position, 0.0) - self._depth)[:, None]
        result = self._model.evaluate(self._points.reshape(-1, 3))
        force = np.where(usable, result.force - self.load, np.nan)
        return Forces(force, -result.stiffness, np.zeros(velocity.shape), history)


def _copies(scene: Scene, contact: Contact, runs: int) -> ContactInput:
    """Elements on the curve of the contact, else with its stiffness: a node's is spread over its length.

    A small swing on an unloading line is one on a spring.
    """
    arrays, element = scene.law_arrays(), contact.element
    law = LawAssignment("linear", np.arange(runs), {"stiffness": contact.stiffness})
    if arrays.law[element] == LawKind.CURVE and not contact.unloading:
        law = LawAssignment("curve", np.arange(runs), {"curve": arrays.curve_index[element]})
    return ContactInput(
        node_ids=np.arange(1, 2 * runs + 1),
        coordinates=np.zeros((2 * runs, 3)),
        element_ids=np.arange(1, runs + 1),
        element_nodes=np.arange(2 * runs).reshape(runs, 2),
        length=np.ones(runs),
        diameter=np.full(runs, scene.diameter[element]),
        laws=(law,),
        curves=arrays.curves,
    )
