"""Where a vertical or other force that stands above the structure lands: on the block under it, on those under the line
over which it is shared, or through fill on all blocks that it spreads to.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray, IntArray, summed
from mbla.deck.units import Units
from mbla.errors import Finding, KeyPath, Notice
from mbla.model.applied_load import sum_on_blocks, wrenches_of
from mbla.model.fill.dispersal import Spread, beside, emerging, spread
from mbla.model.fill.fill import FillBody
from mbla.model.loads.blocks_under import Below
from mbla.model.loads.load_kind import LoadSite
from mbla.model.wording import named, vector

PARALLEL = 1e-6
"""sine of the angle between a line and the direction to its blocks, up to which they are parallel"""
UPRIGHT = 1e-9
"""horizontal component relative to a force, a line or a path, up to which it is none"""
NEAR = 1e-3
"""share of the size of a block that a load may stand beside the fill, or a block rise out of it under the load"""
GAUSS = 0.5 / 3**0.5
"""of the side of a contact, from its middle to the two places that stand for it: its second moment is theirs"""


@dataclass(frozen=True)
class Tread:
    """How an axle stands: on a line across, at a point, or on two wheels.

    width   : of the line; 0 for none
    gauge   : distance of two wheels across; 0 for none
    contact : sides, along and across, of the rectangle under each wheel; 0 for a point
    """

    width: float = 0.0
    gauge: float = 0.0
    contact: tuple[float, float] = (0.0, 0.0)

    def words(self, units: Units) -> str:
        """Of its wheels, for the listing."""
        return f" on wheels {self.gauge:.6g} {units.length} apart" if self.gauge > 0.0 else ""


def on_blocks(landed: Sequence[Spread], forces: FloatArray, site: LoadSite) -> tuple[IntArray, FloatArray]:
    """Blocks, each once, ascending, and the wrenches on them, (n, 15), of forces (m, 3) by where each lands, (m,)."""
    under = np.concatenate([each.blocks for each in landed])
    shared = np.concatenate([each.shares[:, None] * force for each, force in zip(landed, forces, strict=True)])
    points = np.concatenate([each.points for each in landed])
    return sum_on_blocks(under, wrenches_of(shared, points, site.blocks.centroids[under]))


@dataclass(frozen=True)
class LoadFootprint:
    """How loads of one entry of the deck land.

    below : blocks that they may land on; through : the fill on which they stand, None for none
    path  : of the load, for faults
    """

    below: Below
    through: FillBody | None
    path: KeyPath
    site: LoadSite

    def of(self, place: FloatArray, along: FloatArray, width: float) -> Spread | None:
        """Of a force at a place, (3,), shared over a width across the way along, (3,) unit and level; 0 at the place.

        None where part of it lies over no block, in fill where it stands beside it, which leaves a fault.
        """
        if self.through is not None:
            return self._through(self.through, place, along, width)
        if width > 0.0:
            across = width / 2 * np.array([-along[1], along[0], 0.0])
            return self.of_line(place - across, place + across)
        block = self.below.at(place[None])
        return Spread(block, np.ones(1), place[None], 0.0) if block[0] >= 0 else None

    def of_axle(self, place: FloatArray, along: FloatArray, tread: Tread) -> Spread | None:
        """Of an axle with its middle at a place, (3,), each wheel with half of it; as ``of`` otherwise.

        On blocks the contact of a wheel is two lines along the way, which are divided where the blocks are; in fill
        four points, each of which spreads to all sides.
        """
        if tread.gauge == 0.0:
            return self.of(place, along, tread.width)
        across = np.array([-along[1], along[0], 0.0])
        length, aside = tread.contact[0] * along, GAUSS * tread.contact[1] * across
        wheels = [place + side * tread.gauge / 2 * across for side in (-1.0, 1.0)]
        if not any(tread.contact):
            found = [self.of(wheel, along, 0.0) for wheel in wheels]
        elif self.through is None:
            lines = [wheel + side * aside for wheel in wheels for side in (-1.0, 1.0)]
            found = [self.of_line(middle - length / 2, middle + length / 2) for middle in lines]
        else:
            corners = [end * GAUSS * length + side * aside for end in (-1.0, 1.0) for side in (-1.0, 1.0)]
            law = self.through.dispersal.model_copy(update={"contact": None})
            on = replace(self, through=replace(self.through, dispersal=law))
            found = [on.of(wheel + corner, along, 0.0) for wheel in wheels for corner in corners]
        landed = [each for each in found if each is not None]
        return _together(landed) if len(landed) == len(found) else None

    def of_line(self, begin: FloatArray, end: FloatArray) -> Spread | None:
        """Of a force that is shared evenly over a line; None where part of it lies over no block."""
        ends, carriers = self.parts_of_line(begin, end)
        if (carriers < 0).all(axis=0).any():
            return None
        shares = np.where(carriers >= 0, 1.0, 0.0)
        shares *= np.diff(ends) / shares.sum(axis=0)
        side, part = np.nonzero(shares > 0.0)
        points = begin + ((ends[:-1] + ends[1:]) / 2)[part, None] * (end - begin)
        return Spread(carriers[side, part], shares[side, part], points, 0.0)

    def parts_of_line(self, begin: FloatArray, end: FloatArray) -> tuple[FloatArray, IntArray]:
        """Ends of the parts of a line, (n + 1,), and the blocks under them left and right of it, (2, n).

        Bare parts that are narrower than the tolerance of contacts are joints that are not quite closed: they count to
        the part before them, or after them at the beginning.
        """
        ends, carriers = self.below.parts(begin, end)
        bare = np.asarray((carriers < 0).all(axis=0))
        size = float(self.site.blocks.sizes[self.below.chosen].min())
        narrow = self.site.tolerance * size / float(np.linalg.norm(end - begin))
        for part in np.flatnonzero(bare & (np.diff(ends) <= narrow)):  # few: open joints
            near = next((other for other in (part - 1, part + 1) if 0 <= other < len(bare) and not bare[other]), part)
            carriers[:, part] = carriers[:, near]
        return ends, carriers

    def _through(self, body: FillBody, place: FloatArray, along: FloatArray, width: float) -> Spread | None:
        across = width / 2 * np.array([-along[1], along[0], 0.0])
        places = np.stack([place - across, place, place + across])
        reach = NEAR * float(self.site.blocks.sizes[body.blocks].min())
        outside = places[beside(body, places, along, reach)]
        if len(outside):
            smaller = ", or shorten it" if self.path[-1] == "line" else ", or make its width smaller"
            words = (
                f"at {vector(outside[0])} it is beside the fill {body.name}: move it{smaller if width > 0.0 else ''}"
            )
            self.site.refuse(Finding("load-beside-structure", words, *self.path))
            return None
        for each in places:
            block = emerging(body, each, reach)
            if block is not None:
                name = self.site.blocks.name(block)
                words = (
                    f"at {vector(each)} {name} rises out of the fill {body.name}: leave out through, or raise the fill"
                )
                self.site.refuse(Finding("load-not-on-fill", words, *self.path))
                return None
        found = spread(body, place, along, width, self.site.blocks)
        if not len(found.blocks):
            under = self._straight_down(body, place)
            if under >= 0 and under not in body.blocks:
                name = self.site.blocks.name(under)
                words = (
                    f"at {vector(place)} it stands over {name}, on which the fill {body.name} does not lie: add {name} "
                    "to on of the fill, or leave out through"
                )
                self.site.refuse(Finding("load-not-on-fill", words, *self.path))
                return None
        return found

    def _straight_down(self, body: FillBody, place: FloatArray) -> int:
        """The block straight under a place on the top of a fill, -1 for none."""
        on_top = np.append(place[:2], body.tops(place))
        return int(self._all_below.at(on_top[None])[0])

    @cached_property
    def _all_below(self) -> Below:
        """All blocks, seen from straight above."""
        blocks = self.site.blocks
        return Below(blocks, np.array([0.0, 0.0, -1.0]), np.arange(len(blocks)))

    def sound(self, forces: FloatArray, way: FloatArray, tread: Tread) -> bool:
        """Whether forces (n, 3) that come along a way, (3,), can be spread so; a fault where not.

        In fill they are vertical; what spreads, or has a width, needs to know what across is.
        """
        width = tread.width or tread.gauge
        flat = float(np.abs(way[:2]).max())
        if (self.through is not None or width > 0.0) and flat <= UPRIGHT * float(np.abs(way).max()):
            words = "is upright: what is level and across it is not known"
            self.site.refuse(Finding("degenerate-line", words, *self.path))
            return False
        across = np.cross([0.0, 0.0, 1.0], level(way))
        lines = [across] * (width > 0.0) + [level(way)] * any(tread.contact)
        if self.through is None and any(np.linalg.norm(np.cross(each, self.below.down)) <= PARALLEL for each in lines):
            words = "looks for its blocks along the width of its axles: give another direction with towards"
            self.site.refuse(Finding("degenerate-line", words, *self.path))
            return False
        if self.through is None:
            return True
        slanting = np.abs(forces[:, :2]).max(axis=1) > UPRIGHT * np.abs(forces).max(axis=1)
        if slanting.any():
            words = (
                f"has the force {vector(forces[slanting][0])}, and only vertical ones spread in fill: give what is "
                "horizontal as a load of its own on blocks"
            )
            self.site.refuse(Finding("load-not-on-fill", words, *self.path))
        return not slanting.any()

    def remark_beyond(self, words: str, forces: FloatArray, landed: Sequence[Spread]) -> None:
        """A notice where part of a load, forces (n, 3), goes past the ends of all blocks."""
        share = share_of(forces, [each.beyond for each in landed])
        if self.through is not None and share > 0.0:
            message = (
                f"{words}: {100 * share:.3g} % of it goes through the fill {self.through.name} beyond the ends of the "
                "blocks under it, and does not act on the structure: the ground there carries it"
            )
            self.site.selection.remark(Notice("notice", "load-beyond-fill", message))

    def remark_met(self, words: str, forces: FloatArray, landed: Sequence[Spread]) -> None:
        """What of a load, forces (n, 3), meets blocks where they carry no fill: which, and what becomes of it.

        A notice, as nothing is lost on upright faces; a warning where a block is not under the fill, or all is lost.
        """
        if self.through is None:
            return
        name, blocks = self.through.name, self.site.blocks
        kept = [each for each in landed if len(each.blocks) and each.met > 0.0]
        if kept:
            others = np.unique(np.concatenate([each.others for each in kept]))
            strange = np.setdiff1d(others, self.through.on)
            share = share_of(forces, [each.met if len(each.blocks) else 0.0 for each in landed])
            message = f"{words}: {100 * share:.3g} % of it goes through the fill {name} towards "
            after = "; what would meet them there acts on the blocks under the load instead, in proportion"
            if len(strange):
                which = f"{named(strange, blocks.name)}, on which this fill does not lie"
                self.site.warn("load-off-fill", f"{message}{which}{after}: add them to its on if they carry it")
            else:
                which = f"faces without fill of {named(others, blocks.name)}, as upright ones are"
                self.site.selection.remark(Notice("notice", "load-towards-wall", f"{message}{which}{after}"))
        lost = [0.0 if len(each.blocks) else each.met for each in landed]
        if share_of(forces, lost) > 0.0:
            others = np.unique(np.concatenate([each.others for each in landed if not len(each.blocks)]))
            message = (
                f"{words}: {100 * share_of(forces, lost):.3g} % of it reaches no block under the fill {name} but meets "
                f"{named(others, blocks.name)} from beside, and is left out: give what it does there as loads"
            )
            self.site.warn("load-off-fill", message)


def _together(parts: Sequence[Spread]) -> Spread:
    """Where equal parts of a load land, as one; a part that lands on no block goes beyond."""
    shares = np.concatenate([each.shares for each in parts]) / len(parts)
    points = np.concatenate([each.points for each in parts])
    blocks, row = np.unique(np.concatenate([each.blocks for each in parts]), return_inverse=True)
    total = summed(row, shares, len(blocks))
    means = summed(row, shares[:, None] * points, len(blocks)) / total[:, None]
    beyond = float(np.mean([each.beyond if len(each.blocks) else 1.0 for each in parts]))
    met = float(np.mean([each.met if len(each.blocks) else 0.0 for each in parts]))
    return Spread(blocks, total, means, beyond, met, np.unique(np.concatenate([each.others for each in parts])))


def share_of(forces: FloatArray, shares: Sequence[float]) -> float:
    """Share of the sum of forces (n, 3), by the share of each, (n,)."""
    sizes = np.linalg.norm(forces, axis=1)
    return float(sizes @ np.array(shares) / sizes.sum()) if sizes.any() else 0.0


def level(way: Sequence[float] | FloatArray) -> FloatArray:
    """The level direction of a way, (3,) unit; nothing of one that is upright."""
    flat = np.array([way[0], way[1], 0.0])
    flat = flat / (np.abs(flat).max() or 1.0)
    return np.asarray(flat / (np.linalg.norm(flat) or 1.0))
