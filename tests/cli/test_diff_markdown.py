"""`mudline diff --output-format markdown`, rendered as GitHub and GitLab do: CommonMark."""

from __future__ import annotations

from html import unescape

import pytest

from mudline.cli import diff_command
from mudline.cli.diff_command import code, fenced
from tests.builders.decks import BAD_NUMBER, CLEAN
from tests.cli.conftest import Place
from tests.cli.runner import run

HOSTILE = ("a|b", "`", "``a`", "*a* _b_ ~~c~~", "<script>alert(1)</script>", "@all #12 $x^2$", "[a](http://b)", "&amp;")
BLOCKS = ("</code></details>", "a\n```\n# b", "````")


def rendered(text: str) -> str:
    """The HTML of a text."""
    return str(pytest.importorskip("markdown_it").MarkdownIt("commonmark").render(text))


@pytest.mark.parametrize("text", [*HOSTILE, *BLOCKS])
def test_text_of_a_deck_is_code_and_nothing_else(text: str) -> None:
    if "\n" not in text:
        assert unescape(rendered(code(text))) == f"<p><code>{text}</code></p>\n"
    html = rendered(fenced([text, "b"]))
    assert html.count("<pre>") == 1
    assert unescape(html) == f'<pre><code class="language-diff">{text}\nb\n</code></pre>\n'


def test_a_text_that_does_not_print_has_marks() -> None:
    assert code("a\x1b[31m\tb") == "`a\ufffd[31m b`"
    assert code("") == ""


def test_two_decks(place: Place) -> None:
    ran = run("diff", place(), place(CLEAN.replace("1000.0", "1200.0"), "b.keyxm"), "--output-format", "markdown")
    assert ran.code == 1
    assert ran.out == (
        "### Differences of decks\n\n`deck.keyxm` → `b.keyxm`: **1 difference**\n\n"
        "```diff\ncurves\n~ Clay/0.1: 1000.0 -> 1200.0  (line -25 +25)\n```\n"
    )
    same = run("diff", "deck.keyxm", "deck.keyxm", "--output-format", "markdown")
    assert (same.code, same.out) == (0, "### Differences of decks\n\n`deck.keyxm` → `deck.keyxm`: **no difference**\n")


def test_two_folders(place: Place) -> None:
    for name, old, new in (("a", CLEAN, CLEAN.replace("1000.0", "1200.0")), ("b", CLEAN, BAD_NUMBER)):
        place(old, f"old/{name}.keyxm")
        place(new, f"new/{name}.keyxm")
    place(CLEAN, "new/c.keyxm")
    ran = run("diff", "old", "new", "--output-format", "markdown")
    assert ran.code == 1
    assert ran.out == (
        "### Differences of decks\n\n`old` → `new`: **3 decks: 1 changed, 1 added, 1 cannot be compared**\n\n"
        "```diff\n--- old/a.keyxm\n+++ new/a.keyxm\ncurves\n~ Clay/0.1: 1000.0 -> 1200.0  (line -25 +25)\n"
        "! b.keyxm: cannot be compared\n+ c.keyxm: only in the second folder\n```\n"
    )


def test_what_does_not_fit_a_comment_is_left_out(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(diff_command, "LONGEST", 300)
    for number in range(5):
        place(CLEAN, f"old/{number}.keyxm")
        place(CLEAN.replace("1000.0", "1200.0"), f"new/{number}.keyxm")
    out = run("diff", "old", "new", "--output-format", "markdown").out
    assert len(out) < 300 + 100
    assert out.endswith("```\n\n*The rest does not fit here: `mudline diff -v` prints all.*\n")
    whole = run("diff", "-v", "old", "new", "--output-format", "markdown").out
    assert whole.count("Clay/0.1") == 5
    assert whole.endswith("```\n")
