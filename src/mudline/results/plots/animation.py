"""A series as moving pictures, GIF or HTML: the line on the seabed, and the seabed reaction along it, step by step."""

from __future__ import annotations

import base64
import html
import io
import warnings
from collections.abc import Iterator
from typing import Any, BinaryIO

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from PIL import Image

from mudline.quantities import ELEMENTS, NODES
from mudline.results.plot_data import Frame, PlotData
from mudline.results.plots.along_line import highest
from mudline.results.plots.stretch import Stretch
from mudline.results.plots.style import SEABED, SETTINGS, Spelled, above, finish, is_number, when
from mudline.scene.numbering import Floats, Indices

_DPI = 90
_MILLISECONDS = 100
"""How long a frame is shown."""
_COLOURS = 64
"""Of a GIF: few, so that it stays small."""


def draw_animation(data: PlotData, form: str, stream: BinaryIO, spelled: Spelled) -> None:
    """Write the frames that were kept as "gif" or "html"; the same ones give the same bytes."""
    with mpl.rc_context(SETTINGS), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a letter that the font lacks becomes a box
        pictures = _Pictures(data, spelled)
        if form == "gif":
            first, *others = [each.quantize(_COLOURS, dither=Image.Dither.NONE) for each in pictures]
            first.save(stream, "GIF", save_all=True, append_images=others, duration=_MILLISECONDS, loop=0)
        else:
            _write_html(list(pictures), pictures.titles, stream)


class _Pictures:
    """The frames, drawn one after the other on the same figure."""

    def __init__(self, data: PlotData, spelled: Spelled) -> None:
        self.data = data
        stretch = Stretch(data)
        source = "" if data.given.names is None else spelled(data.given.names.source)
        self.titles = [f"Seabed contact of {source} at {when(data, frame.step)}" for frame in data.frames]
        self._figure = Figure(figsize=(8.0, 5.6), dpi=_DPI)
        line, force = self._figure.subplots(2, 1, gridspec_kw={"height_ratios": [1.2, 1.0]})
        legend = 0.04 * -(-(len(stretch.lines) + 1) // 2)  # of the height, for rows of two names
        self._figure.subplots_adjust(left=0.13, right=0.97, top=0.91 - legend, bottom=0.1, hspace=0.12)
        self._title = self._figure.suptitle("")
        self._title.set_parse_math(False)
        self._rows = [_Rows(data, stretch, place, number) for place, number in enumerate(stretch.lines)]
        for place, rows in enumerate(self._rows):
            rows.begin(line, force, None if place else "seabed")
        most = highest(data)
        _limits(line, [values for rows in self._rows for frame in data.frames for values in rows.seen(frame, most)])
        _limits(force, [rows.forces(frame) for rows in self._rows for frame in data.frames])
        line.set_ylabel(NODES["x"].axis(data.given.units))
        force.set_ylabel(ELEMENTS["force"].axis(data.given.units))
        for axes in (line, force):
            stretch.show(axes)
            finish(axes)
        line.set_xlabel("")
        line.tick_params(labelbottom=False)
        above(line, 2)
        self._canvas: Any = FigureCanvasAgg(self._figure)  # its methods have no types

    def __iter__(self) -> Iterator[Image.Image]:
        for title, frame in zip(self.titles, self.data.frames, strict=True):
            self._title.set_text(title)
            for rows in self._rows:
                rows.show(frame)
            self._canvas.draw()
            yield Image.fromarray(np.asarray(self._canvas.buffer_rgba())[..., :3].copy())


class _Rows:
    """A line in the frames: which of their nodes and elements are its own, and what is drawn of them."""

    def __init__(self, data: PlotData, stretch: Stretch, place: int, number: int) -> None:
        lines = data.given.lines
        nodes, arcs = stretch.nodes(number)
        self._nodes, kept = _among(data.frame_nodes, nodes)
        self._arcs = arcs[kept]
        elements = stretch.elements(number)
        self._elements, kept = _among(data.frame_elements, elements)
        self._middles = lines.element_arc[elements[kept]]
        self._style = stretch.style(place)
        self._name = stretch.name(number) if len(stretch.lines) > 1 else "line"
        self._drawn: list[Line2D] = []

    def begin(self, line: Axes, force: Axes, label: str | None) -> None:
        """Put the lines to be moved on the axes; `label` is that of the seabed."""
        style = self._style
        drawn: dict[str, Any] = {"color": style.color, "linestyle": style.linestyle, "linewidth": 1.6}
        (seabed,) = line.plot(self._arcs, self._arcs, color=SEABED, linewidth=1.2, label=label)
        (pipe,) = line.plot(self._arcs, self._arcs, label=self._name, **drawn)
        (push,) = force.plot(self._middles, self._middles, **drawn)
        self._drawn = [seabed, pipe, push]

    def heights(self, frame: Frame) -> tuple[Floats, Floats]:
        """Those of the seabed and of the line."""
        return frame.seabed[self._nodes], frame.height[self._nodes]

    def seen(self, frame: Frame, most: float) -> tuple[Floats, Floats]:
        """Those of the seabed, and of the line where it is not too far above; all of it, where nothing is near."""
        seabed, height = self.heights(frame)
        near = height - seabed <= most
        return seabed, height[near] if near.any() else height

    def forces(self, frame: Frame) -> Floats:
        """Those of the elements."""
        return frame.force[self._elements]

    def show(self, frame: Frame) -> None:
        """Move what is drawn to a frame."""
        for line, values in zip(self._drawn, (*self.heights(frame), self.forces(frame)), strict=True):
            line.set_ydata(values)


def _among(kept: Indices, wanted: Indices) -> tuple[Indices, Indices]:
    """Where those of some indices that are kept stand among the kept ones, and among the wanted."""
    at = np.minimum(np.searchsorted(kept, wanted), len(kept) - 1)
    found = np.flatnonzero(kept[at] == wanted)
    return at[found], found


def _limits(axes: Axes, values: list[Floats]) -> None:
    """Make all frames fit on the vertical axis."""
    every = np.concatenate(values) if values else np.zeros(0)
    every = every[np.isfinite(every)]
    if not every.size:
        return
    low, high = float(every.min()), float(every.max())
    beside = 0.06 * (high - low) or 0.5
    if is_number(low) and is_number(high):
        axes.set_ylim(low - beside, high + beside)


def _write_html(pictures: list[Image.Image], titles: list[str], stream: BinaryIO) -> None:
    """Write one page that holds all frames, with a slider and a button."""
    frames = []
    for picture in pictures:
        held = io.BytesIO()
        picture.quantize(_COLOURS, dither=Image.Dither.NONE).save(held, "PNG", optimize=True)
        frames.append(f'"data:image/png;base64,{base64.b64encode(held.getvalue()).decode("ascii")}"')
    title = titles[0].partition(" at ")[0]
    page = _PAGE.format(title=html.escape(title), last=len(frames) - 1, wait=_MILLISECONDS, frames=",\n".join(frames))
    stream.write(page.encode("utf-8", "backslashreplace"))


_PAGE = """\
<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<title>{title}</title>
<style>body {{ font-family: sans-serif; max-width: 720px; margin: 1em auto; }} img {{ width: 100%; }}
p {{ display: flex; gap: 1em; }} input {{ flex: 1; }}</style>
<img id="frame" alt="{title}">
<p><button id="play">pause</button><input id="step" type="range" min="0" max="{last}" value="0"></p>
<script>
const frames = [
{frames}
];
const picture = document.getElementById("frame"), step = document.getElementById("step");
const button = document.getElementById("play");
let timer = null;
function show() {{ picture.src = frames[+step.value]; }}
function advance() {{ step.value = (+step.value + 1) % frames.length; show(); }}
function toggle() {{
  if (timer) {{ clearInterval(timer); timer = null; }} else {{ timer = setInterval(advance, {wait}); }}
  button.textContent = timer ? "pause" : "play";
}}
button.onclick = toggle;
step.oninput = show;
show();
toggle();
</script>
</html>
"""
