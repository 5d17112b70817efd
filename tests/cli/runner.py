"""Running the command: in this process for speed, as a process of its own where that matters."""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias
from unittest.mock import patch

import pytest

from mudline.__main__ import main
from tests.helpers.processes import TIMEOUT

ROOT = Path(__file__).parents[2]
SAMPLES = ROOT / "samples"

Json: TypeAlias = Any
"""What a JSON text holds."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a run gave."""

    code: int
    output: bytes
    errors: bytes

    @property
    def out(self) -> str:
        return self.output.decode("utf-8")

    @property
    def err(self) -> str:
        return self.errors.decode("utf-8")

    def json(self) -> Json:
        return json.loads(self.out, parse_constant=no_constant)


class Stream(io.TextIOWrapper):
    """A standard stream in memory, which may say that it is a terminal."""

    def __init__(self, encoding: str, *, terminal: bool) -> None:
        self.memory = io.BytesIO()
        self.terminal = terminal
        super().__init__(self.memory, encoding=encoding, newline="")

    def isatty(self) -> bool:
        return self.terminal

    def content(self) -> bytes:
        self.flush()
        return self.memory.getvalue()


def run(
    *arguments: str | os.PathLike[str], stdin: bytes = b"", terminal: bool = False, encoding: str = "utf-8"
) -> Outcome:
    """Run a command line in this process."""
    out, err = Stream(encoding, terminal=terminal), Stream(encoding, terminal=terminal)
    source = io.TextIOWrapper(io.BytesIO(stdin), encoding="utf-8")
    with patch.object(sys, "stdout", out), patch.object(sys, "stderr", err), patch.object(sys, "stdin", source):
        code = main([os.fspath(argument) for argument in arguments])
    return Outcome(code, out.content(), err.content())


def process(
    *arguments: str | os.PathLike[str], stdin: bytes = b"", env: dict[str, str] | None = None, cwd: Path | None = None
) -> Outcome:
    """Run a command line as a process of its own."""
    done = subprocess.run(
        [sys.executable, "-m", "mudline", *arguments],
        input=stdin,
        capture_output=True,
        env={**os.environ, **(env or {})},
        cwd=cwd,
        timeout=TIMEOUT,
        check=False,
    )
    return Outcome(done.returncode, done.stdout, done.stderr)


def no_constant(name: str) -> None:
    """JSON knows no NaN and no Infinity."""
    raise AssertionError(f"{name} in JSON")


def assert_fits(value: Json, form: str) -> None:
    """A value keeps to the schema of docs/schemas that describes a form."""
    schema = json.loads((ROOT / "docs" / "schemas" / f"{form}.json").read_text(encoding="utf-8"))
    validator = pytest.importorskip("jsonschema").Draft202012Validator
    validator.check_schema(schema)
    validator(schema).validate(value)
