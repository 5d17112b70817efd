"""A fault of the program in one deck of many: the others are done, and the fault is reported."""

from __future__ import annotations

import re
from collections.abc import Callable
from importlib import import_module
from typing import Any

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN

LOOPS: dict[str, tuple[str, str, Callable[..., str], list[str]]] = {
    "lint": ("checks.fixing", "covered_findings", lambda _, name, *__: name, ["--output-format", "json"]),
    "validate": ("checks.verdict", "judge", lambda context: context.deck.file, ["--output-format", "json"]),
    "diff": (
        "editing.comparison.decks",
        "compare_decks",
        lambda deck, *_: deck.file,
        ["decks", "--output-format", "json"],
    ),
    "report": ("tools.reporting.pages", "report_on", lambda given, *_: given.name, ["--output-format", "json"]),
    "batch": (
        "cli.batch_cases",
        "_evaluated",
        lambda order: order.case.file.name,
        ["--output-format", "json", "-o", "r"],
    ),
}
"""A function that each command calls for a deck, by module and name, how it gets the name of the deck, and options."""


@pytest.mark.parametrize(("command", "jobs"), [*((command, "1") for command in LOOPS), ("lint", "2"), ("diff", "2")])
def test_an_internal_error_loses_no_other_deck(
    place: Place, monkeypatch: pytest.MonkeyPatch, command: str, jobs: str
) -> None:
    module, function, name_of, options = LOOPS[command]
    called = getattr(import_module(f"mudline.{module}"), function)

    def failing(*given: Any, **more: Any) -> Any:  # noqa: ANN401 - as the function
        if name_of(*given).endswith("bad.keyxm"):
            raise IndexError("a\nfault")
        return called(*given, **more)

    monkeypatch.setattr(f"mudline.{module}.{function}", failing)
    monkeypatch.setattr("mudline.tools.running.executors.PAYS", dict.fromkeys(("fork", "forkserver", "spawn"), 0.0))
    monkeypatch.setattr("mudline.tools.running.executors.TRIED", 0.0)
    monkeypatch.setattr("mudline.tools.running.executors.start_method", lambda: "fork")
    for name, text in (("a", CLEAN), ("bad", CLEAN), ("c", BAD_NUMBER), ("d", BAD_NUMBER)):
        place(text, f"decks/{name}.keyxm")
    verbose = ["-v"] if jobs == "2" else []
    outcome = run(command, "decks", *options, "--jobs", jobs, *verbose)
    assert outcome.code == 2
    assert (
        "decks/bad.keyxm: internal error, please report it: IndexError: a fault (test_internal_errors.py, line "
        in outcome.err
    )
    assert ("Traceback (most recent call last)" in outcome.err) is bool(verbose)
    outcome.json()
    assert {"c.keyxm", "d.keyxm"} <= set(re.findall(r"\w+\.keyxm", outcome.out))
