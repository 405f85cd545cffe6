"""Generator of straight walls; x along the wall, y through it, z up."""

from __future__ import annotations

import numpy as np

from mbla.deck.items.wall import WallItem
from mbla.deck.tree import KeyPath
from mbla.errors import Message
from mbla.model.generators.amounts import Amount, refuse_too_many
from mbla.model.generators.generator import Generated, ItemRefused, Site
from mbla.model.generators.masonry.buttresses import check_buttresses, place_buttress
from mbla.model.generators.masonry.irregular import random_levels
from mbla.model.generators.masonry.leg import Leg
from mbla.model.generators.masonry.openings import check_opening, check_spans, place_opening
from mbla.model.generators.masonry.walls import Wall, amount_of_units, fixed_levels, parts_of, with_gable


def amount_wall(item: WallItem) -> Amount:
    """About how many units such an item has."""
    gables = [] if item.gable is None else [item.gable]
    return amount_of_units(item, item.length, ("length",), gables, item.buttresses)


def generate_wall(item: WallItem, site: Site) -> Generated:
    """Units course by course from the bottom, along +x in each, leaf by leaf; then lintels, arches, buttresses.

    Raises
    ------
    ItemRefused
        for openings off the bed joints, lintels and arches without support, buttresses across openings, too many
        units, or where nothing is left of the wall
    """
    refuse_too_many(amount_wall(item), item)
    findings: list[tuple[KeyPath, Message]] = []
    openings = []
    for number, opening in enumerate(item.openings):
        found = list(check_opening(item, opening, site.tolerance))
        findings += [(("openings", number, *path), message) for path, message in found]
        if not found:
            openings.append(place_opening(item, number, opening))
    buttresses = [place_buttress(item, number, buttress) for number, buttress in enumerate(item.buttresses)]
    findings += check_spans(openings, item.length, item)
    findings += check_buttresses(buttresses, openings, item)
    if findings:
        raise ItemRefused(findings)
    passages = tuple(placed.passage for placed in buttresses if placed.buttress.bonded)
    leg = Leg(
        item=item,
        origin=np.zeros(2),
        along=np.array([1.0, 0.0]),
        length=item.length,
        levels=random_levels(item, fixed_levels(openings, buttresses)),
        level_courses=item.courses,
        voids=tuple(void for opening in openings for void in opening.voids),
        passages=passages,
        fitted=bool(passages),
    )
    return Generated(tuple(parts_of([Wall(with_gable(leg, item.gable), openings, buttresses)], numbered=False)))
