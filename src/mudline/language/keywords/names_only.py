"""Keywords of which only name and sections are known: their lines are passed through unchanged.

A keyword that a module of the library declares for some sections may be listed here for others.
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
            "SLUGS",
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
    "HOT SPOT SETS": ("LIFETIME FATIGUE",),
    "PARA ANGLE TENSION": ("SUMMARY POSTPROCESSING",),
    **dict.fromkeys(("IDENTIFY", "PLOT"), ("SUMMARY COLLATE",)),
    **dict.fromkeys(
        (
            "COATINGS",
            "DAMPER",
            "DAMPING",
            "EQUIVALENT",
            "FLEX JOINTS",
            "FLOATING BODY",
            "GUIDE",
            "MOORED VESSEL",
            "POISSON",
            "RAO FORMAT",
            "REGULAR WAVE EQUIVALENT",
            "STIFFENER",
            "TEMPERATURE",
            "WAVE-PIERSON MOSKOWITZ",
            "WAVE-PIERSON-MOSKOWITZ",
            "WIND",
        ),
        (),
    ),
}
"""Sections of each keyword; none if the keyword exists, but its section is not confirmed."""

GIVES: dict[str, tuple[Gift, ...]] = {
    **dict.fromkeys(("FLEX JOINTS", "PROPERTIES"), ("sections", "hydrodynamics")),
    **dict.fromkeys(("DAMPER", "TENSIONER"), ("sections", "hydrodynamics", "supports")),
    **dict.fromkeys(("FLOATING BODY", "MOORED VESSEL"), ("hydrodynamics", "supports")),
    **dict.fromkeys(("EQUIVALENT", "TOP TENSION"), ("supports",)),
    "GUIDE": ("elements", "sections", "hydrodynamics", "supports"),
}
"""Properties that each keyword may define, judged by its name, since its lines are unknown; other keywords none."""

ZERO_LENGTH = ("FLEX JOINTS", "DAMPER")
"""Keywords whose elements may have no length."""
