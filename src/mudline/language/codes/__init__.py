"""Codes of findings that reading or resolving a deck reports, a module for each subject.

A code with a page is a rule without a function of its own: the reader or the resolution of the deck reports its
findings. It is declared only in a module of this package. The codes of rules with a function stand beside the
function. The codes in this file are not rules: they cannot be ignored.
"""

from __future__ import annotations

import sys

from mudline.basics.resources import modules_of
from mudline.language.diagnostics import Code, Severity

DOC001 = Code("DOC001", "unreadable-document", Severity.ERROR)
DOC002 = Code("DOC002", "schema-error", Severity.ERROR)
DAT001 = Code("DAT001", "bad-data-file", Severity.ERROR)
EXP001 = Code("EXP001", "cannot-expand", Severity.ERROR)
MIG001 = Code("MIG001", "cannot-migrate", Severity.ERROR)
RUN001 = Code("RUN001", "cannot-evaluate", Severity.ERROR)


def all_codes() -> list[Code]:
    """Return every code of this package, those in this file first."""
    package = sys.modules[__name__]
    values = [value for module in (package, *modules_of(__name__)) for value in vars(module).values()]
    return [code for code in values if isinstance(code, Code)]
