"""A deck whose lines can be put in another order without another meaning."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from mudline.comparison.comparing import compare
from mudline.comparison.model import Difference
from mudline.deck.loading import load_bytes
from mudline.scene.model import resolve

T = TypeVar("T")

NODES = [" 1, -0.1, 0.0", " 2, -0.1, 10.0", " 3, 0.3, 20.0", " 4, 0.5, 30.0"]
ELEMENTS = [" 1, 1, 2", " 2, 2, 3", " 3, 3, 4"]
POINTS = [" 0.0, 0.0", " 0.1, 1000.0", " 0.5, 3000.0"]
MEMBERS = ["1", "2"]
LAWS = [" SET=Pipe\n STIFFNESS=Clay\n FRICTION=0.3, 0.5", " SET=Rest\n STIFFNESS=50000.0"]


def same(given: list[str]) -> list[str]:
    return given


def deck(order: Callable[[list[str]], list[str]] = same) -> str:
    """The deck, with everything in another order whose order does not matter."""
    blocks = [
        "*OCEAN\n 100.0, 1025.0, 9.81",
        "\n".join(["*NODE", *order(NODES)]),
        "\n".join(["*ELEMENT", *order(ELEMENTS)]),
        f"*ELEMENT SETS\n SET=Pipe\n {', '.join(order(MEMBERS))}\n SET=Rest\n 3",
        "*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, =[od], 0.46, 7850.0",
        "\n".join(["*SEABED PROPERTIES\n TYPE=ELASTIC", *order(LAWS)]),
        "\n".join(["*SEABED STIFFNESS\n CURVE=Clay", *order(POINTS)]),
        "*HYDRODYNAMIC SETS\n SET=ALL, TYPE=CONSTANT\n 1.2, 0.05, 2.0, 1.0, 0.0",
    ]
    lines = "\n".join(order(blocks))
    return f"$PREPROCESSOR\n*PARAMETERS\n od, 0.5\n$MODEL\n{lines}\n"


def differences(
    before: str | bytes, after: str | bytes, tolerance: float = 0.0, name: str = "b.keyxm"
) -> list[Difference]:
    """What differs between two texts; the second one has the form that its name tells."""
    first, second = (text if isinstance(text, bytes) else text.encode() for text in (before, after))
    return compare(resolve(load_bytes(first, "a.keyxm")), resolve(load_bytes(second, name)), tolerance)


def told(found: list[Difference]) -> list[tuple[str, object, object]]:
    """Places and values only."""
    return [(one.where, one.before, one.after) for one in found]
