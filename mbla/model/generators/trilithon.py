"""Generator of trilithons: two uprights and a lintel."""

from __future__ import annotations

import numpy as np

from mbla.deck.items.trilithon import TrilithonItem
from mbla.model.generators.generator import Generated, Part, Site
from mbla.model.solids.polyhedra import cuboids


def generate_trilithon(item: TrilithonItem, site: Site) -> Generated:
    """Left upright, right upright, lintel."""
    upright, lintel = np.array(item.upright), np.array(item.lintel)
    left = np.array([[0.0, 0.0, 0.0], [upright[0] + item.opening, 0.0, 0.0]])
    middle = np.array([upright[0] + item.opening / 2, upright[1] / 2, upright[2] + lintel[2] / 2])
    least = np.array([middle - lintel / 2])
    least[0, 2] = upright[2]
    return Generated(
        (
            Part(cuboids(left, left + upright), member="upright", labels={"unit": np.arange(2)}),
            Part(cuboids(least, least + lintel), member="lintel"),
        )
    )
