"""The pictures of the stability study."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from mudline.study.picture import Picture, label, legend_below, style
from mudline.study.schemes import SCHEMES
from mudline.study.stability.bounded import BOUNDED, SHARES, Measured
from mudline.study.stability.ladder.verdict import Judgement, Verdict
from mudline.study.stability.landings import LANDERS, PHASES, speeds_over_phases

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SHOWN = ((0.1, 0.9965, 1.0025), (0.5, 0.89, 1.04), (1.0, 0.2, 1.15), (10.0, -0.1, 3.0))
"""omega dt of each panel, and what it shows of the axis."""
_DRAWN = tuple(name for name in LANDERS if name != "generalised-alpha-1")
"""With a spectral radius of 1 generalised-alpha does what Newmark's scheme does."""
_COLORS = {
    Verdict.RIGHT: "#9ecae1",
    Verdict.UP_TO: "#c7e9c0",
    Verdict.REFUSED: "#fdd49e",
    Verdict.WRONG: "#b2182b",
    Verdict.UNTOLD: "#67001f",
    Verdict.NOISY: "#3f007d",
}


def ladder_picture(judgements: Sequence[Judgement]) -> Picture:
    """A square for each cell, in a row for each family."""
    families = list(dict.fromkeys(judged.family for judged in judgements))
    widest = max(sum(judged.family == family for judged in judgements) for family in families)

    def draw(figure: Figure) -> None:
        from matplotlib.patches import Patch, Rectangle  # noqa: PLC0415 - only who draws loads it

        axes = figure.subplots()
        for row, family in enumerate(families):
            for column, judged in enumerate(one for one in judgements if one.family == family):
                axes.add_patch(
                    Rectangle((column, row), 1, 1, facecolor=_COLORS[judged.verdict], edgecolor="white", linewidth=1.5)
                )
                text = judged.value.replace("1.7976931348623157E308", "1.8E308")
                axes.text(column + 0.5, row + 0.5, text, ha="center", va="center", fontsize=6.5)
        axes.set_xlim(0, widest)
        axes.set_ylim(len(families), 0)
        axes.set_yticks(np.arange(len(families)) + 0.5, families)
        axes.set_xticks([])
        axes.set_xlabel("rungs of each ladder; the number is that of the deck, in its own units (SI)")
        axes.set_title("What comes out of decks with extreme numbers", fontsize="medium")
        axes.tick_params(length=0)
        for spine in axes.spines.values():
            spine.set_visible(False)
        counts = {verdict: sum(judged.verdict is verdict for judged in judgements) for verdict in Verdict}
        named = [Patch(facecolor=_COLORS[one], label=f"{one.value}: {count}") for one, count in counts.items() if count]
        figure.legend(handles=named, loc="outside lower center", ncols=len(named), fontsize="small")

    caption = "Verdict on each cell of the ladder of extremes."
    return Picture("ladder", caption, draw, (13.0, 1.8 + 0.36 * len(families)))


def landings_picture() -> Picture:
    """Restitution over the landing phase, a panel for each omega dt."""

    def draw(figure: Figure) -> None:
        panels = figure.subplots(2, 2, sharex=True)
        for axes, (omega_dt, low, high) in zip(panels.flat, _SHOWN, strict=True):
            for index, name in enumerate(_DRAWN):
                speeds = speeds_over_phases(SCHEMES[name], omega_dt)
                look = {**style(index), "markevery": (6 * index, 50)}
                axes.plot(PHASES, speeds, label=SCHEMES[name].title, **look)
            axes.axhline(1.0, color="0.4", linewidth=0.8, zorder=0)
            axes.set_ylim(low, high)
            label(axes, f"ω dt = {omega_dt:g}{_off(omega_dt, low)}", "", "speed after / before landing [-]")
        for axes in panels[1]:
            axes.set_xlabel("landing phase, share of the step left at the bed [-]")
        legend_below(figure, panels.flat[0])

    return Picture(
        "landings", "Rebound of a mass from an elastic bed; 1 is right, more is energy from nowhere.", draw, (10.0, 8.0)
    )


def _off(omega_dt: float, low: float) -> str:
    """Tells of backward Euler where it lies below the panel."""
    speeds = speeds_over_phases(SCHEMES["backward-euler"], omega_dt)
    if speeds.min() >= low:
        return ""
    return f"  (backward Euler below: {speeds.min():.2f} to {speeds.max():.2f})"


def critical_picture(measured: Sequence[Measured]) -> Picture:
    """What each scheme did on each contact, at steps around the critical one."""
    rows = [one for one in measured if one.tried]

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        for row, one in enumerate(rows):
            stayed = np.array([word == BOUNDED for word in one.tried])
            for which, mark, color, word in (
                (stayed, "o", "#0072b2", "stays bounded"),
                (~stayed, "x", "#d55e00", "grows"),
            ):
                name = word if not row else None
                axes.plot(SHARES[which], np.full(which.sum(), row), mark, color=color, markersize=5, label=name)
        axes.axvline(1.0, color="0.3", linewidth=1.0, label="predicted critical step")
        axes.set_yticks(range(len(rows)), [_row_name(one) for one in rows], fontsize="small")
        axes.set_ylim(len(rows) - 0.4, -0.6)
        label(axes, "Steps around the critical one, really stepped", "step / predicted critical step [-]", "")
        legend_below(figure, axes, 3)

    caption = "Each mark is a run on a contact of the deck; the predicted step should part them."
    return Picture("critical-steps", caption, draw, (10.0, 2.2 + 0.34 * max(len(rows), 2)))


def _row_name(one: Measured) -> str:
    return f"{one.contact.name}\n{one.scheme.title}, {one.predicted:.4g} s"
