"""What stands in the tables: counts, positions, units, and numbers against what is known of the tower."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pandas
import pytest

from mbla.deck.units import Units
from mbla.errors import UsageError
from mbla.results.outcome import notices_of
from mbla.results.results import Results
from mbla.results.tables.tables import TABLES, tables_of
from mbla.solution.solution import Status
from tests.results.synthetic import TOWER_WEIGHT, standing_at, tower_results


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


def unsolved(results: Results, status: Status) -> Results:
    """The first case with the same figures and another status."""
    return replace(results, cases=(replace(results.cases[0], status=status), results.cases[1]))


@pytest.mark.parametrize("kind", TABLES.values(), ids=TABLES)
def test_columns_are_told_apart_and_explained(kind: object) -> None:
    columns = TABLES[kind.name].columns  # type: ignore[attr-defined]
    assert len({column.name for column in columns}) == len(columns)
    assert all(column.words and column.name.replace("_", "").isalnum() for column in columns)


def test_rows_are_blocks_interfaces_and_points_for_each_case(results: Results) -> None:
    tables = tables_of(results)
    assert list(tables) == list(TABLES)
    assert {name: len(table) for name, table in tables.items()} == {
        "cases": 2,
        "blocks": 2 * 3,
        "interfaces": 2 * 2,
        "points": 2 * 8,
        "reactions": 2,
        "programs": 2,
        "iterations": 12,
        "path": 0,
        "series": 0,
        "notices": len(notices_of(results)),
    }


def test_numbers_of_the_tower(results: Results) -> None:
    """The tower turns about its edge x = 1, y = 0.5, z = 1 and presses there."""
    tables = tables_of(results, cases=["push_x"])
    hinge, brick = tables["interfaces"].to_pandas().to_dict("records")
    assert (hinge["modes"], brick["modes"]) == ("hinge", "stick")
    assert hinge["resultant_forces_z"] == pytest.approx(TOWER_WEIGHT)
    assert hinge["normal_forces"] == pytest.approx(TOWER_WEIGHT)
    assert hinge["shear_forces"] == pytest.approx(0.5 * TOWER_WEIGHT)
    assert [hinge[f"thrust_points_{axis}"] for axis in "xyz"] == pytest.approx([1, 0.5, 1])
    assert hinge["eccentricity"] == pytest.approx(1)
    assert [hinge[f"hinge_points_{axis}"] for axis in "xyz"] == pytest.approx([1, 0.5, 1])
    assert np.isnan(brick["hinge_points_x"])
    moving = tables["blocks"].to_pandas().query("parts == 1")
    assert list(moving["block_name"]) == ["tower[0]"]
    velocity = moving[["mechanism_x", "mechanism_y", "mechanism_z"]].to_numpy()[0]
    live = moving[["live_load_x", "live_load_y", "live_load_z"]].to_numpy()[0]
    assert velocity @ live == pytest.approx(1)
    reactions = tables["reactions"].to_pandas()
    assert reactions["reaction_z"].sum() == pytest.approx(2 * TOWER_WEIGHT)


def test_units_are_those_of_the_deck(results: Results) -> None:
    changed = replace(results, model=replace(results.model, units=Units("mm", "kN", "t")))
    header = tables_of(changed)["interfaces"].header
    for column in (
        "areas [mm2]",
        "centroids_x [mm]",
        "resultant_moments_z [kN mm]",
        "rotations_x [1/(kN mm)]",
        "eccentricity",
    ):
        assert column in header
    assert tables_of(changed)["blocks"].unit_of["densities"] == "t/mm3"


def test_the_best_iterate_is_no_result(results: Results) -> None:
    tables = tables_of(unsolved(results, Status.NOT_VERIFIED), cases=["push_x"])
    cases = tables["cases"]
    assert cases["status"].tolist() == ["not_verified"]
    assert np.isnan(cases["load_factor"]).all()
    assert cases["best_iterate_load_factor"].tolist() == [0.5]
    for name in ("cases", "blocks", "interfaces", "points", "reactions"):
        assert set(tables[name]["figures"].tolist()) == {"best_iterate"}


def test_without_equilibrium_there_is_the_motion_that_proves_it_and_nothing_else(results: Results) -> None:
    tables = tables_of(results, cases=["fall"])
    blocks, interfaces, points = (tables[name] for name in ("blocks", "interfaces", "points"))
    assert blocks["certificate_z"].tolist() == [0, -1, 0]
    assert interfaces["certificate_translations_z"].tolist() == [-1, 0]  # base under tower; brick stands on the ground
    for table, column in (
        (blocks, "mechanism_x"),
        (interfaces, "resultant_forces_x"),
        (interfaces, "work"),
        (points, "contact_forces_N"),
    ):
        assert np.isnan(table[column]).all()
    assert blocks["parts"].tolist() == [0, 1, 0]
    assert set(interfaces["modes"].tolist()) == {""}
    assert tables["cases"]["status"].tolist() == ["no_equilibrium"]
    assert tables["cases"]["reason"].tolist() == ["the dead load cannot be carried"]
    assert len(tables["reactions"]) == 0


def test_blocks_without_a_position_have_none(results: Results) -> None:
    blocks = tables_of(results)["blocks"]
    assert np.ma.getmaskarray(blocks["course"]).all()
    assert blocks.to_pandas()["course"].isna().all()


def test_models_without_contacts_or_cases_have_tables_without_rows(results: Results) -> None:
    none = replace(results, cases=())
    assert {len(table) for name, table in tables_of(none).items() if name != "notices"} == {0}
    assert all(len(table.to_pandas().columns) == len(table.columns) for table in tables_of(none).values())


def test_frames_carry_units_and_meanings(results: Results) -> None:
    frame = tables_of(results)["blocks"].to_pandas()
    assert frame.attrs["units"]["centroids_x"] == "m"
    assert frame.attrs["units"]["block_name"] == ""
    assert frame.attrs["meanings"]["volumes"] == "volume"
    assert pandas.api.types.is_bool_dtype(frame["fixed"])
    assert pandas.api.types.is_integer_dtype(frame["block"])


@pytest.mark.parametrize(
    ("names", "cases", "words"), [(["beams"], None, "no table beams"), (None, ["x"], "no load case x")]
)
def test_unknown_names_are_refused(results: Results, names: list[str], cases: list[str], words: str) -> None:
    with pytest.raises(UsageError, match=words):
        tables_of(results, names, cases)


def test_positions_of_a_travelling_load_that_was_not_asked_for_are_left_out(results: Results) -> None:
    """The other case has no positions."""
    first, second = results.cases
    travel = standing_at(1, 1, np.zeros(3), 0.0)
    moved = replace(first, load_case=replace(first.load_case, travel=travel))
    travelled = replace(results, cases=(moved, second))
    assert len(tables_of(travelled)["series"]) == 1
    assert len(tables_of(travelled, cases=[second.load_case.name])["series"]) == 0
