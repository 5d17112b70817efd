"""What is fuzzed: a function for each target, which raises where a promise is broken."""

from __future__ import annotations

import json
import struct
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from io import BytesIO
from pathlib import Path
from typing import NamedTuple
from zlib import crc32

from mudline.checks.configuration import Configuration, ConfigurationError, read_configuration
from mudline.checks.engine import Fixing, LintSettings, lint_bytes
from mudline.checks.fixing import fix_bytes
from mudline.checks.registry import UnknownRule, rules
from mudline.checks.settings import nearest_settings
from mudline.editing.formatting.document import FormatError, formatted
from mudline.language.deck.forms.json import to_json
from mudline.language.deck.keyword_text import same_meaning, to_keyword
from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import DeckError, Severity
from mudline.language.keywords.values import DataFile
from mudline.language.syntax.source import Source
from mudline.model.scene.data_files import fault_of, has_uneven_times
from mudline.model.scene.seabed import read_profile
from tests.cli.runner import Outcome, run
from tests.fuzz import agreement
from tests.fuzz.agreement import NAME, BrokenPromiseError
from tests.helpers.samples import SAMPLES

ROOT = Path(__file__).parents[2]
_CODES = {0, 1, 2}


class Target(NamedTuple):
    """What is done with an input, and which files its inputs come from."""

    check: Callable[[bytes], None]
    seeds: Callable[[], list[bytes]]


def decks() -> list[bytes]:
    """Samples and the corpus."""
    paths = [
        *SAMPLES.glob("*.key*"),
        *(ROOT / "tests" / "data" / "corpus").rglob("*.key*"),
        *Path(__file__).parent.glob("found/*"),
    ]
    return [path.read_bytes() for path in sorted(paths)]


def _documents() -> list[bytes]:
    made = []
    for data in decks():
        try:
            made.append(to_json(load_bytes(data, NAME)).encode())
        except (DeckError, ValueError):
            continue
    return [one for one in made if len(one) < 20_000]


# ---------------------------------------------------------------------------------------------------------- in process


def _read(data: bytes) -> None:
    source = Source.from_bytes(data, NAME)
    if source.to_bytes() != data:
        raise BrokenPromiseError("reading a file and writing it gives other bytes")
    load_bytes(data, NAME)


def _lint(data: bytes) -> None:
    lint_bytes(data, NAME, rules())


def _fix(data: bytes) -> None:
    settings = LintSettings(rules(), fixing=Fixing.UNSAFE)
    once = fix_bytes(data, NAME, settings)
    if once.changed is None:
        return
    again = fix_bytes(once.changed, NAME, settings)
    if again.changed is not None and again.changed != once.changed:
        raise BrokenPromiseError("fixing a fixed deck changes it again")
    before = {one.code for one in lint_bytes(data, NAME, rules()) if one.severity is Severity.ERROR}
    after = {one.code for one in lint_bytes(once.changed, NAME, rules()) if one.severity is Severity.ERROR}
    if not before and after:
        raise BrokenPromiseError(f"a fixed deck has new errors: {', '.join(sorted(after))}")


def _format(data: bytes) -> None:
    try:
        once = formatted(data, NAME)
    except (DeckError, FormatError) as error:
        if "please report" in str(error):
            raise
        return
    if formatted(once, NAME) != once:
        raise BrokenPromiseError("formatting a formatted deck changes it again")
    if not same_meaning(load_bytes(data, NAME), load_bytes(once, NAME)):
        raise BrokenPromiseError("a formatted deck means something else")


def _convert(data: bytes) -> None:
    """There and back, for what the command converts: decks without an error of reading."""
    deck = load_bytes(data, NAME)
    if any(one.weight is Severity.ERROR for one in deck.problems):
        return
    try:
        text = to_json(deck)
        back = load_bytes(text.encode(), "deck.json")
    except ValueError:
        return
    if to_json(back) != text:
        raise BrokenPromiseError("a deck in JSON, read and written, is another one")
    try:
        keyword = to_keyword(back)
    except ValueError:
        return
    if to_json(load_bytes(keyword.encode(), NAME)) != text:
        raise BrokenPromiseError("a deck in JSON, written as keyword text and read, is another one")


def _document(data: bytes) -> None:
    for name in ("deck.json", "deck.yaml"):
        try:
            load_bytes(data, name)
        except DeckError:
            continue


def _comments(data: bytes) -> None:
    marked = b"\n".join(b"C mudline: " + line if n % 3 else line for n, line in enumerate(data.splitlines()))
    lint_bytes(marked, NAME, rules())


def _configuration(data: bytes) -> None:
    with _file(data, "mudline.toml") as path:
        try:
            found = read_configuration(path)
        except ConfigurationError:
            return
        try:
            nearest_settings().merged(found or Configuration())
        except UnknownRule:
            return


def _data(data: bytes) -> None:
    with _file(data, "data.txt") as path:
        for contents in DataFile:
            if not fault_of(path, contents) and contents is DataFile.ELEVATIONS:
                has_uneven_times(path)
        for columns in (2, 3):
            with suppress(ValueError):
                read_profile(path, columns)


# ------------------------------------------------------------------------------------------------------------ commands


@contextmanager
def _file(data: bytes, name: str) -> Iterator[Path]:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        path.write_bytes(data)
        yield path


def _command(*words: str, name: str = NAME) -> Callable[[bytes], None]:
    """A command on a file, as a user runs it: no traceback, an exit code of the three, JSON that is JSON."""

    def check(data: bytes) -> None:
        with _file(data, name) as path:
            given = [word.format(path=path, folder=path.parent) for word in words]
            _judged(run(*given), words)

    return check


def _judged(outcome: Outcome, words: Sequence[str]) -> None:
    """Raise BrokenPromiseError where an outcome is not as promised."""
    if outcome.code not in _CODES:
        raise BrokenPromiseError(f"exit code {outcome.code}")
    if "Traceback" in outcome.err:
        raise BrokenPromiseError(outcome.err.strip().splitlines()[-1])
    if "json" in words and outcome.code == 0 and outcome.out:
        json.loads(outcome.out)


def _tables() -> list[bytes]:
    return [b"Set,Ratio,Force\nA,0,0\nA,1,5\n", b"Curve Name,Embedment Ratio,Seabed Force\nc,0,0\n,1,5\n"]


def _workbooks() -> list[bytes]:
    from openpyxl import Workbook  # noqa: PLC0415 - an extra

    book = Workbook()
    sheet = book.active
    for row in (("Curve Name", "Embedment Ratio", "Seabed Force"), ("c", 0, 0), (None, 1, 5)):
        sheet.append(row)
    stream = BytesIO()
    book.save(stream)
    return [stream.getvalue()]


def _configurations() -> list[bytes]:
    return [
        b'select = ["SYN", "CRV003"]\nfail-on = "error"\nno-outside = true\n',
        b'[severity]\nLEG = "off"\n[per-file-ignores]\n"*.das" = ["CRV"]\n',
    ]


def _data_files() -> list[bytes]:
    return [
        (SAMPLES / "scr-vessel.rao").read_bytes(),
        b"C a\n0.0 1.0\n0.5 1.5\n",
        b"HEADING=0\n0.1\n" + b"1 2 3 4 5 6\n" * 2,
    ]


def _export(data: bytes) -> None:
    target = _EXPORTS[crc32(data) % len(_EXPORTS)]
    _command("export", "{path}", "--to", target, "-o", "{folder}/out", "--output-format", "json")(data)


_EXPORTS = ("moordyn", "orcaflex")


def _server(data: bytes) -> None:
    from tests.fuzz.editing import edit  # noqa: PLC0415 - an extra

    edit(data)


def _restart(data: bytes) -> None:
    """Of a deck that continues the input."""
    with _file(data, "base.keyxm") as path:
        deck = path.with_name(NAME)
        deck.write_text("$LOAD CASE\n*RESTART\n LAST=base\n*SEABED CONTACT\n SET=ALL\n", encoding="utf-8")
        _judged(run("lint", str(deck)), ())
        _judged(run("evaluate", str(deck), "-q"), ())


def _positions(data: bytes) -> None:
    name = "positions.npz" if data.startswith(b"PK") else "positions.csv"
    option = "--elements" if data.startswith(b"element") else "--positions"
    with _file(data, name) as path:
        _judged(run("evaluate", str(SAMPLES / "legacy-flowline.keyxm"), option, str(path), "-q"), ())


def _archives() -> list[bytes]:
    import numpy as np  # noqa: PLC0415 - as the program does

    stream = BytesIO()
    np.savez(stream, node=np.arange(1, 4), positions=np.zeros((2, 3, 3)), time=np.arange(2.0))
    tables = [(SAMPLES / name).read_bytes()[:600] for name in ("positions.csv", "elements.csv")]
    return [stream.getvalue(), struct.pack("<I", 0x04034B50), *tables]


TARGETS = {
    "read": Target(_read, decks),
    "lint": Target(_lint, decks),
    "fix": Target(_fix, decks),
    "fixes": Target(agreement.fixes, decks),
    "verdicts": Target(agreement.verdicts, decks),
    "line-ends": Target(agreement.line_ends, decks),
    "forms": Target(agreement.forms, decks),
    "messages": Target(agreement.messages, decks),
    "expansion": Target(agreement.expansion, decks),
    "format": Target(_format, decks),
    "convert": Target(_convert, decks),
    "comments": Target(_comments, decks),
    "document": Target(_document, _documents),
    "configuration": Target(_configuration, _configurations),
    "data": Target(_data, _data_files),
    "migrate": Target(_command("migrate", "{path}", "--verify"), decks),
    "evaluate": Target(_command("evaluate", "{path}", "--output-format", "json"), decks),
    "validate": Target(_command("validate", "{path}", "--output-format", "json"), decks),
    "study": Target(_command("study", "{path}", "--only", "stability", "--output-format", "json"), decks),
    "report": Target(
        _command(
            "report", "{path}", "--output-format", "json", "--sections", "verdict,findings,model,curves,contact,plan"
        ),
        decks,
    ),
    "export": Target(_export, decks),
    "restart": Target(_restart, decks),
    "server": Target(_server, decks),
    "index": Target(_command("index", "{path}", "-o", "{folder}/archive", "-q"), decks),
    "csv": Target(_command("convert", "{path}", "-o", "{folder}/o.keyxm", name="t.csv"), _tables),
    "xlsx": Target(_command("convert", "{path}", "-o", "{folder}/o.keyxm", name="t.xlsx"), _workbooks),
    "positions": Target(_positions, _archives),
}
"""By name."""
