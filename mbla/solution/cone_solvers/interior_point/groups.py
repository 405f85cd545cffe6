"""Members of many small groups as arrays, and triangular factors of as many small matrices, one operation for all."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray


def by_group(members: IntArray, group: IntArray, n_groups: int) -> tuple[IntArray, IntArray]:
    """Members of all groups, one after the other, and where each starts."""
    here = group >= 0
    order = np.argsort(group[here], kind="stable")
    counts = np.bincount(group[here], minlength=n_groups)
    return members[here][order], np.concatenate([[0], np.cumsum(counts)])


def taken(part: tuple[IntArray, IntArray], groups: IntArray) -> IntArray:
    """(n_groups, as many as each has)."""
    members, pointers = part
    count = int(pointers[groups[0] + 1] - pointers[groups[0]])
    return np.asarray(members[pointers[groups][:, None] + np.arange(count)])


def triangular_factor(x: FloatArray) -> FloatArray:
    """R of x = U R by modified Gram–Schmidt, (g, g, n), from x (rows, g, n), which is overwritten."""
    g = x.shape[1]
    r = np.zeros((g, g, x.shape[2]))
    for i in range(g):
        r[i, i] = np.sqrt(np.einsum("rn,rn->n", x[:, i], x[:, i]))
        x[:, i] /= r[i, i]
        for j in range(i + 1, g):
            r[i, j] = np.einsum("rn,rn->n", x[:, i], x[:, j])
            x[:, j] -= r[i, j] * x[:, i]
    return r


def forward(r: FloatArray, rhs: FloatArray) -> FloatArray:
    """R⁻ᵀ rhs, (g, n, k)."""
    result = np.empty_like(rhs)
    for i in range(len(r)):
        result[i] = rhs[i]
        for j in range(i):
            result[i] -= r[j, i][:, None] * result[j]
        result[i] /= r[i, i][:, None]
    return result


def backward(r: FloatArray, rhs: FloatArray) -> FloatArray:
    """R⁻¹ rhs, (g, n, k)."""
    result = np.empty_like(rhs)
    for i in reversed(range(len(r))):
        result[i] = rhs[i]
        for j in range(i + 1, len(r)):
            result[i] -= r[i, j][:, None] * result[j]
        result[i] /= r[i, i][:, None]
    return result
