"""What the engine follows in time, derived anew: every law, load and end, in units of a deck."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest

from mbla.assembly import Assembly, build_assembly
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.model import LoadCase
from mbla.solution.settings import settings_for, solver_settings
from mbla.solution.time_history.follow import follow
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.step_rows import HistoryEnd
from mbla.solution.verification.in_time.bodies import MovedSolids, solids_of
from mbla.solution.verification.in_time.history import history_failures
from mbla.solution.verification.in_time.overlaps import deepest_corner

Followed = tuple[Assembly, LoadCase, TimeHistoryResult]

TWO = """\
mbla: 1
materials: {stone: {density: 2000}}
contacts: {joint: dry}
parameters: {mu: 0.6, d: 0.2, every: 0.01, a: 0.6}
joints: {dry: {friction: "=mu"}}
blocks:
  - box: {group: base, material: stone, min: [0, 0, 0], max: [0.5, 0.5, 0.5]}
  - box: {group: top, material: stone, min: [0.05, 0.05, 0.5], max: [0.3, 0.45, 1.2]}
supports: [{ground: {z: 0}}]
load_cases:
  quake:
    time_history:
      motion: [{pulse: sine, amplitude: "0.6 g", duration: 0.3, direction: [0.8, 0.6, 0]}]
      duration: "=d"
      step: 0.002
      record:
        every: "=every"
        points: {crown: {on: top, at: [0.3, 0.45, 1.2]}}
        interfaces: {joint: {between: [base, top]}, foot: {between: [ground, base]}}
"""
MASSES = "masses: [{mass: 60, on: top, at: [0.25, 0.2, 1.0]}]\nsupports:"
LOADS = """\
    dead:
      - {force: [0, 0, -300], on: top, at: [0.2, 0.3, 1.2], follows: true}
      - {force: [50, 0, -200], on: top, at: [0.2, 0.3, 1.2]}
    time_history:
"""
TIES = """\
ties:
  - {through: [[0.1, 0.25, 1.1], [-2, 0.25, 0.3]], on: [top, ground], capacity: 800, prestress: 200}
  - {through: [[0.2, 0.1, 1.0], [0.2, 0.1, 0.1]], on: [top, base], capacity: 500, breaks_at: 0.002}
supports:"""
FORCES = (
    "      forces: [{on: top, at: [0.1, 0.1, 1.1], direction: [0, 1, 0], file: push.csv, columns: [t, f], unit: N}]\n"
)


def followed(text: str, *overrides: str) -> Followed:
    """The load case of a deck in time, by the engine."""
    with TemporaryDirectory() as folder:
        (path := Path(folder) / "deck.yaml").write_text(text, encoding="utf-8")
        (path.parent / "push.csv").write_text("t,f\n0,0\n0.05,900\n0.15,-900\n0.2,0\n", encoding="utf-8")
        deck = read_deck(path, overrides)
        model = build_model(deck)
    assembly, (case,) = build_assembly(deck, model), model.load_cases
    result, _ = follow(assembly, deck.contacts, case, settings_for(case, solver_settings(deck.analysis)))
    return assembly, case, result


def failures(of: Followed) -> list[str]:
    """What is not as it should be, in words."""
    return [f"{failure.identifier}: {failure}" for failure in history_failures(*of)[1]]


@pytest.fixture(scope="module")
def every_step() -> Followed:
    """Two blocks of which every step is kept, with a mass beside the centre and loads that turn."""
    text = TWO.replace("supports:", MASSES).replace("    time_history:\n", LOADS).replace('"0.6 g"', '"1.2 g"')
    return followed(text, "parameters.every=0.002", "parameters.d=0.18")


def test_every_step_of_two_blocks(every_step: Followed) -> None:
    checks, found = history_failures(*every_step)
    assert found == ()
    assert checks is not None
    assert checks.momentum < 1e-9
    assert checks.balance < 1e-9
    assert checks.velocities < 1e-6
    assert every_step[2].peaks is not None
    assert every_step[2].peaks.peak > 0.005


def test_forces_are_those_on_the_second_body_as_the_deck_names_them() -> None:
    """The foot carries both blocks: the ground is pressed down by them, and holds them up."""
    of_ground, of_base = (
        followed(TWO.replace("[ground, base]", order), "parameters.d=0.02")
        for order in ("[base, ground]", "[ground, base]")
    )
    assert failures(of_ground) == failures(of_base) == []
    (down, up) = (each[2].histories for each in (of_ground, of_base))
    assert down is not None
    assert up is not None
    assert up.forces[0, 1, 2] == pytest.approx(2000 * 9.81 * (0.125 + 0.07), rel=0.01)
    assert np.array_equal(down.forces[:, 1], -up.forces[:, 1])
    assert np.array_equal(down.forces[:, 0], up.forces[:, 0])


@pytest.mark.parametrize("joint", [
    "friction: 0.6, cohesion: 2000, tensile_strength: 1000",
    "friction: 0.6, compressive_strength: 30000",
    "friction: 0.6, stiffness: {normal: 1e8, ratio: 0.3}",
])  # fmt: skip
def test_joints_of_all_laws(joint: str) -> None:
    assert failures(followed(TWO.replace('friction: "=mu"', joint))) == []


def test_ties() -> None:
    text = TWO.replace("supports:", TIES).replace('"0.6 g"', '"1.2 g"')
    of = followed(text, "parameters.d=0.3")
    assert failures(of) == []
    assert of[2].rows is not None
    assert of[2].rows.ties.max() > 1e-4


def test_glued_and_kinematic_blocks() -> None:
    boxes = "".join(
        f"  - box: {{group: {'cap' if n > 2 else f'b{n}'}, material: stone, "
        f"min: [0, 0, {0.3 * n:g}], max: [0.3, 0.4, {0.3 * n + 0.3:g}]}}\n"
        for n in range(5)
    )
    head, rest = TWO.split("blocks:\n")
    text = f"{head}blocks:\n{boxes}supports:{rest.split('supports:')[1]}".split("      record:")[0]
    text = text.replace("joint: dry}", "joint: dry, overrides: [{joint: glued, between: [b0, b1]}]}", 1)
    of = followed(text + "      rigid: [cap]\n")
    assert failures(of) == []
    assert of[2].frames is not None
    assert of[2].frames.solid_of_block.tolist() == [0, 0, 1, 2, 2]


def test_guides() -> None:
    text = TWO.replace("supports: [{ground: {z: 0}}]", "supports: [{ground: {z: 0}}, {blocks: top, slide: [0, 0, 1]}]")
    assert failures(followed(text)) == []


def test_forces_over_time_in_other_units() -> None:
    text = TWO.replace("mbla: 1\n", "mbla: 1\nunits: {force: kN, mass: t}\n").replace("density: 2000", "density: 2")
    of = followed(text.replace("      duration:", FORCES + "      duration:"))
    assert failures(of) == []
    assert of[2].rows is not None
    assert np.abs(of[2].rows.forces).max() > 1e-4


@pytest.mark.long
def test_a_block_that_falls_ends_it() -> None:
    text = TWO.replace("max: [0.5, 0.5, 0.5]", "max: [0.5, 0.5, 1.5]").replace(
        "0.5], max: [0.3, 0.45, 1.2]", "1.5], max: [0.3, 0.45, 2.2]"
    )
    text = (
        text.replace("at: [0.3, 0.45, 1.2]", "at: [0.3, 0.45, 2.2]")
        .replace('"0.6 g"', '"1.2 g"')
        .replace("step: 0.002", "step: 0.005")
    )
    assembly, case, result = of = followed(text, "parameters.d=3")
    assert result.end is HistoryEnd.COLLAPSE
    assert failures(of) == []
    for other in (HistoryEnd.DURATION, HistoryEnd.AT_REST, HistoryEnd.STOPPED):
        said = history_failures(assembly, case, replace(result, end=other))[1]
        assert [failure.identifier for failure in said] == ["time-end"]


def test_a_displacement_ends_it() -> None:
    of = followed(TWO + "      stop: {displacement: 0.01}\n", "parameters.d=1")
    assert of[2].end is HistoryEnd.DISPLACED
    assert failures(of) == []


def test_rest_ends_it() -> None:
    of = followed(TWO.replace('"0.6 g"', '"0.05 g"') + "      stop: {rest: true}\n", "parameters.d=3")
    assert of[2].end is HistoryEnd.AT_REST
    assert failures(of) == []


@pytest.mark.parametrize(("name", "by"), [("momenta_before", 0.01), ("shifts", 1e-5), ("remembered", 1.0)])
def test_frames_that_follow_each_other(every_step: Followed, name: str, by: float) -> None:
    """What is forged of one shows in the step before it."""
    assembly, case, result = every_step
    assert result.frames is not None
    values = getattr(result.frames, name).copy()
    if name == "remembered":
        values[result.frames.values(80), 1] += by
    else:
        values[80] += by
    frames = replace(result.frames, **{name: values})
    found = history_failures(assembly, case, replace(result, frames=frames))[1]
    assert any(failure.identifier == "time-frames" and "step before" in failure for failure in found)


def test_the_sag_and_the_damping_that_are_said(every_step: Followed) -> None:
    assembly, case, result = every_step
    for other in (replace(result, sag=2.0 * result.sag), replace(result, damping=0.1 * result.damping)):
        assert [failure.identifier for failure in history_failures(assembly, case, other)[1]] == ["time-frames"]


def test_blocks_in_each_other_without_contact_points(every_step: Followed) -> None:
    assembly, case, result = every_step
    assert result.frames is not None
    solids = solids_of(assembly, case)
    shifts, turns = result.frames.shifts[0], result.frames.turns[0]
    assert deepest_corner(MovedSolids(solids, shifts, turns)) < 1e-4
    sunk = shifts - np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.1]])
    assert deepest_corner(MovedSolids(solids, sunk, turns)) == pytest.approx(0.05 / solids.sizes.min(), rel=1e-3)
    below = shifts - np.array([0.0, 0.0, 0.1])
    assert deepest_corner(MovedSolids(solids, below, turns)) == pytest.approx(0.1 / 0.5, rel=1e-3)


def test_accelerations_over_steps_in_the_place_of_one() -> None:
    """Velocities are those in the middle of the last step before an instant, be it an eighth of one of the deck."""
    of = followed(TWO.replace("0.6, d: 0.2", "0.6, d: 0.35").replace('"0.6 g"', '"0.9 g"'))
    rows, histories = of[2].rows, of[2].histories
    assert failures(of) == []
    assert rows is not None
    assert histories is not None
    small = np.flatnonzero(np.diff(rows.small_steps) == 7)
    small = small[(small > 1) & np.isin(small - 1, np.flatnonzero(np.diff(rows.small_steps) == 0))]
    assert len(small)
    step = 0.002
    gain = np.diff(histories.velocities[:, 0], axis=0)[small] / (1.5 * step - step / 16.0)
    assert of[1].time_history is not None
    fast = of[1].time_history.base_velocity(histories.velocity_times)
    shaken = np.diff(fast, axis=0) / np.diff(histories.velocity_times)[:, None]
    relative = histories.accelerations[small + 1, 0] - shaken[small]
    assert relative == pytest.approx(gain, abs=0.02 * np.abs(gain).max())


def test_a_block_that_flies_and_lands() -> None:
    """Its base goes down faster than it falls: nothing touches for a while."""
    top = "  - box: {group: top, material: stone, min: [0.05, 0.05, 0.5], max: [0.3, 0.45, 1.2]}\n"
    text = TWO.replace(top, "").split("      record:")[0]
    text = text.replace("pulse: sine", "pulse: half_sine").replace('"0.6 g"', '"3 g"')
    of = followed(
        text.replace("[0.8, 0.6, 0]", "[0.1, 0, -1]").replace("duration: 0.3", "duration: 0.1"), "parameters.d=0.5"
    )
    assert failures(of) == []
    assert of[2].rows is not None
    touching = of[2].rows.pressing > 0
    assert touching[0]
    assert touching[-1]
    assert not touching.all()
