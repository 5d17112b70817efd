"""The pictures of a page: SVG that stands in it, or PNG where that is smaller. Needs matplotlib."""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Callable, Iterator
from functools import partial
from io import BytesIO
from typing import Any, BinaryIO, NamedTuple
from xml.etree import ElementTree as ET

import matplotlib as mpl

from mudline.linting.output import visible
from mudline.report.content import Report
from mudline.results.plots import draw_curves, draw_evaluation
from mudline.results.plots.model import can_draw, draw_model
from mudline.study.picture import draw as draw_study

MOST_PICTURES = 20
MOST_BYTES = 600_000
"""Of all pictures of a page, which is to be sent by mail."""
_LARGEST_SVG = 120_000

Draw = Callable[[str, BinaryIO], None]
_REFERENCE = re.compile(r"url\(#([^)]+)\)")
_DROPPED = ("metadata",)
_SETTINGS: dict[Any, Any] = {"svg.fonttype": "none", "svg.hashsalt": "mudline"}
"""Of matplotlib: texts stay texts, and the same picture has the same ids."""


class Picture(NamedTuple):
    """A picture: which section it is in, what it shows in words, and its markup."""

    section: str
    alternative: str
    markup: str


def pictures_of(report: Report) -> tuple[list[Picture], int]:
    """The pictures of a page, and how many were left out of it."""
    made: list[Picture] = []
    size = left = 0
    for number, (section, alternative, draw) in enumerate(_drawings(report)):
        if len(made) == MOST_PICTURES or size > MOST_BYTES:
            left += 1
            continue
        markup = _markup(draw, f"p{number}", alternative)
        size += len(markup)
        made.append(Picture(section, alternative, markup))
    return made, left


def _drawings(report: Report) -> Iterator[tuple[str, str, Draw]]:
    """Each picture that the sections have, the most telling first, and what draws it."""
    scene, found = report.scene, report.json["sections"]
    if scene is None:
        return
    if found.get("model") and can_draw(scene):
        words = "Elevation and plan of the line in the deck's own coordinates, by set, over the seabed"
        yield "model", words, lambda form, stream: draw_model(scene, report.drawn, form, stream, visible)
    if found.get("contact") and report.drawn is not None:
        words = "Contact along the line: its height, the seabed reaction, embedment and stiffness"
        drawn, doubt = report.drawn, report.doubt
        yield "contact", words, lambda form, stream: draw_evaluation(drawn, form, stream, visible, doubt)
    if report.study is not None and report.study.drawn is not None and report.study.drawn.curves:
        study, words = report.study, "Error against run time of three schemes on the stiffest contacts of the deck"
        yield "study", words, lambda form, stream: draw_study(study, form, stream, visible)
    for row in (found.get("curves") or {}).get("curves", ()):
        words = f"The {row['kind']} {visible(row['name'])}: {row['axes'][1]} over {row['axes'][0]}"
        named = row | {"name": visible(row["name"])}
        yield "curves", words, partial(_draw_curve, named, scene.units)


def _draw_curve(row: dict[str, object], units: str, form: str, stream: BinaryIO) -> None:
    draw_curves([row], units, form, stream)


def _markup(draw: Draw, prefix: str, alternative: str) -> str:
    """SVG without what it does not need inside a page; a large one as PNG, whose size has a bound."""
    stream = BytesIO()
    with mpl.rc_context(_SETTINGS):
        draw("svg", stream)
    root = ET.fromstring(stream.getvalue())  # noqa: S314 - matplotlib made it
    _strip(root, prefix)
    root.attrib.update({"role": "img", "aria-label": alternative})
    for name in ("width", "height", "version"):
        root.attrib.pop(name, None)
    text = ET.tostring(root, encoding="unicode")
    if len(text) <= _LARGEST_SVG:
        return text
    stream = BytesIO()
    draw("png", stream)
    image = ET.Element("img", src=f"data:image/png;base64,{b64encode(stream.getvalue()).decode()}", alt=alternative)
    return ET.tostring(image, encoding="unicode", method="html")


def _strip(element: ET.Element, prefix: str) -> None:
    """Drop namespaces and metadata, and make ids differ from those of other pictures."""
    element.tag = element.tag.rpartition("}")[2]
    for child in list(element):
        if child.tag.rpartition("}")[2] in _DROPPED:
            element.remove(child)
        else:
            _strip(child, prefix)
    for name, value in list(element.attrib.items()):
        del element.attrib[name]
        short = name.rpartition("}")[2]
        mark = {"id": "", "href": "#"}.get(short)
        own = mark is not None and value.startswith(mark)
        element.set(short, f"{mark}{prefix}-{value[len(mark or '') :]}" if own else _renamed(value, prefix))


def _renamed(value: str, prefix: str) -> str:
    return _REFERENCE.sub(rf"url(#{prefix}-\1)", value)
