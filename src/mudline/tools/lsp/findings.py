"""Findings for an editor, and their fixes: one by one, or all safe fixes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from lsprotocol import types

from mudline.basics.limits import SHOWN_ROWS
from mudline.checks.engine import Fixing
from mudline.checks.fixing import fix_bytes
from mudline.checks.pages import page
from mudline.language.deck.forms import KEYWORD, form_of
from mudline.language.diagnostics import Diagnostic, Fix, Severity, Span
from mudline.tools.lsp.decks import Analysis, OpenDocument

SOURCE = "mudline"
FIX_ALL = "source.fixAll.mudline"
KINDS = [types.CodeActionKind.QuickFix.value, FIX_ALL]
_SEVERITIES = {
    Severity.ERROR: types.DiagnosticSeverity.Error,
    Severity.WARNING: types.DiagnosticSeverity.Warning,
    Severity.INFO: types.DiagnosticSeverity.Information,
}


def span_of(document: OpenDocument, finding: Diagnostic) -> Span:
    """Return the place of a finding."""
    start = document.point(finding.line, finding.column)
    return Span(start, max(start, document.point(finding.end_line, finding.end_column)))


def shown(analysis: Analysis) -> list[types.Diagnostic]:
    """Return the findings of a deck."""
    return [_shown(analysis.document, finding) for finding in analysis.found]


def _shown(document: OpenDocument, finding: Diagnostic) -> types.Diagnostic:
    address = page(finding.code)
    related = [
        types.DiagnosticRelatedInformation(
            types.Location(document.uri, document.range(span_of(document, consequence))),
            f"{consequence.code} {consequence.message}",
        )
        for consequence in finding.following[:SHOWN_ROWS]
    ]
    return types.Diagnostic(
        range=document.range(span_of(document, finding)),
        message=finding.message,
        severity=_SEVERITIES[finding.severity],
        code=finding.code,
        code_description=types.CodeDescription(address) if address else None,
        source=SOURCE,
        related_information=related or None,
    )


# -------------------------------------------------------------------------------------------------------------- fixes


def actions(
    analysis: Analysis, range_: types.Range, only: Sequence[str] | None, *, resolved: bool
) -> Iterator[types.CodeAction]:
    """Yield the fixes for findings in a range, and an action that fixes the whole deck.

    `only` are the kinds that the editor requests, None for any. If the editor asks for edits later (`resolved`), those
    of the last action are left to `fix_all`: they take as long as several checks.
    """
    document = analysis.document
    if _asked(types.CodeActionKind.QuickFix.value, only):
        yield from _quick_fixes(analysis, Span(document.offset(range_.start), document.offset(range_.end)))
    if _asked(FIX_ALL, only) and any(fix.applicability == "safe" for _, fix in _fixes(analysis)):
        action = types.CodeAction("Fix all findings that have a safe fix", FIX_ALL, data={"uri": document.uri})
        if not resolved:
            action.edit = fix_all(analysis)
        yield action


def _asked(kind: str, kinds: Sequence[str] | None) -> bool:
    """Return True if a kind of action is requested; kinds have parts with dots, and `a` includes `a.b`."""
    return kinds is None or any(kind == asked or kind.startswith(f"{asked}.") or not asked for asked in kinds)


def _fixes(analysis: Analysis) -> Iterator[tuple[Diagnostic, Fix]]:
    unfixable = analysis.settings.unfixable
    return ((each, each.fix) for each in analysis.found if each.fix is not None and each.code not in unfixable)


def _quick_fixes(analysis: Analysis, asked: Span) -> Iterator[types.CodeAction]:
    document = analysis.document
    for finding, fix in _fixes(analysis):
        span = span_of(document, finding)
        if span.start <= asked.end and asked.start <= span.end:
            unsafe = "" if fix.applicability == "safe" else " (may change what the deck means)"
            places = (Span(document.point(*edit.start), document.point(*edit.end)) for edit in fix.edits)
            ranges = map(document.range, places)
            edits = [types.TextEdit(at, edit.text) for at, edit in zip(ranges, fix.edits, strict=True)]
            yield types.CodeAction(
                f"{finding.code}: {fix.message}{unsafe}",
                types.CodeActionKind.QuickFix,
                diagnostics=[_shown(document, finding)],
                is_preferred=not unsafe,
                edit=types.WorkspaceEdit(changes={document.uri: edits}),
            )


def fix_all(analysis: Analysis) -> types.WorkspaceEdit | None:
    """Return the edits of all safe fixes of a deck, as `mudline lint --fix` makes them; None if there are none."""
    document = analysis.document
    if form_of(document.name) != KEYWORD or document.is_too_large:
        return None
    folder = document.path.parent if document.path else None
    settings = replace(analysis.settings, fixing=Fixing.SAFE)
    with analysis.reading():
        fixed = fix_bytes(document.as_file(), document.name, settings, folder)
    if fixed.changed is None:
        return None
    return types.WorkspaceEdit(changes={document.uri: document.difference(fixed.changed)})
