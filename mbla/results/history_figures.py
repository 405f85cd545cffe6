"""Figures of a structure in time: what it does at most, what stays, what falls, and how well energies balance."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.model.model import LoadCase
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.judged import change_by_half_step
from mbla.solution.time_history.step_rows import StepRows

TAKEN, GIVEN = ("kinetic", "potential", "contacts", "friction", "ties"), ("base", "forces", "numerical")
"""sides of the balance of energies, by their names in the rows of steps"""


@dataclass(frozen=True)
class HistoryFigures:
    """Of a structure that was followed in time, from rest.

    peak, peak_time, peak_block : greatest displacement of the centre of a block relative to the base, m, when, which
    residual, residual_uncertainty, residual_block : greatest displacement at the end, m, and its uncertainty
    falls, fall_time, fallen : first block that has fallen by half of its height, -1 for none, when, and how many have
    opening, opening_interface, slip, slip_interface : greatest of all interfaces, m, and of which; -1 without any
    lasted      : s
    steps, halved, missed, small_steps, factorisations : of the deck; those that were halved, small ones that did not
                  converge, those made in the place of one of the deck
    balance     : largest error of the balance of energies, over the largest of them
    peak_of_half_step, half_step : peak with half of the step, m, and its change over the peak; nan where not known
    """

    peak: float
    peak_time: float
    peak_block: int
    residual: float
    residual_uncertainty: float
    residual_block: int
    falls: int
    fall_time: float
    fallen: int
    opening: float
    opening_interface: int
    slip: float
    slip_interface: int
    lasted: float
    steps: int
    halved: int
    missed: int
    small_steps: int
    factorisations: int
    balance: float
    peak_of_half_step: float
    half_step: float

    @property
    def range_of_peak(self) -> tuple[float, float]:
        """The lesser and the greater with the step and with half of it, no bounds of it; nan where not known."""
        both = self.peak, self.peak_of_half_step
        return (math.nan, math.nan) if math.isnan(both[1]) else (min(both), max(both))


def history_figures(found: TimeHistoryResult) -> HistoryFigures | None:
    """None where it does not stand at the begin."""
    peaks, rows = found.peaks, found.rows
    if peaks is None or rows is None:
        return None
    most, stays, falls = peaks.block, int(peaks.residuals.argmax()), peaks.first_to_fall
    opening, opens = _greatest(peaks.openings)
    slip, slips = _greatest(peaks.slips)
    return HistoryFigures(
        peak=float(peaks.displacements[most]),
        peak_time=float(peaks.times[most]),
        peak_block=most,
        residual=float(peaks.residuals[stays]),
        residual_uncertainty=_uncertainty(found, stays),
        residual_block=stays,
        falls=falls,
        fall_time=float(peaks.falling[falls]) if falls >= 0 else math.nan,
        fallen=int(np.isfinite(peaks.falling).sum()),
        opening=opening,
        opening_interface=opens,
        slip=slip,
        slip_interface=slips,
        lasted=float(rows.times[-1]),
        steps=len(rows) - 1,
        halved=int(rows.halved[-1]),
        missed=int(rows.missed[-1]),
        small_steps=int(rows.small_steps[-1]),
        factorisations=int(rows.factorisations[-1]),
        balance=balance_error(rows),
        peak_of_half_step=math.nan if found.half is None else found.half.peak,
        half_step=change_by_half_step(found),
    )


def _uncertainty(found: TimeHistoryResult, block: int) -> float:
    """Of the displacement of a block at the end: by how much it still varied, half of the step changes it, joints give.

    What half of the step changes is that of the block that has the greatest there.
    """
    peaks = found.peaks
    assert peaks is not None
    by_step = 0.0 if found.half is None else abs(found.half.residual - float(peaks.residuals[block]))
    sag = 0.0 if math.isnan(found.sag) else found.sag
    return max(float(peaks.wanders[block]), by_step, sag)


def _greatest(values: FloatArray) -> tuple[float, int]:
    if not len(values):
        return 0.0, -1
    at = int(values.argmax())
    return float(values[at]), at


def balance_error(rows: StepRows) -> float:
    """Largest difference of both sides of the balance in any step, over the largest energy of any step."""
    taken = np.sum([getattr(rows, name) for name in TAKEN], axis=0)
    given = np.sum([getattr(rows, name) for name in GIVEN], axis=0)
    largest = max(float(np.abs(getattr(rows, name)).max()) for name in (*TAKEN, *GIVEN))
    return float(np.abs(taken - given).max()) / max(largest, 1e-300)


def drift_of(assembly: Assembly, case: LoadCase, figures: HistoryFigures) -> float:
    """The peak over the height of the centre of its block above the lowest contact point at a support; nan without.

    Heights are against the dead load.
    """
    model, contacts = assembly.model.of_case(case), assembly.contacts
    bodies = np.append(model.fixed, np.ones(len(model.grounds), dtype=np.bool_))
    held = np.any(bodies[contacts.bodies], axis=1)[contacts.interface_of_point]
    points = contacts.points[held]
    weight = case.dead_load[model.free, :3].sum(axis=0)
    size = float(np.linalg.norm(weight))
    if not len(points) or not size > 0.0:
        return math.nan
    up = -weight / size
    height = float(model.blocks.centroids[figures.peak_block] @ up - (points @ up).min())
    return figures.peak / height if height > 0.0 else math.nan
