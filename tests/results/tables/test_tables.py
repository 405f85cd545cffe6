"""What stands in the tables: counts, positions, units, and numbers against what is known of the tower."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.errors import UsageError
from mbla.results.outcome import notices_of
from mbla.results.quantities.quantity import COMPONENTS, Quantity
from mbla.results.quantities.registry import BLOCK_COLUMNS, CASE_COLUMNS, INTERFACE_COLUMNS, POINT_COLUMNS
from mbla.results.results import Results
from mbla.results.tables.tables import TABLES, tables_of
from mbla.solution.solution import Status
from tests.results.rocking import rocking_case, rocks
from tests.results.synthetic import tower_results


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
        "ties": 0,
        "programs": 2,
        "iterations": 12,
        "path": 0,
        "curve": 0,
        "history": 0,
        "history_interfaces": 0,
        "history_steps": 0,
        "spectra": 0,
        "modes": 0,
        "modes_after": 0,
        "sensitivity": 0,
        "series": 0,
        "notices": len(notices_of(results)),
    }


def test_spectra_are_those_of_the_base_and_then_of_points() -> None:
    results, spectra = tower_results(), rocks().spectra
    assert spectra is not None
    table = tables_of(replace(results, cases=(rocking_case(results.cases[0]),)), ["spectra"])["spectra"]
    n = len(spectra.periods)
    assert table["point"].tolist() == ["base"] * n + ["middle"] * n
    assert np.array_equal(table["period"], np.tile(spectra.periods, 2))
    assert np.array_equal(table["spectral_acceleration_x"], np.append(spectra.base[:, 0], spectra.points[0, :, 0]))


def test_the_best_iterate_is_no_result(results: Results) -> None:
    tables = tables_of(unsolved(results, Status.NOT_VERIFIED), cases=["push_x"])
    cases = tables["cases"]
    assert cases["status"].tolist() == ["not_verified"]
    assert np.isnan(cases["load_factor"]).all()
    assert cases["best_iterate_load_factor"].tolist() == [0.5]
    for name in ("cases", "blocks", "interfaces", "points", "reactions"):
        assert set(tables[name]["figures"].tolist()) == {"best_iterate"}


@pytest.mark.parametrize(
    ("names", "cases", "words"), [(["beams"], None, "no table beams"), (None, ["x"], "no load case x")]
)
def test_unknown_names_are_refused(results: Results, names: list[str], cases: list[str], words: str) -> None:
    with pytest.raises(UsageError, match=words):
        tables_of(results, names, cases)


@pytest.mark.parametrize("columns", [CASE_COLUMNS, BLOCK_COLUMNS, INTERFACE_COLUMNS, POINT_COLUMNS])
def test_every_dimension_of_a_column_has_names_for_its_components(columns: tuple[Quantity, ...]) -> None:
    """Else a table that has values for it cannot be made; sentences are joined to one text."""
    rows = int(columns is not CASE_COLUMNS)
    known = {*COMPONENTS, "sentence"}
    assert {dim for column in columns for dim in column.dims[rows:]} <= known
