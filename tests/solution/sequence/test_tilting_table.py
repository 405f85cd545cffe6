"""Angle of collapse of a tilting table against closed forms, and against tilted gravity without any table."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from mbla.model.model import LoadCase
from mbla.program import assemble
from mbla.questions.angle import Angle
from mbla.solution.sequence import tilting_table
from mbla.solution.sequence.sequence import answer_of
from mbla.solution.sequence.solved_case import SolvedCase
from mbla.solution.sequence.tilting_table import falls_at_once, never_collapses, tilt_angles
from mbla.solution.solution import Checks, Solution, Status
from mbla.solution.verification.tilting_table import never_failures, tilt_failures
from mbla.solution.verification.verify import verify
from mbla.solution.verification.verify_points import verified_status
from tests.asked import tilt_of
from tests.line import Line, line_of, solution_of
from tests.reached import reaches
from tests.solution.by_hand import claim, found, state

BLOCK = """mbla: 1
units: {length: %(length)s, force: %(force)s, mass: %(mass)s}
parameters: {mu: 0.4, c: 0.0, f: 0.0, w: 20000, m: %(m)s, s: %(s)s}
materials: {stone: {unit_weight: "=w*s/m**3"}}
joints: {bed: {friction: "=mu", cohesion: "=c*s/m**2", tensile_strength: "=f*s/m**2"}}
blocks: [{box: {group: block, material: stone, min: [0, 0, 0], max: ["=3*m", "=0.9*m", "=2.2*m"]}}]
contacts: {joint: bed}
supports: [{ground: {z: 0}}]
load_cases: {turn: {live: [{tilt: {axis: [0, 1, 0]}}]}}
analysis: {flow_rule: associative}
"""
METRES = BLOCK % {"length": "m", "force": "N", "mass": "kg", "m": "1", "s": "1"}
MILLIMETRES = BLOCK % {"length": "mm", "force": "kN", "mass": "t", "m": "1000", "s": "0.001"}
WALL = """mbla: 1
parameters: {c: 3000, f: 1000, t: 0}
materials: {stone: {density: 2000}}
joints: {bed: {friction: 0.65, cohesion: "=c", tensile_strength: "=f"}}
blocks: [{wall: {material: stone, unit: [0.4, 0.2, 0.175], length: 1.2, courses: 4}}]
contacts: {joint: bed}
supports: [{ground: {z: 0}}]
load_cases:
  turn: {live: [{tilt: {axis: [0, 1, 0]}}]}
  slope: {dead: [{gravity: ["=9.81*sin(t)", 0, "=-9.81*cos(t)"]}], live: [{acceleration: [1, 0, 0]}]}
analysis: {flow_rule: associative}
"""


def answered(line: Line, ask: Callable[[LoadCase], tuple[Solution, Checks]]) -> SolvedCase:
    """The search for the angle, each load case answered by ``ask``."""
    return answer_of(
        tilt_angles(line.assembly, line.load_case, tilt_of(line.load_case)), lambda case: SolvedCase(case, *ask(case))
    )


def turned(text: str, *overrides: str) -> SolvedCase:
    line = line_of(text, *overrides)

    def ask(case: LoadCase) -> tuple[Solution, Checks]:
        program = assemble(line.model, line.contacts, case)
        solution = solution_of(replace(line, load_case=case, program=program))
        return solution, verify(line.assembly, case, solution)

    answer = answered(line, ask)
    checks = verify(line.assembly, answer.load_case, answer.solution)
    return SolvedCase(answer.load_case, answer.solution, checks)


def angle(answer: SolvedCase) -> float:
    tilt = tilt_of(answer.load_case)
    assert verified_status(answer.solution, answer.checks) is Status.SOLVED
    return math.degrees(math.atan(answer.load_factor)) if tilt.tangent else tilt.angle


@pytest.mark.parametrize("mu", [0.1, 0.4, 0.9])
def test_dry_blocks_need_one_program_only(mu: float) -> None:
    answer = turned(METRES, f"parameters.mu={mu}")
    assert angle(answer) == pytest.approx(math.degrees(math.atan(mu)), rel=1e-8)
    assert tilt_of(answer.load_case).tangent


@pytest.mark.parametrize(("mu", "c"), [(0.4, 4000), (0.1, 25000), (0.0, 30000)])
def test_cohesion(mu: float, c: float) -> None:
    """W sin t = mu W cos t + c A, W/A = 44,000 N/m2; the tangent of the angle is no load factor here."""
    expected = math.atan(mu) + math.asin(c / 44000 * math.cos(math.atan(mu)))
    assert angle(turned(METRES, f"parameters.mu={mu}", f"parameters.c={c}")) == pytest.approx(
        math.degrees(expected), rel=1e-8
    )


def test_units_do_not_matter() -> None:
    overrides = ("parameters.c=4000", "parameters.f=2000")
    assert angle(turned(MILLIMETRES, *overrides)) == pytest.approx(angle(turned(METRES, *overrides)), rel=1e-9)


def test_beyond_the_vertical() -> None:
    """Glued to its base, the block comes off in tension after the table has turned over: -W cos t = f A."""
    expected = math.degrees(math.acos(-0.9))
    answer = turned(METRES, "parameters.mu=0.01", "parameters.c=200000", "parameters.f=39600")
    # the tilted block also bends the joint, which goes first: a bound from above, and beyond 90 degrees
    assert 90 < angle(answer) < expected


def test_a_wall_in_mortar_against_tilted_gravity() -> None:
    """Just below the angle the wall stands under gravity tilted by it, just above it does not."""
    found = angle(turned(WALL))
    assert 10 < found < 80
    for turn, status in ((found - 1e-3, Status.SOLVED), (found + 1e-3, Status.NO_EQUILIBRIUM)):
        line = line_of(WALL, f"parameters.t={turn}", case=1)
        assert solution_of(line).status is status, turn


@pytest.mark.parametrize("rule", ["non_associative", "dilatancy"])
def test_without_normality(rule: str) -> None:
    """At or below the associative angle, with the load factor 1 there."""
    associative = angle(turned(WALL))
    answer = turned(WALL, f"analysis.flow_rule={rule}")
    assert abs(answer.load_factor - 1.0) <= 1e-6
    assert angle(answer) <= associative + 1e-6


def test_what_holds_at_every_angle_has_none() -> None:
    answer = turned(METRES, "parameters.c=500000", "parameters.f=400000")
    assert math.isnan(tilt_of(answer.load_case).angle)
    assert verified_status(answer.solution, answer.checks) is Status.UNBOUNDED
    assert "up to 180 degrees, and forces are known for all others" in answer.solution.reason


def test_of_what_may_collapse_between_nothing_is_claimed() -> None:
    """Were the level table to bear little across, the arc would leave what is proved; verification sees that too."""
    answer = turned(METRES, "parameters.c=500000", "parameters.f=400000")
    tilt = tilt_of(answer.load_case)
    live = answer.load_case.live_load
    failures = never_failures(replace(tilt, upright=0.5), live, answer.checks)
    assert failures == ("nothing proves that the table bears every angle up to 180 degrees",)
    assert never_failures(tilt, 0.5 * live, answer.checks) == (
        "the live load is not the change from the level table to the one turned over",
    )
    unproved = never_collapses(replace(tilt, upright=0.5, angle=180.0), answer_as_solved(answer))
    assert unproved.status is Status.NOT_VERIFIED


def answer_as_solved(answer: SolvedCase) -> SolvedCase:
    return replace(answer, solution=replace(answer.solution, status=Status.SOLVED))


def test_what_falls_while_level_has_none() -> None:
    text = METRES.replace("max:", "transform: {rotate: {axis: [0, 1, 0], angle: 0}}, max:")
    lean = text.replace("{live: [{tilt", "{dead: [{gravity: [6, 0, -9]}], live: [{tilt")
    answer = turned(lean, "parameters.c=100")
    assert answer.solution.status is Status.NO_EQUILIBRIUM
    assert math.isnan(tilt_of(answer.load_case).angle)


def test_what_is_at_its_limit_while_level_falls_at_once() -> None:
    """A force through the centroid that the joint just bears: mu W + c A."""
    force = "{dead: [{gravity: [0, 0, -9.81]}, {force: ['=0.4*w*5.94+4000*2.7', 0, 0], on: block, at: [0, 0.45, 0]}], "
    answer = turned(METRES.replace("{live: [{tilt", force + "live: [{tilt"), "parameters.c=4000")
    assert tilt_of(answer.load_case).tangent
    assert answer.load_factor == pytest.approx(0.0, abs=1e-7)


def test_crushing_on_the_way_is_not_passed_over() -> None:
    """Gravity begins 30 degrees behind the vertical; as it comes upright the joint is crushed, long before 30 degrees
    on the other side, where friction would give way. N = W cos u >= f_c A at u = acos(0.95), less for the lever arm of
    the block, a thousandth of its length."""
    text = METRES.replace("tensile_strength:", "compressive_strength: 19, tensile_strength:")
    text = text.replace('"=2.2*m"', '"=0.001*m"').replace(
        "{live: [{tilt", "{dead: [{gravity: [-4.905, 0, -8.4957]}], live: [{tilt"
    )
    answer = turned(text, "parameters.mu=0.9")
    assert angle(answer) == pytest.approx(30 - math.degrees(math.acos(0.95)), abs=0.1)


def test_a_false_angle_is_found_out() -> None:
    answer = turned(METRES, "parameters.c=4000")
    tilt = tilt_of(answer.load_case)
    line = line_of(METRES, "parameters.c=4000")
    assert not tilt_failures(line.model, line.contacts, answer.load_case, answer.solution)
    false = replace(answer.load_case, question=Angle(replace(tilt, angle=tilt.angle + 0.01)))
    assert len(tilt_failures(line.model, line.contacts, false, answer.solution)) == 1


@pytest.mark.parametrize("rule", ["associative", "non_associative"])
def test_what_slips_with_the_first_turn_has_the_angle_zero(rule: str) -> None:
    """Between two upright walls that hold it along x, frictionless; the axis is not level, so that a part of gravity
    along y comes up as the table turns."""
    text = METRES.replace("axis: [0, 1, 0]", "axis: [0, 1, 0.2]").replace(
        "supports: [", "supports: [{ground: {x: 0}}, {ground: {point: [3, 0, 0], normal: [-1, 0, 0]}}, "
    )
    text = text.replace("blocks: [", "# a little strength, so that the size of the loads counts\nblocks: [")
    answer = turned(text, "parameters.mu=0", "parameters.f=1", f"analysis.flow_rule={rule}")
    assert angle(answer) == 0.0
    assert any("as soon as it turns" in remark for remark in answer.solution.remarks)


@pytest.mark.parametrize(("crossing", "at_once"), [(0.0, True), (5e-7, True), (5e-6, False)])
def test_at_once_is_within_what_rounding_leaves_of_an_angle(
    crossing: float, at_once: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A load factor of 1e-13 puts the crossing of a line through the level loads at sqrt(2e-13), 4.5e-7."""
    text = METRES.replace(
        "supports: [", "supports: [{ground: {x: 0}}, {ground: {point: [3, 0, 0], normal: [-1, 0, 0]}}, "
    )
    text = text.replace("axis: [0, 1, 0]", "axis: [0, 1, 0.2]")
    answer = turned(text, "parameters.mu=0", "parameters.f=1")
    monkeypatch.setattr(tilting_table, "next_angle", lambda tilt, found: crossing)
    assert falls_at_once(tilt_of(answer.load_case), answer) is at_once
    assert not falls_at_once(tilt_of(answer.load_case), replace(answer, solution=carrying(answer, 1e-5)))


def carrying(answer: SolvedCase, load_factor: float) -> Solution:
    mechanics = answer.solution.mechanics
    assert mechanics is not None
    return replace(answer.solution, mechanics=replace(mechanics, load_factor=load_factor))


def test_lifted_out_of_walls_after_turning_over() -> None:
    """Smooth walls bear any load across; the joint below tears where -W cos t = f A, f A = 0.95 W."""
    walls = "{joint: smooth, ground: {x: 0}}, {joint: smooth, ground: {point: [3, 0, 0], normal: [-1, 0, 0]}}, "
    text = METRES.replace("supports: [", "supports: [" + walls).replace("joints: {", "joints: {smooth: {friction: 0}, ")
    answer = turned(text, "parameters.f=41800", "parameters.c=41800")
    assert angle(answer) == pytest.approx(math.degrees(math.acos(-0.95)), rel=1e-8)


def test_in_a_closed_box_it_holds_at_every_angle() -> None:
    """Grounds on all sides, friction alone: the level table bears any multiple, and so does the one turned over."""
    grounds = (
        "{ground: {x: 0}}, {ground: {point: [3, 0, 0], normal: [-1, 0, 0]}}, "
        "{ground: {point: [0, 0, 2.2], normal: [0, 0, -1]}}, "
    )
    answer = turned(METRES.replace("supports: [", "supports: [" + grounds))
    assert math.isnan(tilt_of(answer.load_case).angle)
    assert verified_status(answer.solution, answer.checks) is Status.UNBOUNDED
    assert any("angles tried: 90, 135, 180" in remark for remark in answer.solution.remarks)


GROOVE = """mbla: 1
parameters: {c: 4000, mu: 0.5, t: "=tan(30)"}
materials: {stone: {unit_weight: 20000}}
joints: {bed: {friction: "=mu", cohesion: "=c"}}
blocks:
  - polyhedron:
      material: stone
      vertices: [[0, 0, 0], [9, 0, 0], [0, -1, "=t"], [0, 1, "=t"], [9, -1, "=t"], [9, 1, "=t"]]
      faces: [[0, 2, 3], [1, 4, 5], [0, 1, 4, 2], [0, 1, 5, 3], [2, 3, 5, 4]]
contacts: {joint: bed}
supports:
  - ground: {point: [0, 0, 0], normal: [0, 0.5, "=cos(30)"]}
  - ground: {point: [0, 0, 0], normal: [0, -0.5, "=cos(30)"]}
load_cases: {turn: {live: [{tilt: {axis: [0, 1, 0]}}]}}
analysis: {flow_rule: non_associative}
"""
"""A wedge in a groove of two planes at 30 degrees, 1/cos 30 wide each, that is lifted at one end."""


def test_secants_lead_to_the_angle_without_normality() -> None:
    """W sin t = mu W cos t/cos b + 2 c A/L per length, W = 20000 tan b, A = 1/cos b; normality locks it more."""
    b, mu = math.radians(30), 0.5
    slope = math.atan(mu / math.cos(b))
    cohesion = 2 * 4000 / math.cos(b) / (20000 * math.tan(b))
    expected = slope + math.asin(cohesion * math.cos(slope))
    answer = turned(GROOVE)
    assert reaches(angle(answer), math.degrees(expected))
    assert angle(turned(GROOVE, "analysis.flow_rule=associative")) > angle(answer) + 1.0


@pytest.mark.parametrize(("most", "status"), [(1, Status.NOT_VERIFIED), (3, Status.APPROXIMATE)])
def test_an_angle_that_does_not_settle_is_no_answer(most: int, status: Status, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tilting_table, "MOST_STEPS", most)
    answer = turned(GROOVE)
    assert answer.solution.status is status
    assert "the angle did not settle: its load factor differs from 1 by" in answer.solution.reason


# --- answers made up, as of a structure that may collapse on the way ------------------------------------------------


def made(factor: float, crossing: float, *, static_bound: float = 0.1) -> tuple[Solution, Checks]:
    """What a solver says of a line: its load factor, and the angle in degrees that its mechanism bounds."""
    line = line_of(METRES, "parameters.c=4000")
    table = tilt_of(line.load_case)
    # across · u = factor/sin t and turning · u = 0: the circle leaves the line at t
    size = float((table.across**2).sum())
    mechanism = factor / math.sin(math.radians(crossing)) * table.across / size
    bounding = state(np.zeros((4, 3)), mechanism, factor)
    return claim(bounding), found(static_bound=static_bound)


def searched(factors: Callable[[float], tuple[float, float]]) -> SolvedCase:
    """The search over made-up answers: load factor and bounding angle for every angle in degrees, nan for level."""
    line = line_of(METRES, "parameters.c=4000")

    def ask(case: LoadCase) -> tuple[Solution, Checks]:
        return made(*factors(tilt_of(case).angle))

    return answered(line, ask)


def test_a_line_made_up_is_left_where_it_says() -> None:
    solution, checks = made(0.7, 25.0)
    line = line_of(METRES, "parameters.c=4000")
    next_angle = tilting_table.next_angle(tilt_of(line.load_case), SolvedCase(line.load_case, solution, checks))
    assert math.degrees(next_angle) == pytest.approx(25.0, rel=1e-12)


def tried(answer: SolvedCase) -> str:
    return next(remark for remark in answer.solution.remarks if "angles tried" in remark).split("angles tried: ")[1]


def test_a_collapse_on_the_way_is_found_where_nothing_is_proved_of_the_way() -> None:
    """The level table bears a tenth across, 60 degrees fit; at 30 the structure has fallen, from 20 on as it shows."""

    def factors(degrees: float) -> tuple[float, float]:
        if math.isnan(degrees):
            return 0.5, 60.0
        return (1.0, 60.0) if degrees > 59 else (0.5, 20.0) if degrees > 29 else (1.0 if degrees > 19 else 2.0, 20.0)

    answer = searched(factors)
    assert tilt_of(answer.load_case).angle == pytest.approx(20.0, rel=1e-9)
    assert tried(answer) == "60, 7.5, 15, 22.5, 30, 20"
    assert "tilt-between-not-proved" in {remark.identifier for remark in answer.solution.remarks}


def test_angles_before_are_looked_at_where_nothing_is_proved_of_them() -> None:
    answer = searched(lambda degrees: (0.5 if math.isnan(degrees) else 1.0 if degrees > 59 else 2.0, 60.0))
    assert tilt_of(answer.load_case).angle == pytest.approx(60.0, rel=1e-9)
    assert tried(answer) == "60, 7.5, 15, 22.5, 30, 37.5, 45, 52.5"
    assert "tilt-between-not-proved" in {remark.identifier for remark in answer.solution.remarks}


def test_a_table_that_falls_at_once_on_the_way_has_the_angle_zero() -> None:
    def factors(degrees: float) -> tuple[float, float]:
        return (0.5, 60.0) if math.isnan(degrees) else (1.0, 60.0) if degrees > 59 else (1e-9, 1e-6)

    answer = searched(factors)
    assert tilt_of(answer.load_case).angle == 0.0
    assert tried(answer) == "60, 7.5"


def test_a_probe_without_an_answer_ends_the_search() -> None:
    """Nothing comes down across, and of 90 degrees the solver says nothing."""
    line = line_of(METRES, "parameters.c=4000")

    def ask(case: LoadCase) -> tuple[Solution, Checks]:
        level = math.isnan(tilt_of(case).angle)
        return claim(None, Status.UNBOUNDED if level else Status.NUMERICAL_ERROR, reason="broke down"), found()

    answer = answered(line, ask)
    assert answer.solution.status is Status.NUMERICAL_ERROR
    assert answer.solution.reason == "broke down"
    assert tried(answer) == "90"
