"""What the load path makes of a load factor: a peak above it, the state at its end below it, or no answer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mbla.solution.nonassociative.factor_range import unbalanced
from mbla.solution.nonassociative.first_fall import NOT_STANDING, PathVerdict, judged_by_path
from mbla.solution.standing.standing_path import StandingPath

from mbla.program.program import Program
from mbla.program.yield_conditions import yield_violation
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.mechanics import mechanics_of
from mbla.solution.nonassociative.law_state import LawState, SequenceResult, law_state
from mbla.solution.solution import Status
from mbla.solution.standing.weak_spring_continuation import Outcome, Weakening
from mbla.solution.verification.further_claims import peak_check
from tests.line import BLOCK, HEAD, Line, line_of, line_of_file, load_factor, solution_of
from tests.solution.nonassociative.structures import FERRIS_3, SETTINGS, solved
from tests.solution.planar import planar_program


def prism(group: str, *corners: tuple[float, float]) -> str:
    """A block with the given corners in the x-z plane, 0.5 thick."""
    n = len(corners)
    vertices = [[x, y, z] for y in (0.0, 0.5) for x, z in corners]
    faces = [list(range(n)), list(range(n, 2 * n))]
    faces += [[i, (i + 1) % n, (i + 1) % n + n, i + n] for i in range(n)]
    return f"  - polyhedron: {{group: {group}, material: stone, vertices: {vertices}, faces: {faces}}}\n"


PLANK = (
    HEAD
    + "joints: {dry: {friction: 0.4}}\nblocks:\n"
    + prism("base", (0, 0), (1, 0), (1, 1), (0, 0.9))
    + prism("back", (0, 0.9), (0.7, 0.97), (0.7, 1.17), (0, 1.05))
    + prism("plank", (0.7, 0.97), (1.5, 1.05), (1.5, 1.17 + 0.8 * 0.12 / 0.7), (0.7, 1.17))
    + prism("top", (0, 1.05), (1, 1.17 + 0.3 * 0.12 / 0.7), (1, 2.1), (0, 2.1))
    + "supports: [{blocks: base}]\nload_cases: {pull: {live: [{acceleration: [1, 0, 0], on: plank}]}}\n"
)
"""A plank thicker outside than inside, clamped under a wall and pulled out."""


CONFINED = (
    HEAD
    + "joints: {dry: {friction: 0.5}}\n"
    + "blocks:\n"
    + "  - box: {group: block, material: stone, min: [0, 0, 0], max: [2, 1, 1]}\n"
    + "  - box: {group: ceiling, material: stone, min: [0, 0, 1], max: [2, 1, 2]}\n"
    + "supports: [{ground: {z: 0}, blocks: block}, {blocks: ceiling}]\n"
    + "load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}\n"
)
"""A block that fills the room between the ground and a fixed ceiling, which it does not press."""


def judged(
    program: Program, state: LawState, *, most: float = np.inf, peak: bool = True, status: Status = Status.SOLVED
) -> PathVerdict:
    """The verdict on a state of the law by a path from the dead load."""
    path = StandingPath.from_dead_load(program, SETTINGS)
    sequence = SequenceResult(status, state, "", ())
    return judged_by_path(path, sequence, most, lambda record: None, 5, peak=peak)


def at(state: LawState, load_factor: float) -> LawState:
    """The same forces and mechanism at another load factor, which they do not belong to."""
    return replace(state, load_factor=load_factor)


@pytest.fixture(scope="module")
def plank() -> tuple[Line, LawState, PathVerdict]:
    line = line_of(PLANK)
    state = solved(line.program)
    return line, state, judged(line.program, state)


def test_a_clamped_plank_is_held_by_what_it_loses_as_it_slides(plank: tuple[Line, LawState, PathVerdict]) -> None:
    line, state, found = plank
    assert found.peak is not None
    assert found.sequence.state is state
    assert found.peak.load_factor > 1.5 * state.load_factor
    assert "the peak is the collapse load" in str(found.remark)
    assert [(record.program, record.kind) for record in found.programs] == [(5, "load path")]
    associative = solve_associative(line.program, SETTINGS, lambda record: None).state
    assert associative is not None
    assert found.peak.load_factor < associative.load_factor


def test_a_peak_is_looked_for_where_it_is_asked_for(plank: tuple[Line, LawState, PathVerdict]) -> None:
    line, state, _ = plank
    found = judged(line.program, state, peak=False)
    assert (found.peak, found.remark, found.sequence.state) == (None, None, state)


def test_the_forces_of_a_peak_carry_its_load(plank: tuple[Line, LawState, PathVerdict]) -> None:
    line, _, found = plank
    assert found.peak is not None
    assert unbalanced(line.program, found.peak) < 1e-8
    assert yield_violation(found.peak.forces, line.program.limits).max() < 1e-9
    assert found.peak.residual > 1e-3  # passed, not at rest: its velocities are none of a mechanism at this load


def test_a_peak_is_verified_by_statics(plank: tuple[Line, LawState, PathVerdict]) -> None:
    line, _, found = plank
    assert found.peak is not None
    peak = mechanics_of(line.program, found.peak)
    here = line.model, line.contacts, line.load_case
    assert peak_check(*here, peak) == peak.load_factor
    assert np.isnan(peak_check(*here, replace(peak, load_factor=1.001 * peak.load_factor)))
    assert np.isnan(peak_check(*here, replace(peak, contact_forces=peak.contact_forces * np.array([1.0, 2.0, 2.0]))))
    assert np.isnan(peak_check(*here, None))


@pytest.mark.every(2)
@pytest.mark.parametrize("text", [BLOCK, FERRIS_3])
def test_walls_and_sliding_blocks_have_no_peak(text: str) -> None:
    line = line_of(text, *(("parameters.h=0.5",) if text is BLOCK else ()))
    program = line.program if text is BLOCK else planar_program(line)
    state = solved(program)
    found = judged(program, state)
    assert (found.peak, found.remark, found.sequence.state) == (None, None, state)


def test_next_to_the_associative_factor_no_path_is_followed() -> None:
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = solved(program)
    assert judged(program, state, most=state.load_factor).programs == ()


def test_what_stands_up_to_the_associative_factor_has_its_peak_there() -> None:
    """Of a state at half the load factor; nothing carries more than the associative one."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = solved(program)
    most = (1.0 - 1e-7) * state.load_factor
    found = judged(program, at(state, 0.5 * state.load_factor), most=most)
    assert found.peak is not None
    assert found.peak.load_factor == pytest.approx(most, rel=1e-5)
    assert "the peak is the collapse load" in str(found.remark)


def test_where_it_is_not_seen_to_stand_no_path_is_followed() -> None:
    program = line_of(BLOCK).program
    state = solved(program)
    undecided = Weakening(Outcome.UNDECIDED, None, np.nan, "")
    path = StandingPath.from_dead_load(program, SETTINGS, undecided)
    found = judged_by_path(path, SequenceResult(Status.SOLVED, state, "", ()), np.inf, print, 5, peak=True)
    assert (found.peak, found.remark, found.programs) == (None, NOT_STANDING, ())
    nothing = SequenceResult(Status.NOT_VERIFIED, None, "", ())
    assert judged_by_path(path, nothing, np.inf, print, 5, peak=True).remark is None


def test_a_ceiling_that_nothing_presses_carries_nothing() -> None:
    """The law forgets the gap that the weight opens: it allows 0.5625 and 2. The ground gives 0.5."""
    assert load_factor(CONFINED, "analysis={}") == pytest.approx(0.5, rel=1e-6)


def test_a_state_above_the_end_of_the_path_gives_way_to_the_one_there() -> None:
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = solved(program)
    found = judged(program, at(state, 1.3 * state.load_factor))
    assert found.sequence.status is Status.SOLVED
    assert found.sequence.state is not None
    assert found.sequence.state.load_factor == pytest.approx(state.load_factor, rel=1e-6)
    assert found.sequence.remarks[-1].identifier == "found-above-path"


def test_without_a_state_at_the_end_of_the_path_there_is_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = solved(program)
    monkeypatch.setattr("mbla.solution.nonassociative.first_fall.state_near", lambda *arguments, **more: None)
    found = judged(program, at(state, 1.3 * state.load_factor))
    assert found.sequence.status is Status.NOT_VERIFIED
    assert found.peak is not None
    assert found.peak.load_factor == pytest.approx(state.load_factor, rel=1e-5)
    live = program.scaling.live
    for figure in (1.3 * state.load_factor, state.load_factor):
        assert f"{figure * live:.4g}" in found.sequence.reason


def test_a_factor_below_zero_is_none_of_what_stands() -> None:
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = solved(program)
    found = judged(program, at(state, -state.load_factor), peak=False)
    assert found.sequence.status is Status.NOT_VERIFIED
    assert "no load of a structure that stands" in found.sequence.reason
    assert found.peak is not None
    assert found.peak.load_factor == pytest.approx(state.load_factor, rel=1e-5)


def test_a_block_without_friction_collapses_at_zero_all_the_same() -> None:
    assert load_factor(BLOCK, "parameters.mu=0", "analysis.flow_rule=non_associative") == pytest.approx(0.0, abs=1e-9)


def undecided_from(load_factor: float) -> Callable[..., Weakening]:
    """Springs that decide nothing from a load factor of the program on."""
    from mbla.solution.standing.weak_spring_continuation import weaken_springs

    def weaken(*arguments: object, live: float = 0.0) -> Weakening:
        found: Weakening = weaken_springs(*arguments, live=live)  # type: ignore[arg-type]
        return found if live < load_factor else Weakening(Outcome.UNDECIDED, 0, np.nan, "no state was found")

    return weaken


@pytest.mark.parametrize(
    ("unknown", "status", "said"),
    [
        (0.5, Status.APPROXIMATE, "the load path was followed to"),
        (1.2, Status.NOT_VERIFIED, "its end was not seen"),
    ],
    ids=["below", "above"],
)
def test_what_the_springs_do_not_decide_is_not_solved(
    unknown: float, status: Status, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a state at half the load factor for what lies above it, so that the block stands there still."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = solved(program)
    state = at(state, (1.0 if unknown < 1.0 else 0.5) * state.load_factor)
    monkeypatch.setattr(
        "mbla.solution.standing.standing_path.weaken_springs", undecided_from(unknown * state.load_factor)
    )
    found = judged(program, state)
    assert found.sequence.status is status
    assert (found.peak is not None) is (status is Status.NOT_VERIFIED)
    assert said in str(found.remark)
    assert found.sequence.reason == found.remark


def test_a_block_in_neutral_equilibrium_falls_under_no_live_load() -> None:
    """Its mechanism needs none, as that of torsion about a contact point, but the structure is seen to fall here."""
    line = line_of_file(Path("decks/regressions/neutral_overhang.yaml"))
    solution = solution_of(line)
    assert solution.status is Status.SOLVED
    assert solution.peak is None
    assert solution.mechanics is not None
    assert 0.0 <= solution.mechanics.load_factor < 1e-6


def test_the_motion_of_a_peak_is_the_fall(plank: tuple[Line, LawState, PathVerdict]) -> None:
    """The plank goes out, the wall that clamps it hardly moves."""
    line, _, found = plank
    assert found.peak is not None
    mechanism = mechanics_of(line.program, found.peak).mechanism
    moving = np.linalg.norm(mechanism[:, :3], axis=1)
    outwards = int(np.argmax(moving))
    assert line.model.blocks.groups[outwards] == "plank"
    assert mechanism[outwards, 0] > 0.0
    same = law_state(line.program, 0.0, found.peak.forces, found.peak.velocities, found.peak.load_factor)
    assert same.residual == found.peak.residual


def falls_between(least: float, most: float) -> Callable[..., Weakening]:
    """Springs that see a fall between two load factors of the program, whatever stands."""
    from mbla.solution.standing.weak_spring_continuation import weaken_springs

    def weaken(*arguments: object, live: float = 0.0) -> Weakening:
        found: Weakening = weaken_springs(*arguments, live=live)  # type: ignore[arg-type]
        return replace(found, outcome=Outcome.FALLS) if least < live < most else found

    return weaken


@pytest.mark.parametrize("share", [0.3, 1.0], ids=["below-the-fall", "above-it"])
def test_a_structure_that_stands_above_its_fall_has_no_load_factor(
    share: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whichever state was found: of the same structure in two positions one is found below the fall, one above."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = solved(program)
    falls = falls_between(0.45 * state.load_factor, 0.6 * state.load_factor)
    monkeypatch.setattr("mbla.solution.standing.standing_path.weaken_springs", falls)
    found = judged(program, at(state, share * state.load_factor))
    assert found.sequence.status is Status.NOT_VERIFIED
    assert found.peak is not None
    assert found.peak.load_factor == pytest.approx(0.45 * state.load_factor, rel=1e-2)
    assert "the load path is in doubt" in found.sequence.reason


def test_next_to_the_end_of_the_path_a_state_is_approximate(monkeypatch: pytest.MonkeyPatch) -> None:
    """Half a hundredth above it, with none found at the end itself: told, not taken away, and not called solved."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    state = solved(program)
    monkeypatch.setattr("mbla.solution.nonassociative.first_fall.state_near", lambda *arguments, **more: None)
    found = judged(program, at(state, 1.005 * state.load_factor))
    assert found.sequence.status is Status.APPROXIMATE
    assert "the load path was followed to" in str(found.remark)
    assert str(found.remark).endswith("it falls there")
