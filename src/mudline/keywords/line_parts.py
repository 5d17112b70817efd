"""What the keywords of lines share."""

from __future__ import annotations

from typing import Annotated, ClassVar

from mudline.keywords.model import Record, setting
from mudline.keywords.values import Name


class AdditionalSets(Record):
    """More sets that the elements of a section belong to."""

    rule: ClassVar[str] = "additional_sets"
    sets: Annotated[
        list[Name],
        setting("ADDITIONAL", "more element sets that hold this section", inferred="the line may be repeated"),
    ]
