"""Keywords of which only the name is known, and where they stand: their lines are passed through unchanged.

A keyword that a module of the library declares for some sections may be here for others.
"""

from __future__ import annotations

_POST = ("DATABASE POSTPROCESSING", "POSTPROCESSING")

NAMES: dict[str, tuple[str, ...]] = {
    "EXCEL VARIATIONS": ("PREPROCESSOR",),
    **dict.fromkeys(
        (
            "HYDRODYNAMIC SETS",
            "PIP CONNECTION",
            "PIP SECTION",
            "PROPERTIES",
            "TENSIONER",
            "VESSEL",
            "VESSEL,INTEGRATED",
        ),
        ("MODEL",),
    ),
    **dict.fromkeys(
        (
            "CURRENT",
            "DIRECTORY",
            "DRIFT-OFF LIMITS",
            "DRILLING MUD",
            "LOAD",
            "NON LINEAR STATIC",
            "OFFSET",
            "TIME,DISCONNECT",
            "TOP TENSION",
            "WAVE",
            "WAVE-REGULAR",
            "WAVE-STOKES",
        ),
        ("LOAD CASE",),
    ),
    "ANALYSIS TYPE": ("LOAD CASE", "ANALYSIS"),
    "ELEMENT SETS": ("CLEAR", *_POST),
    **dict.fromkeys(
        (
            "DATABASE",
            "ELEMENT SET",
            "OUTPUT FILES",
            "SNAPSHOT",
            "SPECTRUM",
            "STANDARD OUTPUT",
            "STATISTICS",
            "TIMETRACE",
        ),
        _POST,
    ),
    **dict.fromkeys(("COLLATE", "IDENTIFY", "PLOT"), ("SUMMARY COLLATE",)),
    **dict.fromkeys(
        (
            "AUXILIARY",
            "COATINGS",
            "COLLATE PLOT AXES",
            "DAMPER",
            "DAMPING",
            "DRAG CHAIN",
            "DRAG LIFT",
            "DRIFT",
            "EQUIVALENT",
            "FLEX JOINTS",
            "FLOATING BODY",
            "FORCE-STRAIN",
            "GUIDE",
            "HINGE",
            "INTERNAL FLUID",
            "MASS",
            "MOMENT-CURVATURE",
            "MOONPOOL",
            "NODE SPRING",
            "PIP STIFFNESS",
            "PLASTIC HARDENING",
            "POINT BUOY",
            "POISSON",
            "RAO",
            "SPRING ELEMENT",
            "TAPER",
            "TEMPERATURE",
            "TITLE",
            "TOLERANCE",
            "TORQUE-TWIST",
            "WAVE-DEAN",
            "WAVE-JONSWAP",
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
