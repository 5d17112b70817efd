"""Axis systems and vectors."""

from typing import Annotated, Literal

from mudline.language.keywords.common import *


def _component(axis: str, of: str) -> FieldInfo:
    """Return the field of a component; the first component stands for the whole vector, or for both axes."""
    usual = {("X", "the vector"): LENGTH, ("X", "the local x axis"): AXES}.get((axis, of), COMPONENT)
    return about(f"component of {of} along the global {axis} axis", default="0", usual=usual)


class Components(Row):
    """Vector."""

    x: Annotated[Real | None, _component("X", "the vector")] = None
    y: Annotated[Real | None, _component("Y", "the vector")] = None
    z: Annotated[Real | None, _component("Z", "the vector")] = None


class TwoAxes(Row):
    """First two axes of a system."""

    x1: Annotated[Real | None, _component("X", "the local x axis")] = None
    y1: Annotated[Real | None, _component("Y", "the local x axis")] = None
    z1: Annotated[Real | None, _component("Z", "the local x axis")] = None
    x2: Annotated[Real | None, _component("X", "the local y axis")] = None
    y2: Annotated[Real | None, _component("Y", "the local y axis")] = None
    z2: Annotated[Real | None, _component("Z", "the local y axis")] = None


class NamedVector(Record):
    """Vector."""

    rule = "named_vector"
    name: Annotated[Name, setting("VECTOR", "name of the vector", defines=Names.VECTOR)]
    vector: Annotated[Components, about("its components")]


class Vectors(Block):
    """Vectors."""

    rule = "vector"
    page = "kwd_model_vector"
    summary = "Directions along which *CRITERIA moves a node or a vessel."
    example = "*VECTOR\n VECTOR=Outwards\n 0.0, 1.0, 0.0\n"

    keyword: Literal["VECTOR"] = "VECTOR"
    vectors: Records[NamedVector] = Records()


class LocalAxes(Record):
    """Axis system."""

    rule = "local_axes"
    name: Annotated[Name, setting("NAME", "name of the axis system", unique=True)]
    axes: Annotated[TwoAxes, about("its x and y axes, at right angles")]


class LocalAxisSystems(Block):
    """Axis systems."""

    rule = "local_axis_system"
    page = "kwd_model_localaxissystem"
    summary = "User-defined axis systems for elements, by two axes at right angles."
    example = "*LOCAL AXIS SYSTEM\n NAME=Spool\n 0.0, 1.0, 0.0, 1.0, 0.0, 0.0\n"

    keyword: Literal["LOCAL AXIS SYSTEM"] = "LOCAL AXIS SYSTEM"
    systems: Records[LocalAxes] = Records()


_SECTION = "also in $SUMMARY POSTPROCESSING, where *PARA REACTION names axis systems of this keyword"


class AxesAtNode(Record):
    """Axis system for outputs: by two axes, or by a node on its x axis."""

    rule = "axes_at_node"
    axis: Annotated[Name, setting("AXIS", "name of the axis system", defines=Names.AXIS, inferred=_SECTION)]
    node: Node
    x1: Annotated[Real | None, _component("X", "the local x axis")] = None
    y1: Annotated[Real | None, _component("Y", "the local x axis")] = None
    z1: Annotated[Real | None, _component("Z", "the local x axis")] = None
    x2: Annotated[Real | None, _component("X", "the local y axis")] = None
    y2: Annotated[Real | None, _component("Y", "the local y axis")] = None
    z2: Annotated[Real | None, _component("Z", "the local y axis")] = None
    local_x: Annotated[
        Ident | None,
        setting("LOCAL_X_NODE", "node on the local x axis, in place of axes", inline=True, names=Names.NODE),
    ] = None


class VectorAtNode(Record):
    """Vector for outputs."""

    rule = "vector_at_node"
    vector: Annotated[Name, setting("VECTOR", "name of the vector")]
    node: Node
    x: Annotated[Real | None, _component("X", "the vector")] = None
    y: Annotated[Real | None, _component("Y", "the vector")] = None
    z: Annotated[Real | None, _component("Z", "the vector")] = None


class AxesAndVectors(Block):
    """Axis systems and vectors for outputs."""

    rule = "axis_vector"
    sections = ("DATABASE POSTPROCESSING", "POSTPROCESSING", "SUMMARY POSTPROCESSING")
    subject = "post-processing"
    page = "kwd_databasepostprocessing_axisvector"
    summary = "Axis systems and vectors in which outputs are given."
    example = (
        "*AXIS/VECTOR\n AXIS=Hang-off\n 10, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0\n AXIS=Along\n 10, LOCAL_X_NODE=11\n"
        " VECTOR=Down\n 10, -1.0\n"
    )

    keyword: Literal["AXIS/VECTOR"] = "AXIS/VECTOR"
    entries: Records[AxesAtNode | VectorAtNode] = Records()
