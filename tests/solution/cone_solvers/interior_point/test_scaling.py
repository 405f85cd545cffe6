"""The scaling of Nesterov and Todd: W z = W⁻¹ s, near the border and away from it."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.interior_point.cones import ConeProduct, Scaling
from tests.solution.cone_solvers.interior_point.vectors import inside, vector_of

quick = settings(max_examples=40, derandomize=True)
seeds = st.integers(0, 2**32 - 1)
products = st.builds(ConeProduct, st.integers(0, 6), st.integers(0, 6)).filter(lambda product: product.degree > 0)
distances = st.sampled_from([1.0, 1e-2, 1e-5, 1e-10])


def dense(scaling: Scaling) -> FloatArray:
    """W as a matrix."""
    identity = np.eye(scaling.product.size)
    return np.column_stack([scaling.times(column) for column in identity])


@quick
@given(seed=seeds, product=products, one=distances, other=distances)
def test_primal_and_dual_look_alike_from_the_middle(seed: int, product: ConeProduct, one: float, other: float) -> None:
    """To rounding times the condition of W, which is that of s and z to the power of a half."""
    rng = np.random.default_rng(seed)
    s, z = inside(rng, product, one), inside(rng, product, other)
    scaling = Scaling.of(product, s, z)
    middle = scaling.times(z)
    spread = 1e-15 / min(one, other)
    np.testing.assert_allclose(scaling.inverse(s), middle, rtol=0.0, atol=10 * spread * np.abs(middle).max() + 1e-13)
    assert product.least_eigenvalue(middle) > 0.0
    np.testing.assert_allclose(middle @ middle, s @ z, rtol=100 * spread + 1e-12)


@quick
@given(seed=seeds, product=products, one=distances, other=distances)
def test_times_and_inverse_undo_each_other(seed: int, product: ConeProduct, one: float, other: float) -> None:
    rng = np.random.default_rng(seed)
    scaling = Scaling.of(product, inside(rng, product, one), inside(rng, product, other))
    v = vector_of(rng, product)
    size = float(np.linalg.norm(dense(scaling), 2))
    stretched = max(size, 1.0) * 1e-13 / min(one, other)
    np.testing.assert_allclose(scaling.inverse(scaling.times(v)), v, atol=stretched)
    np.testing.assert_allclose(scaling.times(scaling.inverse(v)), v, atol=stretched)


@quick
@given(seed=seeds, product=products, one=distances, other=distances)
def test_it_is_symmetric_and_keeps_the_cones(seed: int, product: ConeProduct, one: float, other: float) -> None:
    rng = np.random.default_rng(seed)
    scaling = Scaling.of(product, inside(rng, product, one), inside(rng, product, other))
    matrix = dense(scaling)
    np.testing.assert_allclose(matrix, matrix.T, rtol=0.0, atol=1e-14 * np.abs(matrix).max())
    assert np.linalg.eigvalsh(matrix).min() > -1e-14 * np.abs(matrix).max()
    within = scaling.times(inside(rng, product, 0.1))
    assert product.least_eigenvalue(within) > 0.0


@quick
@given(seed=seeds, product=products)
def test_of_equal_vectors_it_is_none(seed: int, product: ConeProduct) -> None:
    rng = np.random.default_rng(seed)
    s, v = inside(rng, product, 0.3), vector_of(rng, product)
    np.testing.assert_allclose(Scaling.of(product, s, s).times(v), v, atol=1e-12)
    np.testing.assert_array_equal(Scaling.identity(product).times(v), v)


@quick
@given(seed=seeds, product=products, factor=st.sampled_from([1e-16, 1e-4, 1e4, 1e16]))
def test_it_is_one_of_the_sizes_of_both(seed: int, product: ConeProduct, factor: float) -> None:
    rng = np.random.default_rng(seed)
    s, z, v = inside(rng, product, 0.1), inside(rng, product, 0.1), vector_of(rng, product)
    grown = Scaling.of(product, factor * s, z / factor).times(v)
    np.testing.assert_allclose(grown, factor * Scaling.of(product, s, z).times(v), rtol=1e-9, atol=1e-11 * factor)
