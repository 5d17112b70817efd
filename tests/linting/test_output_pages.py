"""Where the pages of rules are."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.linting import registry
from mudline.linting.registry import address, page

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


def come_from(package: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(registry._ORIGINS, "ACM001", package)


def test_a_code_of_mudline_has_a_page_in_its_repository_and_no_address() -> None:
    assert page("CRV001") == "docs/rules/CRV001.md"
    assert page("RUN002") == "docs/rules/RUN002.md"
    assert address("CRV001") is None


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
    assert page("ACM001") == address("ACM001") == expected


@pytest.mark.parametrize("package", ["acme_mudline.friction", "acme-that-nobody-has 1.0"])
def test_a_plugin_that_is_no_installed_package_has_none(package: str, monkeypatch: pytest.MonkeyPatch) -> None:
    come_from(package, monkeypatch)
    assert page("ACM001") is None
