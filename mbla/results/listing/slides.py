"""Who moves against whom, and how sliding parts move, in words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.collapse import Failure
from mbla.results.collapse.joint_planes import SlidingPlane
from mbla.results.collapse.mechanics import Work
from mbla.results.collapse.rigid_parts import PartMotion
from mbla.results.listing.places import direction_words, point_words
from mbla.results.listing.text import counted, percent

LONGEST = 30
"""characters of the label of a ground up to which it is named in a sentence"""


def part_name(model: Model, failure: Failure, number: int) -> str:
    """``part 2``; ``it`` where everything moves as one, ``the stationary blocks`` for 0."""
    if number == 0:
        return "the stationary blocks"
    return "it" if moves_whole(model, failure.motions[0]) else f"part {number}"


def moves_whole(model: Model, part: PartMotion) -> bool:
    """Whether the part is everything that can move."""
    return len(part.blocks) == len(model.free)


def other_name(model: Model, contacts: Contacts, failure: Failure, number: int, interfaces: IntArray) -> str:
    """The same; the stationary by their name where it is one body: ``ground z = 0``, ``base[0]``.

    interfaces : (n,) those between the two parts
    """
    if number:
        return part_name(model, failure, number)
    rests = np.append(failure.clusters, np.zeros(len(model.grounds), dtype=np.int64)) == 0
    bodies = contacts.bodies[interfaces]
    found = np.unique(bodies[rests[bodies]])
    if len(found) == 1:
        name = model.body_name(int(found[0]))
        if len(name) <= LONGEST:
            return name
    supports = np.append(model.fixed, np.ones(len(model.grounds), dtype=bool))
    return "the supports" if len(found) and supports[found].all() else "the stationary blocks"


# --- Sliding in plain sentences -------------------------------------------------------------------------------------


MOST_SLIDES = 2
"""movements that are told; the table holds more, the result files all"""
SAME_WAY = 0.9
"""cosine from which planes of the same two parts are told together"""
UNDER_FORCE = 5e-4
"""share of the power above which sliding is said to take work: what is written as 0.1 % or more"""


def slide_sentences(model: Model, contacts: Contacts, failure: Failure, work: Work) -> list[str]:
    """Planes of the same two parts and direction in one sentence, those that take most work first."""
    runs = _runs(failure.sliding_planes)
    working = [run for run in runs if _takes_work(run)]
    idle = sum(len(plane.interfaces) for run in runs if not _takes_work(run) for plane in run)
    sliding = [line for line in failure.hinge_lines if line.slides]
    texts = [_slide_sentence(model, contacts, failure, run) for run in working[:MOST_SLIDES]]
    if len(working) > MOST_SLIDES:
        left = sum(plane.shear_power_share for run in working[MOST_SLIDES:] for plane in run)
        more = counted(len(working) - MOST_SLIDES, "more movement")
        takes = "" if np.isnan(left) else f", {percent(left)} % of the work"
        texts.append(f"{more} of this kind in the table below{takes}.")
    in_hinges = sum(line.shear_power_share for line in sliding)
    if in_hinges >= UNDER_FORCE:
        slide = "slides" if len(sliding) == 1 else "slide"
        texts.append(f"{counted(len(sliding), 'hinge')} {slide} as well, {percent(in_hinges)} % of the work.")
    else:
        idle += len(sliding)
    if not texts:
        verb = "slides" if idle == 1 else "slide"
        how = "" if np.isnan(work.given) else " without doing work"
        texts.append(f"{counted(idle, 'joint')} {verb}{how}." if idle else "Nothing slides.")
    return texts + _balance(failure, work)


def _runs(planes: Sequence[SlidingPlane]) -> list[list[SlidingPlane]]:
    by_clusters: dict[tuple[int, int], list[list[SlidingPlane]]] = {}
    runs: list[list[SlidingPlane]] = []
    for plane in planes:
        known = by_clusters.setdefault(plane.clusters, [])
        fit = next((run for run in known if float(run[0].direction @ plane.direction) > SAME_WAY), None)
        if fit is None:
            known.append([plane])
            runs.append(known[-1])
        else:
            fit.append(plane)
    return runs


def _takes_work(planes: Sequence[SlidingPlane]) -> bool:
    """Where no power is put in at all, or none is known, whatever slides is told."""
    shear = sum(plane.shear_power_share for plane in planes)
    return bool(np.isnan(shear) or shear >= UNDER_FORCE)


def _slide_sentence(model: Model, contacts: Contacts, failure: Failure, planes: Sequence[SlidingPlane]) -> str:
    first = planes[0]
    number, other = first.clusters
    joints = sum(len(plane.interfaces) for plane in planes)
    area = sum(plane.area for plane in planes)
    where = counted(joints, "joint") + (f" in {len(planes)} planes" if len(planes) > 1 else "")
    shear = sum(plane.shear_power_share for plane in planes)
    share = "" if np.isnan(shear) else f", {percent(shear)} % of the work"
    does = "twists on" if first.twists else "slides over"
    way = "" if first.twists else f" along {direction_words(first.direction)}"
    at = ("at " if len(planes) == 1 else "mostly at ") + point_words(model, first.centroid)
    interfaces = np.concatenate([plane.interfaces for plane in planes])
    what = other_name(model, contacts, failure, other, interfaces)
    who = part_name(model, failure, number)
    who = who[0].upper() + who[1:]
    return f"{who} {does} {what}{way}: {where}, {area:.4g} {model.units.length}2, {at}{share}."


def _balance(failure: Failure, work: Work) -> list[str]:
    """What sliding takes that no sentence tells, and what normal forces of joints that lift give back."""
    given = work.given
    if not given > 0:
        return []
    told = sum(plane.shear_power_share for plane in failure.sliding_planes) + sum(
        line.shear_power_share for line in failure.hinge_lines
    )
    within = float(work.friction.sum() + work.cohesion.sum()) / given - told
    texts = [f"Sliding within the parts: {percent(within)} % of the work."] if within >= UNDER_FORCE else []
    back = -float(work.normal.sum()) / given
    if back >= UNDER_FORCE:
        texts.append(f"Dilatancy of the sliding joints: their normal forces do {percent(-back)} % of the work.")
    return texts
