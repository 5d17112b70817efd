"""Run by the interpreter that has Exudyn: a bouncing beam from JSON on standard input, its heights as JSON.

The same masses and springs, given as matrices; Exudyn has its own contact (the limit stop of a spring with friction,
switched by its own contact iteration) and its own integrator.
"""

from __future__ import annotations

import json
import sys
import warnings
from importlib import import_module
from importlib.metadata import version
from types import ModuleType
from typing import Any, TypeAlias

System: TypeAlias = Any
"""Exudyn ships no types."""

_NOWHERE = 1e9
"""Metres: the upper stop, which is not there."""


def stops(items: ModuleType, system: System, markers: list[int], stiffness: float) -> None:
    """A stop below each of the coordinates, at 0."""
    ground = system.AddNode(items.NodePointGround())
    fixed = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    for marker in markers:
        data = system.AddNode(items.NodeGenericData(initialCoordinates=[0, 0, 0], numberOfDataCoordinates=3))
        system.AddObject(
            items.CoordinateSpringDamperExt(
                markerNumbers=[fixed, marker],
                nodeNumber=data,
                limitStopsLower=0.0,
                limitStopsUpper=_NOWHERE,
                limitStopsStiffness=stiffness,
                useLimitStops=True,
            )
        )


def masses(items: ModuleType, system: System, given: dict[str, Any]) -> tuple[int, list[int]]:
    """The model of matrices: its one node, and the markers of its heights."""
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
    return node, markers


def main() -> None:
    """Heights (s, n) at the wanted moments."""
    warnings.simplefilter("ignore")
    given = json.load(sys.stdin)
    exudyn, items = import_module("exudyn"), import_module("exudyn.itemInterface")
    system = exudyn.SystemContainer().AddSystem()
    node, markers = masses(items, system, given)
    stops(items, system, markers, given["contact"])
    kind = exudyn.OutputVariableType.Coordinates
    sensor = system.AddSensor(items.SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=kind))
    system.Assemble()
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = given["end"]
    settings.timeIntegration.numberOfSteps = given["steps"]
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.newton.relativeTolerance = 1e-10
    settings.timeIntegration.discontinuous.iterationTolerance = 1e-6
    settings.timeIntegration.generalizedAlpha.useNewmark = True
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = given["every"]
    system.SolveDynamic(settings, solverType=exudyn.DynamicSolverType.GeneralizedAlpha)
    stored = system.GetSensorStoredData(sensor)
    answer = {
        "program": f"Exudyn {version('exudyn')}",
        "times": stored[:, 0].tolist(),
        "heights": stored[:, 1:].tolist(),
    }
    print(json.dumps(answer))


if __name__ == "__main__":
    main()
