"""Generator of one cuboid along the axes."""

from __future__ import annotations

import numpy as np

from mbla.deck.types import BoxItem
from mbla.model.generators.generator import Generated, ItemRefused, Part, Site
from mbla.model.polyhedra import cuboids


def generate_box(item: BoxItem, site: Site) -> Generated:
    """The cuboid between two corners.

    Raises
    ------
    ItemRefused
        where ``max`` is not greater than ``min``
    """
    findings = [
        (("max", axis), f"must be greater than min, {least:g}")
        for axis, (least, greatest) in enumerate(zip(item.min, item.max, strict=True))
        if not greatest > least
    ]
    if findings:
        raise ItemRefused(findings)
    return Generated((Part(cuboids(np.array([item.min]), np.array([item.max]))),))
