"""mudline: read, check, convert and evaluate the seabed contact of riser and pipeline decks.

deck = mudline.read("scr.keyxm")
for finding in mudline.lint("scr.keyxm"):
    print(finding)
scene = deck.scene()
result = scene.contact().evaluate(positions)
"""

from __future__ import annotations

from mudline.basics.version import __version__ as __version__

TYPE_CHECKING = False  # as in typing, whose import would take longer than `mudline --version` does otherwise

if TYPE_CHECKING:
    from mudline.api import Deck as Deck
    from mudline.api import Scene as Scene
    from mudline.api import contact_warnings as contact_warnings
    from mudline.api import from_json as from_json
    from mudline.api import from_keyword as from_keyword
    from mudline.api import from_yaml as from_yaml
    from mudline.api import lint as lint
    from mudline.api import read as read
    from mudline.api import read_positions as read_positions
    from mudline.api.commands import diff as diff
    from mudline.api.commands import diff_matrix as diff_matrix
    from mudline.api.commands import expand as expand
    from mudline.api.commands import export as export
    from mudline.api.commands import fix as fix
    from mudline.api.commands import format as format  # noqa: A004 - the name of the command
    from mudline.api.commands import migrate as migrate
    from mudline.api.commands import report as report
    from mudline.api.commands import show as show
    from mudline.api.commands import study as study
    from mudline.api.commands import validate as validate
    from mudline.editing.backbone_block import backbone as backbone
    from mudline.language.diagnostics import DeckError as DeckError
    from mudline.language.diagnostics import Diagnostic as Diagnostic
    from mudline.language.diagnostics import Severity as Severity
    from mudline.model.contact import ContactModel as ContactModel
    from mudline.model.contact import ContactResult as ContactResult
    from mudline.model.contact import ContactState as ContactState
    from mudline.model.contact import Plan as Plan
    from mudline.model.contact import PositionError as PositionError
    from mudline.model.curves import CurveError as CurveError
    from mudline.model.curves import ForceCurve as ForceCurve
    from mudline.model.results.warnings import ContactWarning as ContactWarning
    from mudline.tools.touchdown_study.study import Study as Study

_HOMES = {
    name: home
    for home, names in {
        "api": "Deck Scene contact_warnings from_json from_keyword from_yaml lint read read_positions",
        "api.commands": "diff diff_matrix expand export fix format migrate report show study validate",
        "editing.backbone_block": "backbone",
        "model.contact": "ContactModel ContactResult ContactState Plan PositionError",
        "model.curves": "CurveError ForceCurve",
        "language.diagnostics": "DeckError Diagnostic Severity",
        "model.results.warnings": "ContactWarning",
        "tools.touchdown_study.study": "Study",
    }.items()
    for name in names.split()
}
__all__ = list(_HOMES)
__all__ += ["__version__"]


def __getattr__(name: str) -> object:
    """Import a public name when it is first used, so that `mudline --version` imports nothing."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module  # noqa: PLC0415 - as above

    return getattr(import_module(f"mudline.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
