"""The evaluator: from positions to contact forces, with only the stages that an input needs."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mudline.contact import floor
from mudline.contact.arrays import FloatArray
from mudline.contact.errors import ElementError
from mudline.contact.inputs import ContactInput
from mudline.contact.plan import Plan, make_plan
from mudline.contact.positions import as_mask, as_series, read_steps
from mudline.contact.result import ContactResult, blank_result
from mudline.contact.stages import make_assembly, make_normal_law

_CHUNK = 16384
"""Elements or nodes, times steps, evaluated at a time: the work arrays stay in the second-level cache."""


class ContactModel:
    """Contact of the elements of an input with one flat bed at X = 0. Holds no state; may be shared by threads.

    Laws per unit length act on an element: depth is the mean of its two nodes' depths, and each node takes half of the
    force. (So a line whose nodes lie alternately by the same distance above and below their mean feels no change.)

    Attributes:
        input: what the model was made from.
        plan: the stages, active or not, and why.
    """

    def __init__(self, inputs: ContactInput) -> None:
        self.input = inputs
        self.plan: Plan = make_plan(inputs)
        self._first, self._second = inputs.element_nodes.T
        self._no_diameter = np.isnan(inputs.diameter)
        self._normal_law = make_normal_law(inputs)
        self._assembly = make_assembly(inputs, self._normal_law)

    def evaluate(self, positions: ArrayLike | None = None, *, present: ArrayLike | None = None) -> ContactResult:
        """Evaluate positions (n, 3), or all steps (steps, n, 3) at once; None stands for the input's coordinates.

        Positions are real numbers of any type, in the input's length unit, X up; a memory-mapped series is read a few
        steps at a time. `present` (n,) says which nodes have a position: what stands at the others is not looked at,
        elements with one of them are left out, and a node's reaction is that of the elements that are evaluated.

        Raises:
            PositionError: a position is NaN or infinite.
            ElementError: a value of an element overflows.
            ValueError: `positions` or `present` do not have the shape or type they should.
        """
        given = self.input.coordinates if positions is None else positions
        nodes = len(self.input.node_ids)
        series, mask = as_series(given, nodes), as_mask(present, nodes)
        result = blank_result(len(series), mask[self._first] & mask[self._second], mask)
        rows = max(1, _CHUNK // max(nodes, len(self.input.element_ids), 1))
        with np.errstate(all="ignore"):  # everything that can overflow is checked
            for start in range(0, len(series), rows):
                steps = range(start, min(start + rows, len(series)))
                points = read_steps(series, steps, self.input.node_ids, mask)
                self._evaluate_steps(points, result.steps(steps.start, steps.stop), start)
        return result if np.ndim(given) == 3 else result.step(0)

    def _evaluate_steps(self, points: FloatArray, part: ContactResult, first_step: int) -> None:
        floor.gaps(points, out=part.gap)
        self._embed(part, first_step)
        part.slope[:, self._no_diameter] = np.nan
        if self._normal_law is not None:
            self._normal_law.apply(part, first_step)
        if self._assembly is not None:
            self._assembly.apply(part, first_step)
        self._blank_absent(part)

    def _embed(self, part: ContactResult, first_step: int) -> None:
        """Depth, ratio and contact of the elements from the gaps of the nodes."""
        part.depth[...] = 0.5 * part.gap[:, self._first]  # halves first: their sum cannot overflow
        part.depth[...] += 0.5 * part.gap[:, self._second]
        np.subtract(0.0, part.depth, out=part.depth)
        np.divide(part.depth, self.input.diameter, out=part.ratio)
        np.greater(part.depth, 0.0, out=part.contact)
        infinite = np.argwhere(np.isinf(part.ratio))
        if infinite.size:
            row, column = infinite[0].tolist()
            element, step = int(self.input.element_ids[column]), first_step + row
            raise ElementError(f"element {element} at step {step}: its embedment ratio overflows", element, step)

    @staticmethod
    def _blank_absent(part: ContactResult) -> None:
        """Leave no number where there was no position; depth, ratio and gap are NaN already."""
        if part.present.all():
            return
        for on_elements in (part.force, part.slope, part.stiffness):
            on_elements[:, ~part.evaluated] = np.nan
        part.normal_force[:, ~part.present] = np.nan
        part.reaction[:, ~part.present] = np.nan
