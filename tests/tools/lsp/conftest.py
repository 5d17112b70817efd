"""A server and an editor for all tests; without the libraries, the modules of this folder are skipped by name."""

from __future__ import annotations

from importlib.util import find_spec

if find_spec("pygls") is not None and find_spec("pytest_lsp") is not None:
    from tests.tools.lsp.fixtures import client, editor

    __all__ = ["client", "editor"]
