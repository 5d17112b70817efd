"""Tests of archives need the extra of that name."""

from __future__ import annotations

from importlib.util import find_spec

collect_ignore_glob = [] if find_spec("duckdb") and find_spec("pyarrow") else ["test_*.py"]
