"""Response spectra of the points of a structure in time that the deck names."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.quantities.group import Field, Group
from mbla.results.quantities.history_tables import BASE_NAME
from mbla.results.record.scene import Scene, Values, as_text
from mbla.solution.time_history.history import PointSpectra

SPECTRA = Group[PointSpectra](
    lambda scene: scene.solved.solution.further.time_history.spectra,
    file="cases/*/time_history/spectra",
    part="spectra of points",
    unverified="time",
)
SPECTRA.fields(
    PointSpectra,
    periods=Field(
        "period of what stands on a point, from ten steps to the length of the history", "spectral_period", unit="time"
    ),
    damping=Field("its share of critical damping"),
    base=Field("spectral acceleration of the base over the same steps", "spectral_period axis", unit="acceleration"),
    points=Field(
        "spectral acceleration on each point that the deck names, of its absolute acceleration",
        "recorded_point spectral_period axis",
        unit="acceleration",
    ),
)


# --- In long form, as histories are -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class SpectraInRows:
    """Spectra period by period: the base first, then the points that the deck names."""

    names: list[str]
    found: PointSpectra

    @property
    def count(self) -> int:
        """Rows."""
        return len(self.found.periods) * len(self.names)


def spectra_in_rows(scene: Scene) -> SpectraInRows | None:
    """Of a load case that was followed in time."""
    found, asked = scene.solved.solution.further.time_history.spectra, scene.solved.load_case.time_history
    if found is None or asked is None:
        return None
    return SpectraInRows([BASE_NAME, *(point.name for point in asked.points)], found)


ROWS = Group[SpectraInRows](spectra_in_rows, files="table", table="spectra")


@ROWS.quantity(dims="row")
def point(of: SpectraInRows) -> Values:
    """Point that the deck names, or the base."""
    return as_text([name for name in of.names for _ in of.found.periods])


@ROWS.quantity(dims="row", unit="time")
def period(of: SpectraInRows) -> FloatArray:
    """Of what stands on it."""
    return np.tile(of.found.periods, len(of.names))


@ROWS.quantity(dims="row axis", unit="acceleration")
def spectral_acceleration(of: SpectraInRows) -> FloatArray:
    """Of what stands on it, with 5 % of critical damping: of the absolute acceleration of the point."""
    return np.concatenate([of.found.base[None], of.found.points]).reshape(-1, 3)
