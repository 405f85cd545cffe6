"""The static form of the convex model allows, at given limits of friction, the forces that its formulas allow."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.deck.sections.analysis import AnalysisSection
from mbla.program.kinematic import ConeProgram
from mbla.program.resultants.assemble import ConvexProgram, assemble_convex
from mbla.program.resultants.conditions import MN, T1, T2
from mbla.program.resultants.crushing import crushing_violation
from mbla.program.resultants.friction_limit import curve_size
from mbla.program.resultants.shapes import local_points
from mbla.program.resultants.static import ConvexStaticForm, given_friction_form
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.settings import solver_settings
from tests.program.resultants.test_shapes import PRISM, prism_line

SETTINGS = solver_settings(AnalysisSection())
OUTLINES: dict[str, tuple[tuple[float, float], ...]] = {
    "rectangle": ((0, 0), (1.25, 0), (1.25, 0.75), (0, 0.75)),
    "triangle": ((0, 0), (1.0, 0), (0.25, 0.75)),
    "ell": ((0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)),
}
STRENGTH = "compressive_strength: 2.e5"


def convex_program(name: str, law: str) -> ConvexProgram:
    """One block on the ground."""
    line = prism_line(OUTLINES[name], f"joints.dry={{{law}}}")
    return assemble_convex(line.model, line.contacts, line.load_case, "convex")


def room(form: ConvexStaticForm, rhs: FloatArray, forces: FloatArray) -> float:
    """How far inside of all cones the best helping unknowns bring the forces; below zero where none do."""
    program = form.cone_program
    first, n = program.n_equations, form.convex.points.n_points * 3
    left = rhs[first:] - program.matrix[first:, :n] @ forces.ravel()
    sizes = [1] * program.n_half_lines + [3] * program.n_cones + list(program.further_cones)
    heads = np.zeros(len(left))
    heads[np.cumsum(sizes) - sizes] = 1.0
    helpers = program.matrix[first:, n:-1]
    tail = np.flatnonzero(np.repeat(np.array(sizes) == 1, sizes))
    order = np.concatenate([tail, np.flatnonzero(np.repeat(np.array(sizes) > 1, sizes))])
    search = ConeProgram(
        cost=np.append(np.zeros(helpers.shape[1]), -1.0),
        matrix=sp.csc_array(sp.csr_array(sp.hstack([helpers, sp.csr_array(heads[:, None])]))[order]),
        rhs=left[order],
        n_half_lines=len(tail),
        n_cones=0,
        n_equations=0,
        further_cones=tuple(size for size in sizes if size > 1),
    )
    return float(ClarabelProgram(search, SETTINGS, lambda *_: None).solve(1, 1.0).x[-1])


def allowed(
    convex: ConvexProgram, forces: FloatArray, limit: FloatArray, share: FloatArray, rest: FloatArray
) -> FloatArray:
    """What each condition leaves, by the formulas; below zero where it is broken."""
    law, r = convex.points.limits, convex.resultants_of(forces)
    left = [forces[:, 0] + law.tension, law.compression - forces[:, 0], limit - np.linalg.norm(forces[:, 1:], axis=1)]
    if len(share):
        of_torsion = r[convex.torsion.interfaces]
        beyond = np.maximum(np.hypot(of_torsion[:, T1], of_torsion[:, T2]) - rest, 0.0)
        twist = np.abs(of_torsion[:, MN]) / convex.torsion.radii
        left.append(share - curve_size(beyond, twist, convex.torsion.thetas))
    left.append(-crushing_violation(convex.crushing, r))
    return np.concatenate(left)


@pytest.mark.parametrize("name", OUTLINES)
@pytest.mark.parametrize(
    "law",
    [
        "friction: 0.5",
        f"friction: 0.5, {STRENGTH}",
        f"friction: 0.5, cohesion: 20000, tensile_strength: 10000, {STRENGTH}",
        f"friction: 0, {STRENGTH}",
    ],
    ids=["dry", "crushes", "mortar", "slippery"],
)
def test_forces_at_given_limits(name: str, law: str) -> None:
    convex = convex_program(name, law)
    form = given_friction_form(convex)
    draw, seen = np.random.default_rng(1), []
    n, n_torsion = convex.points.n_points, len(convex.torsion.interfaces)
    for _ in range(60):
        forces = draw.normal(scale=0.3, size=(n, 3))
        forces[:, 0] = draw.uniform(-0.1, 1.0 if draw.random() < 0.5 else 4.0, n)
        limit = draw.uniform(0.25, 2.0, n)
        share, rest = draw.uniform(0.05, 2.0, n_torsion), draw.uniform(0.0, 1.0, n_torsion)
        if draw.random() < 0.5:
            forces[:, 0] = np.abs(forces[:, 0])
            forces[:, 1:] *= 0.2
        if name == "ell" and draw.random() < 0.5:  # four triangles at once: next to even pressure on each
            pressed = np.bincount(convex.interface_of_point, minlength=convex.n_interfaces)
            even = dict(zip(convex.crushing.interfaces.tolist(), convex.crushing.strength, strict=True))
            near = np.array([0.3 * even.get(row, 1.0) / pressed[row] for row in convex.interface_of_point.tolist()])
            forces[:, 0] = near * draw.uniform(0.9, 1.1, n)
            forces[:, 1:] *= 0.01
        rhs = form.rhs_for(limit, share, rest)
        left = allowed(convex, forces, limit, share, rest)
        if np.abs(left).min() > 1e-4:
            good = bool((left > 0).all())
            assert (room(form, rhs, forces) > 0) == good, left
            seen.append(good)
    assert set(seen) == {False, True}
    assert len(seen) > 40


def test_each_of_two_rectangles_has_bounds_of_its_own() -> None:
    """Two like blocks: the one that is pressed a quarter of a side off its middle bears half of its strength."""
    text = PRISM.replace(
        "blocks:\n", "blocks:\n  - box: {group: two, material: stone, min: [5, 0, 0], max: [6.25, 0.75, 1]}\n"
    )
    line = prism_line(OUTLINES["rectangle"], f"joints.dry={{friction: 0.5, {STRENGTH}}}", text=text)
    convex = assemble_convex(line.model, line.contacts, line.load_case, "convex")
    form = given_friction_form(convex)
    strength = float(convex.crushing.strength[0])
    ones = np.ones(2)
    rhs = form.rhs_for(np.ones(8), ones, ones)
    arms = local_points(line.contacts).reshape(2, 4, 2)
    for pressed, axis, way in itertools.product((0, 1), (0, 1), (1.0, -1.0)):
        for share, held in ((0.45, True), (0.55, False)):
            forces = np.zeros((2, 4, 3))
            forces[:, :, 0] = share * strength / 4
            forces[pressed, :, 0] *= 1.0 + 0.5 * np.sign(way * arms[pressed, :, axis])
            assert (room(form, rhs, forces.reshape(8, 3)) > 0) == held
