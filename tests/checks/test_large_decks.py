"""What large decks cost: memory for the arrays of their scene, and work as long as their chains."""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable
from functools import partial
from itertools import count
from pathlib import Path

import pytest

import mudline
from mudline.checks.context import LintContext
from mudline.checks.engine import lint_bytes, problems_in
from mudline.checks.registry import rules
from mudline.language.deck.loading import load_bytes
from tests.helpers.growth import TWOFOLD, call_growth

COUNT = 400_000
LAWS = (
    "*GEOMETRIC SETS\n OPTION=RIGID\n SET=pipe\n 207.0E9, 79.6E9, 0.4064, 0.3682, 7850.0\n"
    "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=pipe\n STIFFNESS=100.0E3\n"
)


def generated(count: int, more: str = "") -> bytes:
    nodes = f"*NODE\n 1, -0.1, 0.0\n {count + 1}, -0.1, {float(count)}\n GEN=1, {count + 1}\n"
    elements = f"*ELEMENT\n 1, 1, 2\n GEN=1, {count}\n*ELEMENT SETS\n SET=pipe\n GEN=1, {count}\n"
    return f"$MODEL\n*OCEAN\n 500.0, 1025.0, 9.81\n{nodes}{elements}{more}".encode()


def test_memory_of_linting() -> None:
    """An element and a node need 80 bytes: two numbers, coordinates, ends and their nodes, a length, an index."""
    problems_in(LintContext(load_bytes(generated(10, LAWS), "deck.keyxm")), rules())  # modules are loaded once
    tracemalloc.start()
    try:
        found = problems_in(LintContext(load_bytes(generated(COUNT, LAWS), "deck.keyxm")), rules())
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert {problem.code.code for problem in found} <= {"SBD006"}
    assert peak < 150 * COUNT


# ------------------------------------------------------------------ chains of definitions, each of which needs the next

MODEL = "$MODEL\n*NODE\n 1, 0.0, 0.0\n 2, 0.0, 1.0\n*ELEMENT\n 1, 1, 2\n"
SHORT, LONG = 600, 1200


def sets(count: int, step: int) -> str:
    """Sets of which each has the one `step` further as its part; the last has an element."""
    order = range(count) if step > 0 else range(count, 0, -1)
    links = "".join(f" SET=S{i}\n SUBSET=S{i + step}\n" for i in order)
    return f"{MODEL}*ELEMENT SETS\n{links} SET=S{count if step > 0 else 0}\n 1\n"


def parameters(count: int, step: int) -> str:
    """Parameters of which each is defined by the one `step` further."""
    order = range(count) if step > 0 else range(count, 0, -1)
    links = "".join(f" p{i}, =[p{i + step} + 1]\n" for i in order)
    return f"$PREPROCESSOR\n*PARAMETERS\n{links} p{count if step > 0 else 0}, 1.0\n{MODEL}"


def closed(text: str, count: int) -> str:
    """A chain whose last link leads back to its first."""
    return text.replace(f" SET=S{count}\n 1\n", f" SET=S{count}\n SUBSET=S0\n").replace(
        f"p{count}, 1.0", f"p{count}, =[p0]"
    )


def codes(text: str, folder: Path) -> list[str]:
    path = folder / "deck.keyxm"
    path.write_text(text, encoding="utf-8")
    return [found.code for found in mudline.lint(path)]


@pytest.mark.untraced
@pytest.mark.parametrize("chain", [sets, parameters])
@pytest.mark.parametrize("step", [1, -1])
def test_work_is_as_long_as_the_chain(chain: Callable[[int, int], str], step: int, tmp_path: Path) -> None:
    paths = [tmp_path / f"{count}.keyxm" for count in (SHORT, LONG)]
    for path in paths:
        path.write_text(chain(int(path.stem), step), encoding="utf-8")
        assert not [found for found in mudline.lint(path) if found.code.startswith("REF")]
    assert call_growth(lambda path: list(mudline.lint(path)), *paths) < TWOFOLD


@pytest.mark.untraced
@pytest.mark.parametrize(("chain", "code"), [(sets, "REF008"), (parameters, "REF014")])
def test_a_chain_without_an_end_is_told_once(chain: Callable[[int, int], str], code: str, tmp_path: Path) -> None:
    assert codes(closed(chain(LONG, 1), LONG), tmp_path).count(code) == 1


# ------------------------------------------------------------------------------------- many faults that are corrected

_RUNS = count(10)


def lint_faulty(faults: int, head: str, each: str) -> None:
    """Lint a deck with so many faults, whose blocks no deck before had."""
    run = next(_RUNS)
    text = MODEL + head + "".join(each.format(f"{run}{i:04}") for i in range(faults))
    lint_bytes(text.encode(), "deck.keyxm", rules())


@pytest.mark.covered
@pytest.mark.parametrize(
    ("head", "each"),
    [
        ("", "*SEABED STIFNESS\n CURVE=c{0}\n 0, 0\n 1, {0}\n"),
        ("", "SEABED STIFFNESS\n CURVE=c{0}\n 0, 0\n 1, {0}\n*NODE\n {0}, 0, 5\n"),
        ("", "*NODE\n {0}, 0, 5\n CURVE=c{0}\n 0, 0\n 1, {0}\n"),
        ("*SEABED PROPERTIES\n TYPE=ELASTIC\n", " SET=a{0}\n STIFNESS={0}\n"),
        ("*ELEMENT SETS\n", " SETT=a{0}\n 1\n"),
        ("*NODE\n", " {0}, 0,5, 1,{0}, 2,5\n"),
    ],
    ids=["keyword", "star", "line", "key", "set", "commas"],
)
def test_recovery_costs_as_much_as_the_faults_are_many(head: str, each: str) -> None:
    """With fewer faults than corrections are tried for."""
    assert call_growth(partial(lint_faulty, head=head, each=each), 95, 190) < TWOFOLD
