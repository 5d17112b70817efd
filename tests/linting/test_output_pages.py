"""Where the pages of rules are."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import url2pathname

import pytest

from mudline.linting import registry
from mudline.linting.registry import page

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
    monkeypatch.setitem(registry._ORIGINS, "ACM001", package)


def test_a_code_of_mudline_has_a_page_among_the_installed_files() -> None:
    for code in ("CRV001", "RUN002"):
        address = page(code)
        assert address is not None
        assert Path(url2pathname(urlsplit(address).path)).read_text(encoding="utf-8").count(f"# {code} ") == 1


def test_where_the_package_names_a_site_the_page_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(registry, "_documentation", lambda package: f"https://example.org/{package.split()[0]}/")
    assert page("CRV002") == "https://example.org/mudline/rules/CRV002/"


def test_a_code_without_a_page_has_none() -> None:
    assert page("XYZ999") is None


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


@pytest.mark.parametrize("package", ["acme_mudline.friction", "acme-that-nobody-has 1.0"])
def test_a_plugin_that_is_no_installed_package_has_none(package: str, monkeypatch: pytest.MonkeyPatch) -> None:
    come_from(package, monkeypatch)
    assert page("ACM001") is None
