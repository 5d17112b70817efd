"""Which rules a selection holds, and where their pages are."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest

from mudline.checks import pages
from mudline.checks.pages import page
from mudline.checks.registry import UnknownRule, rules, select
from mudline.language.rules import Rule


def _codes(chosen: tuple[Rule, ...]) -> list[str]:
    return [rule.code.code for rule in chosen]


def test_nothing_chosen_means_every_rule_that_is_on() -> None:
    assert _codes(select()) == sorted(rule.code.code for rule in rules() if not rule.off)


@pytest.mark.parametrize("word", ["SYN002", "syn002", " SYN002 ", "bad-number", "Bad-Number"])
def test_a_code_or_a_slug_in_any_case_names_one_rule(word: str) -> None:
    assert _codes(select([word])) == ["SYN002"]


def test_a_prefix_names_all_rules_that_begin_with_it() -> None:
    assert _codes(select(["syn00"])) == [f"SYN00{digit}" for digit in range(1, 10)]
    assert set(_codes(select(["SYN", "LEG"]))) == {code for code in _codes(rules()) if code[:3] in ("SYN", "LEG")}


def test_ignored_rules_are_left_out_whatever_names_them() -> None:
    assert _codes(select(["SYN00"], ["SYN002", "unreadable-line"]))[0] == "SYN003"
    assert "LEG001" not in _codes(select(ignored=["LEG"]))
    assert "LEG001" not in _codes(select(ignored=["LEG"], also=["LEG001"]))


@pytest.mark.parametrize(
    ("word", "hint"),
    [
        ("SYN0002", "did you mean SYN002?"),
        ("syn099x", "did you mean SYN00"),
        ("bad-numbers", "did you mean bad-number?"),
        ("Unkown-Keyword", "did you mean unknown-keyword?"),
        ("REFX", "did you mean REF?"),
        ("crb", "did you mean CRV?"),
        ("Unloading", "did you mean soft-unloading or unloading-conflict?"),
        ("zzz", "`mudline rules` lists all rules"),
        ("", "`mudline rules` lists all rules"),
        ("-", "`mudline rules` lists all rules"),
    ],
)
def test_a_word_that_names_no_rule_is_refused_with_a_hint(word: str, hint: str) -> None:
    with pytest.raises(UnknownRule) as caught:
        select([word])
    assert str(caught.value).startswith(f"{word!r} names no rule")
    assert hint in str(caught.value)


# ----------------------------------------------------------------------------------------- where the pages of rules are


@pytest.mark.parametrize("place", ["chosen", "ignored", "also"])
def test_a_word_is_checked_wherever_it_stands(place: str) -> None:
    with pytest.raises(UnknownRule, match="did you mean SYN001"):
        select(**{place: ["SYN0001"]})


TOLD = (
    ("", None),
    ("Documentation, https://acme.example/rules", "https://acme.example/rules"),
    ("Homepage, http://acme.example", "http://acme.example"),
    (
        "Homepage, https://acme.example\nProject-URL: documentation, https://acme.example/docs",
        "https://acme.example/docs",
    ),
    ("Documentation, docs/rules.md", None),
    ("Changes, https://acme.example", None),
)


@pytest.fixture(autouse=True)
def _fresh() -> Iterator[None]:
    """Addresses are remembered for a run; here packages change."""
    page.cache_clear()
    yield
    page.cache_clear()


def come_from(package: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(pages.ORIGINS, "ACM001", package)


def test_a_code_of_mudline_has_a_page_among_the_installed_files() -> None:
    for code in ("CRV001", "RUN002"):
        address = page(code)
        assert address is not None
        assert Path(url2pathname(urlsplit(address).path)).read_text(encoding="utf-8").count(f"# {code} ") == 1


def test_a_code_of_mudline_has_the_page_of_the_site_that_its_package_names(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pages, "_documentation", {"mudline": "https://mudline.example/"}.get)
    assert page("CRV001") == "https://mudline.example/rules/CRV001.html"


@pytest.mark.parametrize(("number", "told", "expected"), [(n, *row) for n, row in enumerate(TOLD)])
def test_a_plugin_has_the_page_that_its_package_tells(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int, told: str, expected: str | None
) -> None:
    info = tmp_path / f"acme_{number}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(
        f"Metadata-Version: 2.1\nName: acme-{number}\nVersion: 1.0\n" + (f"Project-URL: {told}\n" if told else "")
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    come_from(f"acme-{number} 1.0", monkeypatch)
    assert page("ACM001") == expected
