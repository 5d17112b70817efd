"""Time integration scheme of a deck, and the schemes of its kind."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, cast

from mudline.model.scene.deck_values import number
from mudline.model.scene.oscillation import line_of
from mudline.model.scene.resolved import ResolvedDeck

if TYPE_CHECKING:
    from mudline.language.keywords.library.analysis import TimeStepping


class Scheme(NamedTuple):
    """Time integration scheme: M [(1 - am) a1 + am a0] + (1 - af) R1 + af R0 = 0 with Newmark's gamma and beta.

    name: "generalised-alpha" or "hilber-hughes".
    alpha_m, alpha_f: am and af.
    rho, alpha: the parameter of each scheme, None for the other scheme.
    """

    name: str
    alpha_m: float
    alpha_f: float
    rho: float | None = None
    alpha: float | None = None

    @property
    def radius(self) -> float:
        """Spectral radius at infinite frequency."""
        share = self.alpha_f if self.alpha is None else 0.5 * (1.0 + self.alpha)
        return share / (1.0 - share)

    @property
    def gamma(self) -> float:
        """Newmark's gamma of second order."""
        return 0.5 - self.alpha_m + self.alpha_f

    @property
    def beta(self) -> float:
        """Newmark's beta of the least dissipation at low frequencies."""
        return 0.25 * (1.0 - self.alpha_m + self.alpha_f) ** 2


def generalised_alpha(rho: float) -> Scheme:
    """Return generalised-alpha (Chung and Hulbert 1993) with the spectral radius `rho` at infinity."""
    return Scheme("generalised-alpha", (2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0), rho=rho)


def hilber_hughes(alpha: float) -> Scheme:
    """Return the scheme of Hilber, Hughes and Taylor (1977), `alpha` from -1/3 to 0."""
    return Scheme("hilber-hughes", 0.0, -alpha, alpha=alpha)


_DEFAULT_RHO, _DEFAULT_HUGHES = 0.4, -0.25


def scheme_of(scene: ResolvedDeck) -> tuple[Scheme, int]:
    """Return the scheme of the last `*TIME STEPPING`, or the program's default, and its line, 0 for none."""
    scheme, line = generalised_alpha(_DEFAULT_RHO), 0
    for where, block in scene.deck.blocks("TIME STEPPING", "LOAD CASE"):
        stepping, line = cast("TimeStepping", block), line_of(scene, where)
        if stepping.type_ == "HILBER-HUGHES":
            scheme = hilber_hughes(max(number(stepping.hilber_hughes, "coefficient", _DEFAULT_HUGHES), -1.0 / 3.0))
        elif stepping.alphas is not None:
            default = generalised_alpha(_DEFAULT_RHO)
            alpha_m = number(stepping.alphas, "alpha_m", default.alpha_m)
            alpha_f = number(stepping.alphas, "alpha_f", default.alpha_f)
            scheme = Scheme("generalised-alpha", alpha_m, alpha_f)
        else:
            scheme = generalised_alpha(number(stepping, "infinity", _DEFAULT_RHO))
    return scheme, line
