"""`mudline convert`."""

from __future__ import annotations

import math
from pathlib import Path, PurePath

import click
import numpy as np

from mudline.checks.context import LintContext
from mudline.checks.engine import readable
from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import GivenDeck, require_text, takes_deck
from mudline.cli.streams import emit, notify, require, write_text
from mudline.cli.view import View
from mudline.language.deck.forms import KEYWORD, SUFFIXES, form_names, form_of
from mudline.language.deck.keyword_text import with_raw_lines
from mudline.language.deck.loading import dump
from mudline.language.deck.model import Deck
from mudline.language.deck.searching import has_suffix
from mudline.language.diagnostics import DeckError
from mudline.language.keywords.contents import is_refused
from mudline.language.keywords.model import FEWEST_POINTS, Block

_FORMS = click.Choice(form_names())
_TABLES = ("xlsx", "csv")
_GRIDS = ("geotiff", "esri-asc", "moordyn-grid")
_KINDS = {".xlsx": "xlsx", ".xlsm": "xlsx", ".csv": "csv", ".tif": "geotiff", ".tiff": "geotiff", ".asc": "esri-asc"}
_SOURCES = click.Choice([*form_names(), *_TABLES, *_GRIDS])
_OTHER_SHEETS = {".xls", ".xlsb", ".ods"}


@options.command("convert")
@options.output(type=options.OUTPUT_TEXT, help="Write to this file; without it, or with -, to standard output.")
@options.option("--from", "source", type=_SOURCES, help="Read DECK in this format, not in that of its suffix.")
@options.option("--to", "target", type=_FORMS, help="Write in this format, not in that of the suffix of OUT.")
@options.flag("--sorted", "in_order", help="Write curves with their points sorted by ratio.")
@options.option("--within", type=float, metavar="METRES", help="Thin a seabed (.tif, .asc) as far as this error.")
@options.option("--origin", metavar="E,N", help="Easting and northing of Y = Z = 0 of a seabed (default 0,0).")
@options.option("--datum", type=float, metavar="ELEVATION", help="Elevation of X = 0 of a seabed (default 0).")
@options.flag("--keep-faults", help="Carry blocks that cannot be read as their lines, as they are written.")
@options.flag("--anonymous", help="Replace names, drop what the contact does not need, move the origin; forces stay.")
@takes_deck
def command(
    *,
    deck: GivenDeck,
    output: str | None,
    source: str | None,
    target: str | None,
    in_order: bool,
    within: float | None,
    origin: str | None,
    datum: float | None,
    keep_faults: bool,
    anonymous: bool,
    view: View,
) -> int:
    """Convert a deck between keyword text, JSON and YAML; tables (.xlsx, .csv) and seabeds (.tif, .asc) to a deck.

    Only blank lines and the spelling of numbers are lost. A deck with lines that cannot be read is not converted, nor
    one with a value that its keyword does not allow, as a curve of one point or a negative depth, to JSON or YAML:
    --keep-faults carries such blocks as they are.
    """
    suffix = PurePath(deck.path).suffix.lower()
    kind = source or _KINDS.get(suffix, "")
    if kind in _GRIDS:
        return _bed(deck, kind, output, within, _origin(origin, datum), view)
    if (within, origin, datum) != (None, None, None):
        raise click.UsageError("--within, --origin and --datum are for a seabed: give a .tif or .asc, or --from")
    if keep_faults and anonymous:
        raise click.UsageError("--keep-faults carries lines unread, with their names: leave it or --anonymous out")
    form = target or _form_of_output(output)
    if source is None and suffix in _OTHER_SHEETS:
        raise click.UsageError(f"{deck.path}: {suffix} cannot be read: save it as .xlsx in the spreadsheet program")
    given = _tables(deck, kind) if kind in _TABLES else deck.load(source)
    read = _with_faults(given, view) if keep_faults else readable(given)
    if form != "keyword":
        _require_values(read)
    if anonymous:
        read = _anonymous(read, view)
    if in_order:
        for name in sort_curves(read):
            notify(f"curve {name} keeps its order: a ratio in it is an equation")
    text = dump(read, form)
    if not output:
        emit([text])
        return DONE
    path = Path(output)
    write_text(path, [text])
    view.note(f"{deck.path if anonymous else read.file} -> {path.as_posix()}")
    return DONE


def _with_faults(deck: Deck, view: View) -> Deck:
    """The deck with its faulty blocks as lines; says which they are. Raises DeckError."""
    made, places = with_raw_lines(require_text(deck))
    for where in places:
        line = deck.place(where).line
        keyword = deck.sections[where.section].blocks[where.block].keyword
        view.note(f"{deck.file}:{line}: *{keyword} is carried as its lines: it has errors")
    return made


def _anonymous(deck: Deck, view: View) -> Deck:
    """The deck without what tells whose it is; says what was done to it. Raises DeckError."""
    from mudline.editing.anonymizing import TOLERANCE, anonymous  # noqa: PLC0415 - few decks are given away

    made = anonymous(deck)
    view.note(f"both decks evaluated: forces are the same to {TOLERANCE:g} of the largest")
    if made.left_out:
        view.note(f"left out: {', '.join(f'*{keyword}' for keyword in made.left_out)}")
    if any(made.shift):
        view.note("for you alone: {:g} was taken from Y and {:g} from Z".format(*made.shift))
    view.note("diameters, soil, elevations and numbers of nodes and elements stay: read the deck before you send it")
    return made.deck


def _origin(given: str | None, datum: float | None) -> tuple[float, float, float]:
    """Elevation, easting and northing of the deck's origin; raises click.UsageError."""
    try:
        east, north = (float(word) for word in (given or "0,0").split(","))
    except ValueError:
        east = north = math.nan
    if not math.isfinite(east + north + (datum or 0.0)):
        raise click.UsageError(f"--origin {given!r}, --datum {datum}: expected finite numbers, as in 430000,6500000")
    return datum or 0.0, east, north


def _bed(
    deck: GivenDeck, form: str, output: str | None, within: float | None, origin: tuple[float, float, float], view: View
) -> int:
    """Write the deck of a seabed and its file of points. Raises DeckError, click.ClickException."""
    if not output or PurePath(output).suffix.lower() not in {".keyxm", ".keyx", ".das"}:
        raise click.UsageError("a seabed in metres becomes two files: give -o OUT.keyxm")
    if within is None or not 0.0 < within < math.inf:
        raise click.UsageError("a seabed is thinned: give its largest error, as in --within 0.05")
    require(f"a seabed ({form})", "bathymetry", "scipy", *["rasterio"] * (form == "geotiff"))
    from mudline.cli.evaluate_inputs import read_file  # noqa: PLC0415 - only a seabed needs it
    from mudline.language.deck.loading import load_bytes  # noqa: PLC0415 - as above
    from mudline.tools.exporting.bathymetry import bed_deck  # noqa: PLC0415 - as above

    path = Path(output).with_suffix(".xyz")
    bed = read_file(deck.path, lambda file: bed_deck(file, form, path.name, within, origin))
    found = load_bytes(bed.deck.encode(), output)
    if found.problems or [getattr(block, "file", "") for each in found.sections for block in each.blocks] != [
        path.name
    ]:
        raise click.UsageError(
            f"{path.name!r}: a deck does not read this as the name of a file: give letters and digits"
        )
    write_text(path, [bed.points])
    write_text(Path(output), [bed.deck])
    if bed.above:
        notify(f"{bed.above} of {bed.given} points are above the sea: are they depths, not elevations?")
    view.note(f"{bed.kept} of {bed.given} points, largest difference {bed.error:.3g} m")
    view.note(f"{deck.path} -> {output}, {path.as_posix()}")
    if bed.error > within:
        notify(f"--within {within:g} m is not held: write the points with more digits, or nearer to X = 0")
        return FOUND
    return DONE


def _tables(deck: GivenDeck, form: str) -> Deck:
    """The deck of tables; ends the command without the library that they need. Raises DeckError."""
    if form == "xlsx":
        require(".xlsx", "excel", "openpyxl")
    from mudline.model.scene.keyword_tables import read_tables  # noqa: PLC0415 - only tables need it
    from mudline.model.scene.workbook import csv_sheet, workbook_sheets  # noqa: PLC0415 - as above

    data, file = deck.content()
    sheets = workbook_sheets(data, file.name) if form == "xlsx" else [csv_sheet(data, file.name)]
    found = read_tables(sheets, file.name, deck.units)
    for sheet in found.left_out:
        notify(f"sheet {sheet} is left out: no headings of a keyword in its first row")
    return found.deck


def _require_values(deck: Deck) -> None:
    """Raise DeckError with the errors of a deck some of whose values no document holds."""
    if not any(is_refused(block) for _, _, block in deck.every_block() if isinstance(block, Block)):
        return
    from mudline.checks.engine import all_findings, errors_of  # noqa: PLC0415 - only a faulty deck is checked

    raise DeckError(deck.diagnose(errors_of(all_findings(LintContext(deck)))))


def _form_of_output(output: str | None) -> str:
    if not output:
        raise click.UsageError("unknown format to write: give -o OUT with a suffix, or --to")
    if not has_suffix(output):
        known = ", ".join(sorted({*SUFFIXES, *(f".{name}" for name in form_names() if name != KEYWORD)}))
        raise click.UsageError(f"{output}: unknown file format (known: {known}): give --to {', '.join(form_names())}")
    return form_of(output)


def sort_curves(deck: Deck) -> list[str]:
    """Sort the points of every curve in place, comments before a point going with it.

    Returns the names of curves that were left as they are, because a ratio in them is an equation.
    """
    left: list[str] = []
    for _, block in deck.blocks_with("defines"):
        for curve in block.curves if block.facts.defines == "curves" else ():
            if any(column == 0 for _, column in curve.points.words):
                left.append(getattr(curve, "name", None) or curve.set_name or "ALL")
                continue
            if len(curve.points) < FEWEST_POINTS:
                continue
            table, order = curve.points, np.argsort(curve.points.values[:, 0], kind="stable")
            new_row = {old: new for new, old in enumerate(order.tolist())}
            moved = [
                each.model_copy(update={"before": new_row.get(each.before, len(order))}) for each in curve.comments
            ]
            curve.comments = sorted(moved, key=lambda comment: comment.before)
            curve.points = table.chosen(order)
    return left
