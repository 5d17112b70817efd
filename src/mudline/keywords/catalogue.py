"""Every section and keyword that is known, and which module declares it; a module is imported when a deck needs it."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import cast

from mudline.keywords.kept import Kept
from mudline.keywords.model import Block

_LIBRARY = "mudline.keywords.library"

SECTIONS = (
    "PREPROCESSOR",
    "MODEL",
    "LOAD CASE",
    "MODES",
    "MODES POSTPROCESSING",
    "DATABASE POSTPROCESSING",
    "TIMETRACE POSTPROCESSING",
    "SUMMARY POSTPROCESSING",
    "SUMMARY COLLATE",
    "SPECTRAL POSTPROCESSING",
    "CODE CHECKING",
    "HISTOGRAM",
    "LIFETIME",
    "LIFEFREQUENCY",
    "CLEAR",
    "ANALYSIS",
    "POSTPROCESSING",
)

_MODULES = {
    ("ANALYSIS", "UNITS"): "units",
    ("PREPROCESSOR", "PARAMETERS"): "parameters",
    ("PREPROCESSOR", "VARIATION"): "variation",
    ("PREPROCESSOR", "COMBINATIONS"): "combinations",
    ("MODEL", "OCEAN"): "ocean",
    ("MODEL", "NODE"): "node",
    ("MODEL", "ELEMENT"): "element",
    ("MODEL", "ELEMENT SETS"): "element_sets",
    ("MODEL", "LINE SECTION GROUPS"): "line_section_groups",
    ("MODEL", "LINE PATH SECTIONS"): "line_path_sections",
    ("MODEL", "GEOMETRIC SETS"): "geometric_sets",
    ("MODEL", "SEABED PROPERTIES"): "seabed_properties",
    ("MODEL", "SEABED STIFFNESS"): "seabed_stiffness",
    ("MODEL", "SEABED PROFILE"): "seabed_profile",
    ("MODEL", "SEABED PLANES"): "seabed_planes",
    ("MODEL", "SEABED CONTACT"): "seabed_contact",
    ("MODEL", "SEABED SUCTION"): "seabed_suction",
    ("MODEL", "SEABED UNLOADING"): "seabed_unloading",
    ("MODEL", "SEABED FRICTION"): "seabed_friction",
    ("MODEL", "SEABED TRENCH"): "seabed_trench",
    ("MODEL", "EMBEDMENT"): "embedment",
    ("MODEL", "ELASTIC SURFACE"): "elastic_surface",
    ("MODEL", "RIGID SURFACE"): "rigid_surface",
    ("MODEL", "P-Y"): "p_y",
    ("MODEL", "T-Z"): "t_z",
    ("LOAD CASE", "RESTART"): "restart",
    ("LOAD CASE", "TIME"): "time",
    ("LOAD CASE", "BOUNDARY"): "boundary",
    ("LOAD CASE", "FRICTION"): "friction",
    ("MODES", "FRICTION"): "friction",
}

_KEPT = {
    ("MODEL", "LINES"): "lines",
    ("MODEL", "LINE PATHS"): "line_paths",
    ("MODEL", "LINE LOCATIONS"): "line_locations",
    ("MODEL", "CABLE"): "cable",
    ("MODEL", "NODE,CURVILINEAR"): "node_curvilinear",
    ("LOAD CASE", "NO FRICTION"): "no_friction",
}
"""Keywords whose lines are kept, and of which a module says what they are for."""

_POST = ("DATABASE POSTPROCESSING", "POSTPROCESSING")
_ANY: tuple[str, ...] = ()

_OPAQUE: dict[str, tuple[str, ...]] = {
    "EXCEL VARIATIONS": ("PREPROCESSOR",),
    **dict.fromkeys(
        (
            "HYDRODYNAMIC SETS",
            "PROPERTIES",
            "PIP SECTION",
            "PIP CONNECTION",
            "VESSEL",
            "VESSEL,INTEGRATED",
            "TENSIONER",
        ),
        ("MODEL",),
    ),
    **dict.fromkeys(
        (
            "TIME,DISCONNECT",
            "LOAD",
            "CURRENT",
            "WAVE",
            "WAVE-REGULAR",
            "WAVE-STOKES",
            "OFFSET",
            "NON LINEAR STATIC",
            "DIRECTORY",
            "TOP TENSION",
            "DRILLING MUD",
            "DRIFT-OFF LIMITS",
        ),
        ("LOAD CASE",),
    ),
    "ANALYSIS TYPE": ("LOAD CASE", "ANALYSIS"),
    "ELEMENT SET": _POST,
    "STANDARD OUTPUT": _POST,
    "TIMETRACE": _POST,
    "SNAPSHOT": _POST,
    "STATISTICS": _POST,
    "SPECTRUM": _POST,
    "OUTPUT FILES": _POST,
    "DATABASE": _POST,
    "IDENTIFY": ("SUMMARY COLLATE",),
    "COLLATE": ("SUMMARY COLLATE",),
    "PLOT": ("SUMMARY COLLATE",),
    **dict.fromkeys(
        (
            "RAO",
            "GUIDE",
            "COATINGS",
            "COLLATE PLOT AXES",
            "MASS",
            "INTERNAL FLUID",
            "WIND",
            "DAMPING",
            "AUXILIARY",
            "POINT BUOY",
            "DAMPER",
            "SPRING ELEMENT",
            "NODE SPRING",
            "FLEX JOINTS",
            "HINGE",
            "FORCE-STRAIN",
            "MOMENT-CURVATURE",
            "TORQUE-TWIST",
            "DRAG CHAIN",
            "DRAG LIFT",
            "WINCH",
            "TAPER",
            "POISSON",
            "MOONPOOL",
            "FLOATING BODY",
            "PIP STIFFNESS",
            "EQUIVALENT",
            "PLASTIC HARDENING",
            "WAVE-JONSWAP",
            "WAVE-PIERSON MOSKOWITZ",
            "WAVE-DEAN",
            "WAVE-USER DEFINED",
            "DRIFT",
            "TEMPERATURE",
            "TOLERANCE",
            "TITLE",
        ),
        _ANY,
    ),
}
"""Keywords that are recognised and kept as they are; no sections: known to exist, section not confirmed."""

_ALSO_OPAQUE_IN = {"ELEMENT SETS": ("CLEAR", *_POST)}
_UNCONFIRMED = ("NO FRICTION",)
"""Keywords with a module whose section is not confirmed."""


def block_class(section: str, keyword: str) -> type[Block] | None:
    """The declaration of a keyword in a section, or None when it is kept as it is."""
    module = _MODULES.get((section, keyword))
    return load(module) if module else None


@cache
def load(module: str) -> type[Block]:
    """The block class that a module of the library declares as BLOCK."""
    return cast("type[Block]", import_module(f"{_LIBRARY}.{module}").BLOCK)


def kept_of(section: str, keyword: str) -> Kept | None:
    """What is known of a keyword that is kept as it is, or None when that is its name at most."""
    module = _KEPT.get((section, keyword))
    return _load_kept(module) if module else None


@cache
def _load_kept(module: str) -> Kept:
    return cast("Kept", import_module(f"{_LIBRARY}.{module}").KEPT)


def kept_keywords(section: str) -> list[str]:
    """The keywords of a section that `kept_of` knows, in the order of the catalogue."""
    return [keyword for where, keyword in _KEPT if where == section]


def kept() -> list[Kept]:
    """Every keyword that `kept_of` knows, in the order of the catalogue."""
    return [_load_kept(module) for module in dict.fromkeys(_KEPT.values())]


def modules() -> list[str]:
    """Names of all library modules, in the order of the catalogue."""
    return list(dict.fromkeys(_MODULES.values()))


@cache
def sections_of(keyword: str) -> tuple[str, ...] | None:
    """The sections where a keyword belongs; () when not confirmed, None for an unknown keyword."""
    if keyword in _UNCONFIRMED:
        return _ANY
    declared = tuple(section for section, name in (*_MODULES, *_KEPT) if name == keyword)
    if declared:
        return declared + _ALSO_OPAQUE_IN.get(keyword, ())
    return _OPAQUE.get(keyword)


def begins_keyword(text: str) -> bool:
    """Whether known keywords begin with a text that is none itself."""
    return text not in keywords() and any(known.startswith(text) for known in keywords())


@cache
def keywords() -> tuple[str, ...]:
    """Every known keyword."""
    return tuple(sorted({name for _, name in (*_MODULES, *_KEPT)} | set(_OPAQUE)))


@cache
def read_keywords() -> tuple[str, ...]:
    """Every keyword of which more is known than its name."""
    return tuple(sorted({name for _, name in (*_MODULES, *_KEPT)}))
