"""What is noticed while a deck is read or resolved, a module for each subject.

A code with a page is a rule that needs no function of its own: the reader, or what resolves the deck, gives the
findings. Codes of rules with a function stand beside it. A module of this package is all that such a code is declared
in. The codes in this file are no rules: nothing leaves them out.
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
    """Every code of this package, those in this file first."""
    package = sys.modules[__name__]
    found = [value for module in (package, *modules_of(__name__)) for value in vars(module).values()]
    return [code for code in found if isinstance(code, Code)]
