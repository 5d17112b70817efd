"""mudline: read, check, convert and evaluate the seabed contact of riser and pipeline decks.

deck = mudline.read("scr.keyxm")
for finding in mudline.lint("scr.keyxm"):
    print(finding)
scene = deck.scene()
result = scene.contact().evaluate(positions)
"""

from __future__ import annotations

TYPE_CHECKING = False  # as in typing, whose import would take longer than `mudline --version` does otherwise

if TYPE_CHECKING:
    from mudline.api import (
        Deck,
        Scene,
        contact_warnings,
        from_json,
        from_keyword,
        from_yaml,
        lint,
        read,
        read_positions,
    )
    from mudline.commands import (
        backbone,
        diff,
        diff_matrix,
        expand,
        export,
        fix,
        format,  # noqa: A004 - the name of the command
        migrate,
        report,
        show,
        study,
        validate,
    )
    from mudline.language.diagnostics import DeckError, Diagnostic, Severity
    from mudline.model.contact import ContactModel, ContactResult, ContactState, Plan, PositionError
    from mudline.model.curves import CurveError, ForceCurve
    from mudline.model.results.warnings import ContactWarning
    from mudline.tools.touchdown_study.study import Study

__version__ = "0.1.0"

__all__ = [
    "ContactModel",
    "ContactResult",
    "ContactState",
    "ContactWarning",
    "CurveError",
    "Deck",
    "DeckError",
    "Diagnostic",
    "ForceCurve",
    "Plan",
    "PositionError",
    "Scene",
    "Severity",
    "Study",
    "__version__",
    "backbone",
    "contact_warnings",
    "diff",
    "diff_matrix",
    "expand",
    "export",
    "fix",
    "format",
    "from_json",
    "from_keyword",
    "from_yaml",
    "lint",
    "migrate",
    "read",
    "read_positions",
    "report",
    "show",
    "study",
    "validate",
]

_HOMES = {
    name: home
    for home, names in {
        "api": "Deck Scene contact_warnings from_json from_keyword from_yaml lint read read_positions",
        "commands": "backbone diff diff_matrix expand export fix format migrate report show study validate",
        "model.contact": "ContactModel ContactResult ContactState Plan PositionError",
        "model.curves": "CurveError ForceCurve",
        "language.diagnostics": "DeckError Diagnostic Severity",
        "model.results.warnings": "ContactWarning",
        "tools.touchdown_study.study": "Study",
    }.items()
    for name in names.split()
}


def __getattr__(name: str) -> object:
    """Public names are imported when they are first used: the command line asks for the version alone."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module  # noqa: PLC0415 - as above

    return getattr(import_module(f"mudline.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return __all__
