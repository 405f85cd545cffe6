"""The failure in a few plain sentences: what moves and how, where it turns, where it parts, what slides.

A reader who has not seen a picture can draw it from them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.deck.suggestions import listed
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.collapse import Collapse, Failure
from mbla.results.collapse.cracks import Crack, YieldLine
from mbla.results.collapse.joint_planes import HingeLine
from mbla.results.collapse.rigid_parts import PartMotion, moving_blocks, moving_share, reach
from mbla.results.collapse.thrust import curvature_sides
from mbla.results.listing.places import (
    direction_words,
    extents_of,
    group_words,
    point_words,
    range_words,
    region_words,
    way_words,
)
from mbla.results.listing.slides import moves_whole, other_name, part_name, slide_sentences
from mbla.results.listing.text import counted

MOST_PARTS, MOST_LINES, MOST_CRACKS = 4, 4, 2
"""what is told of each kind; the tables hold more, the result files all"""
IN_PLACE = 0.02
"""speed of the middle of a part over that by its rotation, up to which it turns on the spot"""
SPREADS = 2 * MOST_PARTS
"""parts, as told, from which on a mechanism is said to have no few parts"""
PLACES = 2
"""digits behind the point of a yield line: it is fitted through joints that lie a block apart"""
FAR_AXIS = 5.0
"""speed of the centroid of a part over that by its rotation from which it is said to move rather than to turn"""
ON_AXIS = 0.02
"""distance of a hinge line from the axis of a part, over the size of the part, up to which it turns about that line"""


def failure_sentences(
    model: Model, contacts: Contacts, load_case: LoadCase, collapse: Collapse, failure: Failure
) -> list[str]:
    """Sentences in the order in which they are read; the first says how much moves."""
    if not collapse.motions:
        return ["No block moves."]
    told = failure.main.motions[:MOST_PARTS]
    texts = [_scale(model, collapse, failure)]
    texts += [_part_sentence(model, contacts, load_case, failure, part) for part in told]
    left = len(failure.main.motions) - len(told)
    if left:
        weight = sum(part.weight for part in failure.motions) or 1.0
        share = 100 * (1 - sum(part.weight for part in told) / weight)
        verb = "moves" if left == 1 else "move"
        texts.append(f"{counted(left, 'more part')} {verb} besides, {share:.3g} % of the weight that moves.")
    if failure.spreads:
        return [*texts, *_yield_sentences(model, failure), _counts(failure)]
    texts += _hinge_sentences(model, contacts, failure, told)
    texts += [_crack_sentence(model, contacts, failure, crack) for crack in failure.cracks[:MOST_CRACKS]]
    if len(failure.cracks) > MOST_CRACKS:
        texts[-1] += f" {counted(len(failure.cracks) - MOST_CRACKS, 'more crack')} in the table below."
    return texts + slide_sentences(model, contacts, failure, collapse.work)


def _scale(model: Model, collapse: Collapse, failure: Failure) -> str:
    """``The mechanism is partial: 12 of 52 free blocks, 20.8 % of the weight, move in 1 rigid part.``"""
    moving = moving_blocks(model, collapse.parts)
    share = moving_share(model, collapse.parts)
    parts = len(failure.motions)
    text = (
        f"The mechanism is {reach(share)}: {moving} of {counted(len(model.free), 'free block')}, "
        f"{100 * share:.3g} % of the weight, {'moves' if moving == 1 else 'move'}"
    )
    if not failure.merged:
        return f"{text} {'as one rigid part' if parts == 1 else f'in {parts} rigid parts'}."
    if failure.spreads:
        return (
            f"{text}. Distributed mechanism over many joints, approximated by {as_parts(len(failure.main.motions))}: "
            f"each block belongs to the part whose motion is nearest to its own, which reproduces "
            f"{100 * failure.main.explained:.3g} % of the motion (of its square over the volume)."
        )
    text = (
        f"{text}: {counted(parts, 'rigid part')}, neglecting relative motion below {100 * failure.merged:g} % of the "
        "largest contact velocity."
    )
    if len(failure.motions) < SPREADS:
        return text
    return f"{text} Distributed mechanism; the {MOST_PARTS} heaviest parts:"


def _part_sentence(model: Model, contacts: Contacts, load_case: LoadCase, failure: Failure, part: PartMotion) -> str:
    """Which part, and how it moves."""
    who = _who(model, load_case, part)
    way = way_words(model, load_case, part.velocity, part.centroid)
    if not part.turns:
        along = "" if way.startswith("towards") else f", along {direction_words(part.direction)}"
        way = way if along else f"along {direction_words(part.direction)}"
        return f"{who} moves {way}{along}, without turning."
    low, high = extents_of(model, part.blocks)
    spin = float(np.linalg.norm(part.rotation)) * float(np.linalg.norm(high - low))
    if np.linalg.norm(part.velocity) > FAR_AXIS * spin:
        along = direction_words(part.velocity / np.linalg.norm(part.velocity))
        return f"{who} moves {way}, along {along}, turning slightly about {direction_words(part.direction)}."
    goes = f", its centroid moving {way}," if way and np.linalg.norm(part.velocity) > IN_PLACE * spin else ""
    turns = f"{who} turns about {direction_words(part.direction)}{goes}"
    line = None if failure.spreads else _line_of(model, failure.hinge_lines, part)
    if line is not None:
        other = line.clusters[1] if line.clusters[0] == part.number else line.clusters[0]
        over = other_name(model, contacts, failure, other, line.interfaces)
        return f"{turns} over {over}, on {_line_words(model, line)}."
    broken = _breaks_off(model, failure, part)
    return f"{turns}{broken}." if broken else f"{turns} round an axis through {point_words(model, part.axis_point)}."


def as_parts(count: int) -> str:
    """``one rigid part``, ``3 rigid parts``."""
    return "one rigid part" if count == 1 else f"{count} rigid parts"


def _breaks_off(model: Model, failure: Failure, part: PartMotion) -> str:
    """`` and breaks off along a line from (7.6, 0.3, 0) to (0.4, 0.3, 5.4), 40 degrees to the horizontal``."""
    own = [line for line in failure.yield_lines if part.number in line.parts]
    line = min(
        own, key=lambda line: 0 not in line.parts, default=None
    )  # that on the stationary blocks, else the longest
    if line is None:
        return ""
    other = sum(line.parts) - part.number
    return f" and breaks off {f'part {other} ' if other else ''}along {_yield_words(model, line)}"


def _yield_words(model: Model, line: YieldLine) -> str:
    """``a line from (7.6, 0.3, 0) to (0.4, 0.3, 5.4), 40 degrees to the horizontal``; of a broken one its corners."""
    points = [point_words(model, np.round(point, PLACES)) for point in line.points]
    if len(points) == 2:
        return f"a line from {points[0]} to {points[1]}, {line.inclination:.0f} degrees to the horizontal"
    return f"a broken line from {points[0]} over {' and '.join(points[1:-1])} to {points[-1]}"


def _yield_sentences(model: Model, failure: Failure) -> list[str]:
    """The lines along which main parts move apart from each other."""
    between = [line for line in failure.yield_lines if line.parts[1]]
    return [
        f"Parts {line.parts[0]} and {line.parts[1]} break apart along {_yield_words(model, line)}." for line in between
    ]


def _counts(failure: Failure) -> str:
    """How many lines and joints there are of each kind, which the tables have."""
    kinds = ((failure.hinge_lines, "hinge line"), (failure.sliding_planes, "sliding plane"), (failure.cracks, "crack"))
    words = listed([counted(len(found), word) for found, word in kinds if found], "and")
    return f"The tables below have {words} of {len(failure.motions)} smaller parts, numbered by themselves."


def _who(model: Model, load_case: LoadCase, part: PartMotion) -> str:
    """``Part 1, the upper right corner (12 blocks of wall, 20.8 % of the weight, courses 1 to 6, x 2.2 .. 3.2 m),``."""
    free = ~model.fixed
    total = float(model.blocks.masses[free].sum())
    blocks = counted(len(part.blocks), "block")
    if moves_whole(model, part):
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
    """``a hinge line of 8 interfaces from (0, 0.25, 0) to (3.2, 0.25, 0)``, ``a hinge at (1, 1, 0)`` about a corner."""
    count = len(line.interfaces)
    what = "a hinge" if count == 1 else f"a hinge line of {counted(count, 'interface')}"
    if point_words(model, line.start) == point_words(model, line.end):
        return f"{what} at {point_words(model, line.start)}"
    return f"{what} from {point_words(model, line.start)} to {point_words(model, line.end)}"


def _hinge_sentences(model: Model, contacts: Contacts, failure: Failure, told: Sequence[PartMotion]) -> list[str]:
    """The hinge lines that move most, beyond those about which the parts were said to turn."""
    lines = [line for line in failure.hinge_lines if line.share > 0]
    said = {id(_line_of(model, failure.hinge_lines, part)) for part in told if part.turns}
    left = [line for line in lines if id(line) not in said]
    if not left:
        return []
    outward = curvature_sides(model, contacts)
    places = [_place_of_line(model, contacts, failure, outward, line) for line in left[:MOST_LINES]]
    also = "Further hinges" if len(left) < len(lines) else "Hinges"
    most = ", those that move most" if len(left) > MOST_LINES else ""
    more = f"; and {len(left) - MOST_LINES} more" if len(left) > MOST_LINES else ""
    return [f"{also}{most}: {'; '.join(places)}{more}."]


def _place_of_line(model: Model, contacts: Contacts, failure: Failure, outward: FloatArray, line: HingeLine) -> str:
    """``at (1, 0.5, 2) on the extrados between part 1 and part 2``."""
    middle = (line.start + line.end) / 2
    side = hinge_side(contacts, outward, line)
    on = f" on the {side}" if side in ("intrados", "extrados") else ""
    count = f", {counted(len(line.interfaces), 'interface')}" if len(line.interfaces) > 1 else ""
    slides = (", sliding" if line.slides else "") + (", crushing" if line.crushes else "")
    return f"at {point_words(model, middle)}{on} between {_pair_words(model, contacts, failure, line)}{count}{slides}"


def hinge_side(contacts: Contacts, outward: FloatArray, line: HingeLine) -> str:
    """Where a hinge line lies on its first interface: intrados or extrados in an arch, else the axis it is off to.

    outward : (n_interfaces, 3) direction out of the curve, as ``curvature_sides`` gives it
    """
    first = int(line.interfaces[0])
    offset = (line.start + line.end) / 2 - contacts.centroids[first]
    offset = offset - (offset @ line.direction) * line.direction
    along = float(offset @ outward[first])
    if abs(along) > 0.5 * np.linalg.norm(offset) * np.linalg.norm(outward[first]):
        return "extrados" if along > 0 else "intrados"
    axis = int(np.argmax(np.abs(offset)))
    return f"{'+' if offset[axis] > 0 else '-'}{'xyz'[axis]} side"


def _pair_words(model: Model, contacts: Contacts, failure: Failure, line: HingeLine) -> str:
    first, second = line.clusters
    if second:
        return f"parts {second} and {first}"
    return f"{part_name(model, failure, first)} and {other_name(model, contacts, failure, 0, line.interfaces)}"


def _crack_sentence(model: Model, contacts: Contacts, failure: Failure, crack: Crack) -> str:
    first, second = crack.clusters
    other = other_name(model, contacts, failure, second, crack.interfaces)
    apart = f"separates {part_name(model, failure, first)} from {other}"
    count = len(crack.interfaces)
    if count == 1:
        return f"An open joint at {point_words(model, crack.start)} {apart}."
    ends = f"from {point_words(model, crack.start)} to {point_words(model, crack.end)}"
    return f"A {crack_kind(contacts, crack)}crack of {count} open joints {ends} {apart}."


def crack_kind(contacts: Contacts, crack: Crack) -> str:
    """``stepped `` where its joints have several directions at right angles or so, else nothing."""
    normals = contacts.normals[crack.interfaces]
    return "stepped " if np.abs(normals @ normals[0]).min() < 0.5 else ""
