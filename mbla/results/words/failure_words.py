"""The failure in a few plain sentences: what moves and how, where it turns, where it parts, what slides.

A reader who has not seen a picture can draw it from them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.collapse import Collapse
from mbla.results.collapse.cracks import Crack
from mbla.results.collapse.failure import Failure
from mbla.results.collapse.hinge_lines import HingeLine
from mbla.results.collapse.mechanics import curvature_sides
from mbla.results.collapse.rigid_parts import PartMotion, moving_share, reach
from mbla.results.collapse.sliding_planes import SlidingPlane
from mbla.results.words.direction_words import direction_words, way_words
from mbla.results.words.place_words import extents_of, group_words, point_words, range_words, region_words
from mbla.results.words.text import counted, percent

MOST_PARTS, MOST_LINES, MOST_CRACKS, MOST_SLIDES = 4, 4, 2, 2
"""what is told of each kind; the tables hold more, the result files all"""
IN_PLACE = 0.02
"""speed of the middle of a part over that by its rotation, up to which it turns on the spot"""
SAME_WAY = 0.9
"""cosine from which planes of the same two parts are told together"""
UNDER_FORCE = 5e-4
"""share of the power above which sliding is said to take work: what is written as 0.1 % or more"""
ON_AXIS = 0.02
"""distance of a hinge line from the axis of a part, over the size of the part, up to which it turns about that line"""


def failure_sentences(
    model: Model, contacts: Contacts, load_case: LoadCase, collapse: Collapse, failure: Failure
) -> list[str]:
    """Sentences in the order in which they are read; the first says how much moves."""
    if not collapse.motions:
        return ["No block moves."]
    told = _told(failure)
    texts = [_scale(model, collapse, failure)]
    texts += [_part_sentence(model, load_case, failure, part) for part in told]
    left = len(failure.motions) - len(told)
    if left:
        weight = sum(part.weight for part in failure.motions) or 1.0
        share = 100 * (1 - sum(part.weight for part in told) / weight)
        verb = "moves" if left == 1 else "move"
        texts.append(f"{counted(left, 'more part')}, {share:.3g} % of the weight that moves, {verb} besides.")
    texts += _hinge_sentences(model, contacts, failure, told)
    texts += [_crack_sentence(model, contacts, crack) for crack in failure.cracks[:MOST_CRACKS]]
    if len(failure.cracks) > MOST_CRACKS:
        texts[-1] += f" {counted(len(failure.cracks) - MOST_CRACKS, 'more crack')} in the table below."
    return texts + _slide_sentences(model, failure)


def _told(failure: Failure) -> Sequence[PartMotion]:
    """The parts that are described: the heaviest."""
    return failure.motions[:MOST_PARTS]


def _scale(model: Model, collapse: Collapse, failure: Failure) -> str:
    """``The mechanism is partial: 12 of 52 free blocks, 20.8 % of the weight, move in 1 rigid part.``"""
    moving = int(np.sum(~model.fixed & (collapse.parts > 0)))
    share = moving_share(model, collapse.parts)
    text = (
        f"The mechanism is {reach(share)}: {moving} of {counted(len(model.free), 'free block')}, "
        f"{100 * share:.3g} % of the weight, {'moves' if moving == 1 else 'move'} "
        f"in {counted(len(collapse.motions), 'rigid part')}"
    )
    if not failure.merged:
        return f"{text}."
    return (
        f"{text}, told as {len(failure.motions)}: what moves by less than {100 * failure.merged:g} % of the fastest "
        "contact counts as at rest, or as one with its neighbour."
    )


def _part_sentence(model: Model, load_case: LoadCase, failure: Failure, part: PartMotion) -> str:
    """Which part, and how it moves."""
    who = _who(model, load_case, part)
    way = way_words(model, load_case, part.velocity, part.centroid)
    if not part.turns:
        return f"{who} moves {way}, along {direction_words(part.direction)}, without turning."
    low, high = extents_of(model, part.blocks)
    spin = float(np.linalg.norm(part.rotation)) * float(np.linalg.norm(high - low))
    goes = f", its middle moving {way}," if way and np.linalg.norm(part.velocity) > IN_PLACE * spin else ""
    turns = f"{who} turns about {direction_words(part.direction)}{goes}"
    line = _line_of(model, failure.hinge_lines, part)
    if line is not None:
        other = line.clusters[1] if line.clusters[0] == part.number else line.clusters[0]
        return f"{turns} over {part_name(other)}, on {_line_words(model, line)}."
    return f"{turns} round an axis through {point_words(model, part.axis_point)}."


def _who(model: Model, load_case: LoadCase, part: PartMotion) -> str:
    """``Part 1, the upper right corner (12 blocks of wall, 20.8 % of the weight, courses 1 to 6, x 2.2 .. 3.2 m),``."""
    free = ~model.fixed
    total = float(model.blocks.masses[free].sum())
    blocks = counted(len(part.blocks), "block")
    if len(part.blocks) == int(free.sum()):
        return f"The whole structure ({blocks})" if free.all() else f"The whole structure on its supports ({blocks})"
    names = group_words(model, part.blocks)
    count = [] if len(part.blocks) == 1 or names.startswith(blocks) else [blocks]
    share = 100 * float(model.blocks.masses[part.blocks].sum()) / total if total > 0 else 0.0
    about = [f"{share:.3g} % of the weight"] if share else []
    support = load_case.settlement
    gives = (
        ["with the support that gives way"]
        if support is not None and np.isin(support.blocks, part.blocks).any()
        else []
    )
    detail = [*count, *about, *range_words(model, part.blocks), *gives]
    if len(part.blocks) == 1:
        return f"Part {part.number}, {names} ({', '.join(detail)}),"
    return f"Part {part.number}, the {region_words(model, part.blocks)} ({', '.join([names, *detail])}),"


def part_name(number: int) -> str:
    """``part 2``, or ``what rests`` for 0."""
    return "what rests" if number == 0 else f"part {number}"


def _line_of(model: Model, lines: Sequence[HingeLine], part: PartMotion) -> HingeLine | None:
    """The hinge line about which the part turns, None where its axis is no hinge; one on what rests goes first."""
    low, high = extents_of(model, part.blocks)
    limit = ON_AXIS * float(np.linalg.norm(high - low))

    def off(line: HingeLine) -> float:
        arms = np.stack([line.start, line.end]) - part.axis_point
        return float(np.linalg.norm(np.cross(arms, part.direction), axis=1).max())

    own = [line for line in lines if part.number in line.clusters and off(line) <= limit]
    return min(own, key=lambda line: (0 not in line.clusters, off(line)), default=None)


def _line_words(model: Model, line: HingeLine) -> str:
    """``a hinge line of 8 interfaces from (0, 0.25, 0) to (3.2, 0.25, 0)``."""
    count = len(line.interfaces)
    what = "a hinge" if count == 1 else f"a hinge line of {counted(count, 'interface')}"
    return f"{what} from {point_words(model, line.start)} to {point_words(model, line.end)}"


def _hinge_sentences(model: Model, contacts: Contacts, failure: Failure, told: Sequence[PartMotion]) -> list[str]:
    """The hinge lines that move most, beyond those about which the parts were said to turn."""
    lines = [line for line in failure.hinge_lines if line.share > 0]
    said = {id(_line_of(model, failure.hinge_lines, part)) for part in told if part.turns}
    left = [line for line in lines if id(line) not in said]
    if not left:
        return []
    outward = curvature_sides(model, contacts)
    places = [_place_of_line(model, contacts, outward, line) for line in left[:MOST_LINES]]
    also = "Further hinges" if len(left) < len(lines) else "Hinges"
    most = ", those that move most" if len(left) > MOST_LINES else ""
    more = f"; and {len(left) - MOST_LINES} more" if len(left) > MOST_LINES else ""
    return [f"{also}{most}: {'; '.join(places)}{more}."]


def _place_of_line(model: Model, contacts: Contacts, outward: FloatArray, line: HingeLine) -> str:
    """``at (1, 0.5, 2) on the extrados between part 1 and part 2``."""
    middle = (line.start + line.end) / 2
    side = hinge_side(contacts, outward, line)
    on = f" on the {side}" if side in ("intrados", "extrados") else ""
    count = f", {counted(len(line.interfaces), 'interface')}" if len(line.interfaces) > 1 else ""
    slides = ", sliding" if line.slides else ""
    return f"at {point_words(model, middle)}{on} between {_pair_words(line.clusters)}{count}{slides}"


def hinge_side(contacts: Contacts, outward: FloatArray, line: HingeLine) -> str:
    """Where a hinge line lies on its first interface: intrados or extrados in an arch, else the axis it is off to."""
    first = int(line.interfaces[0])
    offset = (line.start + line.end) / 2 - contacts.centroids[first]
    offset = offset - (offset @ line.direction) * line.direction
    along = float(offset @ outward[first])
    if abs(along) > 0.5 * np.linalg.norm(offset) * np.linalg.norm(outward[first]):
        return "extrados" if along > 0 else "intrados"
    axis = int(np.argmax(np.abs(offset)))
    return f"{'+' if offset[axis] > 0 else '-'}{'xyz'[axis]} side"


def _pair_words(clusters: tuple[int, int]) -> str:
    first, second = clusters
    return f"part {first} and what rests" if second == 0 else f"parts {second} and {first}"


def _crack_sentence(model: Model, contacts: Contacts, crack: Crack) -> str:
    first, second = crack.clusters
    apart = f"separates part {first} from {part_name(second)}"
    count = len(crack.interfaces)
    if count == 1:
        return f"An open joint at {point_words(model, crack.start)} {apart}."
    ends = f"from {point_words(model, crack.start)} to {point_words(model, crack.end)}"
    return f"A {crack_kind(contacts, crack)}crack of {count} open joints {ends} {apart}."


def crack_kind(contacts: Contacts, crack: Crack) -> str:
    """``stepped `` where its joints have several directions at right angles or so, else nothing."""
    normals = contacts.normals[crack.interfaces]
    return "stepped " if np.abs(normals @ normals[0]).min() < 0.5 else ""


def _slide_sentences(model: Model, failure: Failure) -> list[str]:
    """Planes of the same two parts and direction in one sentence, those that take most work first."""
    by_clusters: dict[tuple[int, int], list[list[SlidingPlane]]] = {}
    runs: list[list[SlidingPlane]] = []
    for plane in failure.sliding_planes:
        known = by_clusters.setdefault(plane.clusters, [])
        fit = next((run for run in known if float(run[0].direction @ plane.direction) > SAME_WAY), None)
        if fit is None:
            known.append([plane])
            runs.append(known[-1])
        else:
            fit.append(plane)
    working = [run for run in runs if _takes_work(run)]
    idle = sum(len(plane.interfaces) for run in runs if not _takes_work(run) for plane in run)
    hinges = [line for line in failure.hinge_lines if line.slides]
    in_hinges = sum(np.nan_to_num(line.shear) for line in hinges)
    if not working:
        if in_hinges >= UNDER_FORCE:
            slide = "slides" if len(hinges) == 1 else "slide"
            count = counted(len(hinges), "hinge")
            return [f"{count} {slide} as well, taking {percent(in_hinges)} % of the power."]
        idle += len(hinges)
        verb = "slides" if idle == 1 else "slide"
        return [f"{counted(idle, 'joint')} {verb} without taking work." if idle else "Nothing slides."]
    texts = [_slide_sentence(model, run) for run in working[:MOST_SLIDES]]
    if len(working) > MOST_SLIDES:
        left = sum(plane.shear for run in working[MOST_SLIDES:] for plane in run)
        texts.append(f"Sliding elsewhere takes {percent(left)} % of the power; see the table below.")
    if in_hinges >= UNDER_FORCE:
        texts.append(f"Hinges that slide take {percent(in_hinges)} % of it.")
    given_back = sum(plane.shear - plane.share for plane in failure.sliding_planes)
    if given_back >= UNDER_FORCE:
        texts.append(f"Joints lift as they slide, and their normal forces give {percent(given_back)} % back.")
    return texts


def _takes_work(planes: Sequence[SlidingPlane]) -> bool:
    """Where no power is put in at all, whatever slides is told."""
    shear = sum(plane.shear for plane in planes)
    return bool(np.isnan(shear) or shear >= UNDER_FORCE)


def _slide_sentence(model: Model, planes: Sequence[SlidingPlane]) -> str:
    first = planes[0]
    number, other = first.clusters
    joints = sum(len(plane.interfaces) for plane in planes)
    area = sum(plane.area for plane in planes)
    where = counted(joints, "joint") + (f" in {len(planes)} planes" if len(planes) > 1 else "")
    shear = sum(plane.shear for plane in planes)
    share = "" if np.isnan(shear) else f", taking {percent(shear)} % of the power"
    does = "twists on" if first.twists else "slides over"
    way = "" if first.twists else f" along {direction_words(first.direction)}"
    at = ("at " if len(planes) == 1 else "mostly at ") + point_words(model, first.centroid)
    return f"Part {number} {does} {part_name(other)}{way}: {where}, {area:.4g} {model.units.length}2, {at}{share}."
