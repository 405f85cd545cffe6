"""The mechanism of a case in words: its parts, how they move, and the fall of a structure without equilibrium."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from mbla.arrays import IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.collapse import Collapse, Failure, collapse_of, failure_of, fall_of
from mbla.results.collapse.cracks import Crack
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.joint_planes import HingeLine, SlidingPlane
from mbla.results.collapse.rigid_parts import PartMotion, moving_blocks
from mbla.results.collapse.thrust import curvature_sides
from mbla.results.listing.failure_words import as_parts, crack_kind, failure_sentences, hinge_side
from mbla.results.listing.places import TABLE_DIGITS, block_names, direction_words, point_words
from mbla.results.listing.text import MOST_ROWS, counted, number, percent, sentence, table
from mbla.results.results import CaseResult

LONGEST = 40
"""characters up to which the blocks of parts are named; beyond, their groups: the sentences say more"""


def part_lines(model: Model, motions: Sequence[PartMotion]) -> list[str]:
    """A table of the parts that move, the heaviest first."""
    shown = motions[:MOST_ROWS]
    names = [f"{each.number}: {block_names(model, each.blocks)}" for each in shown]
    if max(map(len, names), default=0) > LONGEST:
        names = [f"{each.number}: {_groups(model, each)}" for each in shown]
    rows = [
        [
            name,
            motion_words(model, each),
            str(len(each.blocks)),
            number(each.weight),
        ]
        for name, each in zip(names, shown, strict=True)
    ]
    if not rows:
        return []
    head = ["part", "motion", "blocks", f"weight [{model.units.force}]"]
    more = sentence(f"and {len(motions) - MOST_ROWS} lighter ones; the result files hold them all")
    return [*table(head, rows, left=2), *(more if len(motions) > MOST_ROWS else [])]


def _groups(model: Model, part: PartMotion) -> str:
    """``junction``, ``wall and 2 more``: the groups of a part, that with most blocks first."""
    counts = Counter(model.blocks.groups[block] for block in part.blocks.tolist()).most_common()
    return str(counts[0][0]) + (f" and {len(counts) - 1} more" if len(counts) > 1 else "")


def motion_words(model: Model, part: PartMotion) -> str:
    """``turns about +y at (1, 0.5, 1)`` or ``moves along (0.8, 0, 0.6)``."""
    if not part.turns:
        return f"moves along {direction_words(part.direction, TABLE_DIGITS)}"
    return f"turns about {direction_words(part.direction, TABLE_DIGITS)} at {point_words(model, part.axis_point)}"


# --- Mechanisms in tables: the parts that move, hinge lines, sliding planes and cracks between them -----------------


T = TypeVar("T", HingeLine, SlidingPlane, Crack)

MANY = 40
"""joints beyond which their number says less than what moves"""


def mechanism_summary(model: Model, collapse: Collapse, failure: Failure) -> str:
    """``4 hinges, sliding at 2 interfaces; 23 of 27 free blocks move in 3 parts``; parts as they are told and drawn.

    Of a mechanism of many joints first what moves, then how many they are.
    """
    count = collapse.interfaces.count
    moving = moving_blocks(model, collapse.parts)
    words = [
        (count(InterfaceMode.HINGE), "{}", "hinge"),
        (count(InterfaceMode.SLIDE), "sliding at {}", "interface"),
        (count(InterfaceMode.TWIST), "twisting at {}", "interface"),
        (count(InterfaceMode.OPEN), "{} open", "interface"),
        (int(collapse.interfaces.crushes.sum()), "crushing at {}", "interface"),
    ]
    found = (
        ", ".join(text.format(counted(n, word)) for n, text, word in words if n)
        or "no interface opens, slides or crushes"
    )
    verb = "moves" if moving == 1 else "move"
    blocks = f"{moving} of {counted(len(model.free), 'free block')} {verb}"
    if failure.spreads:
        return f"{blocks}, mainly as {as_parts(len(failure.main.motions))}; {found}"
    if sum(n for n, _, _ in words) > MANY:
        return f"{blocks}{_told_parts(failure)}; {found}"
    return f"{found}; {blocks}{_told_parts(failure)}"


def _told_parts(failure: Failure) -> str:
    """How many parts; where small motions within them are left out, that the blocks move as so many."""
    count = len(failure.motions)
    if failure.merged:
        return f" as {counted(count, 'rigid part')}"
    return f" in {count} rigid parts" if count > 1 else ""


def mechanism_lines(model: Model, contacts: Contacts, failure: Failure) -> list[str]:
    """Parts, then a table each for hinge lines, sliding planes and cracks."""
    return [
        *part_lines(model, failure.motions),
        *_hinge_table(model, contacts, failure.hinge_lines),
        *_sliding_table(model, contacts, failure.sliding_planes),
        *_crack_table(model, contacts, failure.cracks),
    ]


def _hinge_table(model: Model, contacts: Contacts, lines: Sequence[HingeLine]) -> list[str]:
    outward = curvature_sides(model, contacts)
    rows = [
        [
            _interfaces(model, contacts, line.interfaces),
            _parts(line.clusters),
            point_words(model, line.start),
            number(float(f"{line.length:.4g}")),
            direction_words(line.direction, TABLE_DIGITS),
            hinge_side(contacts, outward, line).removesuffix(" side")
            + (", slides" if line.slides else "")
            + (", crushes" if line.crushes else ""),
        ]
        for line in _shown(lines)
    ]
    length = model.units.length
    head = ["hinge lines", "parts", f"from [{length}]", f"length [{length}]", "about", "side"]
    return _table(head, rows, len(lines), 6)


def _sliding_table(model: Model, contacts: Contacts, planes: Sequence[SlidingPlane]) -> list[str]:
    """What slides over what, the direction in the plane, the share of the power that shear forces take there."""
    rows = [
        [
            _interfaces(model, contacts, plane.interfaces),
            _parts(plane.clusters),
            point_words(model, plane.centroid),
            "twists" if plane.twists else direction_words(plane.direction, TABLE_DIGITS),
            number(float(f"{plane.area:.4g}")),
            percent(plane.shear_power_share),
        ]
        for plane in _shown(planes)
    ]
    length = model.units.length
    head = ["sliding planes", "parts", f"at [{length}]", "along", f"area [{length}2]", "shear work [%]"]
    return _table(head, rows, len(planes), 4)


def _crack_table(model: Model, contacts: Contacts, cracks: Sequence[Crack]) -> list[str]:
    rows = [
        [
            _interfaces(model, contacts, crack.interfaces),
            _parts(crack.clusters),
            point_words(model, crack.start),
            point_words(model, crack.end),
            crack_kind(contacts, crack).strip() or "one way",
            number(float(f"{crack.area:.4g}")),
        ]
        for crack in _shown(cracks)
    ]
    length = model.units.length
    head = ["cracks", "parts", f"from [{length}]", f"to [{length}]", "joints", f"area [{length}2]"]
    return _table(head, rows, len(cracks), 5)


def _shown(found: Sequence[T]) -> list[T]:
    """All by their first interfaces, or of too many those that move or work most, these first."""
    if len(found) > MOST_ROWS:
        return list(found[:MOST_ROWS])
    return sorted(found, key=lambda each: int(each.interfaces[0]))


def _table(head: list[str], rows: list[list[str]], total: int, left: int) -> list[str]:
    if not rows:
        return []
    more = sentence(f"and {total - len(rows)} more that move less; the result files hold them all")
    return ["", *table(head, rows, left=left), *(more if total > len(rows) else [])]


def _parts(clusters: tuple[int, int]) -> str:
    """``2/0``: that which moves, and against what; 0 is at rest."""
    return f"{clusters[0]}/{clusters[1]}"


def _interfaces(model: Model, contacts: Contacts, interfaces: IntArray) -> str:
    """``arch[2]/[3]`` in one group, ``arch[2]/pier[0]``, with ``and 7 more`` behind the first of several."""
    a, b = contacts.bodies[int(interfaces[0])].tolist()
    more = f" and {len(interfaces) - 1} more" if len(interfaces) > 1 else ""
    first, second = model.body_name(a), model.body_name(b)
    if max(a, b) < len(model.blocks) and model.blocks.groups[a] == model.blocks.groups[b]:
        second = f"[{model.blocks.group_indices[b]}]"
    return f"{first}/{second}{more}"


# --- How a structure without equilibrium falls, in the words of any other failure -----------------------------------


LIFTS = (
    "The motion is one of associative flow, in which joints dilate as they slide: it proves that nothing holds the "
    "structure, and need not be the way in which it falls."
)
"""what the motion is worth as a picture of the fall, where anything slides in it"""


@dataclass(frozen=True)
class Told:
    """How a case fails, or falls without equilibrium; the sentences are read in their order, tables follow."""

    collapse: Collapse
    failure: Failure
    sentences: list[str]


def told_of(model: Model, contacts: Contacts, case: CaseResult) -> Told | None:
    """From the mechanism, a result or not; None without any motion.

    Without equilibrium the live load does not act yet, and says no way.
    """
    load_case, mechanics, certificate = case.load_case, case.solution.mechanics, case.solution.certificate
    remark = []
    if mechanics is not None:
        collapse = collapse_of(model, contacts, load_case, mechanics)
    elif certificate is not None:
        collapse, mechanics = fall_of(model, contacts, certificate)
        load_case = replace(load_case, live_load=np.zeros_like(load_case.live_load))
        remark = [LIFTS] if collapse.interfaces.slides.any() else []
    else:
        return None
    failure = failure_of(model, contacts, collapse, mechanics)
    return Told(collapse, failure, failure_sentences(model, contacts, load_case, collapse, failure) + remark)
