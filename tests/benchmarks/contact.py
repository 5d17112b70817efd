"""Nanoseconds a node and step of the contact evaluator: python -m tests.benchmarks.contact

Printed is the least processor time of several runs, on which other programs have the least influence, of a line with
every law on (curves, linear and smoothed laws, nodal springs, unloading, both suctions, friction, lateral springs,
trenches), each drawn at random for each element, and of a line with one curve on all elements; then of a function
written by hand for one curve.

`--ratios` has the goals alone: a compiled step into the arrays of an earlier one beside copy and root of 16 numbers a
node, and a series with nine nodes of ten above the seabed beside one with all on it, with every law. What is compared
runs in turn; a ratio is that of the least times.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from mudline.model.contact import ContactInput, ContactModel, LawAssignment
from mudline.model.contact.arrays import FloatArray, IndexArray
from mudline.model.contact.plan import Backend
from tests.benchmarks.goals import GOALS
from tests.helpers.builders.contact import ALONG_Y, CLAY, FRICTION, bridge_law, line, on, suction

Work = Callable[[], object]

_NODE_STEPS = 400_000
"""Of a run, about."""


def all_laws(nodes: int) -> ContactInput:
    """A line with every law on some of its elements or nodes."""
    rng, count = np.random.default_rng(1), nodes - 1
    points = line(count, 1)

    def some(share: float, of: int = count) -> IndexArray:
        return np.flatnonzero(rng.random(of) < share)

    curves, unloads, spread, slides = some(0.5), some(0.4), some(0.7), some(0.9, nodes)
    linear = np.setdiff1d(np.arange(count), curves)
    plain, smoothed = np.intersect1d(linear, unloads), np.setdiff1d(linear, unloads)
    diameter = rng.choice([0.3, 0.5], count)
    nodal, trench, k = some(0.3, nodes), some(0.7), len(slides)
    constant = np.where(rng.random((k, 1)) < 0.5, rng.uniform(2e4, 1e5, (k, 2)), np.nan)
    turned = np.where(rng.random(k) < 0.3, rng.uniform(-180.0, 180.0, k), np.nan)
    sliding = np.column_stack(
        [rng.uniform(0.2, 0.9, (k, 2)), constant, rng.uniform(0.005, 0.05, (k, 2)), rng.random(k) < 0.4, turned]
    )
    straight = np.where(rng.random((len(trench), 1)) < 0.3, np.array([[0.0, 0.1, 50.0, 0.3]]), np.nan)
    walls = dict(zip(ALONG_Y, straight.T, strict=True))
    zone, nodal_zone = rng.uniform(0.0, 0.02, len(smoothed)), rng.uniform(0.0, 0.01, len(nodal))
    return of_line(
        points,
        diameter,
        on("curve", curves, curve=0),
        on("linear", plain, stiffness=2.0e4),
        on("smoothed", smoothed, stiffness=2.0e4, half_width=zone, one_sided=rng.random(len(smoothed)) < 0.5),
        on("nodal", nodal, stiffness=3.0e4, half_width=nodal_zone, one_sided=rng.random(len(nodal)) < 0.5),
        on("unloading", unloads, stiffness=4.0e5),
        on("suction spring", np.setdiff1d(np.arange(count), spread), stiffness=800.0, extent=0.2),
        suction(bridge_law(len(spread), 4000.0, diameter[spread]), spread.tolist()),
        on("friction", slides, **dict(zip(FRICTION, sliding.T, strict=True))),
        on("lateral", some(0.3), stiffness=900.0),
        on("trench peak", trench, peak=350.0, bottom=0.02, upper=0.4, **walls),
    )


def of_line(points: FloatArray, diameter: FloatArray, *laws: LawAssignment) -> ContactInput:
    """A line through points with laws and one curve."""
    count = len(diameter)
    return ContactInput(
        node_ids=np.arange(1, count + 2),
        coordinates=points,
        element_ids=np.arange(1, count + 1),
        element_nodes=np.column_stack([np.arange(count), np.arange(1, count + 1)]),
        length=np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1)),
        diameter=diameter,
        laws=laws,
        curves=(CLAY,),
    )


def one_curve(nodes: int) -> ContactInput:
    """A line with one curve on all elements."""
    diameter = np.random.default_rng(1).choice([0.3, 0.5], nodes - 1)
    return of_line(line(nodes - 1, 1), diameter, on("curve", np.arange(nodes - 1), curve=0))


def series(inputs: ContactInput, steps: int) -> FloatArray:
    """Positions (steps, n, 3) of nodes that move a little about where they lie."""
    moves = np.random.default_rng(2).normal(0.0, 0.01, (4, *inputs.coordinates.shape))
    return np.stack([inputs.coordinates + moves[step % 4] for step in range(steps)])


def by_hand(positions: FloatArray, diameter: FloatArray, half: FloatArray) -> None:
    """The results of one curve on all elements of a line, as one writes them for one purpose."""
    slopes, rows = np.append(CLAY.slopes, CLAY.slopes[-1]), max(1, 8192 // positions.shape[1])
    for start in range(0, len(positions), rows):
        gap = positions[start : start + rows, :, 0] + 0.0
        depth = 0.0 - (0.5 * gap[:, :-1] + 0.5 * gap[:, 1:])
        ratio, contact = depth / diameter, depth > 0.0
        at = np.searchsorted(CLAY.ratios[1:], ratio, side="right")
        slope = slopes[at]
        force = np.where(contact, CLAY.forces[at] + slope * (ratio - CLAY.ratios[at]), 0.0)
        slope = np.where(contact, slope, 0.0)
        _stiffness, _cut, load = slope / diameter, np.zeros(depth.shape, np.bool_), force * half
        normal, reaction = np.zeros(gap.shape), np.zeros((*gap.shape, 3))
        normal[:, :-1] += load
        normal[:, 1:] += load
        reaction[..., 0] = normal


def streaming(inputs: ContactInput, positions: FloatArray, backend: Backend) -> Work:
    """A run through a whole series, a few steps at a time."""
    model, times = ContactModel(inputs, backend=backend, threads=1), 0.1 * np.arange(float(len(positions)))

    def run() -> None:
        for _ in model.stream(positions, times=times):
            pass

    return run


def stepping(inputs: ContactInput, positions: FloatArray, backend: Backend) -> Work:
    """One step behind another."""
    model = ContactModel(inputs, backend=backend, threads=1)
    _, state = model.step(positions[0], None, model.initial_state())
    return lambda: model.step(positions[1], None, state, 0.1)


def stepping_again(inputs: ContactInput, positions: FloatArray) -> Work:
    """One compiled step behind another, into the arrays of an earlier one."""
    model = ContactModel(inputs, backend="fast", threads=1)
    _, state = model.step(positions[0], None, model.initial_state())
    out = model.step(positions[1], None, state, 0.1)
    return lambda: model.step(positions[1], None, state, 0.1, out=out)


def copy_and_root(nodes: int) -> Work:
    """What numpy takes for two passes over 16 numbers of each node."""
    numbers = np.random.default_rng(1).random((nodes, 16))
    target = np.empty_like(numbers)

    def run() -> None:
        np.copyto(target, numbers)
        np.sqrt(target, out=target)

    return run


def above_and_on(nodes: int, steps: int) -> tuple[Work, Work]:
    """Compiled series with nine nodes of ten 5 m above the seabed, and with all of them 0.1 m in it."""
    inputs = all_laws(nodes)
    positions = series(inputs, steps)
    above, on_it = positions.copy(), positions.copy()
    above[:, : nodes * 9 // 10, 0] += 5.0
    on_it[..., 0] -= 0.1
    return streaming(inputs, above, "fast"), streaming(inputs, on_it, "fast")


def ratios(rounds: int) -> Iterator[tuple[str, list[float], list[float]]]:
    """The goal that is measured, and the seconds of a work and of its peer in each round, which run in turn."""
    pairs: list[tuple[str, int, tuple[Work, Work]]] = []
    for nodes in (1000, 100):
        inputs = all_laws(nodes)
        pairs.append((f"step {nodes}", 100, (stepping_again(inputs, series(inputs, 2)), copy_and_root(nodes))))
    pairs.append(("in the air", 1, above_and_on(1000, 400)))
    for key, times, works in pairs:
        taken = [[_average(work, times) for work in works] for _ in range(rounds + 1)][1:]
        yield key, [one for one, _ in taken], [peer for _, peer in taken]


def _average(work: Work, times: int) -> float:
    start = time.thread_time()
    for _ in range(times):
        work()
    return (time.thread_time() - start) / times


def main() -> None:
    """Print the goals, or times of lines of growing numbers of nodes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--nodes", type=int, nargs="+", default=[1000, 10_000, 100_000, 1_000_000])
    parser.add_argument("--rounds", type=int, default=7, help="runs to take the least time of (default 7)")
    parser.add_argument("--json", action="store_true", help="with --ratios: print the figures as JSON")
    parser.add_argument("--ratios", action="store_true", help="print the goals alone, with what is reached")
    given = parser.parse_args()
    if not given.ratios:
        for nodes in given.nodes:
            _print_times(nodes, given.rounds)
        return
    found = list(ratios(given.rounds))
    if given.json:
        print(json.dumps(found))
        return
    goals = {goal.key: goal for goal in GOALS}
    for key, (taken, peer) in ((key, map(min, times)) for key, *times in found):
        reached = f"{taken / peer:.3g} ({taken * 1e6:.0f} / {peer * 1e6:.0f} us; goal at most {goals[key].limit:g})"
        print(f"{goals[key].what}: {reached}")


def _print_times(nodes: int, rounds: int) -> None:
    steps = max(8, _NODE_STEPS // nodes)
    curve = one_curve(nodes)
    places = series(curve, steps)
    works: dict[str, Work] = {"one curve by hand": partial(by_hand, places, curve.diameter, 0.5 * curve.length)}
    backends: tuple[Backend, ...] = ("numpy", "fast")
    for name, inputs in (("one curve", curve), ("all laws", all_laws(nodes))):
        works |= {f"{name}, {backend}": streaming(inputs, places, backend) for backend in backends}
    for name, work in works.items():
        taken = min([_average(work, 1) for _ in range(rounds + 1)][1:])
        print(f"{nodes:>8} nodes, {name}: {1e9 * taken / (nodes * steps):.1f} ns a node and step", flush=True)


if __name__ == "__main__":
    main()
