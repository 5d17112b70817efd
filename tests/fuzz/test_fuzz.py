"""What fuzzing found stays mended, and the fuzzer itself works: `make fuzz` looks for more."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fuzz.agreement import BrokenPromiseError
from tests.fuzz.mutation import Mutator
from tests.fuzz.targets import TARGETS

FOUND = sorted((Path(__file__).parent / "found").glob("*"))


@pytest.mark.parametrize("path", FOUND, ids=lambda path: path.name)
def test_what_was_found_is_mended(path: Path) -> None:
    TARGETS[path.name.partition("-")[0]].check(path.read_bytes())


def test_inputs_are_many_and_repeatable() -> None:
    seeds = TARGETS["read"].seeds()
    first, second = (Mutator(seeds, 1) for _ in range(2))
    made = [first.made() for _ in range(300)]
    assert made == [second.made() for _ in range(300)]
    assert len({*made} - {*seeds}) > 200


@pytest.mark.parametrize("name", ["verdicts", "fixes", "line-ends", "forms", "messages", "expansion"])
def test_answers_agree(name: str) -> None:
    mutator = Mutator([seed for seed in TARGETS[name].seeds() if len(seed) < 2000], 3)
    for _ in range(20):
        TARGETS[name].check(mutator.made())


@pytest.mark.parametrize("name", ["read", "lint", "format", "convert", "document", "configuration", "data", "csv"])
def test_a_target_takes_inputs(name: str) -> None:
    mutator = Mutator(TARGETS[name].seeds(), 2)
    for _ in range(5):
        TARGETS[name].check(mutator.made())


def test_a_broken_promise_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tests.fuzz.targets.formatted", lambda data, _name: data + b"C more\n")
    with pytest.raises(BrokenPromiseError, match="changes it again"):
        TARGETS["format"].check(b"$MODEL\n")
