"""Faults of lines that stand below a keyword which can have them, or passes them through, and belong to another one."""

from __future__ import annotations

from tests.faults.draft import Draft
from tests.faults.kind import Group

LINES = Group("lines of another keyword")
kind = LINES.kind

STRAY = ("SYN001", "SYN003", "SYN004", "SYN011")


def without_head(draft: Draft, keyword: str, *, above: str = "") -> None:
    """Delete the line of a keyword, which is to stand below another one; its first data line is marked."""
    head, first, *_ = draft.block(keyword)
    at = draft.rows.index(head)
    draft.needs(at > 1)
    others = [row.text for row in draft.rows[:at] if row.text.startswith("*")]
    draft.needs(not above or (others and others[-1] == above))
    draft.mark(first)
    draft.remove([head])


@kind(*STRAY)
def boundary_line_missing(draft: Draft) -> None:
    """The `*BOUNDARY` line is missing below `*ANALYSIS TYPE`, of which no line is public."""
    without_head(draft, "*BOUNDARY", above="*ANALYSIS TYPE")


@kind(*STRAY)
def boundary_line_missing_elsewhere(draft: Draft) -> None:
    """The `*BOUNDARY` line is missing below `*TIME`."""
    without_head(draft, "*BOUNDARY", above="*TIME")


@kind(*STRAY)
def time_line_missing(draft: Draft) -> None:
    """The `*TIME` line is missing below `*ANALYSIS TYPE`."""
    without_head(draft, "*TIME", above="*ANALYSIS TYPE")


@kind(*STRAY)
def current_line_missing(draft: Draft) -> None:
    """The `*CURRENT` line is missing below `*BOUNDARY`."""
    without_head(draft, "*CURRENT", above="*BOUNDARY")


@kind(*STRAY)
def hydrodynamic_sets_line_missing(draft: Draft) -> None:
    """The `*HYDRODYNAMIC SETS` line is missing below `*GEOMETRIC SETS`, whose property lines take as many values."""
    without_head(draft, "*HYDRODYNAMIC SETS")


@kind(*STRAY)
def moment_curvature_line_missing(draft: Draft) -> None:
    """The `*MOMENT-CURVATURE` line is missing below `*HYDRODYNAMIC SETS`."""
    without_head(draft, "*MOMENT-CURVATURE")


@kind(*STRAY)
def parameters_line_missing(draft: Draft) -> None:
    """The `*PARAMETERS` line is missing: every equation lacks its parameters."""
    draft.needs("=[" in draft.text)
    head = draft.block("*PARAMETERS")[0]
    draft.mark(draft.data("*PARAMETERS")[0])
    draft.remove([head])


@kind(*STRAY)
def surface_line_missing(draft: Draft) -> None:
    """The `*ELASTIC SURFACE` line is missing below `*GEOMETRIC SETS`: its row has as many values as a mooring line."""
    hydrodynamics = draft.block("*HYDRODYNAMIC SETS")
    draft.needs("*EMBEDMENT" in draft.text)
    draft.remove(hydrodynamics)
    without_head(draft, "*ELASTIC SURFACE", above="*GEOMETRIC SETS")


@kind(*STRAY)
def unloading_line_missing(draft: Draft) -> None:
    """The `*SEABED UNLOADING` line is missing below `*SEABED STIFFNESS`."""
    without_head(draft, "*SEABED UNLOADING", above="*SEABED STIFFNESS")


@kind(*STRAY)
def suction_line_missing(draft: Draft) -> None:
    """The `*SEABED SUCTION` line is missing below `*SEABED STIFFNESS`."""
    without_head(draft, "*SEABED SUCTION", above="*SEABED STIFFNESS")


@kind("SBD008")
def unloading_in_properties(draft: Draft) -> None:
    """The `*SEABED UNLOADING` line is missing below `*SEABED PROPERTIES`, which can have its lines."""
    last = draft.data("*SEABED PROPERTIES")[-1]
    sets = [row.text for row in draft.settings("*SEABED PROPERTIES", "SET")]
    draft.needs(draft.units == "metric" and "*SEABED UNLOADING" not in draft.text and "TYPE=RIGID" not in draft.text)
    new = draft.insert(last, *(line for name in sets for line in (name, " STIFFNESS=900000.0")), mark=False)
    draft.mark(new[0])


@kind("GEO001")
def pipe_option_over_flexible(draft: Draft) -> None:
    """OPTION=RIGID over the values of a flexible pipe, which are as many as it may have."""
    draft.mark(draft.sections("FLEXIBLE")[0])
    draft.needs("OPTION=FLEXIBLE" in draft.text)
    row = next(each for each in draft.settings("*GEOMETRIC SETS", "OPTION") if "FLEXIBLE" in each.text)
    row.text = " OPTION=RIGID"


@kind("UNT006")
def mooring_option_over_pipe(draft: Draft) -> None:
    """OPTION=MOORING over the values of a pipe, which are as many as it may have."""
    first = draft.sections("RIGID")[0]
    draft.needs(len(draft.fields(first)) == 5 and draft.units != "user")
    row = next(each for each in draft.settings("*GEOMETRIC SETS", "OPTION") if "RIGID" in each.text)
    row.text = " OPTION=MOORING"
    draft.mark(first)
