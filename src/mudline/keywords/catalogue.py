"""Every section and keyword that is known, which module declares it, and which of them an unknown name meant."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from functools import cache
from importlib import import_module
from itertools import takewhile
from typing import cast

from mudline.keywords.model import Block
from mudline.keywords.values import Facts, OpaqueKeyword
from mudline.spelling import Effort, nearest

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

CERTAIN_SECTIONS = ("PREPROCESSOR", "MODEL", "LOAD CASE")
"""Sections of which it is certain which keywords belong there."""

_MODULES = {
    "UNITS": "units",
    "PARAMETERS": "parameters",
    "VARIATION": "variation",
    "COMBINATIONS": "combinations",
    "OCEAN": "ocean",
    "NODE": "node",
    "ELEMENT": "element",
    "ELEMENT SETS": "element_sets",
    "LINE PATH SECTIONS": "line_path_sections",
    "LINE SECTION GROUPS": "line_section_groups",
    "GEOMETRIC SETS": "geometric_sets",
    "SEABED PROPERTIES": "seabed_properties",
    "SEABED STIFFNESS": "seabed_stiffness",
    "SEABED PROFILE": "seabed_profile",
    "SEABED PLANES": "seabed_planes",
    "SEABED CONTACT": "seabed_contact",
    "SEABED SUCTION": "seabed_suction",
    "SEABED UNLOADING": "seabed_unloading",
    "SEABED FRICTION": "seabed_friction",
    "SEABED TRENCH": "seabed_trench",
    "ELASTIC SURFACE": "elastic_surface",
    "RIGID SURFACE": "rigid_surface",
    "EMBEDMENT": "embedment",
    "P-Y": "p_y",
    "T-Z": "t_z",
    "RESTART": "restart",
    "TIME": "time",
    "BOUNDARY": "boundary",
    "FRICTION": "friction",
}
"""The module of each keyword whose lines are read; what it says of the keyword is written nowhere else."""

_KEPT = {
    "LINES": "lines",
    "LINE PATHS": "line_paths",
    "LINE LOCATIONS": "line_locations",
    "CABLE": "cable",
    "NODE,CURVILINEAR": "node_curvilinear",
    "NO FRICTION": "no_friction",
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
"""Keywords that are recognised and passed through unchanged; no sections: known to exist, section not confirmed."""

ZERO_LENGTH = ("FLEX JOINTS", "HINGE", "SPRING ELEMENT", "DAMPER")
"""Keywords whose elements may have no length."""


def block_class(section: str, keyword: str) -> type[Block] | None:
    """The declaration of a keyword in a section, or None when it is passed through."""
    found = declared(keyword)
    return found if found is not None and section in found.sections else None


def declared(keyword: str) -> type[Block] | None:
    """The declaration of a keyword, whatever section it stands in, or None when its lines are not read."""
    module = _MODULES.get(keyword)
    return load(module) if module else None


@cache
def load(module: str) -> type[Block]:
    """The block class that a module of the library declares as BLOCK."""
    return cast("type[Block]", import_module(f"{_LIBRARY}.{module}").BLOCK)


def opaque_keyword(section: str, keyword: str) -> OpaqueKeyword | None:
    """What is known of a keyword that is passed through, or None when that is its name at most."""
    module = _KEPT.get(keyword)
    found = _load_opaque(module) if module else None
    return found if found is not None and section in found.sections else None


@cache
def _load_opaque(module: str) -> OpaqueKeyword:
    return cast("OpaqueKeyword", import_module(f"{_LIBRARY}.{module}").OPAQUE)


def kept_keywords(section: str) -> list[str]:
    """The keywords of a section that `opaque_keyword` knows, in the order of the catalogue."""
    return [keyword for keyword in _KEPT if opaque_keyword(section, keyword)]


def opaque_keywords() -> list[OpaqueKeyword]:
    """Every keyword that `opaque_keyword` knows, in the order of the catalogue."""
    return [_load_opaque(module) for module in _KEPT.values()]


def modules() -> list[str]:
    """Names of all library modules, in the order of the catalogue."""
    return list(_MODULES.values())


def in_order(keywords: Iterable[str]) -> list[str]:
    """Those of the keywords of which more is known than the name, in the order of the catalogue."""
    given = set(keywords)
    return [keyword for keyword in (*_MODULES, *_KEPT) if keyword in given]


def sections_of(keyword: str) -> tuple[str, ...] | None:
    """The sections where a keyword belongs; () when not confirmed, None for an unknown keyword."""
    if (found := declared(keyword)) is not None:
        return found.sections + found.facts.passes_in
    if keyword in _KEPT:
        held = _load_opaque(_KEPT[keyword])
        return _ANY if held.sections_inferred else held.sections
    return _OPAQUE.get(keyword)


def facts_of(keyword: str) -> Facts:
    """What the class of a keyword says of it besides its fields; nothing of a keyword whose lines are not read."""
    found = declared(keyword)
    return found.facts if found else Block.facts


def has_certain_section(keyword: str) -> bool:
    """Whether it is certain where a keyword belongs; of postprocessing that is inferred."""
    return keyword in _MODULES or (sections_of(keyword) or _POST)[0] in CERTAIN_SECTIONS


def is_extension(keyword: str) -> bool:
    """Whether a keyword is mudline's own."""
    return facts_of(keyword).extension


def is_superseded(keyword: str) -> bool:
    """Whether newer keywords take the place of a keyword."""
    return bool(facts_of(keyword).superseded_by)


def supersedes(keyword: str) -> bool:
    """Whether a keyword takes the place of older ones."""
    return facts_of(keyword).supersedes


def holds_in_soil(keyword: str) -> bool:
    """Whether a keyword gives soil springs."""
    return facts_of(keyword).soil_springs


def begins_keyword(text: str) -> bool:
    """Whether known keywords begin with a text that is none itself."""
    return text not in keywords() and any(known.startswith(text) for known in keywords())


@cache
def keywords() -> tuple[str, ...]:
    """Every known keyword."""
    return tuple(sorted({*_MODULES, *_KEPT, *_OPAQUE}))


@cache
def read_keywords() -> tuple[str, ...]:
    """Every keyword of which more is known than its name."""
    return tuple(sorted({*_MODULES, *_KEPT}))


_SAME_BEGINNING = 0.8
"""Share of the longer of two names that has to be the same from its first letter on."""


def meant_section(name: str) -> str:
    """The section that an unknown one was to be, or ""."""
    return nearest(name, SECTIONS) or _begun(name, SECTIONS) or _before(name, SECTIONS)


def suggest_keyword(keyword: str, section: str = "", effort: Effort | None = None) -> str:
    """The keyword that an unknown one was to be, or ""; one that belongs in the section of a block before others."""
    known = keywords()
    own = [name for name in known if section in (sections_of(name) or ())] if section else []
    singular = keyword[:-3] + "Y" if keyword.endswith("IES") else keyword
    return (
        nearest(keyword, own, effort)
        or nearest(keyword, known, effort)
        or (singular if singular in known and singular != keyword else "")
        or _begun(keyword, known)
        or _before(keyword, read_keywords())
    )


def meant_in(keyword: str, section: str) -> str:
    """The keyword of a section that is spelt nearly as one that does not belong in it, or ""."""
    near = [name for name in keywords() if nearest(keyword, [name])]
    return nearest(keyword, [name for name in near if section in (sections_of(name) or ())])


def words_behind(name: str, near: str) -> bool:
    """Whether a name is a known one with words behind it."""
    return name.startswith(near) and name[len(near) : len(near) + 1] in (" ", ",")


def _begun(name: str, known: Collection[str]) -> str:
    """The known name with the longest beginning in common, when that is nearly all of both."""
    head = name[: int(_SAME_BEGINNING * len(name))]
    common, near = max(((_common(name, other), other) for other in known if other.startswith(head)), default=(0, ""))
    return near if common >= _SAME_BEGINNING * max(len(name), len(near)) else ""


def _common(one: str, other: str) -> int:
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(one, other, strict=False)))


def _before(name: str, known: Collection[str]) -> str:
    """The longest known name behind which other words stand."""
    return max((other for other in known if words_behind(name, other)), key=len, default="")
