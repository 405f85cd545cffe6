"""A structure in time as an object of the JSON record; what it did only where that is a result."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.motion.spectrum import spectral_acceleration
from mbla.model.motion.time_history import BaseMotion
from mbla.results.history_damage import HistoryDamage, history_damage
from mbla.results.history_figures import HistoryFigures, drift_of
from mbla.results.listing.history_verdict import history_verdict
from mbla.results.outcome import history_of
from mbla.results.quantities.group import Field
from mbla.results.quantities.time_history import HALF_STEP, RESULT, followed
from mbla.results.record.objects import Object
from mbla.results.record.scene import Scene
from mbla.results.spectral_peak import SpectralPeak, spectral_peak
from mbla.solution.time_history.history import PointSpectra, RecordedHistories
from mbla.solution.time_history.step_rows import StepRows
from mbla.solution.time_history.still_moves import still_moves

TIME_HISTORY = Object[Scene](
    *(quantity for quantity in RESULT.quantities if quantity.name != "seconds"),
    owner=lambda scene: None if followed(scene) is None else scene,
)
ENERGIES, POINT, MOTION = Object[StepRows](), Object["PointPeaks"](), Object["Shaking"]()
SPECTRAL = Object[SpectralPeak]()
SPECTRAL.fields(
    SpectralPeak,
    axis=Field("along which it is: x, y or z"),
    period=Field("of what stands there", unit="time"),
    value=Field("spectral acceleration, with 5 % damping", unit="acceleration"),
)


@TIME_HISTORY.key()
def verdict(scene: Scene) -> str:
    """What the structure does, in one sentence."""
    return history_verdict(scene.model, scene.solved)


def _declare(name: str, kind: str, words: str, of: Callable[[Scene, HistoryFigures], object], unit: str = "1") -> None:
    """A figure of what it did; null where that is no result."""

    def figure(scene: Scene) -> object:
        found = history_of(scene.solved)
        return None if found is None else of(scene, found)

    figure.__annotations__["return"] = f"{kind} | None"
    TIME_HISTORY.key(name=name, words=words, unit=unit)(figure)


def _block(scene: Scene, number: int) -> str | None:
    return scene.model.blocks.name(number) if number >= 0 else None


_declare(
    "peak",
    "float",
    "greatest displacement of the centre of a block relative to the base",
    lambda _, f: f.peak,
    "length",
)
_declare(
    "lower", "float", "lesser peak with the step and half of it; no bound", lambda _, f: f.range_of_peak[0], "length"
)
_declare("upper", "float", "greater peak with these; no bound", lambda _, f: f.range_of_peak[1], "length")
_declare("peak_time", "float", "when that was", lambda _, f: f.peak_time, "time")
_declare("peak_block", "str", "which block", lambda scene, f: _block(scene, f.peak_block))
_declare(
    "drift",
    "float",
    "the peak over the height of that centre above the lowest support",
    lambda scene, f: drift_of(scene.assembly, scene.solved.load_case, f),
)
_declare("residual", "float", "greatest displacement at the end", lambda _, f: f.residual, "length")
_declare(
    "residual_uncertainty",
    "float",
    "by how much that still varied, half of the step changes it, or joints give, whichever is most",
    lambda _, f: f.residual_uncertainty,
    "length",
)
_declare("falls", "str", "block that falls first, by half of its height", lambda scene, f: _block(scene, f.falls))
_declare("fall_time", "float", "when it had", lambda _, f: f.fall_time, "time")
_declare("fallen", "int", "blocks that have fallen", lambda _, f: f.fallen)
_declare(
    "still_moves",
    "bool",
    "whether it still moves far at its end, none having fallen: then whether one falls later is not known",
    lambda scene, _: still_moves(scene.model, scene.solved.solution.further.time_history),
)
_declare("opening", "float", "greatest opening of an interface", lambda _, f: f.opening, "length")
_declare("slip", "float", "greatest slip of an interface", lambda _, f: f.slip, "length")
_declare("lasted", "float", "how long it was followed", lambda _, f: f.lasted, "time")
_declare("steps", "int", "steps of the length that the deck asks for", lambda _, f: f.steps)
_declare("halved", "int", "steps that were halved", lambda _, f: f.halved)
_declare("small_steps", "int", "steps that were made in the place of one of the deck", lambda _, f: f.small_steps)
_declare("missed", "int", "smallest steps that did not converge", lambda _, f: f.missed)
_declare("factorisations", "int", "factorisations", lambda _, f: f.factorisations)
_declare("balance", "float", "error of the balance of energies over the largest of them", lambda _, f: f.balance)
_declare("change_by_half_step", "float", "change of the peak with half of the step, over it", lambda _, f: f.half_step)
_declare(
    "crushing",
    "float",
    "greatest depth by which a joint has crushed; null where none can crush",
    lambda scene, _: _damage(scene).crushing,
    "length",
)
TIME_HISTORY.holds("half_step", HALF_STEP, "the same with half of the step; null where not asked for")


@TIME_HISTORY.key("a time, by the name of the tie", unit="time")
def broken_ties(scene: Scene) -> dict[str, float]:
    """Ties that broke, and about when."""
    return {scene.model.ties.names[tie]: time for tie, time in _damage(scene).broken}


@TIME_HISTORY.key("the name of a tie")
def yielded_ties(scene: Scene) -> list[str]:
    """Ties that yielded and did not break."""
    return [scene.model.ties.names[tie] for tie in _damage(scene).yielded]


def _damage(scene: Scene) -> HistoryDamage:
    """None where what was followed is no result."""
    if history_of(scene.solved) is None:
        return HistoryDamage()
    return history_damage(scene.model, scene.solved.solution.further.time_history)


@TIME_HISTORY.key(inside=ENERGIES)
def energies(scene: Scene) -> StepRows | None:
    """At the end, those that were taken and those that were given; null where that is no result."""
    return None if history_of(scene.solved) is None else scene.solved.solution.further.time_history.rows


def _declare_energy(name: str, words: str) -> None:
    @ENERGIES.key(name=name, words=words, unit="moment")
    def energy(rows: StepRows) -> float:
        """At the end."""
        return float(getattr(rows, name)[-1])


for _name, _words in {
    "kinetic": "of motion in the frame of the base",
    "potential": "gained by the dead load",
    "elastic": "stored in joints and ties, a part of what they took",
    "contacts": "taken across joints",
    "friction": "taken along joints",
    "ties": "taken by ties",
    "base": "work of the motion of the base",
    "forces": "work of forces over time, and of dead loads that turn",
    "numerical": "numerical, of bodies that turn and steps that change",
}.items():
    _declare_energy(_name, _words)


@dataclass(frozen=True)
class Shaking:
    """A motion of the base, and the first period of the structure at rest, s, nan where it is not known."""

    motion: BaseMotion
    period: float


@TIME_HISTORY.key("a motion", inside=MOTION)
def motions(scene: Scene) -> list[Shaking]:
    """What moves the base."""
    asked, period = scene.solved.load_case.time_history, scene.solved.solution.further.time_history.period
    return [] if asked is None else [Shaking(motion, period) for motion in asked.motions]


@MOTION.key(name="words")
def motion_words(shaking: Shaking) -> str:
    """In words."""
    return shaking.motion.words


@MOTION.key(unit="acceleration")
def peak_acceleration(shaking: Shaking) -> float:
    """Greatest acceleration, of the whole motion though less of it be followed."""
    return shaking.motion.peak_acceleration


@MOTION.key(unit="speed")
def peak_velocity(shaking: Shaking) -> float:
    """Greatest velocity, likewise."""
    return shaking.motion.peak_velocity


@MOTION.key(unit="length")
def peak_displacement(shaking: Shaking) -> float:
    """Greatest displacement up to its end, likewise; after a pulse that leaves a velocity the base goes on."""
    return shaking.motion.peak_displacement


@MOTION.key(name="spectral_acceleration", unit="acceleration")
def at_first_period(shaking: Shaking) -> float | None:
    """With 5 % damping at the first period, of joints that stay closed at rest; null where that is not known."""
    period = shaking.period
    return spectral_acceleration(shaking.motion.signal, period) if math.isfinite(period) and period > 0.0 else None


@dataclass(frozen=True)
class PointPeaks:
    """A point that the deck names, in the histories and spectra of all of them."""

    name: str
    row: int
    found: RecordedHistories
    spectra: PointSpectra | None

    def sizes(self, values: FloatArray) -> FloatArray:
        """Of its vectors, (m,)."""
        return np.asarray(np.linalg.norm(values[:, self.row], axis=1))


@TIME_HISTORY.key("a point", inside=POINT)
def points(scene: Scene) -> list[PointPeaks]:
    """Peaks of the points that the deck names; none where they are no result."""
    asked, found = scene.solved.load_case.time_history, scene.solved.solution.further.time_history
    if asked is None or found.histories is None or history_of(scene.solved) is None:
        return []
    return [PointPeaks(point.name, row, found.histories, found.spectra) for row, point in enumerate(asked.points)]


POINT.fields(PointPeaks, name=Field("as the deck names it"))


@POINT.key(name="peak", unit="length")
def peak_of_point(point: PointPeaks) -> float:
    """Greatest displacement relative to the base."""
    return float(point.sizes(point.found.displacements).max())


@POINT.key(name="peak_time", unit="time")
def time_of_peak(point: PointPeaks) -> float:
    """When that was."""
    return float(point.found.times[int(point.sizes(point.found.displacements).argmax())])


@POINT.key(name="peak_velocity", unit="speed")
def peak_velocity_of_point(point: PointPeaks) -> float:
    """Greatest velocity relative to the base."""
    return float(point.sizes(point.found.velocities).max())


@POINT.key(name="peak_acceleration", unit="acceleration")
def peak_acceleration_of_point(point: PointPeaks) -> float:
    """Greatest absolute acceleration."""
    return float(point.sizes(point.found.accelerations).max())


@POINT.key(unit="length")
def at_the_end(point: PointPeaks) -> float:
    """Displacement at the end."""
    return float(point.sizes(point.found.displacements)[-1])


@POINT.key(name="spectral_peak", inside=SPECTRAL)
def most_of_spectra(point: PointPeaks) -> SpectralPeak | None:
    """Greatest of its response spectra; null where the history is too short for them."""
    return None if point.spectra is None else spectral_peak(point.spectra.periods, point.spectra.points[point.row])
