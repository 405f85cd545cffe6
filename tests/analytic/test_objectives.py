"""Least and greatest value of a force: closed forms, a linear program, supports that give way, what must not matter."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

import numpy as np
import pytest

from mbla.results.force_range import force_ranges_of
from mbla.results.outcome import answer_bounds, answer_of, figure_of
from mbla.results.results import CaseResult
from mbla.solution.sequence.objective import measured_force
from mbla.solution.solution import Status
from tests.analytic.planar import (
    arch_joints,
    force_range,
    load_factor,
    polygon_arch,
    rectangles_in_contact,
    wall,
)
from tests.asked import settlement_of
from tests.line import cases_of

EXACT = 1e-7
DENSITY = 2000
WEIGHT = DENSITY * 9.81
HEAD = """
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.5}}
contacts: {joint: dry}
"""


def asked(**forces: str) -> str:
    """Load cases that ask for forces with these sides and directions."""
    return "load_cases:\n" + "".join(f"  {name}: {{objective: {{force: {{{of}}}}}}}\n" for name, of in forces.items())


def ends_in(cases: Sequence[CaseResult]) -> dict[str, tuple[float, float]]:
    """Least and greatest value of every force, each within its bounds; it must be solved, or have no limit."""
    found = {}
    for force in force_ranges_of(cases):
        for case in force.ends.values():
            assert case.status in (Status.SOLVED, Status.UNBOUNDED), (case.status, case.solution.reason)
            assert case.checks.verified, case.checks.failures
            if case.status is Status.SOLVED:
                low, high = answer_bounds(case)
                settlement = settlement_of(case.load_case)
                room = 1e-9 * settlement.unit
                assert low - room <= figure_of(case) <= high + room
        found[force.name] = figure_of(force.ends["least"]), figure_of(force.ends["greatest"])
    return found


def ends_of(text: str, *overrides: str) -> dict[str, tuple[float, float]]:
    """The same of a deck."""
    return ends_in(cases_of(text, *overrides)[1])


# --- Closed forms ---------------------------------------------------------------------------------------------------

BEAM = f"""{HEAD}
blocks:
  - box: {{group: left, material: stone, min: [0, 0, -1], max: [0.2, 0.5, 0]}}
  - box: {{group: middle, material: stone, min: [0.8, 0, -1], max: [1, 0.5, 0]}}
  - box: {{group: right, material: stone, min: [3.8, 0, -1], max: [4, 0.5, 0]}}
  - box: {{group: beam, material: stone, min: [0, 0, 0], max: [4, 0.5, 0.4]}}
supports: [{{blocks: [left, middle, right]}}]
"""


def test_a_beam_on_three_supports() -> None:
    """With W/2 at its middle and two supports at the edges that are least favourable, the third one free of load."""
    forces = {name: f"from: {name}, direction: [0, 0, 1]" for name in ("left", "middle", "right")}
    forces |= {"pull": "from: middle, direction: [1, 0, 0]", "all": "on: beam, direction: [0, 0, 1]"}
    found, weight = ends_of(BEAM + asked(**forces)), WEIGHT * 4 * 0.5 * 0.4
    exact = {
        "left": (0.0, 2.0 / 3.8),
        "middle": (0.0, 2.0 / 3.0),
        "right": (1 / 3, 2.0 / 3.8),
        "pull": (-0.25, 0.25),  # half of the weight on the middle one, which pulls against the other two
        "all": (1.0, 1.0),
    }
    for name, values in exact.items():
        assert np.array(found[name]) / weight == pytest.approx(values, abs=EXACT), name


def test_another_direction_changes_the_sign_and_its_length_nothing() -> None:
    found = ends_of(
        BEAM + asked(up="from: right, on: beam, direction: [0, 0, 1]", down="from: right, direction: [0, 0, -2]")
    )
    least, greatest = found["up"]
    assert found["down"] == pytest.approx((-greatest, -least), rel=EXACT)


def test_a_stack_that_leans_on_a_prop() -> None:
    """The upper block, its centroid beyond the lower one, on edges at 0.6 to 1 m and 1.8 to 2 m."""
    deck = f"""{HEAD}
blocks:
  - box: {{group: lower, material: stone, min: [0, 0, 0], max: [1, 1, 1]}}
  - box: {{group: prop, material: stone, min: [1.8, 0, 0], max: [2, 1, 1]}}
  - box: {{group: upper, material: stone, min: [0.6, 0, 1], max: [2, 1, 2]}}
supports: [{{ground: {{z: 0}}, blocks: lower}}, {{blocks: prop}}]
"""
    forces = {"prop": "from: prop, direction: [0, 0, 1]", "joint": "from: lower, on: upper, direction: [0, 0, 1]"}
    found, weight = ends_of(deck + asked(**forces)), 1.4 * WEIGHT
    assert np.array(found["prop"]) / weight == pytest.approx((0.3, 0.7 / 1.2), rel=EXACT)
    assert sum(found["prop"]) + sum(found["joint"]) == pytest.approx(2 * weight, rel=EXACT)


def test_a_block_beside_a_wall() -> None:
    """Friction of the ground presses it on the wall, whose friction presses it down: μ W/(1 − μ²) at most."""
    deck = f"""{HEAD}
blocks:
  - box: {{group: wall, material: stone, min: [1, 0, 0], max: [2, 1, 1]}}
  - box: {{group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}}
supports: [{{ground: {{z: 0}}}}, {{blocks: wall}}]
"""
    least, greatest = ends_of(deck + asked(h="from: wall, direction: [-1, 0, 0]"))["h"]
    assert least == pytest.approx(0.0, abs=EXACT * WEIGHT)
    assert greatest == pytest.approx(0.5 * WEIGHT / 0.75, rel=EXACT)


def test_a_block_between_two_walls_may_be_pressed_without_limit() -> None:
    deck = f"""{HEAD}
blocks:
  - box: {{group: walls, material: stone, min: [-1, 0, 0], max: [0, 1, 1], repeat: {{count: 2, translate: [2, 0, 0]}}}}
  - box: {{group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}}
supports: [{{ground: {{z: 0}}}}, {{blocks: walls}}]
"""
    of = "from: {group: walls, index: 0}, direction"
    forces = {"h": f"{of}: [1, 0, 0]", "v": f"{of}: [0, 0, 1]", "ground": "on: block, direction: [0, 0, 1]"}
    found = ends_of(deck + asked(**forces))
    assert found["h"][0] == pytest.approx(0.0, abs=EXACT * WEIGHT)
    assert found["h"][1] == math.inf
    assert found["v"] == (-math.inf, math.inf)
    assert found["ground"] == pytest.approx((WEIGHT, WEIGHT), rel=EXACT)  # walls are supports too


@pytest.mark.parametrize("cut", ["springing", "crown"])
def test_an_arch_of_three_hinges(cut: str) -> None:
    """Halves of weight W: W x/z, x from the hinge at the springing to the centroid, z up to that at the crown."""
    deck = f"""{HEAD}
blocks:
  - arch: {{group: arch, material: stone, shape: semicircular, span: 2, thickness: 0.3, width: 0.5, voussoirs: 2,
            springers: ground}}
"""
    left = "{group: arch, index: 0}"
    of = f"on: {left}" if cut == "springing" else f"from: {left}, on: {{group: arch, index: 1}}"
    found = ends_of(deck + asked(h=f"{of}, direction: [1, 0, 0]"), "joints.dry.friction=10")["h"]
    (weight, _), (centroid, _) = polygon_arch(1.0, 1.3, math.pi, 2).weights, polygon_arch(1.0, 1.3, math.pi, 2).points
    out = abs(centroid[0])
    least, greatest = (1.0 - out) / 1.3, (1.3 - out) / 1.0
    assert np.array(found) / (0.5 * WEIGHT * weight) == pytest.approx((least, greatest), rel=EXACT)


# --- A linear program of another formulation ------------------------------------------------------------------------


@pytest.mark.every(3)
@pytest.mark.parametrize("seed", range(6))
def test_arches_by_a_linear_program(seed: int) -> None:
    """Force through a joint of an arch under its weight and a share of what brings it down."""
    pick = random.Random(seed)
    n, mu, share = pick.randint(5, 24), pick.uniform(0.5, 0.9), pick.choice([0.0, 0.5, 0.9])
    thickness, embrace = pick.uniform(0.35, 0.7), pick.choice([180.0, pick.uniform(80.0, 150.0)])
    arch = polygon_arch(2.0, 2.0 + thickness, math.radians(embrace), n)
    joints = arch_joints(arch, mu)
    weights = WEIGHT * arch.weights
    dead, live = np.outer(weights, [0.0, -1.0]), np.outer(weights, [1.0, 0.0])
    at = share * min(load_factor(joints, arch.points, dead, live) or math.inf, 10.0)
    cut, angle = pick.randint(1, n - 1), pick.uniform(-math.pi, math.pi)
    exact = force_range(joints, arch.points, dead + at * live, {cut: 1.0}, np.array([math.cos(angle), math.sin(angle)]))
    half = math.radians(embrace) / 2
    shape = (
        "semicircular, span: 4" if embrace == 180.0 else f"segmental, span: {4 * math.sin(half)}, embrace: {embrace}"
    )
    deck = f"""{HEAD}
blocks:
  - arch: {{group: arch, material: stone, shape: {shape}, thickness: {thickness}, width: 1, voussoirs: {n},
            springers: ground}}
load_cases:
  f:
    live: [{{acceleration: [1, 0, 0]}}]
    at: {at}
    objective:
      force:
        from: {{group: arch, voussoir: [0, {cut - 1}]}}
        on: {{group: arch, voussoir: [{cut}, -1]}}
        direction: [{math.cos(angle)}, 0, {math.sin(angle)}]
"""
    found = ends_of(deck, f"joints.dry.friction={mu}")["f"]
    assert found == pytest.approx(exact, abs=1e-6 * weights.sum())


@pytest.mark.every(2)
@pytest.mark.parametrize("seed", range(4))
def test_forces_through_part_of_a_section_of_a_wall(seed: int) -> None:
    """Between two units of a wall, which touch each other in other ways too."""
    pick = random.Random(seed)
    rows = [[1.0] * 4, [0.5, 1.0, 1.0, 1.0, 0.5], [1.0] * 4, [0.5, 1.0, 1.0, 1.0, 0.5]]
    bricks = list(wall(rows))
    joints = rectangles_in_contact(bricks, 0.6)
    weights = 0.2 * WEIGHT * np.array([brick.area for brick in bricks])
    at, sides = pick.choice([0.0, 0.2]), pick.sample(range(len(bricks)), 6)
    source, target = set(sides[:3]), set(sides[3:])
    cut = {j: 1.0 for j, each in enumerate(joints) if each.a in source and each.b in target}
    cut |= {j: -1.0 for j, each in enumerate(joints) if each.b in source and each.a in target}
    loads = np.outer(weights, [at, -1.0])
    along = np.array([pick.uniform(-1, 1), pick.uniform(-1, 1)])
    along /= np.linalg.norm(along)
    if not cut:
        pytest.skip("these do not touch")
    exact = force_range(joints, np.array([brick.centroid for brick in bricks]), loads, cut, along)
    boxes = "".join(
        f"  - box: {{group: b{i}, material: stone, min: [{b.left}, 0, {b.bottom}], max: [{b.right}, 0.2, {b.top}]}}\n"
        for i, b in enumerate(bricks)
    )
    names = [[f"b{i}" for i in sorted(side)] for side in (source, target)]
    deck = f"""{HEAD}
blocks:
{boxes}
supports: [{{ground: {{z: 0}}}}]
load_cases:
  f:
    live: [{{acceleration: [1, 0, 0]}}]
    at: {at}
    objective: {{force: {{from: {names[0]}, on: {names[1]}, direction: [{along[0]}, 0, {along[1]}]}}}}
"""
    found = ends_of(deck.replace("'", ""), "joints.dry.friction=0.6")["f"]
    assert found == pytest.approx(exact, abs=1e-6 * weights.sum())


# --- The same question asked in another way, and what must not matter -----------------------------------------------

ARCH = f"""{HEAD}
parameters: {{s: 1}}
blocks:
  - arch: {{group: arch, material: stone, shape: semicircular, span: "=4*s", thickness: "=0.6*s", width: "=s",
            voussoirs: 13, springers: blocks}}
"""
THRUST = "{force: {from: {group: arch_springers, index: 1}, direction: [1, 0, 0]}}"
"""of the right springer on the arch: to the left, so negative"""


def test_a_support_that_gives_way_has_the_same_reaction() -> None:
    cases = """load_cases:
  out: {settlement: {on: {group: arch_springers, index: 1}, direction: [1, 0, 0]}}
  in: {settlement: {on: {group: arch_springers, index: 1}, direction: [-1, 0, 0]}}
"""
    _, solved = cases_of(f"{ARCH}{cases}  thrust: {{objective: {THRUST}}}\nanalysis: {{flow_rule: associative}}\n")
    least, greatest = ends_in(solved)["thrust"]
    outwards, inwards = (answer_of(case) for case in solved[:2])
    assert outwards == pytest.approx(-greatest, rel=EXACT)
    assert inwards == pytest.approx(least, rel=EXACT)


PUSHED = f"""{ARCH}load_cases:
  quake: {{live: [{{acceleration: [1, 0, 0]}}]}}
  thrust: {{live: [{{acceleration: [1, 0, 0]}}], at: 0, objective: {THRUST}}}
"""


@pytest.mark.parametrize("flow_rule", ["associative", "non_associative"])
def test_the_state_of_collapse_lies_between_the_ends_which_meet_there_by_normality(flow_rule: str) -> None:
    settings = (f"analysis.flow_rule={flow_rule}", "joints.dry.friction=0.35")
    assembly, (quake, *_) = cases_of(PUSHED, *settings)
    mechanics = quake.solution.mechanics
    assert mechanics is not None
    _, (_, *pair) = cases_of(PUSHED, *settings, f"load_cases.thrust.at={mechanics.load_factor * (1 - 1e-9)!r}")
    settlement = settlement_of(pair[0].load_case)
    own = measured_force(assembly.of(pair[0].load_case), mechanics.contact_forces)
    least, greatest = ends_in(pair)["thrust"]
    room = 1e-5 * settlement.unit
    assert least - room <= own <= greatest + room
    if flow_rule == "associative":
        assert greatest - least <= room


def test_beyond_collapse_nothing_carries_the_loads() -> None:
    _, (quake, *pair) = cases_of(PUSHED, "load_cases.thrust.at=0.5", "joints.dry.friction=0.7")
    assert quake.solution.mechanics is not None
    assert quake.solution.mechanics.load_factor < 0.5
    for case in pair:
        assert case.status is Status.NO_EQUILIBRIUM
        assert case.checks.verified
        assert math.isnan(figure_of(case))


@pytest.mark.every(2)
@pytest.mark.parametrize(
    "change",
    [
        ("analysis.reductions=false",),
        ("analysis.solver=mbla",),
        ("analysis.contact_model=convex",),
        ("analysis.flow_rule=non_associative", "analysis.accuracy=draft"),
        ("joints.dry.compressive_strength=1e12",),
        ("contacts.points.per_edge=2",),
        ("blocks.0.arch.transform=[{rotate: {axis: [0, 0, 1], angle: 90}}, {translate: [50, -20, 3]}]", TURNED := "y"),
    ],
    ids=lambda change: change[0],
)
def test_ways_of_solving_and_places_do_not_matter(change: tuple[str, ...]) -> None:
    cases = f"load_cases:\n  thrust: {{objective: {THRUST}}}\n"
    turned = change[-1] == TURNED
    deck = ARCH + (cases.replace("[1, 0, 0]", "[0, 1, 0]") if turned else cases)
    found = ends_of(deck, *(text for text in change if text != TURNED))["thrust"]
    assert found == pytest.approx(ends_of(ARCH + cases)["thrust"], rel=1e-6)


def test_forces_go_with_the_units() -> None:
    cases = f"load_cases:\n  thrust: {{objective: {THRUST}}}\n"
    found = ends_of(
        ARCH + cases + "units: {length: mm, force: kN, mass: t}\n", "parameters.s=1000", "materials.stone.density=2e-9"
    )
    assert 1e3 * np.array(found["thrust"]) == pytest.approx(ends_of(ARCH + cases)["thrust"], rel=EXACT)


def test_stone_that_crushes_leaves_less_room() -> None:
    cases = f"load_cases:\n  thrust: {{objective: {THRUST}}}\n"
    rough = "joints.dry.friction=0.9"
    least, greatest = ends_of(ARCH + cases, rough)["thrust"]
    crushing = ends_of(ARCH + cases, rough, "joints.dry.compressive_strength=3e5")["thrust"]
    assert least < crushing[0] - 1e-3 * abs(least)
    assert crushing[1] < greatest - 1e-3 * abs(greatest)


def test_glued_blocks_are_one() -> None:
    """The beam in two glued pieces, one of which alone touches the support that is asked for."""
    piece = "{{group: {name}, material: stone, min: [{a}, 0, 0], max: [{b}, 0.5, 0.4]}}"
    beam = "box: {group: beam, material: stone, min: [0, 0, 0], max: [4, 0.5, 0.4]}"
    two = "\n  - box: ".join(piece.format(name=name, a=a, b=b) for name, a, b in (("one", 0, 1.5), ("two", 1.5, 4)))
    glued = BEAM.replace(beam, f"box: {two}").replace(
        "contacts: {joint: dry}", "contacts: {joint: dry, overrides: [{joint: glued, between: [one, two]}]}"
    )
    forces = asked(right="from: right, direction: [0, 0, 1]")
    assert ends_of(glued + forces)["right"] == pytest.approx(ends_of(BEAM + forces)["right"], rel=EXACT)


def test_glue_beside_a_cut_takes_no_part_in_it() -> None:
    """Two cubes glued to each other, and a slab on one of them: the weight amid the edges where they meet."""
    deck = f"""{HEAD.replace("{joint: dry}", "{joint: dry, overrides: [{joint: glued, between: [one, two]}]}")}
blocks:
  - box: {{group: one, material: stone, min: [0, 0, 0], max: [1, 1, 1]}}
  - box: {{group: two, material: stone, min: [1, 0, 0], max: [2, 1, 1]}}
  - box: {{group: slab, material: stone, min: [0, 0, 1], max: [2, 1, 2]}}
supports: [{{ground: {{z: 0}}}}]
"""
    forces = {name: f"on: {name}, direction: [0, 0, 1]" for name in ("one", "two")}
    found = ends_of(deck + asked(**forces, slab="from: two, on: slab, direction: [0, 0, 1]"))
    for name, most in (("one", 4.0), ("two", 4.0), ("slab", 2.0)):
        assert np.array(found[name]) / WEIGHT == pytest.approx((0.0, most), abs=EXACT), name


def test_forces_in_space() -> None:
    """A slab on four columns: two of them, on one diagonal, can carry all of it, or nothing."""
    column = "box: {{group: c{i}, material: stone, min: [{x}, {y}, -1], max: [{x1}, {y1}, 0]}}"
    corners = [(0, 0), (3.8, 0), (0, 2.8), (3.8, 2.8)]
    columns = "".join(
        f"  - {column.format(i=i, x=x, y=y, x1=x + 0.2, y1=y + 0.2)}\n" for i, (x, y) in enumerate(corners)
    )
    deck = f"""{HEAD}
blocks:
{columns}
  - box: {{group: slab, material: stone, min: [0, 0, 0], max: [4, 3, 0.2]}}
supports: [{{blocks: [c0, c1, c2, c3]}}]
"""
    found = ends_of(deck + asked(pair="from: [c0, c3], direction: [0, 0, 1]"))["pair"]
    assert np.array(found) / (WEIGHT * 4 * 3 * 0.2) == pytest.approx((0.0, 1.0), abs=EXACT)


TIED = f"""{HEAD.replace("contacts: {joint: dry}", "")}
blocks:
  - arch: {{group: arch, material: stone, shape: semicircular, span: 4, thickness: 0.6, width: 1, voussoirs: 13}}
  - box: {{group: left, material: stone, min: [-0.7, 0, -0.5], max: [0.2, 1, 0]}}
  - box: {{group: right, material: stone, min: [3.8, 0, -0.5], max: [4.7, 1, 0]}}
contacts: {{joint: dry, overrides: [{{joint: frictionless, between: [ground, right]}}]}}
supports: [{{ground: {{z: -0.5}}}}]
ties: [{{name: rod, through: [[0, 0.5, -0.25], [4, 0.5, -0.25]], on: [left, right], capacity: 1e5}}]
load_cases:
  tie: {{objective: {{tie: rod}}}}
  thrust: {{objective: {{force: {{from: left, on: arch, direction: [1, 0, 0]}}}}}}
"""


def test_a_tie_has_the_thrust_of_the_arch_that_it_holds() -> None:
    """Its right springer slides freely. Prestress changes nothing, as between limits without it."""
    rough = "joints.dry.friction=0.9"
    free = ends_of(TIED, rough)
    assert free["tie"] == pytest.approx(free["thrust"], rel=EXACT)
    weak = ends_of(TIED, rough, "ties.0.capacity=15000")
    assert weak["tie"] == pytest.approx((free["tie"][0], 15000.0), rel=EXACT)
    assert ends_of(TIED, rough, "ties.0.prestress=15000")["tie"] == pytest.approx(free["tie"], rel=EXACT)


def test_a_tie_that_is_too_weak_for_every_thrust() -> None:
    _, solved = cases_of(TIED, "joints.dry.friction=0.9", "ties.0.capacity=5000")
    assert [case.status for case in solved] == [Status.NO_EQUILIBRIUM] * 4
    assert all(case.checks.verified for case in solved)


def test_one_of_two_ties_side_by_side_in_space() -> None:
    """In its own half of a structure that is symmetric: it may be slack, or carry what the other leaves out."""
    two = TIED.replace("[0, 0.5, -0.25], [4, 0.5, -0.25]", "[0, 0.3, -0.25], [4, 0.3, -0.25]").replace(
        "capacity: 1e5}", "capacity: 1e5, repeat: {count: 2, translate: [0, 0.4, 0]}}"
    )
    one = two + "  one: {objective: {tie: rod, index: 1}}\n"
    found = ends_of(one, "joints.dry.friction=0.9")
    least, greatest = found["tie"]
    assert found["thrust"] == pytest.approx((least, greatest), rel=1e-6)
    assert 0.0 <= found["one"][0] < 0.45 * greatest
    assert 0.55 * least < found["one"][1] <= greatest * (1 + 1e-6)
    full = ends_of(one, "joints.dry.friction=0.9", "analysis.reductions=false")
    assert full["one"] == pytest.approx(found["one"], rel=1e-6, abs=1e-6 * greatest)


LEVER = (
    HEAD
    + """\
blocks:
  - box: {group: beam, material: stone, min: [0, 0, 0], max: [4, 1, 0.4]}
  - box: {group: pad, material: stone, min: [0, 0, -0.4], max: [0.2, 1, 0]}
  - box: {group: pad, material: stone, min: [3.8, 0, -0.4], max: [4, 1, 0]}
supports: [{blocks: pad}]
ties: [{through: [[0.1, 0.5, 0.4], [0.1, 0.5, -3]], on: [beam, ground], capacity: 5000}]
load_cases:
  sinks:
    dead: [{gravity: none}, {moment: [0, 3000, 0], on: beam}]
    settlement: {on: {group: pad, index: 1}, direction: [0, 0, -1]}
  ends:
    dead: [{gravity: none}, {moment: [0, 3000, 0], on: beam}]
    objective: {force: {on: beam, from: {group: pad, index: 1}, direction: [0, 0, 1]}}
analysis: {flow_rule: associative}
"""
)


def test_moments_alone_are_loads() -> None:
    """A beam without weight that is twisted about a tie: 3000 N m between the tie, the pad beside it and the other."""
    _, (sinks, *ends) = cases_of(LEVER)
    assert answer_of(sinks) == pytest.approx(657.8947368, rel=1e-6)
    assert [answer_of(end) for end in ends] == pytest.approx([657.8947368, 921.0526316], rel=1e-6)
