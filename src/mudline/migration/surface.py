"""A legacy surface as the lines of the new family, field by field as it is written."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

_FRICTION = (
    "longitudinal",
    "transverse",
    "longitudinal_mobilisation",
    "transverse_mobilisation",
    "constant",
)
_CHARACTERISTIC = (("longitudinal", "longitudinal_length"), ("transverse", "transverse_length"))


@dataclass(frozen=True, slots=True)
class SurfaceLines:
    """What a surface says of every element: `stiffness` as written, "" when it gives none, and the other lines."""

    stiffness: str
    others: Sequence[str]

    def block(self, set_name: str, stiffness: str) -> list[str]:
        """The lines of one SET=, which takes all from itself: nothing is inherited from another block."""
        lines = [f"SET={set_name}"]
        if stiffness:
            lines.append(f"STIFFNESS={stiffness}")
        return [*lines, *self.others]


def surface_lines(fields: Mapping[str, str]) -> SurfaceLines:
    """The lines of a surface whose fields are given by name, as text, "" for an empty one."""
    others: list[str] = []
    friction = [fields.get(name, "") for name in _FRICTION]
    if any(friction):
        friction[:2] = [value or "0" for value in friction[:2]]
        others.append("FRICTION=" + _joined(friction))
    if fields.get("lateral"):
        others.append(f"LATERAL={fields['lateral']}")
    suction = [fields.get("suction_stiffness", ""), fields.get("suction_extent", "")]
    if any(suction):
        others.append("SUCTION=" + _joined([suction[0] or "0", suction[1]]))
    return SurfaceLines(fields.get("stiffness", ""), others)


def lengths_in_force(fields: Mapping[str, str], without_friction: Mapping[str, bool]) -> list[str]:
    """The largest characteristic lengths that bound the mobilisation length, which the new family cannot say.

    One does not count where the mobilisation length itself is given, or where `without_friction` says that the
    coefficient of its direction is 0.
    """
    return [
        length
        for direction, length in _CHARACTERISTIC
        if fields.get(length) and not fields.get(f"{direction}_mobilisation") and not without_friction[direction]
    ]


def lengths_given(fields: Mapping[str, str]) -> list[str]:
    """The largest characteristic lengths with their directions, as they are written."""
    return [f"{direction} {fields[name]}" for direction, name in _CHARACTERISTIC if fields.get(name)]


def _joined(values: Sequence[str]) -> str:
    last = max(index for index, value in enumerate(values) if value)
    return ", ".join(values[: last + 1])
