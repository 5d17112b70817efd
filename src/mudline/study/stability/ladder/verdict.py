"""What is said of a cell of the ladder."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Verdict(StrEnum):
    """Only the first three may ever appear."""

    RIGHT = "right"
    """Every result is within the bound."""
    UP_TO = "right, beyond refused"
    """Results are within the bound; where one would overflow it is refused, with a line of the deck."""
    REFUSED = "refused"
    """The deck is refused, with a line of the deck."""
    WRONG = "WRONG"
    """A result is outside its bound, or not finite."""
    UNTOLD = "REFUSED WITHOUT A LINE"
    """A refusal that names no line, or one of a result that a float64 can hold."""
    NOISY = "WARNED"
    """A numpy warning came out, or an error that is none of ours."""

    @property
    def sound(self) -> bool:
        """Whether it may appear."""
        return self in {Verdict.RIGHT, Verdict.UP_TO, Verdict.REFUSED}


@dataclass(frozen=True, slots=True)
class Judgement:
    """A cell and what came of it.

    Attributes:
        family: what grows along the ladder.
        value: where on it, as the deck has it.
        verdict: see `Verdict`.
        results: how many numbers were compared.
        error: the largest error, in roundings (2^-53) of the largest term; 0 where nothing was compared.
        bound: roundings that are allowed.
        told: the diagnostic of a refusal, else what is wrong.
    """

    family: str
    value: str
    verdict: Verdict
    results: int = 0
    error: float = 0.0
    bound: float = 0.0
    told: str = ""
