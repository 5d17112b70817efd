"""Run by the interpreter that has Exudyn: a bouncing beam from JSON on standard input, its heights as JSON.

Two models. "masses": the same masses and springs, given as matrices; Exudyn has its own contact (the limit stop of a
spring with friction, switched by its own contact iteration) and its own integrator. "cable": its beam element ANCF
Cable2D, with cubic shape functions, a consistent mass matrix and large rotations, on the same limit stops.
"""

from __future__ import annotations

import json
import sys
import warnings
from importlib import import_module
from importlib.metadata import version
from itertools import pairwise
from types import ModuleType
from typing import Any, TypeAlias

System: TypeAlias = Any
"""Exudyn ships no types."""

_NOWHERE = 1e9
"""Metres: the upper stop, which is not there."""


def stops(items: ModuleType, system: System, markers: list[int], levels: list[float], stiffness: float) -> None:
    """A stop below each of the coordinates, at these levels."""
    ground = system.AddNode(items.NodePointGround())
    fixed = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    for marker, level in zip(markers, levels, strict=True):
        data = system.AddNode(items.NodeGenericData(initialCoordinates=[0, 0, 0], numberOfDataCoordinates=3))
        system.AddObject(
            items.CoordinateSpringDamperExt(
                markerNumbers=[fixed, marker],
                nodeNumber=data,
                limitStopsLower=level,
                limitStopsUpper=_NOWHERE,
                limitStopsStiffness=stiffness,
                useLimitStops=True,
            )
        )


def masses(items: ModuleType, system: System, given: dict[str, Any]) -> tuple[list[int], list[int], list[float]]:
    """The model of matrices: its one node, the markers of its heights, and where these have their stops."""
    import numpy as np  # noqa: PLC0415 - there it is Exudyn's

    heights = given["heights"]
    count, stiffness = len(heights), np.array(given["stiffness"])
    node = system.AddNode(
        items.NodeGenericODE2(
            referenceCoordinates=[0.0] * count,
            initialCoordinates=heights,
            initialCoordinates_t=[0.0] * count,
            numberOfODE2Coordinates=count,
        )
    )
    system.AddObject(
        items.ObjectGenericODE2(
            nodeNumbers=[node],
            massMatrix=np.diag(given["mass"]),
            stiffnessMatrix=stiffness,
            dampingMatrix=given["damping"] * stiffness,
            forceVector=given["weight"],
        )
    )
    markers = [system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=i)) for i in range(count)]
    return [node], markers, [0.0] * count


def cable(items: ModuleType, system: System, given: dict[str, Any]) -> tuple[list[int], list[int], list[float]]:
    """The model of beam elements: its nodes, the markers of their vertical displacements, and their stops."""
    heights, along = given["heights"], given["along"]
    rise, run = heights[1] - heights[0], along[1] - along[0]
    length = (rise * rise + run * run) ** 0.5
    nodes = [
        system.AddNode(items.Point2DS1(referenceCoordinates=[y, x, run / length, rise / length]))
        for x, y in zip(heights, along, strict=True)
    ]
    for pair in pairwise(nodes):
        element = system.AddObject(
            items.Cable2D(
                physicsLength=length,
                physicsMassPerLength=given["mass_per_length"],
                physicsBendingStiffness=given["bending"],
                physicsAxialStiffness=given["axial"],
                physicsBendingDamping=given["damping"] * given["bending"],
                physicsAxialDamping=given["damping"] * given["axial"],
                nodeNumbers=list(pair),
            )
        )
        marker = system.AddMarker(items.MarkerBodyMass(bodyNumber=element))
        fall = given["weight"][1] / given["mass"][1]
        system.AddLoad(items.LoadMassProportional(markerNumber=marker, loadVector=[0.0, fall, 0.0]))
    markers = [system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=1)) for node in nodes]
    return nodes, markers, [-height for height in heights]


def main() -> None:
    """Heights (s, n) at the wanted moments."""
    warnings.simplefilter("ignore")
    given = json.load(sys.stdin)
    exudyn, items = import_module("exudyn"), import_module("exudyn.itemInterface")
    system = exudyn.SystemContainer().AddSystem()
    model = {"masses": masses, "cable": cable}[given["model"]]
    nodes, markers, levels = model(items, system, given)
    every = slice(None, None, given["refined"])
    stops(items, system, markers[every], levels[every], given["contact"])
    kind = exudyn.OutputVariableType.Coordinates
    sensors = [
        system.AddSensor(items.SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=kind))
        for node in nodes
    ]
    system.Assemble()
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = given["end"]
    settings.timeIntegration.numberOfSteps = given["steps"]
    settings.timeIntegration.verboseMode = 0
    # the residual of short beam elements has a round-off of 1e-10
    settings.timeIntegration.newton.relativeTolerance = 1e-10 if given["model"] == "masses" else 1e-9
    settings.timeIntegration.discontinuous.iterationTolerance = 1e-6
    settings.timeIntegration.generalizedAlpha.useNewmark = True
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = given["every"]
    system.SolveDynamic(settings, solverType=exudyn.DynamicSolverType.GeneralizedAlpha)
    stored = [system.GetSensorStoredData(sensor) for sensor in sensors]
    if given["model"] == "masses":
        heights = stored[0][:, 1:].tolist()
    else:
        columns = [(data[:, 2] + height).tolist() for data, height in zip(stored, given["heights"], strict=True)]
        heights = [list(row) for row in zip(*columns, strict=True)]
    heights = [row[every] for row in heights]
    print(json.dumps({"program": f"Exudyn {version('exudyn')}", "times": stored[0][:, 0].tolist(), "heights": heights}))


if __name__ == "__main__":
    main()
