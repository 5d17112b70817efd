"""Keywords of which only the name is known, and where they stand: their lines are passed through unchanged.

A keyword that a module of the library declares for some sections may be here for others.
"""

from __future__ import annotations

from mudline.language.keywords.values import Gift

_POST = ("DATABASE POSTPROCESSING", "POSTPROCESSING")

NAMES: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(
        (
            "PANEL SECTIONS,AUXILIARY",
            "PROPERTIES",
            "STRESS/STRAIN",
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
            "TIMETRACE",
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
            "RAO",
            "SNAPSHOT",
            "SPECTRUM",
            "STANDARD OUTPUT",
            "STATISTICS",
        ),
        _POST,
    ),
    "PARA ANGLE TENSION": ("SUMMARY POSTPROCESSING",),
    **dict.fromkeys(("IDENTIFY", "PLOT"), ("SUMMARY COLLATE",)),
    **dict.fromkeys(
        (
            "COATINGS",
            "DAMPER",
            "DAMPING",
            "EQUIVALENT",
            "FATIGUE DATA",
            "FLEX JOINTS",
            "FLOATING BODY",
            "GUIDE",
            "PLASTIC HARDENING",
            "POINT BUOY",
            "POISSON",
            "RAO FORMAT",
            "S-N CURVE",
            "SEASTATE FILES",
            "SLUGS",
            "TAPER",
            "TEMPERATURE",
            "WAVE-PIERSON MOSKOWITZ",
            "WAVE-PIERSON-MOSKOWITZ",
            "WINCH",
            "WIND",
        ),
        (),
    ),
}
"""The sections of each; none: known to exist, section not confirmed."""

GIVES: dict[str, tuple[Gift, ...]] = {
    **dict.fromkeys(("EQUIVALENT", "FLEX JOINTS", "PROPERTIES"), ("sections", "hydrodynamics")),
    **dict.fromkeys(("DAMPER", "TENSIONER"), ("sections", "hydrodynamics", "supports")),
    **dict.fromkeys(("FLOATING BODY", "POINT BUOY"), ("hydrodynamics", "supports")),
    "TAPER": ("sections",),
    "TOP TENSION": ("supports",),
    **dict.fromkeys(("GUIDE", "WINCH"), ("elements", "sections", "hydrodynamics", "supports")),
}
"""What each may give to nodes and elements, as its name says, since its lines are not known; others give nothing."""

ZERO_LENGTH = ("FLEX JOINTS", "DAMPER")
"""Those whose elements may have no length."""
