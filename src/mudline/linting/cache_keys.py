"""What findings depend on: the key under which a cache holds them, and decks that no key can stand for."""

from __future__ import annotations

import os
import re
import sys
from hashlib import blake2b
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from mudline.deck.loading import form_of
from mudline.linting.plugins import Guarded, origin
from mudline.linting.registry import Rule
from mudline.linting.settings import LintSettings
from mudline.resources import grammar_file

KEY = 40
"""Letters of a key."""

_PACKAGES = ("mudline", "lark", "numpy", "pydantic", "pyyaml")
_NAMES_A_FILE = re.compile(r"FILE[^\r\nA-Z0-9]*=|RESTART")
_NAMES_A_FILE_IN_A_FORM = re.compile(r"FILE|RESTART|\\")


def stands_alone(name: str, data: bytes) -> bool:
    """Whether a deck certainly names no other file, so that nothing but its content tells what is found in it.

    Decks that continue others or read files are looked at anew in each run, and so is what is not certain: text of
    two bytes a character, and escapes by which JSON and YAML may write any name.
    """
    if b"\0" in data:
        return False
    text = data.decode("utf-8", "replace").upper()
    pattern = _NAMES_A_FILE if form_of(name) == "keyword" else _NAMES_A_FILE_IN_A_FORM
    return pattern.search(text) is None


def program() -> str:
    """What the program is: its version, its files as they are installed, and the libraries it reads decks with."""
    words = [f"{name} {_version(name)}" for name in _PACKAGES]
    for root in {Path(__file__).parents[1], grammar_file("deck.lark").parent}:
        for folder, _, names in os.walk(root):
            words += (_state(os.path.join(folder, name)) for name in names if not name.endswith(".pyc"))  # noqa: PTH118 - quicker than Path
    words.sort()
    return "\n".join(words)


def of_settings(settings: LintSettings, running: str) -> bytes:
    """What the settings and the program add to each key."""
    rules = [
        [rule.code.code, rule.code.severity.value, origin(rule.code.code), _source(rule)] for rule in settings.rules
    ]
    severities = sorted((code, severity.value) for code, severity in settings.severities.items())
    return repr((running, rules, settings.units, settings.dialect, severities)).encode("utf-8", "backslashreplace")


def key(start: bytes, name: str, data: bytes) -> str:
    """The key of a file's content under settings; what it is called tells units and form, and stands in findings."""
    called = name.encode("utf-8", "surrogatepass")
    digest = blake2b(b"%d %d " % (len(start), len(called)), digest_size=KEY // 2)
    for part in (start, called, data):
        digest.update(part)
    return digest.hexdigest()


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:  # bundled into a program without its metadata
        return ""


def _source(rule: Rule) -> str:
    """The file of a plugin's rule, which may change while its package is written; mudline's own are in `program`."""
    if not isinstance(rule.check, Guarded):
        return ""
    module = sys.modules.get(getattr(rule.check.check, "__module__", ""))
    path = getattr(module, "__file__", None)
    return _state(path) if path else ""


def _state(path: str) -> str:
    try:
        found = os.stat(path)  # noqa: PTH116 - hundreds of files
    except OSError:  # inside an archive
        return path
    return f"{path} {found.st_size} {found.st_mtime_ns}"
