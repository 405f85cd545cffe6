"""How a pushover starts: the state of its row 0, its control point there, and what keeps it from being done."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.model.pose import Pose, turns_and_slides
from mbla.program.build import crushable_interfaces
from mbla.program.reductions.scene import refined
from mbla.solution.pushover.control import Control
from mbla.solution.solution import Mechanics, Solution

SAME_STATE = 5e-3
"""Share of the load factor within which the least state of rigid joints is that of the path."""

AT_REST = 1e-9
"""Speed of the control point over the greatest with which it does not move."""

MORE_POINTS = "give contacts.points a per_edge or spacing"
"""What helps where joints crush as stress blocks, and have points at their corners alone."""

RESTS = "the control point does not move as the structure starts to: leave control out, or name blocks that move"
"""Why a curve has no displacement."""


def why_not_pushed(model: Model, contacts: Contacts, case: LoadCase, solution: Solution, solved: bool) -> str:
    """What keeps a pushover from being done, in words; empty where nothing does."""
    at_corners = solution.stress_blocks and crushes_at_corners(model, contacts)
    against = {
        "the load case is not solved": not solved or solution.mechanics is None,
        "the table collapses at no angle": case.question.tilts and bool(np.isnan(factor_at_start(case, solution))),
        "guided blocks turn and move besides": turns_and_slides(model.guides),
        f"joints can crush, which is followed at points: {MORE_POINTS}": at_corners,
        "nothing touches it": not len(contacts.points),
        "flow_rule: livesley": solution.flow_rule == "livesley",
        "contact_model: convex": solution.contact_model == "convex",
        RESTS: _rests(model, case, solution),
    }
    against |= dict.fromkeys(_above_start(case, solution), True)
    return ", ".join(words for words, holds in against.items() if holds)


def _above_start(case: LoadCase, solution: Solution) -> Iterator[str]:
    """In words: the end of the curve is asked for at no lower load factor than that of its beginning."""
    asked = case.pushover
    if asked is None or not case.question.multiplies or solution.mechanics is None:
        return
    first = start_of(solution).load_factor
    if asked.until_load_factor >= first > 0.0:
        words = f"its until_load_factor {asked.until_load_factor:g} is not below the load factor {first:.6g} at which "
        yield words + "the structure starts to move: give a lower one"


def crushes_at_corners(model: Model, contacts: Contacts) -> bool:
    """Whether an interface that can crush has contact points at its corners alone."""
    interface = contacts.interface_of_point
    grid = refined(interface, contacts.points, contacts.frames[:, 0])
    has_grid = np.bincount(interface, grid, len(contacts)) > 0.0
    return bool((crushable_interfaces(model, contacts) & ~has_grid).any())


def _rests(model: Model, case: LoadCase, solution: Solution) -> bool:
    """Whether the control point does not move at first."""
    if solution.mechanics is None:
        return False
    speed, greatest = speeds_at_start(model, case, solution)
    return not abs(speed) > AT_REST * greatest


def start_of(solution: Solution) -> Mechanics:
    """The state that a pushover starts from: of rigid joints where a search found it, else that of elastic ones."""
    own, least = solution.mechanics, solution.least
    assert own is not None  # else there is no curve
    if least is None or abs(least.load_factor - own.load_factor) > SAME_STATE * abs(own.load_factor):
        return own
    return least


def factor_at_start(case: LoadCase, solution: Solution) -> float:
    """Load factor of row 0; of a tilting table its angle in radians. nan where the structure does not start to move."""
    if solution.mechanics is None:
        return np.nan
    return case.question.followed(start_of(solution).load_factor)


def speeds_at_start(model: Model, case: LoadCase, solution: Solution) -> tuple[float, float]:
    """Of the control point, in its direction, as the structure starts to move, and the greatest of a block."""
    motion = start_of(solution).mechanism
    own = Control.of(model, case, motion).speed(model, Pose.at_rest(len(model.blocks)), motion)
    return own, float(np.linalg.norm(motion[:, :3], axis=1).max())


def no_pushover(against: str) -> Message:
    """The remark on what keeps a pushover from being done."""
    return Message("pushover-not-done", f"there is no pushover: {against}")
