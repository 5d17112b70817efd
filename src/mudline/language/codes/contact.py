"""Codes shared by rules of the checks and warnings of an evaluated deck, and codes of such warnings alone.

The pages of the shared codes are the docstrings of their rules.
RUN003 to RUN008 are not rules: they depend on positions.
"""

from __future__ import annotations

from mudline.language.diagnostics import Code, Severity

REF003 = Code("REF003", "unused-curve", Severity.WARNING)
REF004 = Code("REF004", "duplicate-curve", Severity.WARNING)
SBD006 = Code("SBD006", "no-vertical-restraint", Severity.WARNING)
SBD017 = Code("SBD017", "curve-named-as-number", Severity.WARNING)
SBD025 = Code("SBD025", "law-without-effect", Severity.WARNING)
GEO005 = Code("GEO005", "not-on-the-seabed", Severity.WARNING)
GEO017 = Code("GEO017", "beyond-the-survey", Severity.WARNING)
RUN003 = Code("RUN003", "no-equilibrium", Severity.WARNING)
RUN004 = Code("RUN004", "floating-pipe", Severity.WARNING)
RUN005 = Code("RUN005", "rigid-reaction", Severity.WARNING)
RUN006 = Code("RUN006", "other-lengths", Severity.WARNING)
RUN007 = Code("RUN007", "no-positions", Severity.WARNING)
RUN008 = Code("RUN008", "rounded-positions", Severity.WARNING)
