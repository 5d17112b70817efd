"""The force-embedment curves as a picture."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from matplotlib.figure import Figure

FORCE_UNITS = {"metric": "N/m", "imperial": "lbf/ft", "user": "force per length"}
_MARGIN = 0.15


def draw(rows: list[dict[str, Any]], units: str, form: str) -> bytes:
    """A picture ("png" or "svg") of all curves: points, segments, and the extrapolation beyond both ends dashed."""
    figure = Figure(figsize=(8, 5), layout="constrained", dpi=150)
    axes = figure.add_subplot()
    for row in rows:
        ratios, forces = np.array(row["points"]).T
        (line,) = axes.plot(ratios, forces, marker="o", markersize=3.5, label=row["name"])
        width = _MARGIN * (ratios[-1] - ratios[0])
        first, last = row["segments"][0]["slope"], row["segments"][-1]["slope"]
        for x, y, step, slope in ((ratios[0], forces[0], -width, first), (ratios[-1], forces[-1], width, last)):
            axes.plot([x, x + step], [y, y + slope * step], linestyle="--", color=line.get_color(), linewidth=1)
        for value in row["at"]:
            axes.plot(value["ratio"], value["force"], marker="x", color=line.get_color(), markersize=8)
        for static in row.get("static", []):
            axes.axvline(static["ratio"], color=line.get_color(), linestyle=":", linewidth=1)
    axes.set_xlabel("embedment ratio [-]")
    axes.set_ylabel(f"seabed force [{FORCE_UNITS[units]}]")
    axes.set_title("Force-embedment curves (dashed: extrapolated)")
    axes.grid(visible=True, alpha=0.3)
    if rows:
        axes.legend()
    buffer = io.BytesIO()
    figure.savefig(buffer, format=form, metadata={"Date": None} if form == "svg" else None)
    return buffer.getvalue()
