"""What is noticed while a deck is read or resolved, a module for each subject.

A code with a page is a check that needs no function of its own: the reader, or what resolves the deck, gives the
findings. Codes of checks with a function stand beside it. A module of this package is all that such a code is declared
in.
"""

from __future__ import annotations

from mudline.codes.curves import *  # noqa: F403 - each code is named once, where it is declared
from mudline.codes.fields import *  # noqa: F403 - as above
from mudline.codes.lines import *  # noqa: F403 - as above
from mudline.codes.references import *  # noqa: F403 - as above
from mudline.codes.words import *  # noqa: F403 - as above
from mudline.diagnostics import Code, Severity

DOC001 = Code("DOC001", "unreadable-document", Severity.ERROR)
DOC002 = Code("DOC002", "schema-error", Severity.ERROR)
DAT001 = Code("DAT001", "bad-data-file", Severity.ERROR)
EXP001 = Code("EXP001", "cannot-expand", Severity.ERROR)
MIG001 = Code("MIG001", "cannot-migrate", Severity.ERROR)
RUN001 = Code("RUN001", "cannot-evaluate", Severity.ERROR)
