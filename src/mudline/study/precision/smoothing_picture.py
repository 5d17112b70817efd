"""What smoothing costs and saves, as a picture."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from mudline.study.picture import Picture, label, style
from mudline.study.precision.smoothing import ImpactRow, RestRow
from mudline.study.schemes import SCHEMES

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_NONE = 1e-5
"""Where h = 0 stands on a logarithmic axis."""


def smoothing_picture(rest: Sequence[RestRow], impacts: Sequence[ImpactRow]) -> Picture:
    """At rest: iterations and error; at an impact: error of the rebound and iterations."""
    caption = "Smoothing: Newton iterations and errors against the half width h of the zone; h = 0 stands far left."
    return Picture("smoothing", caption, partial(_draw, rest, impacts), (11.5, 9.0))


def _draw(rest: Sequence[RestRow], impacts: Sequence[ImpactRow], figure: Figure) -> None:
    (iterations, error), (rebound, effort) = figure.subplots(2, 2)
    for index, name in enumerate(dict.fromkeys(row.case for row in rest)):
        rows = sorted((row for row in rest if row.case == name), key=lambda row: row.share)
        shares = [max(row.share, _NONE) for row in rows]
        iterations.semilogx(shares, [row.from_above for row in rows], label=f"{name}, from above", **style(2 * index))
        below = [row.from_below for row in rows]
        iterations.semilogx(shares, below, label=f"{name}, from below", **style(2 * index + 1))
        wrong = [(share, row.error) for share, row in zip(shares, rows, strict=True) if row.error > 1e-15]
        error.loglog(*_columns(wrong), label=name, **style(index))
    label(iterations, "at rest", "h / static penetration [-]; h = 0 far left", "Newton iterations [-]")
    label(error, "at rest", "h / static penetration [-]; h = 0 far left", "error of the penetration [-]")
    for index, (name, omega_dt) in enumerate(dict.fromkeys((row.scheme, row.omega_dt) for row in impacts)):
        chosen = [row for row in impacts if (row.scheme, row.omega_dt) == (name, omega_dt)]
        words = f"{SCHEMES[name].title}, omega dt = {omega_dt:g}"
        speeds = [(max(row.share, _NONE), row.rebound) for row in chosen if row.rebound is not None]
        rebound.loglog(*_columns(speeds), label=words, **style(index))
        tries = [(max(row.share, _NONE), row.iterations) for row in chosen]
        effort.semilogx(*_columns(tries), label=words, **style(index))
    label(rebound, "impact", "h / deepest penetration [-]; h = 0 far left", "error of the rebound speed [-]")
    label(effort, "impact", "h / deepest penetration [-]; h = 0 far left", "Newton iterations per step [-]")
    for axes in (iterations, error, rebound):
        _legend(axes)


def _legend(axes: Axes) -> None:
    axes.legend(fontsize="x-small", loc="best")


def _columns(pairs: Sequence[tuple[float, float]]) -> tuple[list[float], list[float]]:
    return [pair[0] for pair in pairs], [pair[1] for pair in pairs]
