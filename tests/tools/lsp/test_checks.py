"""Checks beside the loop that answers: what overtakes them, what they are answered beside, and how they fail."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncIterator, Iterator, Sequence
from dataclasses import dataclass, field

import pytest
import pytest_asyncio
from lsprotocol import types

from mudline.checks.context import LintContext
from mudline.checks.engine import lint_context
from mudline.language.diagnostics import Diagnostic
from mudline.language.rules import Rule
from mudline.tools.lsp.server import DeckServer
from tests.helpers.builders.decks import CLEAN

pytestmark = pytest.mark.asyncio

URI = "untitled:deck"
SECONDS = 60
"""After which a test fails that waits for another thread."""


@dataclass
class Checking:
    """What stands in for the check of a deck: it waits until it may go on, and fails if it is told to."""

    begun: threading.Event = field(default_factory=threading.Event)
    goes_on: threading.Event = field(default_factory=threading.Event)
    fails: bool = False

    def __call__(self, context: LintContext, rules: Sequence[Rule]) -> list[Diagnostic]:
        self.begun.set()
        assert self.goes_on.wait(SECONDS)
        if self.fails:
            message = "a rule has a fault"
            raise ValueError(message)
        return lint_context(context, rules)


@pytest.fixture
def checking(monkeypatch: pytest.MonkeyPatch) -> Iterator[Checking]:
    made = Checking()
    monkeypatch.setattr("mudline.tools.lsp.decks.lint_context", made)
    yield made
    made.goes_on.set()


@dataclass
class Served:
    """A server without an editor, and what it sends: versions with the codes of their findings, and its log."""

    server: DeckServer
    sent: asyncio.Queue[tuple[int | None, list[str]]]
    logged: asyncio.Queue[str]

    def open(self, text: str) -> None:
        self.server.opened(types.TextDocumentItem(URI, "mudline", 1, text))

    def change(self, version: int, text: str) -> None:
        identifier = types.VersionedTextDocumentIdentifier(version, URI)
        whole = types.TextDocumentContentChangeWholeDocument(text)
        self.server.changed(types.DidChangeTextDocumentParams(identifier, [whole]))


@pytest_asyncio.fixture
async def served(checking: Checking, monkeypatch: pytest.MonkeyPatch) -> AsyncIterator[Served]:
    server = DeckServer()
    made = Served(server, asyncio.Queue(), asyncio.Queue())

    def publish(params: types.PublishDiagnosticsParams) -> None:
        made.sent.put_nowait((params.version, [str(one.code) for one in params.diagnostics]))

    monkeypatch.setattr(server, "text_document_publish_diagnostics", publish)
    monkeypatch.setattr(server, "window_log_message", lambda params: made.logged.put_nowait(params.message))
    asyncio.get_running_loop().set_exception_handler(server.unexpected)
    yield made
    checking.goes_on.set()
    await asyncio.to_thread(server.shutdown)


async def test_a_check_that_a_newer_text_has_overtaken_is_dropped(served: Served, checking: Checking) -> None:
    served.open("$MODLE\n")
    assert await asyncio.to_thread(checking.begun.wait, SECONDS)
    for version in range(2, 6):
        served.change(version, f"{CLEAN}*OCAEN{version}\n")
    checking.goes_on.set()
    assert await served.sent.get() == (5, ["SYN009"])
    served.change(6, CLEAN)
    assert await served.sent.get() == (6, [])
    assert served.sent.empty()


async def test_requests_are_answered_while_a_check_runs(served: Served, checking: Checking) -> None:
    served.open(CLEAN)
    assert await asyncio.to_thread(checking.begun.wait, SECONDS)
    served.change(2, CLEAN.replace("Clay", "Sand"))
    found = await served.server.analysis(URI)
    assert served.sent.empty()
    assert found is not None
    assert "Sand" in [one.name for one in found.names]
    assert found.scene is not None
    assert not found.found
    checked = asyncio.create_task(served.server.analysis(URI, checked=True))
    served.change(3, "$MODLE\n")
    checking.goes_on.set()
    found = await checked
    assert found is not None
    assert [one.code for one in found.found] == ["SYN010"]


async def test_a_deck_that_is_closed_while_it_is_checked_shows_nothing(served: Served, checking: Checking) -> None:
    served.open("$MODLE\n")
    assert await asyncio.to_thread(checking.begun.wait, SECONDS)
    asked = asyncio.create_task(served.server.analysis(URI, checked=True))
    await asyncio.sleep(0)
    served.server.closed(URI)
    assert await asked is None
    assert await served.sent.get() == (None, [])
    served.open(CLEAN)
    checking.goes_on.set()
    assert await served.sent.get() == (1, [])


async def test_a_fault_in_a_rule_is_told_and_the_next_text_is_checked(served: Served, checking: Checking) -> None:
    checking.goes_on.set()
    checking.fails = True
    served.open(CLEAN)
    assert await served.logged.get() == "ValueError: a rule has a fault: please report this fault of mudline"
    assert await served.server.analysis(URI, checked=True) is not None
    checking.fails = False
    served.change(2, "$MODLE\n")
    assert await served.sent.get() == (2, ["SYN010"])


async def test_the_end_waits_for_a_check(served: Served, checking: Checking) -> None:
    others = set(threading.enumerate())
    served.open(CLEAN)
    assert await asyncio.to_thread(checking.begun.wait, SECONDS)
    ended = asyncio.create_task(asyncio.to_thread(served.server.shutdown))
    checking.goes_on.set()
    await ended
    mine = set(threading.enumerate()) - others
    assert not [each for each in mine if each.name.startswith("check")]
