"""The cone program against the static form of the same problem, in its plainest form and solved by HiGHS."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import linprog

from mbla.arrays import FloatArray
from mbla.program.kinematic import kinematic_form
from tests.line import BLOCK, WALL, line_of, load_factor


def planar_static_factor(text: str, *overrides: str) -> float:
    """Max λ by linear programming with friction |T| ≤ μN in the plane of the structure (exact for planar ones)."""
    line = line_of(text, *overrides)
    program, limits = line.program, line.program.limits
    matrix = program.equilibrium_matrix.toarray()
    n = program.n_points
    in_plane = np.abs(line.contacts.frames[:, 1:, 1]) < 0.5  # tangents in the x-z plane
    rows: list[FloatArray] = []
    bounds: list[tuple[float | None, float | None]] = []
    for k in range(n):
        for j in (0, 1):
            sign = np.zeros((2, 3 * n + 1))
            sign[:, 3 * k] = -limits.friction[k]
            if in_plane[k, j]:
                sign[0, 3 * k + 1 + j], sign[1, 3 * k + 1 + j] = 1.0, -1.0
                rows.append(sign)
    for k in range(n):
        bounds.append((0, None))
        bounds += [(None, None) if in_plane[k, j] else (0, 0) for j in (0, 1)]
    result = linprog(
        np.append(np.zeros(3 * n), -1.0),
        A_ub=np.vstack(rows),
        b_ub=np.zeros(2 * len(rows)),
        A_eq=np.column_stack([matrix, program.live_load]),
        b_eq=-program.dead_load,
        bounds=[*bounds, (None, None)],
        method="highs",
    )
    assert result.status == 0, result.message
    return program.scaling.load_factor(-float(result.fun or 0.0))


@pytest.mark.parametrize("mu", [0.2, 0.45, 0.65, 1.2])
@pytest.mark.parametrize("n", [3, 5])
def test_planar_walls_agree_with_the_static_linear_program(mu: float, n: int) -> None:
    overrides = (f"parameters.mu={mu}", f"parameters.n={n}")
    assert load_factor(WALL, *overrides) == pytest.approx(planar_static_factor(WALL, *overrides), rel=1e-6)


def test_dry_points_take_no_multiplier_and_others_do() -> None:
    dry = line_of(BLOCK).program
    form = kinematic_form(dry, dry.limits)
    assert (len(form.cone_program.cost), form.cone_program.n_cones, form.cone_program.n_half_lines) == (6, 4, 0)
    kept = kinematic_form(dry, dry.limits, reduce_dry=False)
    assert (len(kept.cone_program.cost), kept.cone_program.n_cones, kept.cone_program.n_half_lines) == (10, 4, 4)
    smooth = line_of(BLOCK, "parameters.mu=0").program
    form = kinematic_form(smooth, smooth.limits)
    assert (len(form.cone_program.cost), form.cone_program.n_cones, form.cone_program.n_half_lines) == (6, 0, 4)
    weak = line_of(BLOCK, "joints.dry.compressive_strength=1e5").program
    form = kinematic_form(weak, weak.limits)
    assert (len(form.cone_program.cost), form.cone_program.n_cones, form.cone_program.n_half_lines) == (14, 4, 8)
