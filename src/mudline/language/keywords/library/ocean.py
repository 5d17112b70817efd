"""`*OCEAN`: water depth, density and gravity."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *


class Ocean(Block):
    """Water of the sea."""

    rule = "ocean"
    facts = Facts(once=True, tells_units=True)
    page = "kwd_model_ocean"
    summary = "Water depth, density of sea water, gravity."
    example = "*OCEAN\n 500.0, 1025.0, 9.81\n"

    keyword: Literal["OCEAN"] = "OCEAN"
    depth: Annotated[
        Real, about("water depth", unit="L", above=0, usual=Usual(high=12_000.0, why="the deepest sea has 11 km"))
    ]
    density: Annotated[
        Real | None, about("density of sea water", unit="M/L3", default="1025 kg/m3", at_least=0, usual=SEA_DENSITY)
    ] = None
    gravity: Annotated[
        Real | None, about("acceleration of gravity", unit="L/T2", default="9.81 m/s2", at_least=0, usual=GRAVITY)
    ] = None
    viscosity: Annotated[
        Real | None,
        about(
            "kinematic viscosity",
            unit="L2/T",
            default="1.3e-6 m2/s, 1.4e-5 ft2/s, 1e-10 in user units",
            at_least=0,
            usual=Usual(5e-7, 2e-5, "water has 0.8E-6 to 1.8E-6, air 1.5E-5", typical=1.3e-6),
        ),
    ] = None
