"""Public objects of `import mudline`: decks from files and texts, and their findings."""

from __future__ import annotations

import errno
import os
from collections import Counter
from collections.abc import Iterable, Mapping
from functools import cached_property, partial
from itertools import chain
from pathlib import Path
from types import NoneType
from typing import TYPE_CHECKING, Literal, cast

import numpy as np

from mudline.basics.arguments import expect, expect_word, given_path, read_only, several
from mudline.basics.files import write_atomically
from mudline.basics.units import UNITS
from mudline.checks.configuration import Configured
from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select as _chosen
from mudline.language.deck import model
from mudline.language.deck.forms import KEYWORD, form_of
from mudline.language.deck.loading import dump, load_bytes, load_path
from mudline.language.deck.typed import TypedDeck
from mudline.language.deck.writing import keyword_file
from mudline.language.diagnostics import Diagnostic
from mudline.model.scene import model as scenes

if TYPE_CHECKING:
    from mudline.language.deck.parameters import EvaluatedDeck
    from mudline.language.rules import Rule
    from mudline.model.contact import ContactModel, ContactResult
    from mudline.model.contact.arrays import Positions
    from mudline.model.contact.plan import Backend
    from mudline.model.curves import ForceCurve
    from mudline.model.results.warnings import ContactWarning
    from mudline.model.scene.numbering import Floats, Ids, Indices
    from mudline.model.scene.resolved import ByName


class Deck(TypedDeck):
    """A deck: its sections and blocks as validated models, equations as written.

    `read`, `from_keyword`, `from_json` and `from_yaml` return decks. Values are set as attributes of blocks. A value
    that a field cannot have raises ValueError and changes nothing.
    """

    def to_json(self) -> str:
        """Return the deck as JSON text; nothing but layout is lost."""
        return dump(self.alone, "json")

    def to_yaml(self) -> str:
        """Return the deck as YAML 1.2 text; nothing but layout is lost."""
        return dump(self.alone, "yaml")

    def to_keyword(self) -> str:
        """Return the deck as keyword text.

        Raises:
            DeckError: a name, comment or raw line cannot be written in a keyword file.
        """
        return dump(self.alone, "keyword")

    def set(self, path: str, value: object) -> None:
        """Set one value, as `mudline set` does: `deck.set("SEABED PROPERTIES[TDZ].friction", (0.3, 0.5))`.

        Args:
            path: `KEYWORD.field`. If there are several records, `KEYWORD[TDZ].field` is that of a set or a name, and
                `KEYWORD[N].field` the N-th.
            value: a number or a text; rows for a table; several values for a field of several values.

        Raises:
            ValueError: no keyword has such a field; the deck has no such value, several, or an equation there; or the
                field cannot have the value. The deck is then unchanged.
        """
        from mudline.editing.assignment.assigning import set_value  # noqa: PLC0415 - most scripts set attributes

        expect(path, "path", str, "a str")
        set_value(self, path, value)

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the deck to a file in one step: keyword text, JSON or YAML, by its suffix.

        Keyword text that was read keeps its encoding and line ends. Unchanged lines keep their bytes.

        Raises:
            OSError: the file cannot be written; an existing file remains unchanged.
            DeckError: a name, comment or raw line cannot be written in a keyword file.
        """
        file = given_path(path)
        write_atomically(file, content_as(self, file.name))

    def scene(self) -> Scene:
        """Return the deck resolved: equations evaluated, sets expanded, diameters, lengths and laws as arrays.

        Raises:
            DeckError: the deck has errors on which a result depends.
        """
        return Scene(scenes.resolve(self.alone.placed()).require())


class Scene:
    """A deck resolved: equations evaluated, sets expanded, everything as arrays in the deck's units; X is up.

    `Deck.scene` returns scenes; `contact` returns the evaluator. The scene has n nodes and m elements. Its arrays are
    read-only: evaluation uses the same arrays.
    """

    def __init__(self, resolved: scenes.Scene) -> None:
        expect(resolved, "resolved", scenes.Scene, "the resolved scene of a deck")
        self._resolved = resolved

    def __repr__(self) -> str:
        return repr(self._resolved)

    def _repr_html_(self) -> str:
        """Return counts, laws, curves and sets for notebooks."""
        from mudline.basics.html_repr import html_page, html_table  # noqa: PLC0415 - only notebooks ask for it
        from mudline.model.results.summary_tables import OPEN  # noqa: PLC0415 - as above

        groups = self._resolved.set_table.named.values()
        sets = [(group.name, _members(len(group.elements), is_open=group.open)) for group in groups]
        some_open = any(isinstance(number, str) for _, number in sets)
        counts = (
            ("nodes", len(self.node_ids)),
            ("elements", _members(len(self.element_ids), is_open=self._resolved.set_table.everything.open)),
            ("sets", len(self.sets)),
            ("curves", len(self.curves)),
        )
        laws = Counter(self.law_names)
        curves = ((name, len(curve.ratios), float(curve.forces.max())) for name, curve in self.curves.items())
        return html_page(
            "Scene",
            f"{self.deck.file}, {self.units}{f'; {OPEN}' * some_open}",
            html_table(("", "number"), counts, 4),
            html_table(("law", "elements"), laws.items(), len(laws)),
            html_table(("curve", "points", "largest force"), curves, len(self.curves)),
            html_table(("set", "elements"), sets, len(sets)),
        )

    @property
    def deck(self) -> EvaluatedDeck:
        """The deck with its equations evaluated."""
        return self._resolved.deck

    @property
    def source(self) -> str:
        """Path of the file from which the deck was made, or of the deck."""
        return self._resolved.source

    @property
    def units(self) -> str:
        """The unit system: "metric", "imperial" or "user"."""
        return self._resolved.units

    @property
    def node_ids(self) -> Ids:
        """Node numbers (n,), in the order in which they first appear."""
        return read_only(self._resolved.node_ids)

    @property
    def coordinates(self) -> Floats:
        """Node coordinates (n, 3), X up."""
        return read_only(self._resolved.coordinates)

    @property
    def element_ids(self) -> Ids:
        """Element numbers (m,)."""
        return read_only(self._resolved.element_ids)

    @property
    def element_nodes(self) -> Indices:
        """Indices (m, 2) of each element's nodes."""
        return read_only(self._resolved.element_nodes)

    @property
    def length(self) -> Floats:
        """Element lengths (m,) between the deck's coordinates."""
        return read_only(self._resolved.length)

    @property
    def diameter(self) -> Floats:
        """External diameters (m,): Do, else Dd of a FLEXIBLE section; NaN where there is none."""
        return read_only(self._resolved.diameter)

    @property
    def law_names(self) -> tuple[str, ...]:
        """`curve:NAME`, or the name of another `LawKind` in lower case, for each element."""
        return self._names[0]

    @property
    def law_sets(self) -> tuple[str | None, ...]:
        """Name of the set through which each element got its law; None without a law."""
        return self._names[1]

    @cached_property
    def _names(self) -> tuple[tuple[str, ...], tuple[str | None, ...]]:
        return tuple(self._resolved.law_names), tuple(self._resolved.law_sets)

    @property
    def sets(self) -> ByName[Ids]:
        """Element numbers (k,) of every set by its name, found without case; ALL included."""
        return self._resolved.sets

    @property
    def curves(self) -> ByName[ForceCurve]:
        """The force-embedment curves by name, found without case; a curve of `*EMBEDMENT` has the name of its set.

        The later of two curves of one name applies; a named curve comes before that of a set.
        """
        return self._resolved.curves

    def contact(self, tension: Literal["keep", "cut"] = "keep", *, backend: Backend = "auto") -> ContactModel:
        """Return the evaluator of this scene, with only the stages it needs.

        Args:
            tension: "cut" sets force and stiffness of curves to 0 where the force is tensile.
            backend: "fast" steps through history with compiled loops (extra `mudline[fast]`), "numpy" never does,
                "auto" does for series long enough to pay for compilation.

        Raises:
            ImportError: "fast" is not installed.
            DeckError: findings prevent evaluation, or (RUN001) a fault that no check covers, as a deck without
                elements.
        """
        expect_word(tension, "tension", ("keep", "cut"), "'keep' or 'cut'")
        if not len(self.element_ids):
            from mudline.model.results.evaluation import require_elements  # noqa: PLC0415 - few scenes need it

            require_elements(self._resolved.require_evaluable(tension))
        return self._resolved.contact(tension, backend=backend)

    def rest_shape(self) -> Positions:
        """Return the resting shape: positions of all nodes under weight and contents alone, without a load case.

        A line hangs as a catenary between its held ends; the upper end is moved by the `*OFFSET` of its vessel. The
        line lies at static embedment and bends near its touchdown. Nodes of lines without such a shape are NaN, and
        False in `.present`.

        Raises DeckError if no line has a resting shape (the message gives the reason of the first line), or if the deck
        cannot be evaluated.
        """
        from mudline.tools.touchdown_study.rest_shape import rest_shape  # noqa: PLC0415 - decks alone do without it

        return rest_shape(self._resolved).positions


def _members(number: int, *, is_open: bool) -> int | str:
    """Return the number of elements of a set; a text if the set may have more elements that were not read."""
    return (f"{number}+" if number else "not known") if is_open else number


def read(path: str | os.PathLike[str], *, units: str | None = None) -> Deck:
    """Read a deck from a keyword, JSON or YAML file, by its suffix.

    Args:
        path: the file. `from_keyword`, `from_json` and `from_yaml` read the text of a deck.
        units: "metric", "imperial" or "user", in place of the units in the file.

    Raises:
        OSError: the file cannot be read.
        DeckError: its content cannot be read; `.diagnostics` has the places.
        ValueError: `path` is the text of a deck.
        TypeError: `path` is not a path.
    """
    return public(load_path(given_path(path), units=given_units(units)))


def read_positions(path: object, scene: Scene, *, columns: Mapping[str, str] | None = None) -> Positions:
    """Read positions of a scene's nodes, at one or more times, from a file, a pandas frame or an xarray data set.

    Args:
        path: a CSV with the columns `[time,]node,x,y,z[,vx,vy,vz]` in the units of the deck, an NPZ or NPY, or an
            output of MoorDyn or OrcaFlex; a frame with the columns of the CSV; a data set with `positions` over `time`,
            `node` and an axis, or that array alone.
        scene: the scene of the nodes. Missing nodes are NaN, and False in `.present`.
        columns: headings of columns with other names in a CSV or frame, as in `{"x": "Z (m)"}`.

    Raises:
        OSError: the file cannot be read.
        DeckError: the file has faults or unknown nodes, or has no node numbers while those of the scene do not ascend.
    """
    from mudline.model.scene import positions  # noqa: PLC0415 - decks alone do without it
    from mudline.model.scene.given_positions import require_order  # noqa: PLC0415 - as above
    from mudline.tools.exporting.returned import read_returned  # noqa: PLC0415 - as above

    expect(scene, "scene", Scene, "a Scene")
    expect(columns, "columns", (Mapping, NoneType), "names of columns with their headings")
    headings = dict(columns or {})
    if unknown := sorted(headings.keys() - {*positions.COLUMNS}):
        raise ValueError(f"columns: no column {', '.join(unknown)}; expected some of {', '.join(positions.COLUMNS)}")
    resolved = scene._resolved  # noqa: SLF001 - a class of this module
    if any(hasattr(path, name) for name in ("iloc", "dims")):
        placed = positions.positions_of(path, resolved.nodes, headings)
        return require_order(placed, resolved, f"<{type(path).__name__}>")
    file = given_path(path)
    of_program = not headings and file.suffix.lower() not in {".npz", ".npy"}
    if of_program and (returned := read_returned(file, resolved)) is not None:
        return returned
    return require_order(positions.read_positions(file, resolved.nodes, headings), resolved, file.as_posix())


def contact_warnings(
    scene: Scene, result: ContactResult, positions: Floats | Positions | None = None
) -> list[ContactWarning]:
    """Return the warnings about a result of `scene.contact().evaluate(positions)`, in the order of the deck.

    `positions` are the evaluated ones, (nodes, 3) or (steps, nodes, 3). None stands for the deck's own coordinates, at
    which the reaction is compared with the submerged weight.

    Raises ValueError if result or positions do not belong to the scene.
    """
    from mudline.model.contact.arrays import Positions  # noqa: PLC0415 - decks alone do without it
    from mudline.model.contact.result import ContactResult as Result  # noqa: PLC0415 - as above
    from mudline.model.results import warnings  # noqa: PLC0415 - as above

    expect(scene, "scene", Scene, "a Scene")
    expect(result, "result", Result, "a ContactResult")
    if len(result.evaluated) != len(scene.element_ids) or len(result.present) != len(scene.node_ids):
        raise ValueError("result must be that of the scene: it has another number of nodes or elements")
    given = np.asarray(positions.whole, np.float64) if isinstance(positions, Positions) else positions
    return warnings.contact_warnings(scene._resolved, result, given)  # noqa: SLF001 - as above


def from_keyword(text: str | bytes, *, units: str | None = None) -> Deck:
    """Return the deck of a keyword text, or of the bytes of a keyword file.

    Files that the deck names are not read: a text has no folder.

    Args:
        text: the text, with any line ends. Bytes are UTF-8, CP1252 or Latin-1.
        units: "metric", "imperial" or "user", in place of the units in the text.

    Raises:
        DeckError: the text cannot be read; `.diagnostics` has the places.
    """
    deck = _from_text(text, KEYWORD, given_units(units))
    deck.source = ""
    return deck


def from_json(text: str | bytes) -> Deck:
    """Return the deck of a JSON text, as `Deck.to_json` writes it.

    Raises:
        DeckError: the text is not JSON, has a key twice, or breaks the schema.
    """
    return _from_text(text, "json")


def from_yaml(text: str | bytes) -> Deck:
    """Return the deck of a YAML 1.2 text, as `Deck.to_yaml` writes it.

    Raises:
        DeckError: the text is not valid YAML, has a key twice or an alias, or breaks the schema.
    """
    return _from_text(text, "yaml")


Paths = str | os.PathLike[str] | Iterable[str | os.PathLike[str]]


def lint(
    path: Paths, *, select: Iterable[str] = (), ignore: Iterable[str] = (), units: str | None = None
) -> list[Diagnostic]:
    """Return all findings in decks, file by file, each in the order of the file; never raises for their content.

    Args:
        path: a file, a folder searched for decks, or several of them; its configuration includes and excludes files.
        select: rules by code, prefix of a code, or slug; all rules if empty.
        ignore: rules to leave out, named the same way.
        units: "metric", "imperial" or "user", in place of the units in the files.

    Raises:
        OSError: a file or a folder cannot be read, or a folder has no deck.
        ValueError: a word names no rule, `path` is the text of a deck, or a configuration cannot be used.
        TypeError: `path` is not a path, or `select` or `ignore` are not several words.
    """
    files, units = decks_in(path, including=True), given_units(units)
    rules = given_rules(select, ignore)
    listed = (lint_bytes(file.read_bytes(), file.as_posix(), rules, units=units, folder=file.parent) for file in files)
    return [*chain.from_iterable(listed)]


def decks_in(path: Paths, *, including: bool = False) -> list[Path]:
    """Return the given files and the decks in given folders, without those hidden by .gitignore files.

    Decks that the nearest configuration excludes are left out; those that it includes are taken with `including`.
    Raises FileNotFoundError for a folder without a deck, another OSError for one that cannot be searched completely,
    and ConfigurationError for an unusable configuration.
    """
    is_one = isinstance(path, str | bytes | os.PathLike | Mapping) or not isinstance(path, Iterable)
    files: list[Path] = []
    for each in [path] if is_one else cast("Iterable[object]", path):
        place = given_path(each, "save it to a file")
        decks = _decks_below(place, including=including) if place.is_dir() else [place]
        if not decks:
            raise FileNotFoundError(errno.ENOENT, "no deck in this folder", str(place))
        files += decks
    return files


def _decks_below(folder: Path, *, including: bool) -> list[Path]:
    from mudline.language.deck.searching import Search, is_in_any_form  # noqa: PLC0415 - many name one file

    own, search = Configured(), Search(str(folder))
    taken = partial(own.takes, wanted=own.includes if including else is_in_any_form)
    files = [Path(file) for _, file in search.files(taken)]
    if search.unreadable:
        raise search.unreadable[0]
    return files


def _from_text(text: str | bytes, form: str, units: str | None = None) -> Deck:
    """Return the deck of a text in a form; invalid surrogates are replaced in keyword text, refused in a document."""
    expect(text, "text", (str, bytes), "str or bytes")
    errors = "replace" if form == KEYWORD else "surrogatepass"
    data = text if isinstance(text, bytes) else text.encode(errors=errors)
    return public(load_bytes(data, f"<{form}>", form=form, units=units))


def given_deck(deck: Deck | str | os.PathLike[str], name: str = "deck") -> Deck:
    """Return the deck passed as an argument, read from its file if the argument is a path."""
    return deck if isinstance(deck, Deck) else read(given_path(deck, name=name))


def content_as(deck: Deck, name: str) -> bytes:
    """Return the content of a deck's file in the form given by a file name."""
    form = form_of(name)
    return keyword_file(deck.alone) if form == KEYWORD else dump(deck.alone, form).encode()


def public(deck: model.Deck) -> Deck:
    """Return the public form of a deck; raises DeckError if something in it could not be read."""
    return Deck(**vars(deck.require()))


def given_rules(select: Iterable[str], ignore: Iterable[str]) -> tuple[Rule, ...]:
    """Return the rules that are named as arguments, less those that are left out; raises ValueError."""
    return _chosen(several(select, "select", str, "several str"), several(ignore, "ignore", str, "several str"))


def given_units(units: str | None) -> str | None:
    """Return a unit system passed as an argument, or None; raises ValueError."""
    if units is not None:
        expect_word(units, "units", UNITS)
    return units
