"""A structure in time made by hand: the tower of the small results rocks about its edge and comes to rest.

It turns by φ(t) = 0.1 e^(-t) |sin πt| about its edge x = 1, y the axis, while the base moves by 0.05 sin πt along x.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.motion.signal import Signal
from mbla.model.motion.time_history import BaseMotion, ForceHistory, RecordedInterface, RecordedPoint, TimeHistory
from mbla.questions.time_history import PeakDisplacement
from mbla.results.results import CaseResult
from mbla.solution.further.further import Further
from mbla.solution.solution import Checks, Solution
from mbla.solution.time_history.frames import Frames, PointSet
from mbla.solution.time_history.history import HalfStep, Peaks, RecordedHistories, TimeHistoryResult
from mbla.solution.time_history.judged import judged
from mbla.solution.time_history.point_spectra import point_spectra
from mbla.solution.time_history.step_rows import HistoryEnd, StepRows

STEP, DURATION, EVERY = 0.01, 4.0, 0.1
GREATEST, BASE = 0.1, 0.05
WEIGHT, RADIUS = 10.0, float(np.hypot(0.5, 1.0))
N_BLOCKS, N_INTERFACES = 3, 2
NAN = float("nan")
NOT_CHECKED = Checks(NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, verified=True, failures=())


def turns(times: FloatArray) -> FloatArray:
    """Of the tower, rad."""
    found: FloatArray = GREATEST * np.exp(-times) * np.abs(np.sin(np.pi * times))
    return found


def shifts(times: FloatArray) -> FloatArray:
    """Of its centroid, (n, 3) m: about the edge, which is half of its width beside and half of its height below."""
    turn = turns(times)
    x = -0.5 * np.cos(turn) + 1.0 * np.sin(turn) + 0.5
    z = 0.5 * np.sin(turn) + 1.0 * np.cos(turn) - 1.0
    return np.column_stack([x, np.zeros(len(turn)), z])


def step_rows() -> StepRows:
    """Energies that balance: what the base gave, and the dead load did not gain, was lost across joints."""
    times = np.arange(0.0, DURATION + STEP / 2, STEP)
    none = np.zeros(len(times))
    potential = WEIGHT * shifts(times)[:, 2]
    kinetic = 0.3 * WEIGHT * np.exp(-2.0 * times) * np.sin(np.pi * times) ** 2 / 100.0
    contacts = 0.02 * WEIGHT * (1.0 - np.exp(-times))
    count = np.arange(len(times))
    return StepRows(
        times=times,
        kinetic=kinetic,
        potential=potential,
        elastic=none,
        friction=none,
        contacts=contacts,
        ties=none,
        base=kinetic + potential + contacts,
        forces=none,
        numerical=none,
        residuals=np.where(count == 0, np.nan, 1e-6),
        factorisations=2 * count,
        small_steps=8 * (count // 100),
        halved=count // 200,
        missed=np.zeros(len(times), dtype=np.int64),
        pressing=np.where(turns(times) > 1e-3, 2, 4),
    )


def points() -> PointSet:
    """The four corners under the tower."""
    corners = np.array([[-0.5, -0.5, -1.0], [0.5, -0.5, -1.0], [0.5, 0.5, -1.0], [-0.5, 0.5, -1.0]])
    below = corners + np.array([0.0, 0.0, 1.5])
    return PointSet(
        bodies=np.tile([0, 1], (4, 1)),
        host=np.zeros(4, dtype=np.bool_),
        arms=np.stack([below, corners], axis=1),
        frames=np.tile(np.array([[0.0, 0, 1], [1, 0, 0], [0, 1, 0]]), (4, 1, 1)),
        laws=np.zeros(4, dtype=np.int64),
        areas=np.full(4, 0.25),
        stiffness=np.tile([2.5e8, 1e8, 1e8], (4, 1)),
        dashpot=np.full(4, 1e-3),
    )


def frames() -> Frames:
    """Every ``EVERY`` seconds; the points that press share the weight."""
    times = np.arange(0.0, DURATION + EVERY / 2, EVERY)
    n = len(times)
    shift, turn = np.zeros((n, N_BLOCKS, 3)), np.zeros((n, N_BLOCKS, 3))
    shift[:, 1], turn[:, 1, 1] = shifts(times), turns(times)
    six = np.zeros((n, N_BLOCKS, 6))
    rocking = turns(times) > 1e-3
    share = np.where(rocking[:, None], [0.0, 0.5, 0.5, 0.0], 0.25)
    forces = np.zeros((n, 4, 3))
    forces[:, :, 0] = WEIGHT * share
    return Frames(
        times=times,
        lengths=np.full(n, STEP),
        lengths_before=np.where(times == 0.0, 0.0, STEP),
        shifts=shift,
        turns=turn,
        solid_of_block=np.arange(N_BLOCKS),
        momenta_before=six,
        momenta=six,
        velocities=six,
        base=np.column_stack([BASE * np.sin(np.pi * times), np.zeros(n), np.zeros(n)]),
        missed=np.zeros(n, dtype=np.bool_),
        set_of_frame=np.zeros(n, dtype=np.int64),
        point_start=4 * np.arange(n + 1),
        remembered=np.zeros((4 * n, 3)),
        forces=forces.reshape(-1, 3),
        sets=(points(),),
    )


def histories() -> RecordedHistories:
    """Of the middle of the tower, and of the interface under it."""
    times = np.arange(0.0, DURATION + STEP / 2, STEP)
    n = len(times)
    turn = turns(times)
    moved = shifts(times)[:, None]
    speed = np.gradient(moved, STEP, axis=0)
    base = np.zeros((n, 3, 3))
    base[:, :, 0] = BASE * np.column_stack(
        [np.sin(np.pi * times), np.pi * np.cos(np.pi * times), -(np.pi**2) * np.sin(np.pi * times)]
    )
    forces = np.zeros((n, 1, 3))
    forces[:, 0, 2] = WEIGHT
    return RecordedHistories(
        times=times,
        velocity_times=np.maximum(times - STEP / 2, 0.0),
        displacements=moved,
        velocities=speed,
        accelerations=np.gradient(speed, STEP, axis=0) + base[:, None, 2],
        base=base,
        openings=np.sin(turn)[:, None],
        slips=np.zeros((n, 1)),
        forces=forces,
    )


def ends() -> FloatArray:
    """Where the blocks end, (n, 6)."""
    found = np.zeros((N_BLOCKS, 6))
    found[1, 0] = 1e-3
    return found


def peaks() -> Peaks:
    """Over all steps; the brick stays."""
    moved = np.linalg.norm(shifts(step_rows().times), axis=1)
    none = np.zeros(N_BLOCKS)
    at = int(moved.argmax())
    return Peaks(
        displacements=np.array([0.0, moved[at], 0.0]),
        times=np.array([0.0, at * STEP, 0.0]),
        rotations=np.array([0.0, turns(step_rows().times).max(), 0.0]),
        residuals=np.array([0.0, 1e-3, 0.0]),
        ends=ends(),
        wanders=np.array([0.0, 2e-4, 0.0]),
        openings=np.array([float(np.sin(turns(step_rows().times).max())), 0.0]),
        slips=np.zeros(N_INTERFACES),
        falling=none + np.nan,
    )


def rocks() -> TimeHistoryResult:
    """All of it."""
    found = peaks()
    return TimeHistoryResult(
        end=HistoryEnd.DURATION,
        sag=1e-8,
        stiffness=(1e9, 4e8),
        period=0.02,
        damping=0.05,
        rows=step_rows(),
        frames=frames(),
        histories=histories(),
        peaks=found,
        spectra=point_spectra(asked(), histories()),
        half=HalfStep(1.01 * float(found.displacements.max()), 0.31, 1.1e-3, HistoryEnd.DURATION),
        searches=12,
        seconds=1.5,
    )


def asked() -> TimeHistory:
    """What the deck asks for."""
    times = np.linspace(0.0, DURATION, 401)
    signal = Signal(times, -(np.pi**2) * BASE * np.sin(np.pi * times))
    push = ForceHistory("push.csv on brick[0]", Signal(np.array([0.0, 1.0]), np.array([0.0, 1e-3])), np.zeros((3, 15)))
    return TimeHistory(
        motions=(BaseMotion("sine along (1, 0, 0)", signal, np.array([1.0, 0.0, 0.0])),),
        forces=(push,),
        step=STEP,
        duration=DURATION,
        damping=0.05,
        contact_damping=0.3,
        every=EVERY,
        points=(RecordedPoint("middle", 1, np.array([0.5, 0.5, 2.0])),),
        interfaces=(RecordedInterface("foot", np.array([0, 1])),),
        stop_displacement=np.inf,
        stop_at_rest=False,
        rigid=(np.array([2]),),
        check=False,
        dead_levers=np.zeros((3, 9)),
        dead_following=np.zeros((3, 6)),
    )


def rocking_case(case: CaseResult, **changed: Any) -> CaseResult:
    """A case of the tower as if it had been followed in time."""
    load_case = replace(case.load_case, name="shaken", time_history=asked(), question=PeakDisplacement())
    found = replace(rocks(), **changed)
    status, reason = judged(load_case, found)
    solution = Solution("non_associative", status, reason=reason, further=Further(time_history=found))
    return CaseResult(load_case, solution, NOT_CHECKED, status)
