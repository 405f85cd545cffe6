"""Result files in xarray: every group opens, with the dimensions, units and values that the layout promises."""

from __future__ import annotations

import contextlib
import io
import os
import re
from dataclasses import replace
from pathlib import Path, PurePosixPath
from typing import Any

import h5py
import numpy as np
import pytest
import xarray

from mbla.deck.units import Units
from mbla.results.hdf5.layout import SHARED_DIMENSIONS, fields_of
from mbla.results.hdf5.result_file import write_results_hdf5
from mbla.results.quantities.quantity import unit_text
from mbla.results.quantities.registry import STORED
from tests.results.synthetic import full_results

PAGE = Path(__file__).parents[3] / "schemas" / "results.md"


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("xarray") / "tower.h5"
    path.write_bytes(write_results_hdf5(full_results()))
    return path


def groups_of(path: Path) -> list[str]:
    found: list[str] = []
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.append(name) if isinstance(item, h5py.Group) else None)
    return found


def plain(values: Any) -> Any:
    """Values as HDF5 holds them, text decoded."""
    array = np.asarray(values)
    return np.char.decode(array, "utf-8") if array.dtype.kind == "S" else array


@pytest.mark.long
def test_every_group_opens_with_named_dimensions_units_and_values(path: Path) -> None:
    fields = dict(fields_of(case.name for case in full_results().model.load_cases))
    seen = 0
    with h5py.File(path) as file:
        for group in groups_of(path):
            with xarray.open_dataset(path, group=group, engine="h5netcdf") as data:
                for name, variable in data.variables.items():
                    dataset = file[f"{group}/{name}"]
                    if dataset.is_scale:
                        continue
                    field = fields[f"{group}/{name}"]
                    assert variable.dims == field.dims, field.path
                    assert variable.attrs["units"] == unit_text(field.unit, Units())
                    assert variable.attrs["long_name"] == field.words
                    assert np.array_equal(
                        variable.values.astype(str) if field.kind == "text" else variable.values,
                        plain(dataset[()]),
                        equal_nan=field.kind == "float",
                    ), field.path
                    assert field.kind != "text" or all(isinstance(text, str) for text in variable.values.ravel())
                    seen += 1
    assert seen > 250


def test_no_dataset_has_the_name_of_a_dimension_that_it_sees() -> None:
    """netCDF takes it for the coordinate of that dimension."""
    scales = {
        name if name in SHARED_DIMENSIONS else f"{f.path.rpartition('/')[0]}/{name}" for f in STORED for name in f.dims
    }
    for field in STORED:
        group, _, name = field.path.rpartition("/")
        parents = [group, *map(str, PurePosixPath(group).parents)]
        assert not scales & {name, *(f"{parent}/{name}" for parent in parents)}, field.path


def test_single_letters_stay_apart(path: Path) -> None:
    """netCDF joins arrays of one byte each to words."""
    results = full_results()
    tons = path.with_name("tons.h5")
    tons.write_bytes(
        write_results_hdf5(
            replace(
                results, assembly=replace(results.assembly, model=replace(results.model, units=Units("m", "N", "t")))
            )
        )
    )
    with xarray.open_dataset(tons, group="model", engine="h5netcdf") as data:
        assert data.units.values.tolist() == ["m", "N", "t"]


@pytest.mark.long
def test_the_snippet_of_the_page_runs(path: Path) -> None:
    (snippet,) = re.findall(r"```python\n(import xarray\n.+?)```", PAGE.read_text(encoding="utf-8"), flags=re.DOTALL)
    (path.parent / "arch.h5").write_bytes(path.read_bytes())
    here, said = Path.cwd(), io.StringIO()
    os.chdir(path.parent)
    try:
        with contextlib.redirect_stdout(said):
            exec(compile(snippet, "results.md", "exec"), {})
    finally:
        os.chdir(here)
    results = full_results()
    lines = said.getvalue().splitlines()
    assert lines[0].startswith("('point',) N ")
    assert lines[1] == "solved 0.5"
    assert lines[2].split() == [str(float(results.contacts.areas.sum())), "m2"]
    assert lines[3].startswith(str(float(results.model.blocks.volumes.sum())))
