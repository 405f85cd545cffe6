import numpy as np
import pytest

from mbla.model.solids.measures import volumes_and_centroids
from tests.model.shapes import L_OUTLINE, TETRAHEDRON, box, build, hull, moved, prism, raw, rotation


def test_tetrahedron() -> None:
    volumes, centroids = volumes_and_centroids(raw(TETRAHEDRON))
    assert volumes == pytest.approx([1 / 6], rel=1e-15)
    assert centroids == pytest.approx(np.full((1, 3), 0.25), rel=1e-15)


def test_non_convex_prism() -> None:
    volumes, centroids = volumes_and_centroids(raw(prism(L_OUTLINE, 4.0)))
    assert volumes == pytest.approx([12.0], rel=1e-15)
    assert centroids == pytest.approx(np.array([[5 / 6, 5 / 6, 2.0]]), rel=1e-15)


def test_pyramid_centroid_is_a_quarter_up() -> None:
    shape = (
        [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 3]],
        [[0, 3, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
    )
    volumes, centroids = volumes_and_centroids(raw(shape))
    assert volumes == pytest.approx([4.0])
    assert centroids == pytest.approx(np.array([[1, 1, 0.75]]))


def test_inward_faces_give_a_negative_volume() -> None:
    vertices, faces = box()
    volumes, _ = volumes_and_centroids(raw((vertices, [face[::-1] for face in faces])))
    assert volumes == pytest.approx([-1.0])


@pytest.mark.parametrize("seed", range(5))
def test_random_hulls_against_scipy(seed: int) -> None:
    shape, volume = hull(seed)
    built = build(shape)
    assert not built.defects
    assert built.blocks.volumes == pytest.approx([volume], rel=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_rotation_changes_neither_volume_nor_relative_centroid(seed: int) -> None:
    shape, turn = prism(L_OUTLINE), rotation(seed)
    before, after = build(shape).blocks, build(moved(shape, turn, (3, -4, 5))).blocks
    assert after.volumes == pytest.approx(before.volumes, rel=1e-13)
    assert after.centroids == pytest.approx(before.centroids @ turn.T + [3, -4, 5], rel=1e-13)


def test_far_from_the_origin_nothing_is_lost() -> None:
    # 1e6 and 2^-20 steps beside it are exact in binary, so that only the computation could lose digits
    step = 2.0**-20
    shape = moved(prism(L_OUTLINE), step * np.eye(3), (1e6, -1e6, 1e6))
    volumes, centroids = volumes_and_centroids(raw(shape))
    assert volumes / step**3 == pytest.approx([3.0], rel=1e-14)
    assert (centroids - [1e6, -1e6, 1e6]) / step == pytest.approx(np.array([[5 / 6, 5 / 6, 0.5]]), abs=2e-4)


def test_volume_of_a_bent_face_does_not_depend_on_its_first_corner() -> None:
    vertices, faces = box()
    vertices = [*vertices[:6], [1.0, 1.0, 1.0005], vertices[7]]
    turned = [[*face[2:], *face[:2]] for face in faces]
    shifted = [[*face[1:], *face[:1]] for face in faces]
    volumes, _ = volumes_and_centroids(raw((vertices, faces), (vertices, turned), (vertices, shifted)))
    assert volumes[1:] == pytest.approx([volumes[0]] * 2, rel=1e-15)


def test_blocks_are_measured_independently_of_each_other() -> None:
    shapes = [box(), prism(L_OUTLINE), TETRAHEDRON, hull(1)[0]]
    together = build(*shapes).blocks
    alone = [build(shape).blocks.volumes[0] for shape in shapes]
    assert together.volumes == pytest.approx(alone, rel=1e-15)
