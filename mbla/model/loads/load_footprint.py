"""Where a vertical or other force that stands above the structure lands: on the block under it, on those under the line
or the rectangle over which it is shared, or through fill on all blocks that it spreads to.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Finding, KeyPath, Notice
from mbla.model.applied_load import Patches
from mbla.model.fill.dispersal import Spread, beside, emerging, spread
from mbla.model.fill.fill import FillBody
from mbla.model.loads.blocks_under import Below
from mbla.model.loads.load_kind import LoadSite
from mbla.model.loads.on_soil import refuse_within_soil, refuse_without_length
from mbla.model.loads.spreads import most_laden, share_of, together
from mbla.model.loads.tread import Tread, across, level
from mbla.model.wording import named, vector
from mbla.process.late import shapely

PARALLEL = 1e-6
"""sine of the angle between a line and the direction to its blocks, up to which they are parallel"""
UPRIGHT = 1e-9
"""horizontal component relative to a force, a line or a path, up to which it is none"""
NEAR = 1e-3
"""share of the size of a block that a load may stand beside the fill, or a block rise out of it under the load"""
GAUSS = 0.5 / 3**0.5
"""of the side of a contact, from its middle to the two places that stand for it: its second moment is theirs"""


@dataclass(frozen=True)
class LoadFootprint:
    """How loads of one entry of the deck land.

    below : blocks that they may land on; through : the fill on which they stand, None for none
    path  : of the load, for faults; vehicle : of the deck that it is, empty for none
    """

    below: Below
    through: FillBody | None
    path: KeyPath
    site: LoadSite
    vehicle: str = ""

    def of(self, place: FloatArray, along: FloatArray, width: float, length: float = 0.0) -> Spread | None:
        """Of a force at a place, (3,), shared over a width across the way along, (3,) unit and level, and over a length
        along it; 0 and 0 at the place.

        None where part of it lies over no block, in fill where it stands beside it, which leaves a fault.
        """
        if self.through is not None:
            return self._through(self.through, place, along, width)
        sides = np.stack([length * along, width * across(along)])
        if length > 0.0 and width > 0.0:
            return self._of_rectangle(place, sides)
        if length > 0.0 or width > 0.0:
            half = sides.sum(axis=0) / 2
            return self.of_line(place - half, place + half)
        block = self.below.at(place[None])
        return Spread(block, np.ones(1), place[None], 0.0) if block[0] >= 0 else None

    def of_axle(self, place: FloatArray, along: FloatArray, tread: Tread) -> Spread | None:
        """Of an axle with its middle at a place, (3,), each wheel with half of it; as ``of`` otherwise.

        On blocks the contact presses evenly, and is divided where the blocks are; in fill two places along the way
        stand for its length, and of a wheel two for its width, each of which spreads to all sides.
        """
        length, width = tread.contact
        if self.through is None or length == 0.0:
            found = [self.of(wheel, along, width, length) for wheel in tread.places(place, along)]
        else:
            law = self.through.dispersal.model_copy(update={"contact": None})
            on = replace(self, through=replace(self.through, dispersal=law))
            aside, line = (GAUSS * width, 0.0) if tread.gauge > 0.0 else (0.0, width)
            ways = [end * GAUSS * length * along for end in (-1.0, 1.0)]
            corners = [way + side * across(along) for way in ways for side in dict.fromkeys((-aside, aside))]
            wheels = tread.places(place, along)
            found = [on.of(wheel + corner, along, line) for wheel in wheels for corner in corners]
        landed = [each for each in found if each is not None]
        if len(landed) < len(found) or self._unfit_for_soil(landed, along, tread):
            return None
        return landed[0] if len(landed) == 1 else together(landed)

    def _unfit_for_soil(self, landed: Sequence[Spread], along: FloatArray, tread: Tread) -> bool:
        """Whether an axle stands on soil of cells without a length, or within it; leaves a fault."""
        if self.through is not None:
            return False
        of = f"vehicles.{self.vehicle}" if self.vehicle else "it"
        remedy = f"give {of} a contact, the length along its way on which an axle stands, as 0.4 m of EN 1991-2"
        if tread.gauge > 0.0:
            remedy = f"give the wheels of {of} a contact, as [0.4, 0.4] m of EN 1991-2"
        under = np.concatenate([each.blocks for each in landed])
        if refuse_without_length(under, tread.sides(along), remedy, self.path, self.site):
            return True
        points = np.concatenate([each.points for each in landed])
        return refuse_within_soil(self.below, under, points, self.path, self.site)

    def _of_rectangle(self, middle: FloatArray, sides: FloatArray) -> Spread | None:
        """Of a force that presses evenly on a rectangle, sides (2, 3), about its middle; None where part of it lies
        over no block, but for joints that are not quite closed: these count to the piece that is nearest.
        """
        corner = middle - sides.sum(axis=0) / 2
        pieces, carriers = self.below.pieces(corner, sides)
        bare, lengths = np.flatnonzero(carriers < 0), np.linalg.norm(sides, axis=1)
        narrow = self.site.tolerance * float(self.site.blocks.sizes[self.below.chosen].min()) / lengths.min()
        if len(bare) == len(pieces) or not shapely.is_empty(shapely.buffer(pieces[bare], -narrow / 2)).all():
            return None
        kept = np.flatnonzero(carriers >= 0)
        for piece in bare:  # few: open joints
            carriers[piece] = carriers[kept[np.argmin(shapely.distance(pieces[kept], pieces[piece]))]]
        middles = shapely.get_coordinates(shapely.centroid(pieces))
        return Spread(carriers, shapely.area(pieces), corner + middles @ sides, 0.0)

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
        half = width / 2 * across(along)
        places = np.stack([place - half, place, place + half])
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
        width = tread.contact[1] or tread.gauge
        flat = float(np.abs(way[:2]).max())
        if (self.through is not None or width > 0.0 or tread.contact[0] > 0.0) and flat <= UPRIGHT * float(
            np.abs(way).max()
        ):
            words = "is upright: what is level and across it is not known"
            self.site.refuse(Finding("degenerate-line", words, *self.path))
            return False
        lines = [across(level(way))] * (width > 0.0) + [level(way)] * (tread.contact[0] > 0.0)
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

    def patches_of(
        self, place: FloatArray, along: FloatArray, tread: Tread, force: FloatArray, landed: Spread
    ) -> Patches:
        """What an axle with its middle at a place, (3,), stands on, where it landed."""
        on_top = place if self.through is None else np.append(place[:2], self.through.tops(place))
        corners = tread.corners(on_top, along)
        count = len(corners)
        under = np.full(count, most_laden(landed))
        if self.through is None and count:
            middles = self.below.at(corners.mean(axis=1))
            under = np.where(middles >= 0, middles, under)
        return Patches(corners, np.tile(force / max(count, 1), (count, 1)), under, self.through is not None)

    def bare_words(self, place: FloatArray, tread: Tread, change: str) -> str:
        """What an axle at a place, (3,), is over where part of it lies over no block, and what is to be done.

        change : ``move it``
        """
        if self.through is not None:
            return f"beyond the blocks under the fill {self.through.name}; {change}"
        if self.below.at(place[None])[0] < 0:
            return f"over no block; {change}, or look for blocks in another direction with towards"
        units = self.site.units
        stands = tread.words(units) or f" on a width of {tread.contact[1]:.6g} {units.length}"
        return f"over no block with a part of it, for it stands{stands}; {change}, so that all of it is over blocks"

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
