"""The mechanism of a case: one line, a sentence for each main part, and tables of parts, hinges, slides and cracks.

The fall of a structure without equilibrium is described in the same words.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.assembly.assembly import Assembly
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.collapse import Collapse, Failure, collapse_of, failure_of, fall_of
from mbla.results.collapse.cracks import Crack, YieldLine
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.joint_planes import HingeLine, SlidingPlane
from mbla.results.collapse.rigid_parts import PartMotion, moving_blocks, moving_cells, moving_share, reach
from mbla.results.collapse.thrust import curvature_sides
from mbla.results.listing.blocks import MOST_ROWS, Block, apart, table_of
from mbla.results.listing.places import (
    counted_of,
    direction_words,
    extents_of,
    group_words,
    point_words,
    span_words,
)
from mbla.results.listing.sections.slip_line_words import slip_table
from mbla.results.listing.text import counted, number, percent
from mbla.results.results import CaseResult

MOST_PARTS = 4
"""parts that have a sentence; the tables hold more, the result files all"""
DIGITS = 4
"""of the size of a part in which places of its axis are given, and below which its centroid is at rest"""
FAR_AXIS = 5.0
"""distance of its axis over the size of a part from which it is said to move rather than to turn"""
LIFTS = (
    "The motion is one of associative flow, in which joints dilate as they slide: it proves that nothing holds the "
    "structure, and need not be the way in which it falls."
)
"""limits of the motion as a picture of the fall, where anything slides in it"""


@dataclass(frozen=True)
class FailureDescription:
    """How a case fails, or falls without equilibrium; the sentences are read in their order, tables follow."""

    collapse: Collapse
    failure: Failure
    sentences: list[str]


def description_of(assembly: Assembly, case: CaseResult) -> FailureDescription | None:
    """From the mechanism, a result or not; without equilibrium from the motion that proves it; None without any."""
    load_case, mechanics, certificate = case.load_case, case.solution.mechanics, case.solution.certificate
    model, remark = assembly.model.of_case(load_case), []
    if mechanics is not None:
        collapse = collapse_of(assembly, load_case, mechanics)
    elif certificate is not None:
        collapse, mechanics = fall_of(assembly, load_case, certificate)
        remark = [LIFTS] if collapse.interfaces.slides.any() else []
    else:
        return None
    failure = failure_of(model, assembly.contacts, collapse, mechanics)
    return FailureDescription(collapse, failure, failure_sentences(model, load_case, collapse, failure) + remark)


def mechanism_summary(model: Model, collapse: Collapse, failure: Failure) -> str:
    """``4 hinges, sliding at 2 interfaces; 23 of 27 free blocks move in 3 rigid parts``, as listed and drawn."""
    count = collapse.interfaces.count
    words = [
        (count(InterfaceMode.HINGE), "{}", "hinge"),
        (count(InterfaceMode.SLIDE), "sliding at {}", "interface"),
        (count(InterfaceMode.TWIST), "twisting at {}", "interface"),
        (count(InterfaceMode.OPEN), "{} open", "interface"),
        (int(collapse.interfaces.crushes.sum()), "crushing at {}", "interface"),
        (len(failure.slip_lines), "{} in soil", "slip line"),
        (collapse.yielding, "{} yielding", "tie"),
        (collapse.soil[0], "soil at its passive limit on {}", "face"),
        (collapse.soil[1], "soil at its active limit on {}", "face"),
    ]
    found = ", ".join(text.format(counted(n, word)) for n, text, word in words if n)
    return f"{found or 'no interface opens, slides or crushes'}; {_moving(model, collapse, failure)}"


def _moving(model: Model, collapse: Collapse, failure: Failure) -> str:
    """``12 of 52 free blocks move as one rigid part``."""
    moving = moving_blocks(model, collapse.parts)
    parts = len(failure.motions)
    if not parts:
        return "no block moves"
    how = "as one rigid part" if parts == 1 else f"in {parts} rigid parts"
    cells = model.soil_of_block[model.free] >= 0
    blocks, soil = model.free[~cells], model.free[cells]
    found = [f"{moving} of {counted(len(blocks), 'free block')}"] if len(blocks) or not len(soil) else []
    found += [f"{moving_cells(model, collapse.parts)} of {counted_of(model, soil)}"] if len(soil) else []
    verb = ("moves" if moving == 1 and not len(soil) else "move") + ("" if failure.explained == 1.0 else " mainly")
    return f"{' and '.join(found)} {verb} {how}"


def failure_sentences(model: Model, load_case: LoadCase, collapse: Collapse, failure: Failure) -> list[str]:
    """How much moves, then how each of the heaviest parts does."""
    if not collapse.motions:
        return ["No block moves."]
    share = moving_share(model, collapse.parts)
    text = f"The mechanism is {reach(share)}, {100 * share:.3g} % of the weight: {_moving(model, collapse, failure)}"
    if failure.explained < 1.0:
        text += (
            f". Distributed mechanism of {len(collapse.motions)} rigid parts, approximated by {len(failure.motions)}: "
            f"they reproduce {100 * failure.explained:.3g} % of the motion, as a volume-weighted square"
        )
    texts = [f"{text}.", *(_part_sentence(model, load_case, part) for part in failure.motions[:MOST_PARTS])]
    if len(failure.motions) > MOST_PARTS:
        texts.append(f"{counted(len(failure.motions) - MOST_PARTS, 'lighter part')} in the table below.")
    return texts + [_yield_words(model, line) for line in failure.yield_lines if failure.explained < 1.0]


def _part_sentence(model: Model, load_case: LoadCase, part: PartMotion) -> str:
    """``Part 1 (12 blocks of wall, x 2.2 .. 3.2 m, 20.8 % of the weight) turns about +y ..``."""
    motion = motion_words(model, part)
    if part.turns and not _is_far(model, part) and not _is_at_rest(part, _size_of(model, part)):
        motion += f", its centroid moving along {_way(part)}"
    if len(part.blocks) == len(model.free):
        return f"Everything that is free ({counted_of(model, part.blocks)}) {motion}."
    total = float(model.weights[model.free].sum())
    details = [group_words(model, part.blocks), span_words(model, part.blocks)]
    details += [f"{100 * part.weight / total:.3g} % of the weight"] if total > 0 else []
    if np.isin(load_case.question.giving_way, part.blocks).any():
        details.append("with the settling support")
    about = ", ".join(detail for detail in details if detail)
    return f"Part {part.number} ({about}) {motion}."


def motion_words(model: Model, part: PartMotion) -> str:
    """``turns about +y at (1, 0.5, 1)`` or ``moves along (0.8, 0, 0.6)``."""
    if not part.turns:
        return f"moves along {direction_words(part.direction)}"
    if _is_far(model, part):
        return f"moves along {_way(part)}, turning slightly about {direction_words(part.direction)}"
    place = np.round(part.axis_point, DIGITS - math.floor(math.log10(_size_of(model, part)))) + 0.0
    return f"turns about {direction_words(part.direction)} at {point_words(model, place)}"


def _is_far(model: Model, part: PartMotion) -> bool:
    """Whether the axis lies several sizes of the part away."""
    return bool(np.linalg.norm(part.axis_point - part.centroid) > FAR_AXIS * _size_of(model, part))


def _size_of(model: Model, part: PartMotion) -> float:
    low, high = extents_of(model, part.blocks)
    return float(np.linalg.norm(high - low))


def _is_at_rest(part: PartMotion, size: float) -> bool:
    """Whether the centroid of a part that turns moves by rounding only."""
    return float(np.linalg.norm(part.velocity)) < 10.0**-DIGITS * size * float(np.linalg.norm(part.rotation))


def _way(part: PartMotion) -> str:
    return direction_words(part.velocity / np.linalg.norm(part.velocity))


def _yield_words(model: Model, line: YieldLine) -> str:
    """``Part 1 breaks off part 2 along (7.6, 0.3, 0) - (0.4, 0.3, 5.4), 40 degrees to the horizontal.``"""
    points = " - ".join(point_words(model, np.round(point, 2)) for point in line.points)
    other = f"part {line.parts[1]}" if line.parts[1] else "the stationary blocks"
    return f"Part {line.parts[0]} breaks off {other} along {points}, {line.inclination:.0f} degrees to the horizontal."


# --- Tables ---------------------------------------------------------------------------------------------------------


T = TypeVar("T", HingeLine, SlidingPlane, Crack)


def mechanism_blocks(assembly: Assembly, load_case: LoadCase, failure: Failure) -> list[Block]:
    """Parts, then a table each for hinge lines, sliding planes and cracks."""
    model, contacts, blocks = assembly.model, assembly.contacts, part_table(assembly.model, failure.motions)
    if failure.hinge_lines:
        outward = curvature_sides(assembly.glued(load_case))
        blocks += apart(_hinge_table(model, contacts, outward, failure.hinge_lines))
    if failure.sliding_planes:
        blocks += apart(_sliding_table(model, contacts, failure.sliding_planes))
    blocks += apart(_crack_table(model, contacts, failure.cracks)) if failure.cracks else []
    return blocks + (apart(slip_table(model, contacts, failure.slip_lines)) if failure.slip_lines else [])


def part_table(model: Model, motions: Sequence[PartMotion]) -> list[Block]:
    """A table of the parts that move, the heaviest first."""
    rows = [
        [f"{part.number}: {group_words(model, part.blocks)}", motion_words(model, part), number(part.weight)]
        for part in motions[:MOST_ROWS]
    ]
    return table_of(["part", "motion", f"weight [{model.units.force}]"], rows, left=2, total=len(motions))


def _hinge_table(model: Model, contacts: Contacts, outward: FloatArray, lines: Sequence[HingeLine]) -> list[Block]:
    rows = [
        [
            *_joint(model, contacts, line.interfaces, line.clusters),
            point_words(model, line.start),
            f"{line.length:.4g}",
            direction_words(line.direction),
            hinge_side(contacts, outward, line) + ", slides" * line.slides + ", crushes" * line.crushes,
        ]
        for line in _shown(lines)
    ]
    length = model.units.length
    head = ["hinge lines", "parts", f"from [{length}]", f"length [{length}]", "about", "side"]
    return table_of(head, rows, left=6, total=len(lines))


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
    return f"{'+' if offset[axis] > 0 else '-'}{'xyz'[axis]}"


def _sliding_table(model: Model, contacts: Contacts, planes: Sequence[SlidingPlane]) -> list[Block]:
    """What slides over what, the direction in the plane, the share of the power that shear forces take there."""
    rows = [
        [
            *_joint(model, contacts, plane.interfaces, plane.clusters),
            point_words(model, plane.centroid),
            "twists" if plane.twists else direction_words(plane.direction),
            f"{plane.area:.4g}",
            percent(plane.shear_power_share),
        ]
        for plane in _shown(planes)
    ]
    length = model.units.length
    head = ["sliding planes", "parts", f"at [{length}]", "along", f"area [{length}2]", "shear work [%]"]
    return table_of(head, rows, left=4, total=len(planes))


def _crack_table(model: Model, contacts: Contacts, cracks: Sequence[Crack]) -> list[Block]:
    rows = []
    for crack in _shown(cracks):
        normals = contacts.normals[crack.interfaces]
        course = "stepped" if np.abs(normals @ normals[0]).min() < 0.5 else "one way"
        ends = (point_words(model, crack.start), point_words(model, crack.end))
        joint = _joint(model, contacts, crack.interfaces, crack.clusters)
        rows.append([*joint, *ends, course, f"{crack.area:.4g}"])
    length = model.units.length
    head = ["cracks", "parts", f"from [{length}]", f"to [{length}]", "joints", f"area [{length}2]"]
    return table_of(head, rows, left=5, total=len(cracks))


def _shown(found: Sequence[T]) -> list[T]:
    """All by their first interfaces, or of too many those that move or work most, these first."""
    if len(found) > MOST_ROWS:
        return list(found[:MOST_ROWS])
    return sorted(found, key=lambda each: int(each.interfaces[0]))


def _joint(model: Model, contacts: Contacts, interfaces: IntArray, parts: tuple[int, int]) -> list[str]:
    """``arch[2]/pier[0] and 7 more``, and ``2/0``: the part that moves, and against which; 0 is at rest."""
    a, b = contacts.bodies[int(interfaces[0])].tolist()
    first, second = model.body_name(a), model.body_name(b)
    if max(a, b) < len(model.blocks) and model.blocks.groups[a] == model.blocks.groups[b]:
        second = f"[{model.blocks.group_indices[b]}]"
    more = f" and {len(interfaces) - 1} more" if len(interfaces) > 1 else ""
    return [f"{first}/{second}{more}", f"{parts[0]}/{parts[1]}"]
