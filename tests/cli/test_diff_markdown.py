"""`mudline diff --output-format markdown`, rendered as GitHub and GitLab do: CommonMark with tables."""

from __future__ import annotations

import re
from html import unescape

import pytest

from mudline.cli.diff_output import LONGEST, code, fenced
from tests.builders.decks import BAD_NUMBER, CLEAN
from tests.cli.conftest import Place
from tests.cli.runner import run

HOSTILE = (
    "a|b",
    "`",
    "``a`",
    " a ",
    "*a* _b_ ~~c~~",
    "<script>alert(1)</script>",
    "<!-- x",
    "@all #12 !3 $x^2$",
    "[a](http://b)",
    "![a](b)",
    "\\|",
    "a\\",
    "&amp;",
    "&#42;",
    ":smile:",
    "</code></details>",
    "a`|`b",
    "http://example.org",
)


def rendered(text: str) -> str:
    """The HTML of a text."""
    markdown = pytest.importorskip("markdown_it").MarkdownIt("commonmark").enable("table")
    return str(markdown.render(text))


@pytest.mark.parametrize("text", HOSTILE)
def test_text_of_a_deck_is_code_in_a_cell_and_nothing_else(text: str) -> None:
    html = rendered(f"| a | b |\n| --- | --- |\n| {code(text)} | c |\n")
    (body,) = re.findall(r"<tbody>\n(.*)</tbody>", html, re.DOTALL)
    cells = re.findall(r"<td>(.*?)</td>", body, re.DOTALL)
    assert [unescape(cell).replace(" ", "") for cell in cells] == [f"<code>{text.replace(' ', '')}</code>", "c"]
    assert not re.search(r"<(?!/?(?:td|tr|code)\b)", body)


@pytest.mark.parametrize("text", ["a\n```\n# b", "````", "<b>"])
def test_lines_are_fenced(text: str) -> None:
    html = rendered(fenced(text))
    assert html.count("<pre>") == 1
    assert unescape(html) == f'<pre><code class="language-text">{text}\n</code></pre>\n'


def test_a_text_that_does_not_print_has_marks() -> None:
    assert code("a\x1b[31m\tb") == "`a\ufffd[31m b`"
    assert code("") == ""


def test_two_decks(place: Place) -> None:
    ran = run("diff", place(), place(CLEAN.replace("1000.0", "1200.0"), "b.keyxm"), "--output-format", "markdown")
    assert ran.code == 1
    assert ran.out == (
        "### Differences of decks\n\n`deck.keyxm` → `b.keyxm`: **1 difference**\n\n**`curves`**\n\n"
        "| | what | before | after | lines |\n| --- | --- | --- | --- | --- |\n"
        "| changed | `Clay/0.1` | `1000.0` | `1200.0` | -25 +25 |\n"
    )
    same = run("diff", "deck.keyxm", "deck.keyxm", "--output-format", "markdown")
    assert (same.code, same.out) == (0, "### Differences of decks\n\n`deck.keyxm` → `deck.keyxm`: **no difference**\n")


def test_long_curves_are_folded_away(place: Place) -> None:
    points = "".join(f" {number / 1000}, {number}.5\n" for number in range(300))
    more = CLEAN.replace("*SEABED STIFFNESS\n", f"*SEABED STIFFNESS\n CURVE=Long|one\n{points}")
    out = run("diff", place(), place(more, "b.keyxm"), "--output-format", "markdown").out
    assert "| added | <code>Long&#124;one</code> |  | 300 points, below |" in out
    assert "<summary><code>Long&#124;one</code> after: 300 points</summary>" in out
    assert "\n0.001, 1.5\n" in out
    assert "\nand 100 more\n" in out
    html = rendered(out)
    assert html.count("<details>") == html.count("</details>") == 1


def test_long_tables_are_folded_away(place: Place) -> None:
    curves = "".join(f" CURVE=c{number}\n 0, 0\n 0.1, {number + 1}\n" for number in range(30))
    old = place(CLEAN.replace("*SEABED STIFFNESS\n", f"*SEABED STIFFNESS\n{curves}"))
    out = run("diff", old, place(name="b.keyxm"), "--output-format", "markdown").out
    assert "<summary><code>curves</code>: 30 rows</summary>" in out
    assert rendered(out).count("<table>") == 1


def test_two_folders(place: Place) -> None:
    for name, old, new in (("a", CLEAN, CLEAN.replace("1000.0", "1200.0")), ("b", CLEAN, BAD_NUMBER)):
        place(old, f"old/{name}.keyxm")
        place(new, f"new/{name}.keyxm")
    place(CLEAN, "new/c.keyxm")
    ran = run("diff", "old", "new", "--output-format", "markdown")
    assert ran.code == 1
    assert "`old` → `new`: **3 decks: 1 changed, 1 added, 1 cannot be compared**" in ran.out
    html = rendered(ran.out)
    assert html.count("<table>") == 2
    assert "<h4><code>a.keyxm</code></h4>" in html
    assert "<td>cannot be compared: <code>new/b.keyxm:6:11: SYN002" in html


def test_what_does_not_fit_a_comment_is_left_out(place: Place) -> None:
    nodes = [f" {number}, 0, {number}.123456789" for number in range(100, 1100)]
    old = "\n".join(nodes)
    for number in range(3):
        place(CLEAN.replace("*ELEMENT\n", f"*NODE\n{old}\n*ELEMENT\n"), f"old/{number}.keyxm")
        moved = old.replace(", 0, ", ", 1, ")
        place(CLEAN.replace("*ELEMENT\n", f"*NODE\n{moved}\n*ELEMENT\n"), f"new/{number}.keyxm")
    out = run("diff", "old", "new", "--output-format", "markdown").out
    assert len(out) < LONGEST + 200
    assert out.endswith("*The rest does not fit here: `mudline diff -v` prints all.*\n")
    assert "| `2.keyxm` | 1000 differences |" in out
    assert rendered(out).count("<details>") == out.count("</details>")
    assert run("diff", "-v", "old", "new", "--output-format", "markdown").out.count("| changed |") == 3000
