"""Findings as an editor shows them, and their fixes: one by one, or all that keep what the deck means."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from lsprotocol import types

from mudline.basics.limits import SHOWN_ROWS
from mudline.checks.engine import Fixing
from mudline.checks.fixing import fix_bytes
from mudline.checks.pages import page
from mudline.language.deck.forms import KEYWORD, form_of
from mudline.language.diagnostics import Diagnostic, Fix, Severity, Span
from mudline.tools.lsp.decks import Analysis
from mudline.tools.lsp.documents import Document

SOURCE = "mudline"
FIX_ALL = "source.fixAll.mudline"
KINDS = [types.CodeActionKind.QuickFix.value, FIX_ALL]
_SEVERITIES = {
    Severity.ERROR: types.DiagnosticSeverity.Error,
    Severity.WARNING: types.DiagnosticSeverity.Warning,
    Severity.INFO: types.DiagnosticSeverity.Information,
}


def span_of(document: Document, found: Diagnostic) -> Span:
    """The place of a finding."""
    start = document.point(found.line, found.column)
    return Span(start, max(start, document.point(found.end_line, found.end_column)))


def shown(analysis: Analysis) -> list[types.Diagnostic]:
    """The findings of a deck."""
    return [_shown(analysis.document, found) for found in analysis.found]


def _shown(document: Document, found: Diagnostic) -> types.Diagnostic:
    address = page(found.code)
    related = [
        types.DiagnosticRelatedInformation(
            types.Location(document.uri, document.range(span_of(document, one))), f"{one.code} {one.message}"
        )
        for one in found.following[:SHOWN_ROWS]
    ]
    return types.Diagnostic(
        range=document.range(span_of(document, found)),
        message=found.message,
        severity=_SEVERITIES[found.severity],
        code=found.code,
        code_description=types.CodeDescription(address) if address else None,
        source=SOURCE,
        related_information=related or None,
    )


# -------------------------------------------------------------------------------------------------------------- fixes


def actions(
    analysis: Analysis, range_: types.Range, only: Iterable[str] | None, *, resolved: bool
) -> list[types.CodeAction]:
    """The fixes for findings in a range, and one for all of the deck.

    `only` are the kinds that the editor wants, None for any. The edits of the last one are left to `fix_all` where the
    editor asks for them when it needs them (`resolved`): to find them takes as long as several checks.
    """
    document = analysis.document
    wanted = list(only) if only is not None else None
    found: list[types.CodeAction] = []
    if _asked(types.CodeActionKind.QuickFix.value, wanted):
        found += _quick_fixes(analysis, Span(document.offset(range_.start), document.offset(range_.end)))
    if _asked(FIX_ALL, wanted) and any(fix.applicability == "safe" for _, fix in _fixes(analysis)):
        action = types.CodeAction("Fix all findings that have a safe fix", FIX_ALL, data={"uri": document.uri})
        if not resolved:
            action.edit = fix_all(analysis)
        found.append(action)
    return found


def _asked(kind: str, wanted: list[str] | None) -> bool:
    """Whether a kind of action is wanted: kinds are words with dots, of which a first part stands for all below it."""
    return wanted is None or any(kind == one or kind.startswith(f"{one}.") or not one for one in wanted)


def _fixes(analysis: Analysis) -> Iterator[tuple[Diagnostic, Fix]]:
    unfixable = analysis.settings.unfixable
    return ((one, one.fix) for one in analysis.found if one.fix is not None and one.code not in unfixable)


def _quick_fixes(analysis: Analysis, asked: Span) -> Iterator[types.CodeAction]:
    document = analysis.document
    for one, fix in _fixes(analysis):
        span = span_of(document, one)
        if span.start <= asked.end and asked.start <= span.end:
            unsafe = "" if fix.applicability == "safe" else " (may change what the deck means)"
            edits = [
                types.TextEdit(
                    document.range(Span(document.point(*edit.start), document.point(*edit.end))),
                    edit.text,
                )
                for edit in fix.edits
            ]
            yield types.CodeAction(
                f"{one.code}: {fix.message}{unsafe}",
                types.CodeActionKind.QuickFix,
                diagnostics=[_shown(document, one)],
                is_preferred=not unsafe,
                edit=types.WorkspaceEdit(changes={document.uri: edits}),
            )


def fix_all(analysis: Analysis) -> types.WorkspaceEdit | None:
    """What makes all safe fixes of a deck, as `mudline lint --fix` does; None where there is nothing to be done."""
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
