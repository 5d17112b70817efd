"""Pictures of a page: inline SVG, or PNG if that is smaller. Needs matplotlib."""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Callable, Iterator
from functools import partial
from io import BytesIO
from typing import NamedTuple
from xml.etree import ElementTree as ET

import matplotlib as mpl
from matplotlib.figure import Figure

from mudline.checks.output import visible
from mudline.model.results.plots import can_draw, evaluation_figure, model_figure
from mudline.model.results.plots.curves import curves_figure
from mudline.model.results.plots.style import save
from mudline.model.scene.curves import OF_SEABED
from mudline.tools.reporting.content import PageContent

MOST_PICTURES = 20
MOST_SINGLE, _MOST_TOGETHER = 2, 12
"""Numbers of seabed curves with a picture of their own before the appendix, and in the one picture of more curves."""
MOST_BYTES = 600_000
"""Bytes of all pictures of a page, which is to be sent by mail."""
_LARGEST_SVG = 120_000

_REFERENCE = re.compile(r"url\(#([^)]+)\)")


class Picture(NamedTuple):
    """A picture: its section, its description in words, and its markup."""

    section: str
    alternative: str
    markup: str


def pictures_of(report: PageContent) -> tuple[list[Picture], int]:
    """Return the pictures of a page, and the number of those left out."""
    pictures: list[Picture] = []
    size = left = 0
    for number, (section, alternative, draw) in enumerate(_drawings(report)):
        if len(pictures) == MOST_PICTURES or size > MOST_BYTES:
            left += 1
            continue
        markup = _markup(draw(), f"p{number}", alternative)
        size += len(markup)
        pictures.append(Picture(section, alternative, markup))
    return pictures, left


def _drawings(report: PageContent) -> Iterator[tuple[str, str, Callable[[], Figure]]]:
    """Yield each picture of the sections, the most important first, and the function that draws it."""
    scene, sections, drawn, study = report.scene, report.json["sections"], report.drawn, report.study
    if scene is None:
        return
    if sections.get("model") and can_draw(scene):
        shape = "at its resting shape" if report.at_rest and drawn is not None else "in the deck's own coordinates"
        words = f"Elevation and plan of the line {shape}, by set, over the seabed"
        yield "model", words, partial(model_figure, scene, drawn)
    if sections.get("contact") and drawn is not None:
        words = "Contact along the line: its height, the seabed reaction, embedment and stiffness"
        yield "contact", words, partial(evaluation_figure, drawn, report.doubt)
    if study is not None and study.drawable:
        words = "Error of the touchdown zone against run time, with the deck's own time step"
        yield "study", words, study.figure
    rows = (sections.get("curves") or {}).get("curves", ())
    of_seabed = [row for row in rows if row["kind"] == OF_SEABED]
    if several := len(of_seabed) > MOST_SINGLE:
        followed = {law["law"] for law in sections["curves"]["laws"] if law["elements"]}
        of_seabed.sort(key=lambda row: f"curve:{row['name']}" not in followed)
        words = f"{min(_MOST_TOGETHER, len(of_seabed))} of {len(of_seabed)} force-embedment curves"
        yield "curves", words, partial(curves_figure, of_seabed[:_MOST_TOGETHER], scene.units)
    for row in rows:
        words = f"The {row['kind']} {visible(row['name'])}: {row['axes'][1]} over {row['axes'][0]}"
        section = "curves" if row["kind"] == OF_SEABED and not several else "appendix"
        yield section, words, partial(curves_figure, [row], scene.units)


def _markup(figure: Figure, prefix: str, alternative: str) -> str:
    """Return SVG without the parts that a page does not need; a large picture as PNG, whose size is bounded."""
    stream = BytesIO()
    with mpl.rc_context({"svg.fonttype": "none"}):  # texts stay texts
        save(figure, "svg", stream)
    root = ET.fromstring(stream.getvalue())  # noqa: S314 - matplotlib made it
    _strip(root, prefix)
    root.attrib.update({"role": "img", "aria-label": alternative})
    for name in ("width", "height", "version"):
        root.attrib.pop(name, None)
    text = ET.tostring(root, encoding="unicode")
    if len(text) <= _LARGEST_SVG:
        return text
    stream = BytesIO()
    save(figure, "png", stream)
    image = ET.Element("img", src=f"data:image/png;base64,{b64encode(stream.getvalue()).decode()}", alt=alternative)
    return ET.tostring(image, encoding="unicode", method="html")


def _strip(root: ET.Element, prefix: str) -> None:
    """Remove namespaces and metadata, and make ids differ from those of other pictures."""
    for element in list(root.iter()):
        element.tag = element.tag.rpartition("}")[2]
        for child in element.findall("{*}metadata"):
            element.remove(child)
        for name, value in list(element.attrib.items()):
            short, mark = name.rpartition("}")[2], "#" if name.endswith("href") else ""
            del element.attrib[name]
            own = short == "id" or (mark and value.startswith(mark))
            renamed = f"{mark}{prefix}-{value.removeprefix(mark)}" if own else value
            element.set(short, _REFERENCE.sub(rf"url(#{prefix}-\1)", renamed))
