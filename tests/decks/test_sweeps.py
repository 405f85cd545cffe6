"""Sweeps of decks/sweeps: each is read and made, some of its points are solved, and all of them under ``-m long``."""

from __future__ import annotations

import json
from collections.abc import Sequence
from itertools import pairwise

import jsonschema
import numpy as np
import pytest

from mbla.deck.text.include import read_files
from mbla.sweeps.command import dry_run_json
from mbla.sweeps.file.read import SWEEP_FILE
from tests.analytic.frictional_arch import least_thickness
from tests.decks.folder import DECKS, ROOT, deck_of
from tests.decks.sweeps import NAMES, SWEEPS, Row, number, prepared_sweep, solve_some, sweep_path, whole_sweep

POINTS = {
    "block_records": 25,
    "arch_friction_thickness": 527,
    "dome_workmanship": 96,
    "house_directions": 36,
    "prestwood": 20,
    "rubble_wall": 500,
    "wall_opening": 66,
}
"""of each sweep, those that its constraints leave out not among them"""

RESULTS = {"block_records": "time_history.peak"}
"""of sweeps of which the load factor is not the result"""

SAME = 1e-6
"""relative; the bounds of a standard or draft run, which prove its load factor, lie within 3e-7 of each other"""


@pytest.mark.parametrize("name", NAMES)
def test_every_sweep_agrees_with_its_schema_and_its_row_of_the_page(name: str) -> None:
    prepared, path = prepared_sweep(name), sweep_path(name)
    assert len(prepared.design.points) == POINTS[name]
    assert dry_run_json(prepared)["different"] == POINTS[name]  # no point twice
    assert prepared.title
    assert RESULTS.get(name, "load_factor") in prepared.plan.results
    prefix, schema = "# yaml-language-server: $schema=", ROOT / "schemas" / "sweep.schema.json"
    first = path.read_text(encoding="utf-8").splitlines()[0]
    assert (path.parent / first.removeprefix(prefix)).resolve() == schema
    jsonschema.validate(read_files(path, kind=SWEEP_FILE)[0].data, json.loads(schema.read_text(encoding="utf-8")))
    page = (SWEEPS / "README.md").read_text(encoding="utf-8")
    row = next(line for line in page.splitlines() if line.startswith(f"| [{name}.yaml]({name}.yaml)"))
    assert f"| {POINTS[name]} |" in row
    assert (DECKS / "pictures" / row.split("(../pictures/")[1].split(")")[0]).is_file()


# --- arch: friction and thickness ---------------------------------------------------------------------------------

STEP = 0.005
"""of the thicknesses, m"""
FINITE_JOINTS = 1e-4
"""With 86 joints the arch stands down to a thickness that is smaller than the theory's by up to 7.4e-5 (linear programs
at six frictions); twenty would make that 2e-3."""


def check_arch(rows: Sequence[Row]) -> None:
    """The least thickness that stands is the theory's within one step; more friction or thickness never weakens."""
    stands = {(number(row, "mu"), number(row, "t")): row["status"] == "solved" for row in rows}
    assert {row["status"] for row in rows} == {"solved", "no_equilibrium"}
    assert {row["state"] for row in rows} == {"done"}
    for mu in sorted({mu for mu, _ in stands}):
        least = least_thickness(mu)
        for t in sorted(t for other, t in stands if other == mu):
            if least is None or t < least - FINITE_JOINTS:
                assert not stands[mu, t], (mu, t, least)
            elif t > least:
                assert stands[mu, t], (mu, t, least)
    check_never_weaker(rows, "mu", "t")
    check_never_weaker(rows, "t", "mu")


def check_never_weaker(rows: Sequence[Row], by: str, at: str) -> None:
    """Forces that a joint bears it bears with more friction, and inside a thicker one, too."""
    for fixed in {row[at] for row in rows}:
        line = sorted((row for row in rows if row[at] == fixed), key=lambda row: number(row, by))
        factors = [number(row, "load_factor") if row["status"] == "solved" else 0.0 for row in line]
        assert all(less <= more * (1 + SAME) for less, more in pairwise(factors)), (at, fixed, factors)


def least_standing(rows: Sequence[Row], mu: float) -> float | None:
    """Least thickness of a table that stands at a friction."""
    return min((number(row, "t") for row in rows if row["mu"] == mu and row["status"] == "solved"), default=None)


@pytest.mark.long
def test_the_arch_stands_on_one_side_of_the_theory() -> None:
    """At each friction the steps next to the curve, and a thick arch."""
    chosen = {0.30: (0.24,), 0.32: (0.185, 0.19, 0.24), 0.38: (0.12, 0.125, 0.24), 0.45: (0.105, 0.11, 0.24)}
    near = [(mu, t) for mu, thicknesses in chosen.items() for t in thicknesses]
    prepared = prepared_sweep("arch_friction_thickness")
    rows = solve_some(
        prepared, lambda row: any(np.allclose((number(row, "mu"), number(row, "t")), each) for each in near)
    )
    assert len(rows) == len(near)
    check_arch(rows)


@pytest.mark.trust
def test_the_whole_map_of_the_arch_has_the_theory_for_its_boundary() -> None:
    finished, rows = whole_sweep("arch_friction_thickness")
    assert finished.exit_code == 0
    check_arch(rows)
    frictions = sorted({number(row, "mu") for row in rows})
    assert len(frictions) == 17
    for mu in frictions:
        least, found = least_thickness(mu), least_standing(rows, mu)
        if least is None:
            assert mu < 0.309215
            assert found is None
        else:
            assert found is not None
            assert least - FINITE_JOINTS <= found < least + STEP
    assert sum(row["status"] == "solved" for row in rows) == 321


# --- block: records -----------------------------------------------------------------------------------------------


@pytest.mark.long
def test_a_block_under_records_stands_falls_and_stands_again() -> None:
    """Not at about b/h = 0.25 g, and not the more the stronger: under one record it falls at 0.5 and not at 0.6."""
    chosen = ((0.3, 1), (0.5, 4), (0.6, 4))
    rows = solve_some(
        prepared_sweep("block_records"),
        lambda row: any(
            (row["scale"], row["record"]) == (scale, f"records/shake_{name}.csv") for scale, name in chosen
        ),
    )
    assert [(row["state"], row["time_history.fallen"]) for row in rows] == [("done", 0), ("done", 1), ("done", 0)]
    assert 0.07 < number(rows[2], "time_history.peak") < 0.12  # it hits often: the last digits of a step move it by 5 %
    for row, (scale, _) in zip(rows, chosen, strict=True):
        assert 0.85 * scale < number(row, "time_history.motions.0.peak_acceleration") / 9.80665 < 1.15 * scale


@pytest.mark.trust
def test_the_whole_sweep_of_records_and_its_fragility() -> None:
    finished, rows = whole_sweep("block_records")
    assert finished.exit_code == 0
    fallen = [
        each["passing"] for one in finished.record["fragility"] for each in one["limits"] if each["limit"] == "falls"
    ]
    assert fallen == [0, 2, 3, 2, 5]
    assert sum(number(row, "time_history.fallen") for row in rows) == sum(fallen)
    _, falls = finished.record["fragility_curves"]
    assert (falls["median"], falls["dispersion"]) == pytest.approx((0.505, 0.338), abs=2e-3)


# --- house: directions --------------------------------------------------------------------------------------------


def check_convex(rows: Sequence[Row]) -> None:
    """Loads that are borne together form a convex set under associative flow, so no direction dents the diagram."""
    line = sorted(rows, key=lambda row: number(row, "direction"))
    angles = np.radians([number(row, "direction") for row in line])
    factors = np.array([number(row, "load_factor") for row in line])
    ends = factors[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    edges = np.roll(ends, -1, axis=0) - ends
    after = np.roll(edges, -1, axis=0)
    turns = edges[:, 0] * after[:, 1] - edges[:, 1] * after[:, 0]
    assert (turns >= -SAME * factors.max() ** 2).all()


@pytest.mark.trust
def test_the_diagram_of_the_house_is_convex_and_has_the_figures_of_its_deck() -> None:
    rows = solve_some(prepared_sweep("house_directions"), lambda row: number(row, "direction") % 30 == 0)
    check_convex(rows)
    found = {number(row, "direction"): number(row, "load_factor") for row in rows}
    expected = deck_of(DECKS / "structures" / "house.yaml").content.expected
    assert found[0] == pytest.approx(expected["push_x"].load_factor, rel=SAME)
    assert found[90] == pytest.approx(expected["push_y"].load_factor, rel=SAME)
    for row in rows:
        assert number(row, "static_bound") <= number(row, "kinematic_bound") * (1 + SAME)


# --- wall: opening ------------------------------------------------------------------------------------------------

SOLID = 0.51752079
"""in the plane of the wall: an upper corner falls, which a narrow opening does not touch"""


def overturning(row: Row) -> float:
    """Closed form out of the plane: half the thickness over the height of the centroid, the oak lintel weighed."""
    values = {name: float(value) for name, value in base_parameters().items()}
    course, length, height = values["c"], values["length"], values["n"] * values["c"]
    width, rise, lintel = number(row, "width"), number(row, "rise") * course, number(row, "width")
    lintel += 2 * number(row, "bearing")
    parts = [
        (2200 * length * height, height / 2),
        (-2200 * width * rise, rise / 2),
        (-(2200 - 800) * lintel * course, rise + course / 2),
    ]
    weight, moment = sum(part[0] for part in parts), sum(part[0] * part[1] for part in parts)
    return values["t"] / 2 / (moment / weight)


def base_parameters() -> dict[str, float]:
    """Of the wall with an opening."""
    parameters = deck_of(SWEEPS / "base" / "wall_with_opening.yaml").content.parameters
    return {name: float(value) for name, value in parameters.items()}


def check_wall(rows: Sequence[Row]) -> dict[tuple[float, float, float], float]:
    """Out of the plane the closed form; the factors in the plane by rise, bearing and width in units of 0.4 m.

    In the plane a wider opening need not weaken the wall. A rigid lintel does not break, so that it ties what stands
    on it as soon as it reaches into the crack of the solid wall; and its ends matter more than the jambs: where they
    lie in the middle of the units of their course, in line with the joints above and below, the wall is weaker than
    one whose opening is wider by half a unit at either side.
    """
    for row in rows:
        assert row["state"] == "done"
        assert number(row, "out_of_plane.load_factor") == pytest.approx(overturning(row), rel=SAME)
        assert row["out_of_plane.mechanism.class"] == "overturning"
    return {
        (number(row, "rise"), number(row, "bearing"), round(number(row, "width") / 0.4)): number(
            row, "in_plane.load_factor"
        )
        for row in rows
    }


@pytest.mark.long
def test_a_wider_opening_weakens_the_wall_only_where_its_lintel_ends_badly() -> None:
    points = ((6, 0.4, 1), (6, 0.4, 8), (6, 0.6, 7), (6, 0.4, 9))
    rows = solve_some(
        prepared_sweep("wall_opening"),
        lambda row: any(
            np.allclose((number(row, "rise"), number(row, "bearing"), number(row, "width") / 0.4), each)
            for each in points
        ),
    )
    found = check_wall(rows)
    assert len(found) == len(points)
    assert found[6, 0.4, 1] == pytest.approx(SOLID, rel=SAME)
    assert found[6, 0.6, 7] == pytest.approx(found[6, 0.4, 8], rel=SAME)  # the lintel ends at one place
    assert found[6, 0.4, 8] < 0.91 * SOLID < SOLID < found[6, 0.4, 9]


@pytest.mark.trust
def test_the_whole_sweep_of_the_opening() -> None:
    finished, rows = whole_sweep("wall_opening")
    assert finished.exit_code == 0
    found = check_wall(rows)
    assert found[10, 0.4, 10] == pytest.approx(0.39300695, rel=SAME)
    assert min(found.values()) == found[10, 0.4, 10]
    assert max(found.values()) == found[6, 0.6, 10] == pytest.approx(0.5631, rel=1e-3)
    for (rise, bearing, width), factor in found.items():
        assert factor >= 0.39
        later = found.get((rise, bearing, width + 1))
        out = {round(number(row, "width") / 0.4): number(row, "out_of_plane.load_factor")
               for row in rows if (row["rise"], row["bearing"]) == (rise, bearing)}  # fmt: skip
        if later is not None:  # the wall loses weight below: it always weakens out of its plane
            assert out[int(width) + 1] < out[int(width)]


# --- Prestwood ----------------------------------------------------------------------------------------------------

SCATTER = 0.1
"""by which the load factor on a mesh that is moved may lie above that on another one"""


def check_prestwood(rows: Sequence[Row]) -> None:
    """All solved; more friction or cohesion of the soil never weakens, but for what moved meshes scatter."""
    assert {(row["state"], row["status"]) for row in rows} == {("done", "solved")}
    names = ("phi", "c", "delta", "size")
    found = {tuple(number(row, name) for name in names): number(row, "load_factor") for row in rows}
    for less, factor in found.items():
        for more, other in found.items():
            if less[3] == more[3] and all(np.less_equal(less, more)):
                assert factor <= (1 + SCATTER) * other, (less, more)


@pytest.mark.long
def test_prestwood_with_weak_and_with_strong_soil() -> None:
    chosen = {(27, 0, 20, 0.3), (33, 10, 27, 0.3)}
    rows = solve_some(
        prepared_sweep("prestwood"),
        lambda row: tuple(number(row, name) for name in ("phi", "c", "delta", "size")) in chosen,
    )
    assert len(rows) == len(chosen)
    check_prestwood(rows)


@pytest.mark.trust
def test_the_whole_sweep_of_prestwood() -> None:
    finished, rows = whole_sweep("prestwood")
    assert finished.exit_code == 0
    check_prestwood(rows)


# --- rubble wall --------------------------------------------------------------------------------------------------

LENGTH_OVER_HEIGHT = 1.0


def check_rubble(rows: Sequence[Row]) -> None:
    """Every wall has a proved factor, and none is stronger than one block of its size: it slides, or overturns."""
    for row in rows:
        assert (row["state"], row["status"]) == ("done", "solved")
        factor, friction = number(row, "load_factor"), number(row, "friction")
        assert number(row, "static_bound") <= number(row, "kinematic_bound") * (1 + SAME)
        assert 0 < factor <= min(friction, LENGTH_OVER_HEIGHT) * (1 + SAME)


def test_walls_of_random_units_lie_below_the_block_of_their_size() -> None:
    rows = solve_some(prepared_sweep("rubble_wall"), lambda row: number(row, "point") <= 4)
    check_rubble(rows)
    assert len({row["load_factor"] for row in rows}) == len({row["seed"] for row in rows}) == 4


@pytest.mark.trust
def test_the_whole_sample_of_rubble_walls_and_its_fragility() -> None:
    finished, rows = whole_sweep("rubble_wall")
    assert finished.exit_code == 0
    check_rubble(rows)
    factors = np.array([number(row, "load_factor") for row in rows])
    assert factors.mean() == pytest.approx(0.50001, abs=1e-5)
    assert factors.std() == pytest.approx(0.07426, abs=1e-5)
    (fragility,) = finished.record["fragility"]
    assert fragility["unknown"] == 0
    below = {each["demand"]: each["below"] for each in fragility["demands"]}
    assert list(below.values()) == [33, 118, 264, 397, 460, 485]
    assert list(below.values()) == [int((factors < demand).sum()) for demand in below]


# --- dome ---------------------------------------------------------------------------------------------------------

SAMPLE = 48
"""points of the Latin hypercube, which each bond has"""


def check_dome(rows: Sequence[Row]) -> None:
    """No dome bears more than friction under it; slices that nothing ties bear less than rings in bond."""
    by_point = {int(number(row, "point")): row for row in rows}
    for point, row in by_point.items():
        assert (row["state"], row["status"]) == ("done", "solved")
        assert number(row, "load_factor") <= number(row, "friction") * (1 + SAME)
        if row["bond"] == "running":
            slices = by_point[point + SAMPLE]
            assert slices["bond"] == "stack"
            assert [slices[name] for name in WORKMANSHIP] == [row[name] for name in WORKMANSHIP]
            assert number(slices, "load_factor") < number(row, "load_factor")


WORKMANSHIP = ("thickness", "edge_loss", "friction")


def test_a_dome_of_slices_is_weaker_than_one_in_bond() -> None:
    rows = solve_some(prepared_sweep("dome_workmanship"), lambda row: number(row, "point") in (13, 13 + SAMPLE))
    check_dome(rows)
    assert len(rows) == 2
