"""Frames of a time history derived anew: a block that slides, one that rocks, and one thing forged at a time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.model.motion.signal import Signal
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.step_rows import HistoryEnd
from mbla.solution.verification.in_time.bodies import second_moments
from mbla.solution.verification.in_time.history import TimeChecks, history_failures
from mbla.solution.verification.in_time.motion import integrals
from tests.line import line_of
from tests.solution.structures import deck, prism
from tests.solution.verification.moving_block import G, Shaken, shaken

Change = Callable[[TimeHistoryResult], TimeHistoryResult]
Edit = Callable[[FloatArray], FloatArray]


def push(acceleration: float, duration: float) -> Signal:
    """Of the base, with flanks of 1 ms."""
    times = np.array([0.0, 1e-3, duration, duration + 1e-3])
    return Signal(times, np.array([0.0, acceleration, acceleration, 0.0]))


@pytest.fixture(scope="module")
def slides() -> Shaken:
    """A block whose base is pushed by 0.5 g for 0.2 s, friction 0.3."""
    return shaken(push(0.5 * G, 0.2), friction=0.3, size=(1.0, 1.0, 0.5), duration=0.44)


@pytest.fixture(scope="module")
def rocks() -> Shaken:
    """A slender block, askew to the push, so that it rocks about a corner and turns about skew axes."""
    return shaken(push(6.0, 0.12), friction=0.7, size=(0.3, 0.4, 1.0), duration=0.44, direction=(0.8, 0.6, 0.0))


def found(of: Shaken) -> tuple[TimeChecks, list[str]]:
    """Figures, and identifiers of what fails."""
    checks, failures = history_failures(of.assembly, of.case, of.result)
    assert checks is not None
    return checks, [failure.identifier for failure in failures]


def said(of: Shaken, change: Change) -> set[str]:
    """Identifiers of what fails where something is forged."""
    return {failure.identifier for failure in history_failures(of.assembly, of.case, change(of.result))[1]}


def test_a_block_that_slides(slides: Shaken) -> None:
    checks, failures = found(slides)
    assert failures == []
    assert max(checks.law, checks.momentum, checks.velocities, checks.kinetic) < 1e-9
    assert slides.result.peaks is not None
    assert slides.result.peaks.displacements[0] == pytest.approx(0.0654, rel=0.04)  # Newmark


def test_a_block_that_rocks(rocks: Shaken) -> None:
    checks, failures = found(rocks)
    assert failures == []
    assert max(checks.law, checks.momentum, checks.kinetic) < 1e-9
    assert checks.velocities < 1e-4
    assert rocks.result.peaks is not None
    assert rocks.result.peaks.displacements[0] > 0.01


@pytest.mark.parametrize("strength", [1e-12, 1e-9, 1e-7])
def test_what_hardly_moves_is_not_held_to_less_than_rounding(strength: float) -> None:
    """Energies beside which the rounding of the poses is large: they are told over dead load times sag."""
    still = shaken(push(strength * G, 0.05), friction=0.6, size=(1.0, 1.0, 0.5), duration=0.1)
    assert found(still)[1] == []


def test_nothing_is_said_of_what_does_not_move() -> None:
    line = line_of(deck(["box: {group: a, material: stone, min: [0, 0, 0], max: [1, 1, 1]}"], (1.0, 0.0, 0.0)))
    assert history_failures(line.assembly, line.load_case, TimeHistoryResult()) == (None, ())


def of_part(part: str, changes: dict[str, Edit]) -> Change:
    """Arrays of a part of the result changed."""

    def change(result: TimeHistoryResult) -> TimeHistoryResult:
        own = getattr(result, part)
        values = {name: edit(getattr(own, name).copy()) for name, edit in changes.items()}
        return replace(result, **{part: replace(own, **values)})

    return change


def of_frames(**changes: Edit) -> Change:
    """Of frames."""
    return of_part("frames", changes)


def of_rows(**changes: Edit) -> Change:
    """Of rows."""
    return of_part("rows", changes)


def of_peaks(**changes: Edit) -> Change:
    """Of peaks."""
    return of_part("peaks", changes)


def of_spectra(**changes: Edit) -> Change:
    """Of response spectra."""
    return of_part("spectra", changes)


def of_points(**changes: Edit) -> Change:
    """Of contact points."""

    def change(result: TimeHistoryResult) -> TimeHistoryResult:
        assert result.frames is not None
        (points,) = result.frames.sets
        values = {name: edit(getattr(points, name).copy()) for name, edit in changes.items()}
        points = replace(points, **values)  # type: ignore[arg-type]  # of floats alone
        return replace(result, frames=replace(result.frames, sets=(points,)))

    return change


def of_history(name: str, by: float) -> Change:
    """A column of the histories changed in the middle."""

    def change(result: TimeHistoryResult) -> TimeHistoryResult:
        assert result.histories is not None
        values = getattr(result.histories, name).copy()
        values[len(values) // 2] += by
        return replace(result, histories=replace(result.histories, **{name: values}))

    return change


def add(by: float, *at: int) -> Edit:
    """Add to one entry."""

    def change(values: FloatArray) -> FloatArray:
        values[at] += by
        return values

    return change


def times(factor: float, row: int | slice = slice(None)) -> Edit:
    """Multiply rows."""

    def change(values: FloatArray) -> FloatArray:
        values[row] *= factor
        return values

    return change


def to(value: float, *at: int) -> Edit:
    """Set one entry."""

    def change(values: FloatArray) -> FloatArray:
        values[at] = value
        return values

    return change


FORGED: dict[str, tuple[Change, str]] = {
    "a normal force": (of_frames(forces=times(1.01, 20)), "time-law"),
    "friction beyond its cone": (of_frames(forces=lambda x: np.where([False, True, True], 2.0 * x, x)), "time-law"),
    "friction that it remembers": (of_frames(remembered=add(1e3, 40, 1)), "time-law"),
    "a normal force that it remembers": (of_frames(remembered=add(1e3, 40, 0)), "time-law"),
    "a force that is no number": (of_frames(forces=to(np.nan, 20, 0)), "time-law"),
    "a pose": (of_frames(shifts=add(1e-4, 7, 0, 2)), "time-law"),
    "a turn": (of_frames(turns=add(1e-4, 7, 0, 0)), "time-law"),
    "a momentum": (of_frames(momenta=times(1.001, 5)), "time-momentum"),
    "an angular momentum": (of_frames(momenta=add(1.0, 5, 0, 4)), "time-momentum"),
    "a momentum before": (of_frames(momenta_before=times(1.001, 5)), "time-momentum"),
    "a velocity": (of_frames(velocities=times(1.001, 5)), "time-velocities"),
    "velocities that turn": (of_frames(velocities=add(0.01, 5, 0, 4)), "time-velocities"),
    "the length of a step": (of_frames(lengths=times(0.5, 5)), "time-momentum"),
    "the base of a frame": (of_frames(base=add(1e-5, 9, 0)), "time-base"),
    "the base of the histories": (of_history("base", 1e-4), "time-base"),
    "a history": (of_history("displacements", 1e-4), "time-histories"),
    "an acceleration at rest": (of_part("histories", {"accelerations": add(1.0, 0, 0, 0)}), "time-histories"),
    "the instant of a velocity": (of_history("velocity_times", 1e-4), "time-histories"),
    "a velocity that spectra are made of": (of_history("velocities", 0.05), "time-histories"),
    "spectra": (of_spectra(points=times(1.02)), "time-histories"),
    "spectra of the base": (of_spectra(base=times(0.98)), "time-histories"),
    "spectra that are no numbers": (of_spectra(points=to(np.nan, 0, 3, 0)), "time-histories"),
    "other periods": (of_spectra(periods=times(1.1)), "time-histories"),
    "no spectra": (lambda result: replace(result, spectra=None), "time-histories"),
    "energies of a row": (of_rows(friction=add(1.0, 20)), "time-energy"),
    "a peak too small": (of_peaks(displacements=times(0.9)), "time-peak"),
    "a peak too large": (of_peaks(displacements=times(1.2)), "time-peak"),
    "a peak after the end": (of_peaks(times=times(100.0)), "time-peak"),
    "a block that falls": (of_peaks(falling=lambda x: np.array([0.2])), "time-peak"),
    "the end: collapse": (lambda result: replace(result, end=HistoryEnd.COLLAPSE), "time-end"),
    "the end: displaced": (lambda result: replace(result, end=HistoryEnd.DISPLACED), "time-end"),
    "the end: at rest": (lambda result: replace(result, end=HistoryEnd.AT_REST), "time-end"),
    "no end": (lambda result: replace(result, end=HistoryEnd.NONE), "time-end"),
    "a frame between rows": (of_frames(times=add(3e-4, 9)), "time-frames"),
    "values of another frame": (of_frames(point_start=add(1, 3)), "time-frames"),
    "rows in another order": (of_rows(times=lambda x: x[::-1].copy()), "time-frames"),
    "points beside their body": (of_points(arms=add(0.4, 0, 1, 0)), "time-points"),
    "axes of a point": (of_points(frames=add(0.1, 0, 0, 0)), "time-points"),
    "stiffness of a point": (of_points(stiffness=times(2.0)), "time-points"),
    "dashpot of a point": (of_points(dashpot=times(3.0)), "time-law"),
}


@pytest.mark.parametrize(
    ("one", "sign", "words"),
    [
        ("kinetic", -1.0, "kinetic energy"),
        ("potential", -1.0, "gains"),
        ("base", 1.0, "energy base"),
        ("friction", -1.0, "energy friction"),
        ("elastic", 0.0, "energy elastic"),
    ],
)
def test_energies_that_sum_up_and_are_forged(rocks: Shaken, one: str, sign: float, words: str) -> None:
    """What is more in one is less in contacts."""

    def change(result: TimeHistoryResult) -> TimeHistoryResult:
        rows = result.rows
        assert rows is not None
        more = 0.1 * getattr(rows, one)
        rows = replace(rows, **{one: 1.1 * getattr(rows, one)}, contacts=rows.contacts + sign * more)
        return replace(result, rows=rows)

    _, failures = history_failures(rocks.assembly, rocks.case, change(rocks.result))
    assert {failure.identifier for failure in failures} == {"time-energy"}
    assert any(words in failure for failure in failures)


def test_the_base_does_no_more_in_a_step_than_what_moves_can_take(rocks: Shaken) -> None:
    """Between frames as well."""

    def change(result: TimeHistoryResult) -> TimeHistoryResult:
        rows = result.rows
        assert rows is not None
        more = np.abs(rows.base).max() * ((rows.times > 0.101) & (rows.times < 0.103))  # of one row
        rows = replace(rows, base=rows.base + more, contacts=rows.contacts + more)
        return replace(result, rows=rows)

    _, failures = history_failures(rocks.assembly, rocks.case, change(rocks.result))
    assert any("the base does more in a step" in failure for failure in failures)


@pytest.mark.every(2)
@pytest.mark.parametrize("what", FORGED)
def test_what_is_forged_is_named(rocks: Shaken, what: str) -> None:
    change, identifier = FORGED[what]
    assert identifier in said(rocks, change)


def test_a_record_of_another_scale(slides: Shaken) -> None:
    motions = tuple(replace(each, signal=each.signal.times_factor(1.001)) for each in slides.history.motions)
    other = replace(slides.case, time_history=replace(slides.history, motions=motions))
    failures = history_failures(slides.assembly, other, slides.result)[1]
    assert {"time-momentum", "time-base"} <= {failure.identifier for failure in failures}


def test_another_mass(slides: Shaken) -> None:
    model = slides.assembly.model
    blocks = replace(model.blocks, densities=model.blocks.densities * 1.01)
    other = replace(slides.assembly, model=replace(model, blocks=blocks))
    failures = history_failures(other, slides.case, slides.result)[1]
    assert {"time-momentum", "time-velocities"} <= {failure.identifier for failure in failures}


def test_a_missed_step_may_be_off_the_law(rocks: Shaken) -> None:
    """Where the run says so: its momentum is exact all the same."""
    frames, rows = rocks.result.frames, rocks.result.rows
    assert frames is not None
    assert rows is not None
    frames = replace(frames, remembered=add(1e3, 40, 1)(frames.remembered.copy()), missed=np.arange(len(frames)) == 10)
    assert said(rocks, lambda result: replace(result, frames=frames)) == {"time-frames"}  # no row says it
    rows = replace(rows, missed=(rows.times >= frames.times[10]).astype(np.int64))
    assert said(rocks, lambda result: replace(result, frames=frames, rows=rows)) == set()


def test_integrals_of_a_record() -> None:
    signal = Signal(np.array([0.1, 0.2, 0.2, 0.5]), np.array([1.0, 3.0, -2.0, 4.0]))
    begins, ends = np.array([0.0, 0.15, 0.2, 0.3]), np.array([1.0, 0.3, 0.5, 0.3])
    assert integrals(signal, begins, ends) == pytest.approx(signal.integral(ends) - signal.integral(begins))
    far = integrals(signal, np.full(4, -np.inf), ends, since=True)
    assert far == pytest.approx(signal.second_integral(ends))


def test_second_moments_of_a_box_and_of_a_wedge() -> None:
    lower = [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (0.0, 3.0, 0.0)]
    wedge = prism("wedge", lower, [(x, y, 4.0) for x, y, _ in lower])
    box = "box: {group: box, material: stone, min: [5, 0, 0], max: [7, 3, 4]}"
    blocks = line_of(deck([box, wedge], (1.0, 0.0, 0.0))).model.blocks
    of_box, of_wedge = second_moments(blocks)
    assert of_box == pytest.approx(np.diag([4.0, 9.0, 16.0]) * 24.0 / 12.0, abs=1e-12)
    # ∫ x² of a right triangle about its centroid b³h/36, ∫ xy −b²h²/72
    assert of_wedge[0, 0] == pytest.approx(2.0**3 * 3.0 / 36.0 * 4.0)
    assert of_wedge[0, 1] == pytest.approx(-(2.0**2) * 3.0**2 / 72.0 * 4.0)
    assert of_wedge[2, 2] == pytest.approx(3.0 * 4.0**3 / 12.0)
