"""Two blocks that share a warped face, split alike: one slides on the other along the fold.

The face is folded along its shorter diagonal, of length 2 a, and falls off to both sides with the slope s. On the ridge
stands a block of weight W that presses each side with W/(2 cos θ), tan θ = s: pushed along the ridge it slides at
μ/cos θ = μ √(1 + s²).
"""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import FloatArray
from tests.line import HEAD, factor_of, line_of

MU, SLOPE = 0.4, 0.3
RIDGE = np.array([[-0.8, 0, 0], [0, -1, -SLOPE], [0.8, 0, 0], [0, 1, -SLOPE]])
"""A quadrilateral with the diagonals 1.6, which is the ridge, and 2."""
SADDLE = np.array([[-1, -0.7, 0.1], [1, -0.7, -0.1], [1, 0.7, 0.1], [-1, 0.7, -0.1]])
"""Its diagonals are equally long."""
AS_IT_IS = np.eye(3)
FACES = "[[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]"


def turned(angle: float) -> FloatArray:
    """A rotation about z."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def deck(
    face: FloatArray,
    push: tuple[float, float],
    turn: FloatArray = AS_IT_IS,
    first: int = 0,
    *,
    swapped: bool = False,
    wider: float = 1.0,
) -> str:
    """A block on a fixed one, with the face between them; the corners of the upper one begin at another.

    wider : base of the fixed block over the face
    """
    low, high = (np.column_stack([k * face[:, :2], np.full(4, z)]) for k, z in ((wider, -wider), (1.0, 0.6)))
    order = np.roll(np.arange(4), first)
    blocks = {"lower": np.vstack([low, face]), "upper": np.vstack([face[order], high[order]])}
    items = [
        f"  - polyhedron: {{group: {name}, material: stone, vertices: {(corners @ turn.T).tolist()}, faces: {FACES}}}"
        for name, corners in blocks.items()
    ]
    direction = (turn @ [*push, 0.0] / np.cbrt(abs(np.linalg.det(turn)))).tolist()
    return (
        HEAD
        + f"joints: {{dry: {{friction: {MU}}}}}\nblocks:\n"
        + "\n".join(items[::-1] if swapped else items)
        + f"\nsupports: [{{blocks: lower}}]\nload_cases: {{push: {{live: [{{acceleration: {direction}}}]}}}}\n"
    )


def test_a_block_slides_along_the_fold() -> None:
    assert factor_of(deck(RIDGE, (1, 0))) == pytest.approx(MU * np.sqrt(1 + SLOPE**2), rel=1e-4)


MIRROR = np.diag([1.0, -1.0, 1.0])


@pytest.mark.long
@pytest.mark.parametrize("face", [RIDGE, SADDLE], ids=["a shorter diagonal", "equal diagonals"])
def test_no_position_and_no_order_of_corners_or_blocks_decides(face: FloatArray) -> None:
    one = factor_of(deck(face, (1, 0.3)))
    for number, (turn, first, swapped) in enumerate(
        ((turned(0.7), 0, False), (turned(2.2), 3, True), (100 * turned(-1.0), 2, False), (MIRROR, 1, True))
    ):
        assert factor_of(deck(face, (1, 0.3), turn, first, swapped=swapped)) == pytest.approx(one, rel=1e-4), number


@pytest.mark.parametrize("face", [RIDGE, SADDLE], ids=["a shorter diagonal", "equal diagonals"])
def test_what_one_block_loses_the_other_gains(face: FloatArray) -> None:
    blocks = line_of(deck(face, (1, 0))).model.blocks
    (x1, y1, _), (x2, y2, _) = face[2] - face[0], face[3] - face[1]
    assert blocks.volumes.sum() == pytest.approx(1.6 * abs(x1 * y2 - y1 * x2) / 2, rel=1e-12)


def test_a_large_block_is_split_as_its_small_neighbour_is() -> None:
    """The face leaves its plane by 0.2 % of the size of the small block, and by 0.02 % of that of the large one."""
    line = line_of(deck(SADDLE * [1, 1, 0.02], (1, 0), wider=20.0))
    sizes, deviations = line.model.blocks.sizes, line.model.bent.deviations
    assert (deviations / sizes < 1e-3).tolist() == [True, False]
    assert line.model.bent.twins.tolist() == [1, 0]
    assert len(line.contacts) == 4
