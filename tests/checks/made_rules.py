"""Rules and findings made up for tests."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

import mudline
from mudline.checks.context import LintContext
from mudline.language.diagnostics import Code, Diagnostic, Edit, Fix, Problem, Repair, Severity, Span
from mudline.language.rules import Rule
from tests.cli.runner import ROOT, Outcome, process


def replacing(
    pattern: str, text: str, *, code: str = "TST001", kind: str = "safe", severity: Severity = Severity.WARNING
) -> Rule:
    """A rule that finds a pattern and puts a text (a template of `re`) in its place."""
    name = Code(code, f"made-{code.lower()}", severity)

    def check(context: LintContext) -> Iterator[Problem]:
        if context.text is None:
            return
        for match in re.finditer(pattern, context.text.source.unified, re.MULTILINE):
            span = Span(*match.span())
            yield Problem(name, "replace this", span, repair=Repair(kind, "replace", ((span, match.expand(text)),)))

    return Rule(name, check, "")


# -------------------------------------------------------------------------------------------------------------- outputs

NO_FRICTION = "$MODEL\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=50000.0\n"


def finding(**changed: object) -> Diagnostic:
    given = {
        "file": "decks/scr.keyxm",
        "code": "LEG001",
        "slug": "superseded-keyword",
        "severity": Severity.WARNING,
        "message": "100% of a,b:c <&\"'> are\x00 \x1b[31mred\r\nü",
        "line": 3,
        "column": 2,
        "end_line": 3,
        "end_column": 6,
        "fix": Fix("safe", "write it so", (Edit((3, 2), (3, 6), "a\tb"),)),
    } | changed
    return Diagnostic(**given)  # type: ignore[arg-type] # the values are those of the fields


def plugin_lint(folder: Path, form: str, project_url: str) -> Outcome:
    """Lint a deck with the rule of samples/plugin, whose package tells an address of this kind."""
    info = folder / "acme_mudline-1.0.dist-info"
    info.mkdir(exist_ok=True)
    url = f"Project-URL: {project_url}\n" if project_url else ""
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: acme-mudline\nVersion: 1.0\n{url}")
    (info / "entry_points.txt").write_text("[mudline.rules]\nacme = acme_mudline.friction\n")
    (folder / "deck.keyxm").write_text(NO_FRICTION)
    path = [Path(mudline.__file__).parents[1], folder, ROOT / "samples" / "plugin" / "src"]
    env = {"PYTHONPATH": os.pathsep.join(str(each) for each in path)}
    words = ("lint", "deck.keyxm", "--select", "ACM", "--isolated", "--output-format", form)
    return process(*words, env=env, cwd=folder)
