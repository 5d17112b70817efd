"""Parameters and the equations that use them."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from mudline.codes import REF013, REF014
from mudline.diagnostics import Problem
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.context import MOST_TOLD
from mudline.variations.undefined import undefined_parameters


@rule(REF013)
def undefined_parameter(context: LintContext) -> Iterator[Problem]:
    """An equation uses a parameter that is not defined.

    The field has no value then, and nothing that depends on it can be evaluated. Define the parameter in *PARAMETERS,
    or correct its name. Items of a list have the name of the list in front, as in Soil_stiffness. Told too are a PARA=
    of *VARIATION and a %name% in the names of files of *COMBINATIONS without a parameter: no deck could be made.

    Bad:
        $PREPROCESSOR
        *PARAMETERS
         water depth, 850.0
        $MODEL
        *OCEAN
         =[depth], 1025.0, 9.81

    Good:
        $PREPROCESSOR
        *PARAMETERS
         depth, 850.0
        $MODEL
        *OCEAN
         =[depth], 1025.0, 9.81

    Finds: 6:2
    """
    yield from context.told(REF013)
    yield from islice(undefined_parameters(context.deck), MOST_TOLD)


@rule(REF014)
def parameter_cycle(context: LintContext) -> Iterator[Problem]:
    """Parameters are defined through each other.

    Each of them needs the value of the other first, so none has a value. Give one of them as a number.

    Bad:
        $PREPROCESSOR
        *PARAMETERS
         od, =[wall*17.0]
         wall, =[od/17.0]

    Good:
        $PREPROCESSOR
        *PARAMETERS
         od, 0.3239
         wall, =[od/17.0]

    Finds: 4:8
    """
    yield from context.told(REF014)
