"""The TextMate grammar of decks, from the same words as the Pygments lexer, and the classes of its scopes."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from typing import Any

from tests.project.editors.words import words

GRAMMAR = "editors/vscode/syntaxes/mudline.tmLanguage.json"

SCOPES = {
    "entity.name.section": "section",
    "keyword.control": "keyword",
    "keyword.other.unknown": "unknown keyword",
    "comment.line": "comment",
    "support.type.property-name": "setting",
    "variable.other.property": "unknown setting",
    "constant.language": "choice",
    "constant.numeric": "number",
    "string.unquoted": "text",
    "string.quoted.double": "text",
    "entity.name.label": "text",
    "entity.name.function": "name",
    "variable.parameter": "name",
    "keyword.operator.word": "word",
    "keyword.operator": "operator",
}
"""The class of what has a scope; the first that fits holds."""

Rule = dict[str, Any]

_START = r"(?:^|(?<=[,]))[ \t]*"
_VALUE = r"(?:^|(?<=[,=]))[ \t]*"
_END = r"(?=[ \t]*(?:,|$))"
_NUMBER = r"[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[EeDd][-+]?[0-9]+)?"
_KEY = r"[A-Za-z](?:[\w \t-]*[\w-])?"


def grammar_text() -> str:
    """The whole file."""
    return json.dumps(grammar(), indent=1) + "\n"


def grammar() -> Rule:
    """A rule for each section with keywords whose lines are read, one for each of these, and rules for the others."""
    given = words()
    read: dict[str, Rule] = given["read"]
    sections = sorted({section for block in read.values() for section in block["sections"]})
    blocks = {_name_of(keyword): _block(keyword, block) for keyword, block in read.items()}
    own = [_section(name, [key for key in read if name in read[key]["sections"]]) for name in sections]
    repository = {
        **blocks,
        "other-block": {"patterns": _other_blocks(given["keywords"])},
        "comment": _match(r"^[Cc](?:[ \t]|[-*=#_.~+]{2}|$).*", "comment.line"),
        "plain": {"patterns": [_include("comment"), _match(r"^C[A-Za-z].*", "comment.line"), _include("fields")]},
        "fields": {"patterns": _fields()},
        "equation": {"patterns": _equation()},
    }
    return {
        "name": "mudline deck",
        "scopeName": "source.mudline",
        "fileTypes": ["keyx", "keyxm", "keyxi"],
        "patterns": [*own, _any_section(), _include("other-block"), _include("plain")],
        "repository": repository,
    }


def class_of(scopes: Iterable[str]) -> str:
    """The class of a character by its scopes, the innermost last."""
    for scope in reversed([scope for scope in scopes if not scope.startswith(("meta.", "source.", "punctuation."))]):
        return next(kind for start, kind in SCOPES.items() if scope.startswith(start))
    return ""


def _scoped(scope: str) -> Rule:
    return {"name": f"{scope}.mudline"}


def _match(pattern: str, scope: str = "", **captures: str) -> Rule:
    """A rule for a part of a line; `captures` are the scopes of its groups, _1, _2 and so on."""
    rule: Rule = {"match": pattern}
    if scope:
        rule |= _scoped(scope)
    if captures:
        rule["captures"] = {group.removeprefix("_"): _scoped(name) for group, name in captures.items()}
    return rule


def _include(name: str) -> Rule:
    return {"include": f"#{name}"}


def _name_of(keyword: str) -> str:
    return "block-" + re.sub(r"[^a-z]+", "-", keyword.lower())


def _spelt(name: str) -> str:
    """A pattern for a name in which several blanks are one."""
    return re.escape(name).replace(r"\ ", r"[ \t]+").replace(",", r" *, *").replace(r"\-", "-")


def _any_of(names: Iterable[str]) -> str:
    """A pattern for one of several names, a longer one before its beginning."""
    return "|".join(_spelt(name) for name in sorted(names, key=lambda name: (-len(name), name)))


def _section(name: str, keywords: list[str]) -> Rule:
    return {
        "name": "meta.section.mudline",
        "begin": rf"(?i)^[ \t]*(\$[ \t]*{_spelt(name)})[ \t]*$",
        "beginCaptures": {"1": _scoped("entity.name.section")},
        "end": r"^(?=[ \t]*\$)",
        "patterns": [
            *(_include(_name_of(keyword)) for keyword in keywords),
            _include("other-block"),
            _include("plain"),
        ],
    }


def _any_section() -> Rule:
    return {
        "name": "meta.section.mudline",
        "begin": r"^[ \t]*(\$.*?)[ \t]*$",
        "beginCaptures": {"1": _scoped("entity.name.section")},
        "end": r"^(?=[ \t]*\$)",
        "patterns": [_include("other-block"), _include("plain")],
    }


def _block_rule(head: str, scope: str, patterns: list[Rule]) -> Rule:
    return {
        "name": "meta.block.mudline",
        "begin": rf"(?i)^[ \t]*(\*{head})[ \t]*$",
        "beginCaptures": {"1": _scoped(scope)},
        "end": r"^(?=[ \t]*[*$])",
        "patterns": patterns,
    }


def _block(keyword: str, block: Rule) -> Rule:
    settings: dict[str, list[str]] = block["settings"]
    keys = _any_of(settings)
    not_setting = rf"(?!(?i:{keys})[ \t]*=)" if settings else ""
    patterns = [_include("comment"), _match(rf"^{not_setting}C[A-Za-z].*", "comment.line")]
    if block["slashes"]:
        patterns.append(_match(rf"{_START}(/.*/)", _1="string.unquoted"))
    for key, choices in settings.items():
        if choices:
            choice = rf"(?i){_START}({_spelt(key)})[ \t]*(=)[ \t]*({_any_of(choices)}){_END}"
            patterns.append(
                _match(choice, _1="support.type.property-name", _2="keyword.operator", _3="constant.language")
            )
    if settings:
        setting = rf"(?i){_START}({keys})[ \t]*(=)"
        patterns.append(_match(setting, _1="support.type.property-name", _2="keyword.operator"))
    return _block_rule(rf"[ \t]*{_spelt(keyword)}", "keyword.control", [*patterns, _include("fields")])


def _other_blocks(known: list[str]) -> list[Rule]:
    return [
        _block_rule(rf"[ \t]*(?:{_any_of(known)})", "keyword.control", [_include("plain")]),
        _block_rule(r".*?", "keyword.other.unknown", [_include("plain")]),
    ]


def _fields() -> list[Rule]:
    """Rules for rows, and for settings that the keyword does not have."""
    nested = {"begin": r"\[", "end": r"\]|$", "patterns": [_match('"[^"]*(?:"|$)')]}
    return [
        _match(rf"^[ \t]*{_NUMBER}(?:[ \t]+{_NUMBER})+[ \t]*$", "constant.numeric"),
        _match(rf"{_START}({_KEY})[ \t]*(=)", _1="variable.other.property", _2="keyword.operator"),
        {
            "begin": rf"{_VALUE}(=\[)",
            "beginCaptures": {"1": _scoped("keyword.operator")},
            "end": r"(\])|$",
            "endCaptures": {"1": _scoped("keyword.operator")},
            "patterns": [_include("equation")],
        },
        _match(rf"{_VALUE}({_NUMBER}){_END}", _1="constant.numeric"),
        _match('"[^"]*(?:"|$)', "string.quoted.double"),
        _match(r"\{[^}]*(?:\}|$)", "entity.name.label"),
        {**_scoped("string.unquoted"), **nested, "begin": r"(?<==)\["},
        _match(r"(?:[^,\"{=]|=(?!\[))+|=(?=\[)", "string.unquoted"),
        _match(",", "punctuation.separator"),
    ]


def _equation() -> list[Rule]:
    return [
        _match('"[^"]*(?:"|$)', "string.quoted.double"),
        _match(r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eEdD][-+]?[0-9]+)?", "constant.numeric"),
        _match(r"(?i)(?:and|or|not)(?![\w.])", "keyword.operator.word"),
        _match(r"[^\W\d][\w.]*(?=[ \t]*\()", "entity.name.function"),
        _match(r"[^\W\d][\w.]*", "variable.parameter"),
        _match(r"[-+*/^<>=!]+", "keyword.operator"),
        {"begin": r"\[", "end": r"\]|$", "patterns": [_include("equation")]},
    ]
