"""`mudline lsp` without its library; what it serves is tested in tests/lsp."""

from __future__ import annotations

import pytest

from tests.cli.runner import run


def test_without_its_library_it_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.cli.lsp_command.find_spec", lambda _: None)
    outcome = run("lsp")
    assert (outcome.code, outcome.out) == (2, "")
    assert outcome.err == "mudline: lsp needs pygls: pip install 'mudline[lsp]'\n"


def test_the_library_is_imported_when_it_serves(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pygls")
    monkeypatch.setattr("mudline.lsp.serving.serve", lambda: 0)
    assert run("lsp").code == 0
