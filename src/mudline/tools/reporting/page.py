"""HTML of a page, from tables and pictures of its content and jinja2 templates, which escape every text.

Needs jinja2 and matplotlib.
"""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from io import BytesIO
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree as ET

import jinja2
import matplotlib as mpl
from jinja2.sandbox import SandboxedEnvironment
from markupsafe import Markup
from matplotlib.figure import Figure

from mudline.basics.display import DisplayTable, number, text
from mudline.basics.short_repr import counted, cut
from mudline.checks.configuration import SEVERITIES
from mudline.checks.output import visible
from mudline.model.results.plots import can_draw, evaluation_figure, model_figure
from mudline.model.results.plots.curves import curves_figure
from mudline.model.results.plots.style import save
from mudline.model.scene.curves import OF_SEABED
from mudline.tools.reporting.content import Look, LookError, PageContent
from mudline.tools.reporting.tables import LONGEST, figure_table, four_digits, on_page, page_tables
from mudline.tools.touchdown_study.screen import description, sentences

MOST_FINDINGS = 500
_FEW_FINDINGS, _FEW_INFERRED = 6, 20
"""Findings and deductions before the appendix, which has all."""
_MOST_RULES = 16
"""Rules behind many findings that a page lists."""
_LONGEST_LINE = 160
"""Characters of a line of the deck that a page shows."""
_AROUND = 1
"""Lines of the deck shown above and below that of a finding."""


def page(report: PageContent, look: Look) -> str:
    """Return the page about a deck. Raises LookError."""
    content = report.json
    tables, details = page_tables(report)
    figures, document = content.get("figures"), content["document"]
    revision = f"revision {document['revision']}" if document["revision"] else None
    findings = _groups(report, "reported", lambda severity: severity != "info")
    hidden = _groups(report, "hidden")
    study, study_texts = report.study, [""]
    if study is not None:
        study_texts = [description(study), *(words for part in study.parts for words in sentences(study, part))]
    pictures, pictures_left = pictures_of(report)
    return rendered(
        look,
        "page.html",
        report=content,
        tables=tables,
        details=details,
        figures=figure_table(figures, content["units"]) if figures and not figures["missing"] else None,
        head=_css_text(", ".join(filter(None, [document["number"], revision, content["deck"]]))),
        hash=_css_text(f"SHA-256 {content['sha256'][:_SHORT_HASH]}"),
        study_texts=[text for text in study_texts if text],
        findings=findings,
        infos=_groups(report, "reported", lambda severity: severity == "info"),
        hidden=hidden,
        by_rule={"findings": _by_rule(report, findings), "hidden": _by_rule(report, hidden)},
        most_inferred=_FEW_INFERRED,
        rules=report.named,
        pictures=pictures,
        pictures_left=pictures_left,
        most=MOST_FINDINGS,
    )


_SHORT_HASH = 16


def _css_text(text: str) -> Markup:
    """Return a text in quotes for the style of a page; all but letters and digits are escaped."""
    plain = (letter if letter.isascii() and letter.isalnum() else f"\\{ord(letter):x} " for letter in visible(text))
    return Markup(f'"{"".join(plain)}"')  # noqa: S704 - letters, digits and character numbers


def rendered(look: Look, name: str, **values: object) -> str:
    """Return a template with values, which has the given one in place of the default. Raises LookError."""
    loaders: list[jinja2.BaseLoader] = [jinja2.PackageLoader("mudline.tools.reporting")]
    if look.template is not None:
        loaders.insert(0, jinja2.FileSystemLoader(look.template.parent))
        name = look.template.name
    # Every text of a deck passes `visible`, and is escaped after it.
    environment = SandboxedEnvironment(
        loader=jinja2.ChoiceLoader(loaders),
        autoescape=True,
        finalize=_finalized,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters |= {"number": _number, "counted": counted}
    values["logo"] = _logo(look.logo)
    try:
        return environment.get_template(name).render(values)
    except jinja2.TemplateError as error:
        where = f", line {error.lineno}" if isinstance(error, jinja2.TemplateSyntaxError) else ""
        raise LookError(f"{look.template}: the template cannot be used: {error}{where}") from error
    except OSError as error:
        raise LookError(f"{look.template}: cannot be read: {error.strerror or error}") from error


def _finalized(value: object) -> object:
    return visible(value) if type(value) is str else "" if value is None else value


def _number(value: object, longest: int) -> str:
    return four_digits(value) if isinstance(value, float) else "" if value is None else cut(str(value), longest)


_LOGOS = {".svg": ("image/svg+xml", (b"<",)), ".png": ("image/png", (b"\x89PNG",))}
_LARGEST_LOGO = 300_000


def _logo(path: Path | None) -> str:
    """Return the logo as a data URL, in which nothing can be executed."""
    if path is None:
        return ""
    if path.suffix.lower() not in _LOGOS:
        raise LookError(f"{path}: a logo is a .svg or .png file")
    form, begins = _LOGOS[path.suffix.lower()]
    try:
        data = path.read_bytes()
    except OSError as error:
        raise LookError(f"{path}: cannot be read: {error.strerror or error}") from error
    if not data.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(begins) or len(data) > _LARGEST_LOGO:
        raise LookError(f"{path}: expected a {path.suffix[1:].upper()} image of at most {_LARGEST_LOGO // 1000} kB")
    return f"data:{form};base64,{b64encode(data).decode()}"


# ------------------------------------------------------------------------------------------------------------- findings


Shown = dict[str, Any]
"""A finding on the page: its `number`, what was `found`, and `lines` of the deck with their numbers."""


def _groups(
    report: PageContent, kind: str, wanted: Callable[[str], bool] = lambda _: True
) -> list[tuple[str, list[Shown]]]:
    """Return the first findings by section of the deck, of the severities that `wanted` accepts."""
    findings = (report.json["sections"].get("findings") or {}).get(kind, [])[:MOST_FINDINGS]
    rows = [
        {
            "number": number,
            "found": finding | {"message": cut(finding["message"], LONGEST)},
            "lines": _lines(report, finding["line"]),
        }
        for number, finding in enumerate(findings, 1)
        if wanted(finding["severity"])
    ]
    return [(name, list(group)) for name, group in groupby(rows, key=lambda row: str(row["found"]["section"]))]


def _by_rule(report: PageContent, groups: Sequence[tuple[str, Sequence[Shown]]]) -> DisplayTable | None:
    """Return many findings as a table of the rules behind them, errors first; None for few findings."""
    findings = [shown["found"] for _, group in groups for shown in group]
    if len(findings) <= _FEW_FINDINGS:
        return None
    codes = sorted({(SEVERITIES.index(finding["severity"]), finding["code"]) for finding in findings})
    lines = [(at, code, [finding["line"] for finding in findings if finding["code"] == code]) for at, code in codes]
    columns = (
        text("severity", lambda row: SEVERITIES[row[0]]),
        text("code", 1),
        text("rule", lambda row: report.named[row[1]] or "The file cannot be read as a deck."),
        number("findings", lambda row: len(row[2])),
        text("lines", lambda row: ", ".join(map(str, row[2][:_FEW])) + (" ..." if len(row[2]) > _FEW else "")),
    )
    return on_page(DisplayTable("By rule", columns, lines), _MOST_RULES, LONGEST)


_FEW = 4
"""Lines of findings that are listed."""


def _lines(report: PageContent, line: int) -> list[tuple[int, str]]:
    last = len(report.source.line_starts)
    around = range(max(1, line - _AROUND), min(last, line + _AROUND) + 1)
    return [(number, cut(report.source.line(number), _LONGEST_LINE)) for number in around]


# ------------------------------------------------------------------------------------------------------------- pictures

_MOST_PICTURES = 20
_MOST_SINGLE, _MOST_TOGETHER = 2, 12
"""Numbers of seabed curves with a picture of their own before the appendix, and in the one picture of more curves."""
_MOST_BYTES = 600_000
"""Bytes of all pictures of a page, which is to be sent by mail."""
_LARGEST_SVG = 120_000

_REFERENCE = re.compile(r"url\(#([^)]+)\)")


class Picture(NamedTuple):
    """A picture: its section and its markup."""

    section: str
    markup: Markup


def pictures_of(report: PageContent) -> tuple[list[Picture], int]:
    """Return the pictures of a page, inline SVG, or PNG if that is smaller, and the number of those left out."""
    pictures: list[Picture] = []
    size = left = 0
    for place, (section, alternative, draw) in enumerate(_drawings(report)):
        if len(pictures) == _MOST_PICTURES or size > _MOST_BYTES:
            left += 1
            continue
        markup = _markup(draw(), f"p{place}", alternative)
        size += len(markup)
        pictures.append(Picture(section, Markup(markup)))  # noqa: S704 - made from our figures
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
    if several := len(of_seabed) > _MOST_SINGLE:
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
