"""The algebra of the cones, for random vectors and for such that are almost on the border."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.interior_point.cones import ConeProduct, NesterovToddScaling, determinant
from tests.solution.cone_solvers.interior_point.programs import inside, program_order, vector_of

quick = settings(max_examples=40, derandomize=True)
seeds = st.integers(0, 2**32 - 1)
products = st.builds(ConeProduct, st.integers(0, 6), st.integers(0, 6)).filter(lambda product: product.degree > 0)
distances = st.sampled_from([1.0, 1e-3, 1e-8, 1e-12])
scaled = st.sampled_from([1.0, 1e-2, 1e-5, 1e-10])


@quick
@given(seed=seeds, product=products)
def test_the_product_is_commutative_and_that_of_the_definition(seed: int, product: ConeProduct) -> None:
    rng = np.random.default_rng(seed)
    u, v = vector_of(rng, product), vector_of(rng, product)
    found = product.product(u, v)
    np.testing.assert_array_equal(found, product.product(v, u))
    lines, order = product.n_lines, program_order(product)
    np.testing.assert_allclose(found[:lines], u[:lines] * v[:lines])
    one_by_one = zip(*(w[order][lines:].reshape(-1, 3) for w in (u, v, found)), strict=True)
    for a, b, product_of_both in one_by_one:
        np.testing.assert_allclose(product_of_both, [a @ b, *(a[0] * b[1:] + b[0] * a[1:])], atol=1e-14)


@quick
@given(seed=seeds, product=products, distance=distances)
def test_the_quotient_is_the_inverse_of_the_product(seed: int, product: ConeProduct, distance: float) -> None:
    """Near the border the divisor's own condition, the inverse of the distance, is all that is lost."""
    rng = np.random.default_rng(seed)
    divisor, v = inside(rng, product, distance), vector_of(rng, product)
    back = product.product(divisor, product.quotient(divisor, v))
    np.testing.assert_allclose(back, v, atol=1e-14 * max(1.0, 10.0 / distance))
    again = product.quotient(divisor, product.product(divisor, v))
    np.testing.assert_allclose(again, v, atol=1e-13 / distance)


@quick
@given(seed=seeds, distance=distances)
def test_the_determinant_keeps_its_digits_next_to_the_border(seed: int, distance: float) -> None:
    """The plain formula has none left from a distance of 1e-16 on, and eight at 1e-8."""
    rng = np.random.default_rng(seed)
    tail, head = 1.0, 1.0 + distance * rng.uniform(1.0, 3.0)
    room = head - tail  # as double precision has it
    angle = rng.uniform(0.0, 2.0 * np.pi)
    cone = np.array([[head], [tail * np.cos(angle)], [tail * np.sin(angle)]])
    assert determinant(cone)[0] == pytest.approx(room * (2.0 + room), rel=1e-15 / distance + 1e-12)
    on_axis = np.array([[head], [tail], [0.0]])
    assert determinant(on_axis)[0] == pytest.approx(room * (2.0 + room), rel=1e-15)


@quick
@given(seed=seeds, product=products)
def test_the_least_eigenvalue_is_how_far_the_identity_can_be_taken_away(seed: int, product: ConeProduct) -> None:
    v = vector_of(np.random.default_rng(seed), product)
    least = product.least_eigenvalue(v)
    shifted = v - least * product.identity()
    assert product.least_eigenvalue(shifted) == pytest.approx(0.0, abs=1e-14)


@quick
@given(seed=seeds, product=products, distance=st.sampled_from([1.0, 1e-3, 1e-6]))
def test_the_longest_step_ends_on_the_border(seed: int, product: ConeProduct, distance: float) -> None:
    rng = np.random.default_rng(seed)
    here, step = inside(rng, product, distance), vector_of(rng, product)
    longest = product.step_to_boundary(here, step)
    if not np.isfinite(longest):  # the direction itself is in the cones
        assert product.least_eigenvalue(step) >= -1e-12
        return
    there = here + longest * step
    size = np.abs(here).max() + longest * np.abs(step).max()
    assert abs(product.least_eigenvalue(there)) <= 1e-9 * size
    short = here + 0.99 * longest * step
    assert product.least_eigenvalue(short) > 0.0


@quick
@given(seed=seeds, exponent=st.integers(9, 14))
def test_the_longest_step_next_to_the_border_has_the_sign_of_the_direction(seed: int, exponent: int) -> None:
    """From 1e-9 ... 1e-14 inside: straight out as far as the distance, along the ray without end."""
    rng = np.random.default_rng(seed)
    angle, distance = rng.uniform(0.0, 2.0 * np.pi), 10.0**-exponent
    product = ConeProduct(0, 1)
    here = np.array([1.0 + distance, np.cos(angle), np.sin(angle)])
    room = here[0] - np.hypot(here[1], here[2])
    assert product.step_to_boundary(here, np.array([-1.0, 0.0, 0.0])) == pytest.approx(room, rel=1e-6)
    assert product.step_to_boundary(here, here) == np.inf
    lost = np.sqrt(1e-15 / room)  # of B² − A D, where B and its rounding are as small as D
    assert product.step_to_boundary(here, -here) == pytest.approx(1.0, rel=lost)
    across = np.array([0.0, -np.sin(angle), np.cos(angle)])
    reach = np.sqrt(room * (2.0 + room))
    assert product.step_to_boundary(here, across) == pytest.approx(reach, rel=1e-6)


@quick
@given(seed=seeds, product=products)
def test_clipping_bounds_the_eigenvalues_and_leaves_those_within(seed: int, product: ConeProduct) -> None:
    v = 3.0 * vector_of(np.random.default_rng(seed), product)
    clipped = product.clipped(v, 0.5, 2.0)
    assert product.least_eigenvalue(clipped) >= 0.5 - 1e-14
    assert product.least_eigenvalue(2.0 * product.identity() - clipped) >= -1e-14
    np.testing.assert_allclose(product.clipped(clipped, 0.5, 2.0), clipped, atol=1e-14)


# --- The scaling of Nesterov and Todd: W z = W⁻¹ s, near the border and away from it ---------------------------------


def dense(scaling: NesterovToddScaling) -> FloatArray:
    """W as a matrix."""
    identity = np.eye(scaling.product.size)
    return np.column_stack([scaling.times(column) for column in identity])


@quick
@given(seed=seeds, product=products, one=scaled, other=scaled)
def test_primal_and_dual_look_alike_from_the_middle(seed: int, product: ConeProduct, one: float, other: float) -> None:
    """To rounding times the condition of W, which is that of s and z to the power of a half."""
    rng = np.random.default_rng(seed)
    s, z = inside(rng, product, one), inside(rng, product, other)
    scaling = NesterovToddScaling.of(product, s, z)
    middle = scaling.times(z)
    spread = 1e-15 / min(one, other)
    np.testing.assert_allclose(scaling.inverse(s), middle, rtol=0.0, atol=10 * spread * np.abs(middle).max() + 1e-13)
    assert product.least_eigenvalue(middle) > 0.0
    np.testing.assert_allclose(middle @ middle, s @ z, rtol=100 * spread + 1e-12)


@quick
@given(seed=seeds, product=products, one=scaled, other=scaled)
def test_times_and_inverse_undo_each_other(seed: int, product: ConeProduct, one: float, other: float) -> None:
    rng = np.random.default_rng(seed)
    scaling = NesterovToddScaling.of(product, inside(rng, product, one), inside(rng, product, other))
    v = vector_of(rng, product)
    size = float(np.linalg.norm(dense(scaling), 2))
    stretched = max(size, 1.0) * 1e-13 / min(one, other)
    np.testing.assert_allclose(scaling.inverse(scaling.times(v)), v, atol=stretched)
    np.testing.assert_allclose(scaling.times(scaling.inverse(v)), v, atol=stretched)


@quick
@given(seed=seeds, product=products, one=scaled, other=scaled)
def test_it_is_symmetric_and_keeps_the_cones(seed: int, product: ConeProduct, one: float, other: float) -> None:
    rng = np.random.default_rng(seed)
    scaling = NesterovToddScaling.of(product, inside(rng, product, one), inside(rng, product, other))
    matrix = dense(scaling)
    np.testing.assert_allclose(matrix, matrix.T, rtol=0.0, atol=1e-14 * np.abs(matrix).max())
    assert np.linalg.eigvalsh(matrix).min() > -1e-14 * np.abs(matrix).max()
    within = scaling.times(inside(rng, product, 0.1))
    assert product.least_eigenvalue(within) > 0.0
