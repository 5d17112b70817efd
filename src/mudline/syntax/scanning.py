"""What lark makes of a grammar: its terminals as one regular expression, and its tables, kept from run to run."""

from __future__ import annotations

import json
import os
import re
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any, cast
from zlib import crc32

import lark
from lark import Lark
from lark.grammar import Rule
from lark.lexer import TerminalDef

from mudline.cache_folder import cache_folder
from mudline.files import write_atomically


def scanner(grammar: Lark) -> re.Pattern[str]:
    """Return the pattern whose matches, laid end to end, are the tokens of a text; `lastgroup` is the terminal.

    It cuts a text as lark's basic lexer does, in less time. Where several terminals fit, the first in the order that
    lark documents is taken: by priority, then by length.
    """
    order = sorted(
        grammar.terminals,
        key=lambda one: (-one.priority, -one.pattern.max_width, -len(one.pattern.value), one.name),
    )
    return re.compile("|".join(f"(?P<{one.name}>{one.pattern.to_regexp()})" for one in order))


def kept_parser(name: str, grammar: str, **options: object) -> Lark:
    """Return the LALR parser of a grammar with options of lark.

    To compile a grammar takes ten times as long as to read its tables, so these are kept in the folder for caches, in a
    file with `name` in its name. A transformer or a class of lexers is not kept, but taken from the options. A file
    that is damaged, of another user, or of another grammar or lark is not read.
    """
    plain = {option: value for option, value in options.items() if isinstance(value, str | bool)}
    key = json.dumps([lark.__version__, sys.version_info[:2], grammar, plain])
    folder = cache_folder()
    path = folder / f"{_OPENING}{name}-{crc32(key.encode()):08x}.json" if folder else None
    if path and (tables := _read(path, key)):
        # what lark makes of tables that it did not write is not known: they may be of a version to come
        with suppress(AssertionError, AttributeError, IndexError, KeyError, TypeError, ValueError):
            return _loaded(tables, options)
    made = Lark(grammar, parser="lalr", **cast("dict[str, Any]", options))
    if path:
        _write(path, {"key": key, **_tables(made, options)})
    return made


_OPENING = "grammar-"


def _tables(grammar: Lark, options: dict[str, object]) -> dict[str, Any]:
    """The tables of a parser as plain data, without the options that are not."""
    data, memo = cast("Any", grammar).memo_serialize([TerminalDef, Rule])
    for option, value in options.items():
        if not isinstance(value, str | bool):
            data["options"][option] = None
    data["parser"]["lexer_conf"]["lexer_type"] = None
    return {"data": data, "memo": memo}


def _loaded(tables: dict[str, Any], options: dict[str, object]) -> Lark:
    data = tables["data"]
    data["options"] |= options
    data["parser"]["lexer_conf"]["lexer_type"] = options["lexer"]
    states = data["parser"]["parser"]["states"]
    data["parser"]["parser"]["states"] = {int(state): actions for state, actions in states.items()}
    memo = {int(number): held for number, held in tables["memo"].items()}  # JSON has no numbers as keys
    return Lark.load({"data": data, "memo": memo})


def _read(path: Path, key: str) -> dict[str, Any] | None:
    """The tables in a file of this user's; None where there are none for the key, or the file is damaged."""
    try:
        with path.open("rb") as stream:
            if hasattr(os, "getuid") and os.fstat(stream.fileno()).st_uid != os.getuid():
                return None
            head, _, body = stream.read().partition(b"\n")
        tables = json.loads(body) if head == _checksum(body) else None
    except (OSError, ValueError):
        return None
    return tables if isinstance(tables, dict) and tables.get("key") == key else None


def _write(path: Path, tables: dict[str, Any]) -> None:
    """Keep tables, in the place of those of an older version; does nothing where that is not possible."""
    body = json.dumps(tables).encode()
    with suppress(OSError):
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        write_atomically(path, _checksum(body) + b"\n" + body, synced=False)
        for other in path.parent.glob(f"{path.name.rpartition('-')[0]}-*"):
            if other != path:
                other.unlink()


def _checksum(body: bytes) -> bytes:
    return f"{crc32(body):08x}".encode()
