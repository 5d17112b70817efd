"""A deck that cannot be processed ends a command with its reasons and exit code 1."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec

from mudline.cli.exits import FOUND
from mudline.cli.terminal import tell_diagnostics
from mudline.diagnostics import DeckError

Parameters = ParamSpec("Parameters")


def refuses_bad_decks(command: Callable[Parameters, int]) -> Callable[Parameters, int]:
    """Turn DeckError into messages and an exit code."""

    @wraps(command)
    def guarded(*args: Parameters.args, **kwargs: Parameters.kwargs) -> int:
        try:
            return command(*args, **kwargs)
        except DeckError as error:
            tell_diagnostics(error.diagnostics)
            return FOUND

    return guarded
