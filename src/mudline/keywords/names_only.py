"""Keywords of which only the name is known, and where they stand: their lines are passed through unchanged.

A keyword that a module of the library declares for some sections may be here for others.
"""

from __future__ import annotations

_POST = ("DATABASE POSTPROCESSING", "POSTPROCESSING")

NAMES: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(
        (
            "PROPERTIES",
            "TENSIONER",
        ),
        ("MODEL",),
    ),
    **dict.fromkeys(
        (
            "DIRECTORY",
            "DRIFT-OFF LIMITS",
            "DRILLING MUD",
            "TIME,DISCONNECT",
            "TOP TENSION",
            "WAVE",
        ),
        ("LOAD CASE",),
    ),
    "ELEMENT SETS": _POST,
    **dict.fromkeys(
        (
            "DATABASE",
            "OUTPUT FILES",
            "SNAPSHOT",
            "SPECTRUM",
            "STANDARD OUTPUT",
            "STATISTICS",
        ),
        _POST,
    ),
    **dict.fromkeys(("COLLATE", "IDENTIFY", "PLOT"), ("SUMMARY COLLATE",)),
    **dict.fromkeys(
        (
            "COATINGS",
            "COLLATE PLOT AXES",
            "DAMPER",
            "DAMPING",
            "EQUIVALENT",
            "FLEX JOINTS",
            "FLOATING BODY",
            "GUIDE",
            "MOONPOOL",
            "PLASTIC HARDENING",
            "POINT BUOY",
            "POISSON",
            "TAPER",
            "TEMPERATURE",
            "TITLE",
            "TOLERANCE",
            "WAVE-DEAN",
            "WAVE-PIERSON MOSKOWITZ",
            "WAVE-USER DEFINED",
            "WINCH",
            "WIND",
        ),
        (),
    ),
}
"""The sections of each; none: known to exist, section not confirmed."""

ZERO_LENGTH = ("FLEX JOINTS", "HINGE", "SPRING ELEMENT", "DAMPER")
"""Those whose elements may have no length."""
