"""Completion in the shell, asked for as click's scripts do."""

from __future__ import annotations

import os
from unittest.mock import patch

import pytest

from mudline.cli.main import COMMANDS
from tests.cli.runner import Outcome, run


def complete(*words: str, shell: str = "bash") -> Outcome:
    """What a shell is offered for the last word."""
    env = {"_MUDLINE_COMPLETE": f"{shell}_complete", "COMP_WORDS": " ".join(("mudline", *words))}
    env["COMP_CWORD"] = words[-1] if shell == "fish" else str(len(words))
    return answered(env)


def answered(env: dict[str, str]) -> Outcome:
    """What the program answers in an environment."""
    with patch.dict(os.environ, env):
        return run()


def offered(*words: str) -> list[str]:
    outcome = complete(*words)
    assert (outcome.code, outcome.err) == (0, "")
    return outcome.out.split()


@pytest.mark.parametrize(("shell", "sign"), [("bash", "complete -o"), ("zsh", "compdef"), ("fish", "complete --no")])
def test_script_of_a_shell(shell: str, sign: str) -> None:
    outcome = answered({"_MUDLINE_COMPLETE": f"{shell}_source"})
    assert outcome.code == 0
    assert sign in outcome.out
    assert f"_MUDLINE_COMPLETE={shell}_complete" in outcome.out


def test_commands_are_offered() -> None:
    assert offered("s") == [f"plain,{name}" for name in COMMANDS if name.startswith("s")]


def test_options_and_their_words_are_offered() -> None:
    assert "plain,--output-format" in offered("lint", "--o")
    assert offered("lint", "--fail-on", "w") == ["plain,warning"]


def test_rules_are_offered_by_code_and_name() -> None:
    assert offered("lint", "--select", "crv00") == [f"plain,CRV00{number}" for number in range(1, 10)]
    assert offered("lint", "--ignore", "CRV001,too-f") == ["plain,CRV001,too-few-points"]
    assert offered("lint", "--extend-select", "SYN001") == ["plain,SYN001"]
    assert offered("rules", "too-f") == ["plain,too-few-points"]
