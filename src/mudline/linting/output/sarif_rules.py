"""Rules as SARIF describes them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mudline.diagnostics import Severity
from mudline.linting.registry import Rule, rules


def described(code: str, levels: Mapping[Severity, str], address: str | None) -> dict[str, Any]:
    """The reporting descriptor of a code; one that no rule has (a file that is no deck) is told by its code only.

    `address` is that of its help on the web: SARIF wants a whole address, not the path of a page.
    """
    link = {} if address is None else {"helpUri": address}
    rule = next((rule for rule in rules() if rule.code.code == code), None)
    if rule is None:
        return {"id": code, **link}
    return {
        "id": code,
        "name": "".join(word.capitalize() for word in rule.code.slug.split("-")),
        "shortDescription": {"text": rule.title},
        "fullDescription": {"text": rule.why},
        "defaultConfiguration": {"level": levels[rule.code.severity], "enabled": not rule.off},
        "help": {"text": f"{rule.title}\n\n{rule.why}", "markdown": _markdown(rule)},
        **link,
    }


def _markdown(rule: Rule) -> str:
    examples = f"Bad:\n\n```text\n{rule.bad.rstrip()}\n```\n\nGood:\n\n```text\n{rule.good.rstrip()}\n```\n"
    return f"# {rule.title}\n\n{rule.why}\n\n{examples}"
