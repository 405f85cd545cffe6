"""The size of a program with conditions on interfaces."""

from __future__ import annotations

import pytest

from mbla.program.resultants.assemble import assemble_convex, size_of_convex
from tests.line import BLOCK, WALL, line_of


@pytest.mark.parametrize(
    ("text", "strength", "of_each"),
    [(WALL, (), (8, 2)), (BLOCK, (), (8, 2)), (BLOCK, ("joints.dry.compressive_strength=1e6",), (8 + 34, 2 + 10))],
    ids=["wall", "block", "block that can crush"],
)
def test_every_interface_adds_the_unknowns_and_cones_of_its_conditions(
    text: str, strength: tuple[str, ...], of_each: tuple[int, int]
) -> None:
    """Torsion: 8 unknowns, 2 cones.

    Crushing of a rectangle: at its corners, and of what is left of full stress, 5 unknowns and one for each of 4
    bounds, 3 cones; 4 of each of 4 edges, one cone.
    """
    line = line_of(text, *strength)
    size = size_of_convex(assemble_convex(line.model, line.contacts, line.load_case, "convex"))
    n_free, n_points, n = len(line.model.free), len(line.contacts.points), len(line.contacts)
    assert size.unknowns == size.largest == 6 * n_free + of_each[0] * n
    assert size.cones == n_points + of_each[1] * n
    assert size.entries > line.program.equilibrium_matrix.nnz
