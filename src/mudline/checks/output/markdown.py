"""Findings as a table in Markdown, for a job's summary or a note on a change: errors first, limited in number.

A host takes about a million characters. No text of a deck can act as markup, link or mention there.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from mudline.basics.short_repr import counted
from mudline.checks.output import by_severity, visible
from mudline.checks.pages import page
from mudline.language.diagnostics import Diagnostic

SUMMARY = (
    "a table in Markdown for the summary of a job or a note on a merge request: errors first, "
    "the first 200 findings, the others counted"
)

_MOST = 200
_MARKUP = re.compile(r"[\\`*_{}\[\]<>#|~@&!$]|:(?=//)|(?<=www)\.")


def write(diagnostics: Iterable[Diagnostic], files: Sequence[str]) -> Iterator[str]:
    """Yield a heading with the totals, then a row for each finding; the heading alone without findings."""
    listed = sorted(diagnostics, key=lambda finding: (-finding.severity.rank, finding.sort_key))
    linted = counted(len(files), "file")
    if not listed:
        yield f"### mudline: no findings in {linted}\n"
        return
    yield f"### mudline: {', '.join(words for _, words in by_severity(listed))} in {linted}\n\n"
    yield "| severity | place | rule | message |\n| --- | --- | --- | --- |\n"
    for finding in listed[:_MOST]:
        place = _plain(f"{finding.file.removeprefix('./')}:{finding.line}:{finding.column}")
        address = page(finding.code) or ""
        code = f"[{finding.code}]({address})" if address.startswith("http") else finding.code
        slug, message = _plain(finding.slug), _plain(finding.message)
        yield f"| {finding.severity.value} | {place} | {code} {slug} | {message} |\n"
    if len(listed) > _MOST:
        yield f"\nand {counted(len(listed) - _MOST, 'finding')} more.\n"


def _plain(text: str) -> str:
    """Return a text in which no character is markup."""
    return _MARKUP.sub(lambda char: f"&#{ord(char[0])};", visible(text))
