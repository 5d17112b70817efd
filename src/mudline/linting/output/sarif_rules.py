"""Rules as SARIF describes them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mudline.diagnostics import Diagnostic, Severity
from mudline.linting.registry import rules
from mudline.linting.rule import Rule

_NO_RULE = "This is no rule and cannot be left out; the message says why the file could not be used or checked."


def described(found: Diagnostic, levels: Mapping[Severity, str], address: str | None) -> dict[str, Any]:
    """The reporting descriptor of the code of a finding.

    `address` is that of its help on the web: SARIF wants a whole address, not the path of a page.
    """
    rule = next((rule for rule in rules() if rule.code.code == found.code), None)
    title = rule.title if rule else f"{found.slug.replace('-', ' ').capitalize()}."
    why = rule.why if rule else _NO_RULE
    severity = rule.code.severity if rule else found.severity
    return {
        "id": found.code,
        "name": "".join(word.capitalize() for word in found.slug.split("-")),
        "shortDescription": {"text": title},
        "fullDescription": {"text": why},
        "defaultConfiguration": {"level": levels[severity], "enabled": not (rule and rule.off)},
        "help": {"text": f"{title}\n\n{why}"} | ({"markdown": _markdown(rule)} if rule else {}),
        **({"helpUri": address} if address else {}),
    }


def _markdown(rule: Rule) -> str:
    examples = f"Bad:\n\n```text\n{rule.bad.rstrip()}\n```\n\nGood:\n\n```text\n{rule.good.rstrip()}\n```\n"
    return f"# {rule.title}\n\n{rule.why}\n\n{examples}"
