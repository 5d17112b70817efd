"""Names that packages with rules of their own import: see docs/plugins.md."""

from __future__ import annotations

from mudline.checks.context import LintContext
from mudline.language.diagnostics import Code, Problem, Repair, Severity, Span, Where
from mudline.language.rules import rule

__all__ = ["Code", "LintContext", "Problem", "Repair", "Severity", "Span", "Where", "rule"]
