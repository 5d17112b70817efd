"""Touchdown and length in contact of random scenes, against a plain loop over the nodes of each line."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

from mudline.model.contact import ContactModel, ContactResult
from mudline.model.contact.touchdown import line_summaries
from tests.model.contact.random_scenes import random_scene

SCENES = 50


class Chain(NamedTuple):
    """Elements one behind the other, and the nodes along them."""

    elements: list[int]
    nodes: list[int]


def chains(ends: list[tuple[int, int]]) -> list[Chain]:
    """The lines of elements, by going from node to node."""
    at: dict[int, list[int]] = {}
    for element, pair in enumerate(ends):
        for node in pair:
            at.setdefault(node, []).append(element)
    used: set[int] = set()
    found = []
    for element, pair in enumerate(ends):
        if element in used:
            continue
        used.add(element)
        elements, nodes = [element], list(pair)
        for end in (-1, 0):
            while nodes[0] != nodes[-1] and len(at[nodes[end]]) == 2:
                (following,) = (each for each in at[nodes[end]] if each not in used)
                used.add(following)
                one, other = ends[following]
                place = len(elements) if end else 0
                nodes.insert(place + 1 if end else 0, other if one == nodes[end] else one)
                elements.insert(place, following)
        found.append(Chain(elements, nodes))
    return found


def touchdown(chain: Chain, result: ContactResult, step: int) -> tuple[list[tuple[float, str]], float]:
    """Arc lengths of the points of a line with the side in contact, and its length in contact."""
    assert result.given is not None
    points, lies, arc = [], 0.0, 0.0
    for element, one, other in zip(chain.elements, chain.nodes[:-1], chain.nodes[1:], strict=True):
        length = float(result.given.length[element])
        first, second = float(result.gap[step, one]), float(result.gap[step, other])
        held = (False, False) if result.restrained is None else result.restrained[step, [one, other]].tolist()
        down = (first < 0.0 or held[0], second < 0.0 or held[1])
        if all(down) and not np.isnan(first + second):
            lies += length
        elif any(down) and not np.isnan(first + second):
            part = min(max(first / (first - second), 0.0), 1.0) if first != second else 0.5
            points.append((arc + part * length, "after" if down[1] else "before"))
            lies += length * (1.0 - part if down[1] else part)
        arc += length
    return points, lies


def scenes() -> Iterator[tuple[int, ContactResult]]:
    """Evaluated scenes as series, with their seeds; those that are refused are left out."""
    for seed in range(1, SCENES + 1):
        scene = random_scene(seed)
        count = len(scene.inputs.element_ids)
        weighed = replace(scene.inputs, weight=np.random.default_rng(seed).uniform(-5.0, 300.0, count))
        try:
            result = ContactModel(weighed, backend="numpy").evaluate(
                scene.positions, velocities=scene.velocities, times=scene.times, present=scene.present
            )
        except ValueError:
            continue
        yield seed, result


def expected_rows(result: ContactResult) -> Iterator[tuple[Chain, int]]:
    """The lines with an evaluated element, at each step."""
    assert result.given is not None
    lines = chains([(int(one), int(other)) for one, other in result.given.element_nodes])
    for step in range(len(result.depth)):
        yield from ((chain, step) for chain in lines if result.evaluated[chain.elements].any())


def test_a_plain_loop_finds_the_same() -> None:
    points = 0
    for seed, result in scenes():
        assert result.given is not None
        rows = line_summaries(result)
        for row, (chain, step) in zip(rows, expected_rows(result), strict=True):
            found, lies = touchdown(chain, result, step)
            place = (seed, step, row.line)
            assert [point.contact for point in row.touchdown] == [side for _, side in found], place
            arcs = [point.arc_length for point in row.touchdown]
            assert arcs == pytest.approx([arc for arc, _ in found], rel=1e-9), place
            assert row.contact_length == pytest.approx(lies, rel=1e-9), place
            ids = result.given.element_ids[[chain.elements[0], chain.elements[-1]]].tolist()
            assert [row.first_element, row.last_element] == ids, place
            pushes = result.force[step, chain.elements]
            assert (row.largest_force.force if row.largest_force else 0.0) == max(0.0, np.nanmax(pushes)), place
            assert (row.largest_uplift.force if row.largest_uplift else 0.0) == min(0.0, np.nanmin(pushes)), place
            points += len(found)
    assert points > 400
