"""Round and vaulted items are the same wherever they stand, however they are turned, and in every unit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.model.blocks.assembly import assemble

ITEMS = {
    "column": "column: {material: stone, radius: 0.5, top_radius: 0.4, height: 4, drums: 3, sides: 12, "
    "base: {side: 1.4, height: 0.3}, capital: {radius: 0.6, height: 0.25}",
    "stack": "stack: {material: stone, block: [1, 0.5, 0.2], count: 3, overhang: 0.9",
    "trilithon": "trilithon: {material: stone, upright: [0.6, 0.5, 3], opening: 1.2, lintel: [2.6, 0.7, 0.4]",
    "dome": "dome: {material: stone, shape: segmental, embrace: 150, span: 4, thickness: 0.3, rings: 4, segments: 8, "
    "drum: {height: 1, courses: 2, thickness: 0.5}",
    "barrel_vault": "barrel_vault: {material: stone, shape: elliptic, rise: 1.5, span: 4, thickness: 0.3, courses: 7, "
    "length: 2, unit: 0.5, springers: blocks",
    "cross_vault": "cross_vault: {material: stone, shape: segmental, rise: 1.2, bay: [4, 5], thickness: 0.25, "
    "courses: 9, unit: 0.6, springers: blocks",
    "pavilion_vault": "pavilion_vault: {material: stone, shape: catenary, rise: 1.2, bay: [4, 5], thickness: 0.25, "
    "courses: 9, unit: 0.6, springers: blocks",
    "spiral_stair": "spiral_stair: {material: stone, treads: 20, inner_radius: 0.3, outer_radius: 1.2, rise: 0.18, "
    "angle: 20, overlap: 4, built_in: 0.2, rebate: 0.05, wall: pocket",
}
MOVES = "[{rotate: {axis: [1, 2, 3], angle: 40}}, {translate: [3000, -7000, 500]}]"


@pytest.mark.every(4)
@pytest.mark.parametrize("kind", list(ITEMS))
@pytest.mark.parametrize(("transform", "scale"), [(MOVES, 1.0), ("{scale: 1000}", 1000.0), ("{scale: 0.001}", 0.001)])
def test_turned_far_away_and_in_other_units(tmp_path: Path, kind: str, transform: str, scale: float) -> None:
    lowest = {"column": "member: base", "stack": "drum: 0", "trilithon": "member: upright", "dome": "course: 0"}
    held = f"{kind}_springers" if kind not in lowest else f"{{group: {kind}, {lowest[kind]}}}"
    supports = f"[{{blocks: {held}}}]" if kind in lowest else "[]"
    here = assemble(tmp_path, ITEMS[kind] + "}", supports=supports)
    there = assemble(tmp_path, f"{ITEMS[kind]}, transform: {transform}}}", supports=supports)
    assert there.model.blocks.volumes == pytest.approx(scale**3 * here.model.blocks.volumes, rel=1e-9)
    assert len(there.contacts) == len(here.contacts)
    # bent blocks share several faces, whose order may change where their normals turn
    assert np.sort(there.contacts.areas) == pytest.approx(scale**2 * np.sort(here.contacts.areas), rel=1e-8)
    assert np.array_equal(there.contacts.bodies, here.contacts.bodies)
