"""Makes the stages an input needs; a stage or a law that nothing needs is not even imported."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mudline.contact.inputs import ContactInput, LawKind

if TYPE_CHECKING:
    from mudline.contact.assembly import Assembly
    from mudline.contact.laws.spring import Springs
    from mudline.contact.normal import NormalLaw


def make_normal_law(inputs: ContactInput) -> NormalLaw | None:
    """Return the springs of the bed, or None when no element has one."""
    springs = _springs(inputs)
    if not springs:
        return None
    from mudline.contact.normal import NormalLaw  # noqa: PLC0415 - only now is it needed

    return NormalLaw(inputs, springs)


def make_assembly(inputs: ContactInput, normal_law: NormalLaw | None) -> Assembly | None:
    """Return what adds element forces up at the nodes, or None when there are none."""
    if normal_law is None:
        return None
    from mudline.contact.assembly import Assembly  # noqa: PLC0415 - only now is it needed

    return Assembly(inputs, normal_law.elements)


def _springs(inputs: ContactInput) -> list[Springs]:
    springs: list[Springs] = []
    if (inputs.law == LawKind.CURVE).any():
        from mudline.contact.laws.curve import curve_springs  # noqa: PLC0415 - only now is it needed

        springs.extend(curve_springs(inputs))
    if (inputs.law == LawKind.LINEAR).any():
        from mudline.contact.laws.linear import linear_springs  # noqa: PLC0415 - only now is it needed

        springs.extend(linear_springs(inputs))
    return springs
