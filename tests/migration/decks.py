"""Legacy decks, and a strategy for many more."""

from __future__ import annotations

from hypothesis import strategies as st

from mudline.deck.loading import load_bytes
from mudline.deck.model import Deck

PIPE = """\
$MODEL
*NODE
 1, -0.05, 0.0
 13, -0.05, 120.0
 GEN=1, 13
*ELEMENT
 1, 1, 2
 GEN=1, 12
*ELEMENT SETS
 SET=West
 GEN=1, 6
 SET=East Bank
 GEN=5, 10
 SET=7
 3, 9
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.25, 0.22, 7850.0
 SET=West
 207.0E9, 79.6E9, 0.3, 0.27, 7850.0
"""
"""Twelve elements; West and East Bank overlap, 7 lies in both; two diameters."""

SETS = ("ALL", "West", "East Bank", "7", "west", None)


def deck_of(text: str | bytes, name: str = "deck.keyxm") -> Deck:
    return load_bytes(text if isinstance(text, bytes) else text.encode(), name)


numbers = st.floats(min_value=1e-3, max_value=1e6).map(repr)
coefficients = st.sampled_from(["", "0", "0.0", "0.3", " 0.55 ", "1E-3"])
lengths = st.sampled_from(["", "0.05", "2.5e-2"])
characteristic = st.sampled_from(["", "3.048"])
comments = st.sampled_from(["", "C from the survey\n", "C\n", "C--- rev B ---\n"])


@st.composite
def points(draw: st.DrawFn) -> str:
    """The rows of a curve, in any order."""
    ratios = draw(st.lists(st.integers(-20, 400), min_size=2, max_size=6, unique=True))
    written = st.floats(-1e4, 1e6).map(lambda force: round(force, 6))  # slopes below float64 are refused (CRV011)
    forces = draw(st.lists(written, min_size=len(ratios), max_size=len(ratios)))
    rows = [f" {ratio / 100!r}, {force!r}\n" for ratio, force in zip(ratios, forces, strict=True)]
    return "".join(draw(comments) + row for row in rows)


@st.composite
def embedment(draw: st.DrawFn, first: bool = True) -> str:
    names = draw(st.lists(st.sampled_from(SETS[:-1]), min_size=1, max_size=4))
    curves = [f" SET={name}\n{draw(points())}" for name in names]
    if first and draw(st.booleans()):
        curves.insert(0, draw(points()))
    return "*EMBEDMENT\n" + "".join(draw(comments) + curve for curve in curves)


@st.composite
def elastic(draw: st.DrawFn) -> str:
    fields = [
        draw(st.one_of(st.just("1e4"), numbers)),
        draw(coefficients),
        draw(coefficients),
        draw(st.sampled_from(["", "0", "250.0"])),
        draw(st.sampled_from(["", "300.5"])),
        draw(st.sampled_from(["", "0.1"])),
        draw(characteristic),
        draw(characteristic),
        draw(st.sampled_from(["", "12.5"])),
        draw(lengths),
        draw(lengths),
    ]
    row = f" {', '.join(fields[: draw(st.integers(1, 11))])}\n"
    return "*ELASTIC SURFACE\n" + draw(comments) + row + draw(beds())


@st.composite
def rigid(draw: st.DrawFn) -> str:
    fields = [
        draw(st.sampled_from(["0.3", "0"])),
        draw(coefficients),
        draw(characteristic),
        draw(characteristic),
        draw(st.sampled_from(["", "12.5"])),
        draw(lengths),
        draw(lengths),
    ]
    row = f" {', '.join(fields[: draw(st.integers(1, 7))])}\n"
    return "*RIGID SURFACE\n" + draw(comments) + row + draw(beds())


@st.composite
def beds(draw: st.DrawFn) -> str:
    """Nothing, a slope, or a profile."""
    kind = draw(st.integers(0, 2))
    if kind == 0:
        return ""
    if kind == 1:
        return draw(comments) + f" {draw(st.floats(-20, 20))!r}\n"
    across = draw(st.lists(st.integers(-500, 500), min_size=2, max_size=5, unique=True))
    return "".join(f"{draw(comments)} {float(y)!r}, {draw(st.floats(-30, 30))!r}\n" for y in across)


@st.composite
def legacy_decks(draw: st.DrawFn) -> str:
    """A model with a legacy seabed; blocks in any order."""
    if draw(st.booleans()):
        blocks = [draw(elastic()), *draw(st.lists(embedment(first=False), max_size=2))]
        if draw(st.booleans()):
            blocks.append(draw(embedment()))
        blocks = draw(st.permutations(blocks))
    else:
        blocks = [draw(rigid())]
    existing = draw(st.sampled_from(["", "*SEABED STIFFNESS\n CURVE=WEST\n 0, 0\n 1, 1\n"]))
    indent = draw(st.sampled_from([" ", "", "    "]))
    seabed = "".join(draw(comments) + block for block in blocks)
    text = PIPE + existing + seabed.replace("\n ", f"\n{indent}")
    text += draw(st.sampled_from(["", "$LOAD CASE\n*ANALYSIS TYPE\n TYPE=STATIC\n"]))
    end = draw(st.sampled_from(["\n", "\r\n", "\r"]))
    return text.replace("\n", end)
