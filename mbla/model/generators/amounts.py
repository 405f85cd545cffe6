"""How many blocks an item may ask for: an error in the units of length asks for far more than is meant."""

from __future__ import annotations

import math

from mbla.deck.items.arch import ArchItem, Backing
from mbla.deck.items.bridge import BridgeItem
from mbla.deck.items.column import ColumnItem
from mbla.deck.items.cuboids import StackItem
from mbla.deck.items.dome import DomeItem
from mbla.deck.items.item import Item, Repetition
from mbla.deck.items.spiral_stair import SpiralStairItem
from mbla.deck.items.vaults import BarrelVaultItem, CrossVaultItem, PavilionVaultItem
from mbla.deck.items.walls import WallItem, WallsItem, plan_lines
from mbla.deck.sections.ties import TieSection

MOST = 2_000_000
"""units, or facets of round blocks, that all items together may make: some GB of memory"""


def amount_of(item: Item) -> tuple[float, str]:
    """About how many units one copy of an item makes, known before it is made, and the key that matters most.

    Where blocks have many facets each of these counts; an item that cannot ask for much counts as one unit.
    """
    match item:
        case ArchItem():
            courses = 2 * item.piers.courses if item.piers else 0
            carrying = item.voussoirs * item.rings * item.units_across + courses
            return _with_backing(item.backing, carrying, "voussoirs", item.thickness + (item.span or 0.0))
        case BridgeItem():
            return _of_bridge(item)
        case BarrelVaultItem():
            along = item.length / item.unit
            amount, key = _with_backing(item.backing, item.courses, "length", item.span + item.thickness)
            return amount * along, key
        case CrossVaultItem():
            edge = item.edge or 2 * item.thickness * max(1.0, item.bay[1] / item.bay[0])
            return item.courses * (sum(item.bay) + 4 * edge) / item.unit, "unit"
        case PavilionVaultItem():
            return item.courses * sum(item.bay) / item.unit, "unit"
        case ColumnItem():
            return (len(item.drum_heights or ()) + (item.drums or 0)) * item.sides, "sides"
        case StackItem():
            return item.count, "count"
        case DomeItem():
            rings = item.rings + (item.drum.courses if item.drum else 0)
            return rings * item.segments * (item.facets or 2), "segments"
        case SpiralStairItem():
            return item.treads * (item.facets + 2), "facets"
        case WallItem():
            return _of_walls(item, item.length, item.gable.rise if item.gable else 0.0), "length"
        case WallsItem():
            length = sum(math.dist(start, end) for _, start, end in plan_lines(item))
            return _of_walls(item, length, max((gable.rise for gable in item.gables), default=0.0)), "plan"
    return 1.0, ""


def _of_walls(item: WallItem | WallsItem, length: float, gable: float) -> float:
    """Units of walls of some length together, the highest gable a rise above them."""
    unit, width, height = item.unit
    along = item.leaves * max(length / min(unit, width if item.leaves > 1 else unit), 1.0)
    across = sum(max((buttress.depth + item.leaves * width) / unit, 1.0) for buttress in item.buttresses)
    return (item.courses + gable / height) * (along + across)


def _with_backing(backing: Backing | None, carrying: float, key: str, length: float) -> tuple[float, str]:
    """Units with those of haunches on both sides of an arch, which are no longer than it and their width."""
    if backing is None or not math.isfinite(length + backing.top):
        return carrying, key
    along = max((length + 2 * (backing.width or 0.0)) / backing.unit[0], 1.0)
    filling = along * max(backing.top / backing.unit[1], 1.0)
    return carrying + filling, "backing" if filling > carrying else key


def _of_bridge(item: BridgeItem) -> tuple[float, str]:
    """Units of arches, piers and spandrels; of these none where lengths are beyond what a double holds."""
    n_spans = len(item.spans)
    voussoirs = sum(item.voussoirs) if isinstance(item.voussoirs, list) else item.voussoirs * n_spans
    piers = (item.piers.courses if item.piers else 0) * (n_spans - 1) + 2 * (item.abutments.courses or 0)
    carrying = voussoirs * item.rings + piers
    if item.unit is None or item.cover is None:
        return carrying, "voussoirs"
    rises = item.rise if isinstance(item.rise, list) else [item.rise or max(item.spans) / 2]
    top = max(rises) + item.thickness + item.cover
    length = sum(item.spans) + (item.piers.width if item.piers else 0.0) * (n_spans - 1) + 2 * item.abutments.width
    if not math.isfinite(length + top):
        return carrying, "voussoirs"  # which are refused
    filling = max(length / item.unit[0], 1.0) * max(top / item.unit[1], 1.0)
    return carrying + filling, "unit" if filling > carrying else "voussoirs"


def copies_of(item: Item | TieSection) -> int:
    """How often an item or a tie is there, itself included."""
    steps = [item.repeat] if isinstance(item.repeat, Repetition) else item.repeat
    return math.prod(step.count for step in steps)


MOST_TIES = 200_000
"""lines of ties that all ties together may lay out: as much memory as many blocks take"""


def lines_of(tie: TieSection) -> int:
    """How many lines a tie and its copies lay out; a strip, which has one at each joint, at least one a stretch."""
    points = tie.through or tie.strip or []
    own = len(tie.ring.z) if tie.ring else 1 if tie.through and tie.points == "passes" else len(points)
    return copies_of(tie) * own


def too_many(units: float) -> str:
    """Message on an item, or all of them, that makes more than can be handled."""
    return f"about {min(units, 1e300):.0e} units; at most {MOST:,} can be handled"
