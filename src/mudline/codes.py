"""The codes that rooms before the linter use; every other code stands beside its rule."""

from __future__ import annotations

from mudline.diagnostics import Code, Severity

E, W, I = Severity.ERROR, Severity.WARNING, Severity.INFO  # noqa: E741

SYN001 = Code("SYN001", "unreadable-line", E)
SYN002 = Code("SYN002", "bad-number", E)
SYN003 = Code("SYN003", "wrong-field-count", E)
SYN004 = Code("SYN004", "unknown-setting", E)
SYN005 = Code("SYN005", "bad-choice", E)
SYN006 = Code("SYN006", "unbalanced-bracket", E)
SYN007 = Code("SYN007", "keyword-outside-section", E)
SYN008 = Code("SYN008", "keyword-in-wrong-section", E)
SYN009 = Code("SYN009", "unknown-keyword", I)
SYN010 = Code("SYN010", "unknown-section", I)
SYN011 = Code("SYN011", "data-outside-keyword", W)
SYN012 = Code("SYN012", "bad-encoding", W)
SYN013 = Code("SYN013", "ambiguous-comment", W)
SYN014 = Code("SYN014", "truncated-file", E)
SYN015 = Code("SYN015", "decimal-comma", W)
SYN016 = Code("SYN016", "label-without-braces", W)
SYN017 = Code("SYN017", "expression-error", E)
REF001 = Code("REF001", "undefined-set", E)
REF002 = Code("REF002", "undefined-curve", E)
REF005 = Code("REF005", "undefined-element", E)
REF006 = Code("REF006", "undefined-node", E)
REF007 = Code("REF007", "duplicate-id", E)
REF008 = Code("REF008", "subset-cycle", E)
REF009 = Code("REF009", "redefined-all", E)
REF010 = Code("REF010", "empty-set", W)
REF013 = Code("REF013", "undefined-parameter", E)
REF014 = Code("REF014", "parameter-cycle", E)
CRV001 = Code("CRV001", "too-few-points", E)
CRV003 = Code("CRV003", "duplicate-ratio", E)
CRV011 = Code("CRV011", "slope-overflow", E)
SBD002 = Code("SBD002", "two-seabed-types", E)
SBD009 = Code("SBD009", "missing-diameter", E)
