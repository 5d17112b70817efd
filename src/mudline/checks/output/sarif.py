"""Findings in SARIF 2.1.0, the interchange format of static analysis."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any
from urllib.parse import quote

from mudline.basics.version import __version__
from mudline.checks.output import visible, with_fingerprints
from mudline.checks.pages import page
from mudline.checks.registry import rules
from mudline.language.diagnostics import Diagnostic, Edit, Severity
from mudline.language.rules import Rule

SUMMARY = "SARIF 2.1.0: rules with help, levels, regions in code points, fixes and fingerprints"

SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}
_BASE = "ROOT"

_NO_RULE = "This is not a rule and cannot be ignored; the message says why the file could not be used or checked."


def write(diagnostics: Iterable[Diagnostic], files: Sequence[str]) -> Iterator[str]:  # noqa: ARG001 - the same for every form
    """Yield one log with one run; its rules are those with findings."""
    listed = list(diagnostics)
    first = {finding.code: finding for finding in reversed(listed)}
    codes = sorted(first)
    driver = {
        "name": "mudline",
        "version": __version__,
        "semanticVersion": __version__,
        "rules": [_descriptor(first[code]) for code in codes],
    }
    head = {"$schema": SCHEMA, "version": "2.1.0"}
    log = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "newlineSequences": ["\r\n", "\r", "\n"],
        "originalUriBaseIds": {_BASE: {"description": {"text": "the folder that the linter was run in"}}},
    }
    yield f'{json.dumps(head)[:-1]}, "runs": [\n{json.dumps(log)[:-1]}, "results": ['
    for number, (finding, fingerprint) in enumerate(with_fingerprints(listed)):
        result = _result(finding, codes.index(finding.code), fingerprint)
        yield f"{',' * (number > 0)}\n {json.dumps(result)}"
    yield "\n]}]}\n"


def _result(finding: Diagnostic, index: int, fingerprint: str) -> dict[str, Any]:
    place = {
        "artifactLocation": _location(finding.file),
        "region": _region((finding.line, finding.column), (finding.end_line, finding.end_column)),
    }
    result: dict[str, Any] = {
        "ruleId": finding.code,
        "ruleIndex": index,
        "level": LEVELS[finding.severity],
        "message": {"text": visible(finding.message)},
        "locations": [{"physicalLocation": place}],
        "partialFingerprints": {"mudline/v1": fingerprint},
    }
    if finding.fix is not None:
        changes = [{"artifactLocation": _location(finding.file), "replacements": [_edit(e) for e in finding.fix.edits]}]
        result["fixes"] = [{"description": {"text": visible(finding.fix.message)}, "artifactChanges": changes}]
    return result


def _location(file: str) -> dict[str, str]:
    path = file.removeprefix("./")
    written = quote(_bytes(path), safe="/")
    if path.startswith("/"):
        return {"uri": f"file://{written}"}
    if re.match(r"[A-Za-z]:/", path):
        return {"uri": f"file:///{quote(_bytes(path), safe='/:')}"}
    return {"uri": written, "uriBaseId": _BASE}


def _bytes(path: str) -> bytes:
    """Return the bytes of a name, those of the file system if it may have this name."""
    try:
        return os.fsencode(path)
    except UnicodeEncodeError:
        return path.encode("utf-8", "backslashreplace")


def _region(start: tuple[int, int], end: tuple[int, int]) -> dict[str, int]:
    return {"startLine": start[0], "startColumn": start[1], "endLine": end[0], "endColumn": end[1]}


def _edit(edit: Edit) -> dict[str, Any]:
    return {"deletedRegion": _region(edit.start, edit.end), "insertedContent": {"text": edit.text}}


def _descriptor(finding: Diagnostic) -> dict[str, Any]:
    """Return the reporting descriptor of the code of a finding."""
    rule = next((rule for rule in rules() if rule.code.code == finding.code), None)
    title = rule.page.title if rule else f"{finding.slug.replace('-', ' ').capitalize()}."
    why = rule.page.why if rule else _NO_RULE
    severity = rule.code.severity if rule else finding.severity
    address = page(finding.code) or ""
    return {
        "id": finding.code,
        "name": "".join(word.capitalize() for word in finding.slug.split("-")),
        "shortDescription": {"text": title},
        "fullDescription": {"text": why},
        "defaultConfiguration": {"level": LEVELS[severity], "enabled": not (rule and rule.off)},
        "help": {"text": f"{title}\n\n{why}"} | ({"markdown": _markdown(rule)} if rule else {}),
        # An installed file is another one, or none, where the report is read.
        **({"helpUri": address} if address.startswith("http") else {}),
    }


def _markdown(rule: Rule) -> str:
    content = rule.page
    examples = f"Bad:\n\n```text\n{content.bad.rstrip()}\n```\n\nGood:\n\n```text\n{content.good.rstrip()}\n```\n"
    return f"# {content.title}\n\n{content.why}\n\n{examples}"
