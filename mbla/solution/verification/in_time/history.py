"""Verification of a time history: frames, rows, histories, peaks and end, from what is stored and the deck alone.

Tolerances are relative. Momentum and energy are exact in every step but for rounding and what a file keeps of them; the
law holds to the velocity that a step may leave out of balance.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import evenly
from mbla.assembly.assembly import Assembly
from mbla.errors import Message
from mbla.model.model import LoadCase
from mbla.solution.time_history.frames import Frames
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.step_rows import HistoryEnd
from mbla.solution.verification.in_time.bodies import MovedSolids, Solids, solids_of
from mbla.solution.verification.in_time.following import following_failures
from mbla.solution.verification.in_time.frames import FrameCheck, FrameResidual
from mbla.solution.verification.in_time.joints import points_failures
from mbla.solution.verification.in_time.overlaps import deepest_corner
from mbla.solution.verification.in_time.peaks import PeakCheck
from mbla.solution.verification.in_time.points import HistoryCheck
from mbla.solution.verification.in_time.rows import RowResidual, row_residual
from mbla.solution.verification.in_time.said import end_failures, frames_failures, said_failures
from mbla.solution.verification.in_time.spectra import spectra_failures
from mbla.solution.verification.in_time.works import works, works_failures

LAW = 1e-3
"""Force off the law over the largest of the frame."""
CLOSING = 6e-3
"""Velocity that explains a force off the law, over that of free fall in the step: a step is solved to 1e-3 of it in the
mean of the bodies, by their masses; a corner may be √3 faster by the turn of its body, and two bodies meet."""
MOMENTUM = 1e-6
"""Impulse that a body lacks, over the mean load of a body times the step."""
VELOCITIES = 1e-4
"""Velocity that is not that of the momentum: the inertia half a step ahead is known to twice the turn of a step."""
KINETIC = 1e-3
"""Kinetic energy that is not that of the momentum, over the greatest energy: the inertia of the step before is known to
what its turn and that of the step before it differ by."""
APART = 1e-6
"""Distance of blocks from where their body takes them, over its size."""
ENERGY = 1e-6
"""Energy that a row lacks, or has beside its frame, over the greatest, or dead load times sag where that is more."""
OVERLAP = 0.05
"""Overlap of bodies over the size of the smaller, beyond which they are not beside each other."""

POSES = 20
"""Frames in which blocks are held against each other, contact points or not."""


WITHOUT_ROWS = (HistoryEnd.NONE, HistoryEnd.NO_REST, HistoryEnd.LATE, HistoryEnd.STOPPED)
"""Ends of what may have made no step."""


@dataclass(frozen=True)
class TimeChecks:
    """What was found of a time history, the largest of all frames and rows; each is explained where it is computed.

    law, closing, momentum, velocities, overlap : :class:`FrameResidual`
    balance, kinetic, potential, base : :class:`RowResidual`
    """

    law: float
    closing: float
    momentum: float
    velocities: float
    overlap: float
    balance: float
    kinetic: float
    potential: float
    base: float


def history_failures(
    assembly: Assembly, case: LoadCase, result: TimeHistoryResult
) -> tuple[TimeChecks | None, tuple[Message, ...]]:
    """What a time history shows of itself, and what is not as it should be; None where nothing was followed in time."""
    history, rows, frames = case.time_history, result.rows, result.frames
    if history is None or (rows is None and result.end in WITHOUT_ROWS):
        return None, ()
    if rows is None or frames is None or result.peaks is None or result.histories is None:
        return None, (Message("time-frames", "the time history has no rows, frames, histories or peaks"),)
    solids = solids_of(assembly, case)
    failures = list(frames_failures(history, solids, rows, frames))
    if not failures:
        failures += points_failures(assembly.contacts, case, solids, frames)
    if any(failure.identifier != "time-base" for failure in failures):
        return None, tuple(failures)
    check = FrameCheck.of(case, history, solids, frames)
    residuals, done = [], []
    for frame in range(len(frames)):
        contact = check.contact(frame)
        residuals.append(check.residual(frame, contact))
        done.append(works(check, frame, contact))
    of_rows = row_residual(case, history, solids, rows, frames)
    failures += _residual_failures(frames, residuals)
    failures += _overlap_failures(solids, frames)
    failures += following_failures(check)
    failures += _energy_failures(of_rows)
    failures += works_failures(check, rows, np.array(done))
    failures += said_failures(history, frames, result)
    contacts = assembly.contacts
    failures += HistoryCheck.of(contacts, history, solids, rows, frames, result.histories).failures()
    failures += spectra_failures(history, result.histories, result.spectra)
    failures += PeakCheck(case, contacts, history, solids, rows, frames, result.peaks).failures()
    failures += end_failures(case, history, solids, rows, result.peaks, result.end)
    return _checks(residuals, of_rows), tuple(failures)


def _checks(residuals: Sequence[FrameResidual], of_rows: RowResidual) -> TimeChecks:
    def most(name: str) -> float:
        return float(np.max([getattr(each, name) for each in residuals]))

    names = ("law", "closing", "momentum", "velocities", "overlap")
    parts = {name: getattr(of_rows, name) for name in ("balance", "kinetic", "potential", "base")}
    return TimeChecks(**{name: most(name) for name in names}, **parts)


def _residual_failures(frames: Frames, residuals: Sequence[FrameResidual]) -> Iterator[Message]:
    """By frames; of those that the run says it missed the law need not hold."""
    missed = frames.missed.tolist()
    laws = [0.0 if off or each.closing <= CLOSING else each.law for off, each in zip(missed, residuals, strict=True)]
    limits = (
        ("time-law", "forces are off the law of their joints by {:.2g}", laws, LAW),
        ("time-law", "joints that cannot crush remember {:.2g} of a force", [each.memory for each in residuals], LAW),
        ("time-momentum", "momentum lacks {:.2g}", [each.momentum for each in residuals], MOMENTUM),
        (
            "time-velocities",
            "velocities are off momenta by {:.2g}",
            [each.velocities for each in residuals],
            VELOCITIES,
        ),
        ("time-points", "bodies overlap by {:.2g} of their size", [each.overlap for each in residuals], OVERLAP),
        ("time-frames", "blocks are {:.2g} apart from their body", [each.apart for each in residuals], APART),
    )
    for identifier, words, values, limit in limits:
        off = [not value <= limit for value in values]
        if any(off):
            worst = off.index(True) if np.isnan(values).any() else int(np.argmax(values))
            at = f", at {frames.times[worst]:.4g} s, which exceeds {limit:g}"
            yield Message(identifier, words.format(values[worst]) + at)


def _overlap_failures(solids: Solids, frames: Frames) -> Iterator[Message]:
    """Where blocks lie in each other that no contact point keeps apart."""
    for frame in evenly(len(frames), POSES):
        depth = deepest_corner(MovedSolids(solids, frames.shifts[frame], frames.turns[frame]))
        if not depth <= OVERLAP:
            words = (
                f"a block lies in another, or below ground, by {depth:.2g} of its size, at {frames.times[frame]:.4g} s"
            )
            yield Message("time-points", words)
            return


def _energy_failures(found: RowResidual) -> Iterator[Message]:
    limits = (
        ("the energies of a row do not sum up, by {:.2g}", found.balance, ENERGY),
        ("the kinetic energy of a row is off the momenta of its frame by {:.2g}", found.kinetic, KINETIC),
        ("what the dead load gains is off the poses of a frame by {:.2g}", found.potential, ENERGY),
        ("the base does more in a step than bodies so fast can be given, by {:.2g}", found.base, ENERGY),
    )
    for words, value, limit in limits:
        if not value <= limit:
            yield Message("time-energy", f"{words.format(value)} of the greatest energy, which exceeds {limit:g}")
