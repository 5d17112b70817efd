"""Random decks of all keywords, and whether linting and evaluating agree about what keeps a deck from being evaluated.

`python -m tests.checks.legality 100000` looks at as many decks as one likes.
"""

from __future__ import annotations

import random
import re
import sys
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from mudline.checks.context import LintContext
from mudline.checks.engine import problems_in
from mudline.checks.registry import rules
from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import DeckError, Diagnostic
from mudline.language.keywords import catalogue
from mudline.model.results.evaluation import evaluate_scene
from mudline.model.scene.model import resolve

if TYPE_CHECKING:
    from _typeshed import SupportsLenAndGetItem

_T = TypeVar("_T")
NAME = "deck.keyxm"
NOWHERE = Path("decks")
"""A folder that is not there: files that a deck names are looked for and not found."""

NO_CHECK = re.compile(
    r"the deck has no elements to evaluate|"
    r"(an element ends|\d+ elements end) at nodes that are not known: \*|"
    r"\d+ nodes have no coordinates, node -?\d+ is one: give them with --positions|"
    r"(element -?\d+ has|\d+ elements \(first: -?\d+\) have) no known finite length; this cannot be evaluated|"
    r"(element|node) -?\d+ at step 0: "
)
"""What RUN001 may say: that there is nothing to evaluate, or that the numbers leave the range of a float64."""

Found = tuple[str, int, str]
"""Code, line and message."""


class Outcome(NamedTuple):
    """What blocks a deck according to lint, what evaluate refuses it with, and whether they agree."""

    blocking: set[Found]
    refused: set[Found]

    @property
    def agrees(self) -> bool:
        """Whether evaluate refuses exactly what blocks; without that only for what no check covers."""
        if self.blocking:
            return self.blocking == self.refused
        return all(code == "RUN001" and NO_CHECK.match(message) for code, _, message in self.refused)


def outcome(data: bytes, name: str = NAME, folder: Path | None = NOWHERE) -> Outcome:
    """Lint and evaluate a deck, each on its own."""
    try:
        deck = load_bytes(data, name, folder=folder)
    except DeckError as error:
        found = _found(error.diagnostics)
        return Outcome(found, found)
    linted = deck.diagnose(problems_in(LintContext(deck), rules()))
    return Outcome(_found([one for one in linted if one.blocks]), _refused(data, name, folder))


def _refused(data: bytes, name: str, folder: Path | None) -> set[Found]:
    try:
        evaluation = evaluate_scene(resolve(load_bytes(data, name, folder=folder)))
        for _ in evaluation.parts():
            pass
    except DeckError as error:
        return _found(error.diagnostics)
    return set()


def _found(diagnostics: Sequence[Diagnostic]) -> set[Found]:
    return {(one.code, one.line, one.message) for one in diagnostics}


# ------------------------------------------------------------------------------------------------------------- decks

_NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d*)?(?:E-?\d+)?(?![\w.])")
_SET = re.compile(r"(?<=SET=)\w+")
_VALUES = ["0.0", "-1.0", "1.0", "0.5", "2", "90.0", "0.001", "5000.0", "=[soil]", "=[soil*0]"]
_ODD_VALUES = [
    *("", "x", "1.0E308", "-1.7E308", "5.0E-324", "1.0E200", "=[cu(2)]", "=[nothing]", "=[1/0]", "=[strange]", "NaN"),
    *("1,5", "1.0E", "{a}", "abc"),
]
_CARE = 0.7
_SETS = ["ALL", "A", "B", "C", "a", "Nowhere"]

_PIPE = """\
*OCEAN
 500.0, 1025.0, 9.81
*NODE
 1, -0.05, 0.0, 0.0
 9, -0.05, 40.0, 0.0
 GEN=1, 9
*ELEMENT
 1, 1, 2
 GEN=1, 8
*ELEMENT SETS
 SET=A
 1, 2, 3, 4
 SET=B
 3, 4, 5, 6, 7, 8
 SET=C
 8
"""
_SECTIONS = [
    "*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0.3, 0.265, 7850.0\n",
    "*GEOMETRIC SETS\n OPTION=RIGID\n SET=A\n 207.0E9, 79.6E9, 0.3, 0.265, 7850.0\n",
    "*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0.3, 0.3, 7850.0\n",
    "*GEOMETRIC SETS\n OPTION=FLEXIBLE\n SET=ALL\n 5.0E5, 5.0E5, 1.0E5, 5.0E8, 120.0, 0.0, 0.1, 0.3, 0.3\n",
    "",
]
_CURVES = """\
*SEABED STIFFNESS
 CURVE=Clay
 0.0, 0.0
 0.5, 4200.0
 CURVE=Pull
 0.0, 0.0
 0.2, -50.0
 0.5, 4200.0
 CURVE=Falls
 0.0, 0.0
 0.5, 4200.0
 1.0, 4000.0
"""
_LEGACY = [
    "*RIGID SURFACE\n 0.3, 0.6\n",
    "*RIGID SURFACE\n 0.3, 0.6\n 2.0\n",
    "*ELASTIC SURFACE\n 50000.0, 0.3, 0.6\n",
    "*ELASTIC SURFACE\n , 0.3, 0.6\n",
    "*ELASTIC SURFACE\n 50000.0, 0.3, 0.6\n 0.0, 0.0\n 50.0, 1.0\n",
    "*ELASTIC SURFACE\n 50000.0, 0.3, 0.6\n 0.0, 0.0\n",
    "*ELASTIC SURFACE\n 50000.0, 0.3, 0.6\n 0.0, 0.0\n 0.0, 2.0\n",
    "*EMBEDMENT\n SET=A\n 0.0, 0.0\n 0.5, 4200.0\n",
    "*EMBEDMENT\n 0.0, 0.0\n 0.5, -100.0\n",
]
_PROFILES = [
    "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=2.0\n",
    "*SEABED PROFILE\n TYPE=SLOPING\n DIRECTION=30.0\n SLOPE=89.0\n",
    "*SEABED PROFILE\n TYPE=2D\n FILE=shelf.fcsbd\n",
    "*SEABED PROFILE\n TYPE=3D\n FILE=shelf.txt\n",
    "*SEABED PLANES\n PLANE=a\n POINT=0.0, 0.0, 0.0\n SLOPE=2.0\n",
    "*SEABED PLANES\n PLANE=a\n POINT=0.0, 0.0, 0.0\n SLOPE=2.0\n BOUNDS=10.0, 20.0, -1.0, 1.0\n PLANE=b\n SLOPE=1.0\n",
    "*SEABED PLANES\n",
]
_UNLOADING = ("500000.0", "500000.0", "500000.0", "20000.0", "0.0")


def _settings(draw: random.Random, lines: Sequence[str], least: int = 0) -> str:
    """Some of the lines, in their order."""
    chosen = [line for line in lines if draw.random() < 0.5]
    return "".join(f" {line}\n" for line in (chosen if len(chosen) >= least else lines[:least]))


def _by_set(draw: random.Random, keyword: str, lines: Sequence[str]) -> str:
    sets = draw.sample(_SETS[:4] if draw.random() < 0.9 else _SETS, draw.choice((1, 1, 1, 2)))
    return f"*{keyword}\n" + "".join(f" SET={name}\n{_settings(draw, lines)}" for name in sets)


def _properties(draw: random.Random) -> str:
    type_ = draw.choice((" TYPE=ELASTIC\n",) * 30 + (" TYPE=RIGID\n", ""))
    stiffness = draw.choice(("50000.0",) * 8 + ("Clay",) * 8 + ("Pull", "Falls", "Falls", "Lost", "0.0", "-5.0"))
    lines = [f"STIFFNESS={stiffness}"] * 3 + ["FRICTION=0.3, 0.6", "FRICTION=0.3, 0.6, 0.1, 0.1"]
    rest = ["LATERAL=500.0", "SUCTION=800.0, 0.15"] if draw.random() < 0.3 else []
    sets = draw.sample(["ALL", "A", "B"], draw.choice((1, 1, 1, 2)))
    chosen = [
        f" SET={name}\n" + "".join(f" {line}\n" for line in (draw.choice(lines[:3]), *_two(draw, lines, rest)))
        for name in sets
    ]
    return f"*SEABED PROPERTIES\n{type_}" + "".join(chosen)


def _two(draw: random.Random, lines: Sequence[str], rest: Sequence[str]) -> Iterator[str]:
    if draw.random() < 0.5:
        yield draw.choice(lines[3:])
    yield from (line for line in rest if draw.random() < 0.5)


def _suction(draw: random.Random) -> str:
    lines = ["COHESION=5000.0", "FORCE=3500.0, 0.18", "DEPTH=0.3, 0.26", "CYCLIC=0.5, 0.3", "REGULARISATION=0.001"]
    corners = draw.choice(("0.2, 0.8",) * 6 + ("0.01, 0.99", "0.001, 0.5", "0.8, 0.2", "0.5, 0.995"))
    whole = draw.choice((lines[:1], lines[:1], lines[1:3], []))
    rest = [line for line in lines if line not in whole] if draw.random() < 0.3 else lines[3:]
    return f"*SEABED SUCTION\n SET={draw.choice(_SETS[:4])}\n" + "".join(
        f" {line}\n" for line in (*whole, *(line for line in rest if draw.random() < 0.4), f"CUTOFF={corners}")
    )


def _trench(draw: random.Random) -> str:
    sizes = draw.choice(("0.5, 1.0, 3.0",) * 8 + ("5.0, 1.0, 3.0", "0.5, 3.0, 1.0", "-0.5, 1.0, 3.0"))
    line = draw.choice(("LAID", "LAID", "LAID", "0, 0, 9, 9", "0, 0, 0, 0"))
    lines = ["MODEL=WALL", "PEAK=2000.0", "PEAK=2000.0", f"CENTRELINE={line}"]
    lines = lines[draw.randrange(2) :: 2] if draw.random() < 0.7 else list(dict.fromkeys(lines))
    table = [" PEAK=TABLE\n 0.0, 1.0\n 2.0, 5.0\n", " PEAK=TABLE\n 0.0, 1.0\n", " PEAK=TABLE\n 2.0, 1.0\n 1.0, 5.0\n"]
    name = draw.choice(_SETS[:4])
    model = draw.choice(table) if draw.random() < 0.3 else _settings(draw, lines)
    return f"*SEABED TRENCH\n SET={name}\n GEOMETRY={sizes}\n{model}"


def _contact(draw: random.Random) -> str:
    smoothing = draw.choice(("SMOOTHING=AUTO", "SMOOTHING=NONE", "SMOOTHING=0.01"))
    return _by_set(draw, "SEABED CONTACT", ["NODAL STIFFNESS=9000.0", smoothing])


def _soil(draw: random.Random) -> str:
    strength = draw.choice(("5000.0, 1500.0", "5000.0", "0.0", "5000.0, -1.0"))
    beside = draw.choice(("", "", " SUCTION=0.6, 1.0\n", " BEARING=6.0, 0.0\n", " BUOYANCY=1.5, 6000.0\n"))
    return f"*SEABED SOIL\n SET={draw.choice(_SETS[:4])}\n STRENGTH={strength}\n{beside}"


def _unloading(draw: random.Random) -> str:
    return f"*SEABED UNLOADING\n SET={draw.choice(_SETS[:4])}\n STIFFNESS={draw.choice(_UNLOADING)}\n"


def _friction(draw: random.Random) -> str:
    springs = draw.choice(("0.3, 0.6\n STIFFNESS=20000.0", "0.3, 0.0\n STIFFNESS=20000.0, 40000.0"))
    return f"*SEABED FRICTION\n SET={draw.choice(_SETS)}\n COEFFICIENTS={springs}\n"


def _extensions(draw: random.Random) -> Iterator[str]:
    for make in (_soil, _suction, _trench, _unloading, _contact, _friction, _friction):
        if draw.random() < 0.25:
            yield make(draw)


_EXAMPLES = sorted(
    {
        (section, declared.example)
        for section in catalogue.SECTIONS
        for keyword in catalogue.keywords()
        if (declared := catalogue.block_class(section, keyword) or catalogue.opaque_keyword(section, keyword))
    }
)
"""The example of every keyword that has one, after each of its sections."""


class _Careful(random.Random):
    """Mostly takes the first of several things, which has no fault."""

    def choice(self, seq: SupportsLenAndGetItem[_T]) -> _T:
        return seq[0] if self.random() < _CARE else super().choice(seq)


def deck(seed: int) -> str:
    """A random deck: a pipe on a seabed, blocks of any keywords, and sometimes a fault or several."""
    draw = _Careful(seed) if seed % 3 else random.Random(seed)  # noqa: S311 - decks, not secrets
    model = [_PIPE, draw.choice(_SECTIONS[:1] * 20 + _SECTIONS), _CURVES]
    model += [_properties(draw)] if draw.random() < 0.9 else []
    model += [draw.choice(_LEGACY) for _ in range(draw.choice((0,) * 12 + (1, 2)))]
    model += [draw.choice(_PROFILES) for _ in range(draw.choice((0,) * 8 + (1, 1, 2)))]
    model += _extensions(draw)
    if draw.random() < 0.05:
        model.pop(draw.randrange(3))
    blocks = [("MODEL", block) for block in model]
    blocks += [draw.choice(_EXAMPLES) for _ in range(draw.choice((0,) * 8 + (1, 2)))]
    blocks += [("PREPROCESSOR", "*PARAMETERS\n soil, 5.0\n strange, =[cu(3)]\n")]
    sections: dict[str, list[str]] = {}
    for section, block in blocks:
        sections.setdefault(section, []).append(block if block.endswith("\n") else f"{block}\n")
    text = "".join(f"${name}\n{''.join(found)}" for name, found in sections.items())
    for _ in range(draw.choice((0, 0, 0, 0, 0, 0, 1, 1, 1, 2, 5))):
        text = _spoilt(draw, text)
    return text


def _spoilt(draw: random.Random, text: str) -> str:
    """The text with another number, set or line."""
    kind = draw.randrange(8)
    if kind < 4:
        pool = _VALUES if kind < 3 else _ODD_VALUES
        places = list(_NUMBER.finditer(text))
        return _put(text, draw.choice(places), draw.choice(pool)) if places else text
    if kind == 4:
        places = list(_SET.finditer(text))
        return _put(text, draw.choice(places), draw.choice(_SETS)) if places else text
    lines = text.splitlines(keepends=True)
    one, other = draw.randrange(len(lines)), draw.randrange(len(lines))
    if kind == 5:
        del lines[one]
    elif kind == 6:
        lines.insert(other, lines[one])
    else:
        lines[one], lines[other] = lines[other], lines[one]
    return "".join(lines)


def _put(text: str, place: re.Match[str], value: str) -> str:
    return text[: place.start()] + value + text[place.end() :]


def main(decks: int) -> int:
    """Look at so many decks; 1 behind the first that linting and evaluating disagree about, or that fails."""
    warnings.simplefilter("error")
    for seed in range(decks):
        found = outcome(deck(seed).encode())
        if not found.agrees:
            sys.stdout.write(f"deck {seed}: {found}\n{deck(seed)}")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1])))
