"""Pages of `mudline report` as tests read them, and a small deck for them."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

from mudline.cli import DONE
from tests.cli.runner import run
from tests.helpers.samples import SAMPLES

NO_STUDY = "verdict,findings,inputs,model,curves,contact,plan"
ACTING = {"script", "iframe", "object", "embed", "base", "form", "link", "a:http"}
CSP = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
ON_SOIL = Path(__file__).with_name("on-soil.keyxm").read_text(encoding="utf-8")


def long_deck() -> str:
    """The riser on a vessel on thirty curves, a set each, with thirty warnings and thirty findings that inform."""
    text = (SAMPLES / "scr-vessel.keyxm").read_text(encoding="utf-8")
    sets, laws, curves = "", "", ""
    for number in range(1, 31):
        first = 3 * number - 2 + 2 * number // 3
        sets += f" SET=Zone {number:02d}\n GEN={first}, {first + 2}\n SET=zone {number:02d}\n {first + 2}\n"
        laws += f" SET=Zone {number:02d}\n STIFFNESS=Clay {number:02d}\n FRICTION=0.25, 0.8, 0.0027, 0.1365\n"
        curves += f" CURVE=Clay {number:02d}\n 0.0, 0.0\n 0.05, {500 + 5 * number}\n 0.5, {1400 + 9 * number}\n"
    seabed = f"*SEABED PROPERTIES\n TYPE=ELASTIC\n{laws}*SEABED STIFFNESS\n{curves}"
    unknown = "".join(f"*UNHEARD OF {number}\n 1.0\n" for number in range(30))
    before, _, rest = text.partition("*SEABED PROPERTIES\n")
    after = rest[rest.index("$LOAD CASE") :]
    return before.replace("*ELEMENT SETS\n", f"*ELEMENT SETS\n{sets}") + seabed + unknown + after


class Page(HTMLParser):
    """Elements, ids, references and texts of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.ids: list[str] = []
        self.references: list[str] = []
        self.policy = self.text = ""
        self.headings: list[int] = []
        self.attributes: list[tuple[str, str | None]] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        given = dict(attrs)
        self.attributes += attrs
        if re.fullmatch(r"h[1-6]", tag):
            self.headings.append(int(tag[1]))
        if given.get("http-equiv") == "Content-Security-Policy":
            self.policy = given["content"] or ""
        self.ids += [value for name, value in attrs if name == "id" and value]
        self.references += [value for name, value in attrs if name in {"href", "src", "xlink:href"} and value]

    def handle_data(self, data: str) -> None:
        self.text += data


def checked(text: str) -> Page:
    """A page that stands alone, with one policy, unique ids and references that lead somewhere."""
    page = Page(text)
    assert page.policy == CSP
    assert not ACTING & {*page.tags}
    assert not [name for name, _ in page.attributes if name.startswith("on")]
    assert not re.search(r"https?:|//[a-z]", re.sub('base64,[^"]*', "", text))
    assert sorted(page.ids) == sorted({*page.ids})
    inside = [one[1:] for one in page.references if one.startswith("#")]
    assert {*inside} <= {*page.ids}
    assert all(one.startswith(("#", "data:image/")) for one in page.references)
    assert page.headings[0] == 1
    assert all(after - before <= 1 for before, after in zip(page.headings, page.headings[1:], strict=False))
    return page


def made(tmp_path: Path, *words: str, sections: str = NO_STUDY, code: int = DONE) -> str:
    target = tmp_path / "out.html"
    outcome = run("report", *words, "-o", str(target), "--sections", sections, "-q")
    assert (outcome.code, outcome.err) == (code, "")
    return target.read_text(encoding="utf-8")


def content(*words: str, sections: str = NO_STUDY) -> dict[str, Any]:
    outcome = run("report", *words, "--output-format", "json", "--sections", sections)
    (found,) = json.loads(outcome.out)["reports"]
    assert isinstance(found, dict)
    return found


def row_of(text: str, first: str) -> str:
    """The text of the row of a table that begins with a cell."""
    row = re.search(rf"<tr[^>]*><td[^>]*>{re.escape(first)}</td>.*?</tr>", text, re.DOTALL)
    assert row is not None, first
    return " | ".join(re.findall(r"<td[^>]*>(.*?)</td>", row[0]))
