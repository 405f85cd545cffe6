"""Decks followed in time for tests."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from mbla.assembly import build_assembly
from mbla.deck import read_deck_text
from mbla.errors import Message
from mbla.model import build_model
from mbla.model.pose import Pose
from mbla.solution.pushover.rest import at_rest
from mbla.solution.pushover.way import RATIO
from mbla.solution.settings import settings_for, solver_settings
from mbla.solution.time_history.checkpoint import Unfinished
from mbla.solution.time_history.follow import Followed, follow
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.progress import TimeProgress
from mbla.solution.time_history.step.dashpots import dashpots_of
from mbla.solution.time_history.step.march import March
from mbla.solution.time_history.step.moving_bodies import MovingBodies
from mbla.solution.time_history.step.time_state import TimeState
from mbla.solution.time_history.step_rows import StepRows


def deck_text(blocks: str, history: str, joint: str = "friction: 0.6", more: str = "") -> str:
    """A deck with a single load case, on a ground at z = 0."""
    return f"""mbla: 1
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{{joint}, stiffness: {{normal: 1.e10}}}}}}
blocks: {blocks}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}, joint: dry}}]
load_cases: {{case: {{time_history: {{{history}}}}}}}
{more}
"""


def followed(
    text: str, begin: Unfinished | None = None, stop: int = -1
) -> tuple[TimeHistoryResult, tuple[Message, ...], list[Followed]]:
    """The history of a deck, remarks, and what there was of it after a step."""
    deck = read_deck_text(text, Path("deck.yaml"))
    assembly = build_assembly(deck, build_model(deck))
    case = assembly.model.load_cases[0]
    so_far, kept = list[Callable[[], Followed]](), list[Followed]()

    def watch(progress: TimeProgress) -> None:
        if progress.step == stop:
            kept.append(so_far[0]())

    settings = settings_for(case, solver_settings(deck.analysis))
    found, remarks = follow(assembly, deck.contacts, case, settings, watch, so_far.append, begin)
    return found, remarks, kept


def marched(text: str) -> tuple[March, TimeState]:
    """Steps of the structure of a deck, and its state at rest: to begin from another pose."""
    deck = read_deck_text(text, Path("deck.yaml"))
    assembly = build_assembly(deck, build_model(deck))
    bodies = MovingBodies.of(assembly, deck.contacts, assembly.model.load_cases[0])
    place, _ = at_rest(bodies.structure, RATIO)
    assert place is not None
    return March(bodies, 0.0), TimeState.at_rest(
        place, dashpots_of(bodies, place.joints, place.joints.unloaded(place.pose), 0.0)
    )


def turned_pose(march: March, axis: tuple[float, float, float], about: tuple[float, float, float], by: float) -> Pose:
    """Of the first body alone, turned about a point."""
    rotation = Rotation.from_rotvec(by * np.asarray(axis)).as_matrix()
    arm = march.bodies.structure.solids.model.blocks.centroids[0] - np.asarray(about)
    return Pose((rotation @ arm - arm)[None], rotation[None])


def out_of_balance(rows: StepRows) -> float:
    """Greatest energy that is not accounted for, over the greatest work that anything has done."""
    parts = (rows.kinetic, rows.potential, rows.contacts, rows.friction, rows.ties)
    taken = sum(parts[1:], parts[0])
    given = rows.base + rows.forces + rows.numerical
    largest = max(float(np.abs(each).max()) for each in (*parts, rows.base, rows.forces))
    return float(np.abs(taken - given).max()) / max(largest, 1e-300)
