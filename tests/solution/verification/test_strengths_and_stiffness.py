"""Strengths and stiffness that the verification derives a second time are those of the program."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.assembly import build_assembly
from mbla.program.assemble import LIGHT, yield_limits
from mbla.program.stiffness_shares import shares_in_units, stiffness_areas
from mbla.program.yield_conditions import yield_violation
from mbla.solution.verification.stiffness import relative_stiffness
from mbla.solution.verification.strengths import excess, point_strengths
from tests.decks.folder import PATHS
from tests.line import HEAD, Line, line_of, line_of_file

DECKS = ("tied_wall", "mortar_joint", "eccentric_compression_spacing", "guided_blocks", "open_and_frictionless_joints")


def deck(name: str) -> Path:
    return next(path for path in PATHS if path.stem == name)


@pytest.fixture(params=DECKS, scope="module")
def line(request: pytest.FixtureRequest) -> Line:
    """With rigid bodies in the place of glued blocks, and ties among the contacts."""
    found = line_of_file(deck(request.param))
    bodies = build_assembly(found.deck, found.model).of(found.load_case)
    return Line(found.deck, bodies.model, bodies.contacts, bodies.load_case(found.load_case), found.program)


def test_strengths(line: Line) -> None:
    own, of_program = point_strengths(line.model, line.contacts), yield_limits(line.model, line.contacts)
    assert {name: values.tolist() for name, values in vars(own).items()} == {
        name: values.tolist() for name, values in vars(of_program).items()
    }
    size = max(1.0, *(float(values[np.isfinite(values)].max(initial=0.0)) for values in vars(own).values()))
    forces = 2.0 * size * np.random.default_rng(3).normal(size=(len(line.contacts.points), 3))
    assert (excess(forces, own) > 0).any()
    assert excess(forces, own) == pytest.approx(yield_violation(forces, of_program), abs=1e-12 * size)


def test_stiffness_by_area(line: Line) -> None:
    areas = stiffness_areas(line.contacts)
    assert relative_stiffness(line.model, line.contacts, line.load_case) == pytest.approx(areas / areas.mean())


def pile(*density: float, top: str = "") -> Line:
    """Blocks on each other, the first on the ground, 1 x 1 x 1; interfaces count upwards."""
    names = [f"s{number}" for number in range(len(density))]
    boxes = [
        f"  - box: {{group: {name}, material: {name}, min: [0, 0, {z}], max: [1, 1, {z + 1}]}}\n"
        for z, name in enumerate(names)
    ]
    materials = ", ".join(f"{name}: {{density: {value!r}}}" for name, value in zip(names, density, strict=True))
    text = HEAD.replace("stone: {density: 2000}", materials) + "joints: {dry: {friction: 0.5}}\nblocks:\n"
    text += "".join(boxes) + f"supports: [{{ground: {{z: 0}}}}{top}]\n"
    return line_of(text + "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n")


@pytest.mark.parametrize(
    ("density", "top", "units"),
    [
        ((2000.0, 2e-9), "", (1, 1e-12)),
        ((2000.0, 4e-9, 2e-7), "", (1, 1e-10, 1e-10)),  # a pile has the unit of its largest load
        ((2000.0, 2e-9, 2000.0), "", (1, 1, 1)),  # pressed from above
        ((2e-9, 2000.0), "", (1, 1)),
        ((2000.0, 2e-9), ", {ground: {point: [0, 0, 2], normal: [0, 0, -1]}}", (1, 1, 1)),  # between two bodies
        ((2000.0, 8.0 * LIGHT * 2000.0), "", (1, 1)),
    ],
)
def test_joints_of_light_blocks_are_as_stiff_as_others_in_their_unit(
    density: tuple[float, ...], top: str, units: tuple[float, ...]
) -> None:
    """Over the mean load, in which only heavy blocks count."""
    line = pile(*density, top=top)
    found, areas = relative_stiffness(line.model, line.contacts, line.load_case), stiffness_areas(line.contacts)
    scaled = line.program.scaling.units * np.ones(len(areas))
    assert found == pytest.approx(shares_in_units(areas, scaled) * scaled**2)
    heavy = density.count(2000.0)
    share = 1.0 if max(units) == min(units) else len(density) / heavy
    assert np.sqrt(np.unique(found)) == pytest.approx(np.unique(np.where(np.array(units) < 1, share, 1.0) * units))
