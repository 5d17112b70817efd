"""The stretch of arc length that all panels along the lines show, and the lines that are drawn."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from matplotlib.axes import Axes

from mudline.quantities import labelled, unit_names
from mudline.results.plot_data import PlotData
from mudline.results.plots.style import (
    COLORS,
    Style,
    is_number,
    style_of,
)
from mudline.scene.numbering import Floats, Indices, Mask

MOST_LINES = 6
"""Lines that are drawn."""
_BESIDE = 0.15
"""Part of the stretch in contact that is drawn on both sides of it."""


@dataclass(frozen=True)
class Stretch:
    """The lines that are drawn, and the stretch of arc length that all panels along them show."""

    data: PlotData

    @cached_property
    def lines(self) -> list[int]:
        """The numbers, from 0, of the lines that are drawn: those that touch the seabed first."""
        data = self.data
        of_touched = set(data.given.lines.of_element[data.touched].tolist())
        ranked = sorted(data.lines, key=lambda line: (line not in of_touched, line))
        return sorted(ranked[:MOST_LINES])

    @property
    def left_out(self) -> int:
        """The number of lines that are not drawn."""
        return self.data.more_lines + len(self.data.lines) - len(self.lines)

    @cached_property
    def limits(self) -> tuple[float, float]:
        """The least and the largest arc length that is drawn."""
        given, lines = self.data.given, self.data.given.lines
        drawn = np.isin(lines.of_element, self.lines) & self._evaluated
        half = 0.5 * given.length
        begin, end = lines.element_arc - half, lines.element_arc + half
        first, last = float(begin[drawn].min()), float(end[drawn].max())
        touching = drawn & self.data.touched
        if not touching.any():
            return first, last
        low, high = float(begin[touching].min()), float(end[touching].max())
        beside = max(_BESIDE * (high - low), 2.0 * float(given.length[touching].max()))
        return max(first, low - beside), min(last, high + beside)

    def elements(self, line: int) -> tuple[Indices, Floats]:
        """The evaluated elements of a line within the stretch and one beside it, and the arc lengths there."""
        lines = self.data.given.lines
        along = lines.elements[line]
        along = along[self._evaluated[along]]
        arcs = lines.element_arc[along]
        within = self._within(arcs)
        return along[within], arcs[within]

    def nodes(self, line: int) -> tuple[Indices, Floats]:
        """The nodes of a line within the stretch and one beside it, along the line, and their arc lengths."""
        lines = self.data.given.lines
        arcs = lines.node_arcs(line, self.data.given.length)
        within = self._within(arcs)
        return lines.nodes[line][within], arcs[within]

    def name(self, line: int) -> str:
        """What a line is called in a legend."""
        ids = self.data.given.element_ids[self.data.given.lines.elements[line]]
        return f"line {line + 1}: elements {ids[0]} to {ids[-1]}"

    @cached_property
    def _evaluated(self) -> Mask:
        found = np.zeros(len(self.data.given.element_ids), np.bool_)
        found[self.data.elements] = True
        return found

    def _within(self, arcs: Floats) -> slice:
        low, high = self.limits
        inside = np.flatnonzero((arcs >= low) & (arcs <= high))
        if not inside.size:
            return slice(0, 0)
        return slice(max(0, int(inside[0]) - 1), int(inside[-1]) + 2)

    def show(self, axes: Axes) -> None:
        """Set the horizontal axis."""
        low, high = self.limits
        beside = 0.01 * (high - low) or 0.5
        if is_number(low) and is_number(high):
            axes.set_xlim(low - beside, high + beside)
        axes.set_xlabel(labelled("arc length along the line", unit_names(self.data.given.units).length))

    def style(self, place: int) -> Style:
        """How the line at a place among the drawn ones is drawn: a single one solid, several differ in all."""
        return style_of(place) if len(self.lines) > 1 else Style(COLORS[0], "-", "o")
