"""What the keywords of loads share."""

from __future__ import annotations

from typing import Annotated

from mudline.language.keywords.fields import about
from mudline.language.keywords.usual import DIRECTION
from mudline.language.keywords.values import Real

Direction = Annotated[
    Real | None, about("direction, anticlockwise from the global Y axis", unit="deg", default="0", usual=DIRECTION)
]
