"""Generator of one cuboid along the axes."""

from __future__ import annotations

import numpy as np

from mbla.deck.items.box import BoxItem
from mbla.model.generators.generator import Generated, Part, Site
from mbla.model.solids.polyhedra import cuboids


def generate_box(item: BoxItem, site: Site) -> Generated:
    """The cuboid between two corners."""
    return Generated((Part(cuboids(np.array([item.min]), np.array([item.max]))),))
