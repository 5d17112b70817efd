from __future__ import annotations

from mudline.diagnostics import Diagnostic, Edit, Fix, Severity


def finding(**changed: object) -> Diagnostic:
    given = {
        "file": "decks/scr.keyxm",
        "code": "LEG001",
        "slug": "superseded-keyword",
        "severity": Severity.WARNING,
        "message": "100% of a,b:c <&\"'> are\x00 \x1b[31mred\r\nü",
        "line": 3,
        "column": 2,
        "end_line": 3,
        "end_column": 6,
        "fix": Fix("safe", "write it so", (Edit((3, 2), (3, 6), "a\tb"),)),
    } | changed
    return Diagnostic(**given)  # type: ignore[arg-type] # the values are those of the fields
