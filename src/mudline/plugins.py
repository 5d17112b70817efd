"""What packages with rules of their own need: see docs/plugins.md."""

from __future__ import annotations

from mudline.diagnostics import Code, Problem, Repair, Severity, Span, Where
from mudline.linting.context import LintContext
from mudline.rules import rule

__all__ = ["Code", "LintContext", "Problem", "Repair", "Severity", "Span", "Where", "rule"]
