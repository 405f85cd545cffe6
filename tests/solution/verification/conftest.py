"""A block on the ground, with joints of three kinds."""

from __future__ import annotations

import pytest

from tests.line import Line
from tests.solution.by_hand import pushed_block


@pytest.fixture(scope="module")
def dry() -> Line:
    return pushed_block()


@pytest.fixture(scope="module")
def mortar() -> Line:
    """Cohesion 4, tension 2 at each corner."""
    return pushed_block("friction: 0.5, cohesion: 16, tensile_strength: 8")


@pytest.fixture(scope="module")
def weak() -> Line:
    """Strength 16 at each corner, or 64 as a whole."""
    return pushed_block("friction: 0.5, compressive_strength: 64")
