import io
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from mbla.deck.units import Units
from mbla.results.hdf5.layout import ATTRIBUTES, SHARED_DIMENSIONS, VERSION
from mbla.results.hdf5.result_file import (
    COMPACT_BYTES,
    Labelled,
    LabelledFile,
    write_labelled_hdf5,
    write_results_hdf5,
)
from mbla.results.quantities.quantity import unit_text
from mbla.results.quantities.registry import STORED
from tests.results.outputs import soil_file
from tests.results.synthetic import full_results

PAGE = Path(__file__).parents[3] / "schemas" / "results.md"


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Iterator[h5py.File]:
    path = tmp_path_factory.mktemp("layout") / "tower.h5"
    path.write_bytes(write_results_hdf5(full_results()))
    with h5py.File(path) as opened:
        yield opened


def datasets(file: Any) -> dict[str, Any]:
    """Every dataset that is not a dimension scale, by its path."""
    found = {}
    file.visititems(lambda name, item: found.update({name: item}) if isinstance(item, h5py.Dataset) else None)
    return {name: item for name, item in found.items() if not item.is_scale}


def pattern(path: str) -> str:
    return re.sub(r"^cases/[^/]+/", "cases/*/", path)


def section(text: str, title: str) -> str:
    """The text under a heading, up to the next."""
    return text.partition(f"## {title}\n\n")[2].partition("\n## ")[0]


def test_page_has_every_attribute() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert f"layout version {VERSION}" in text
    described = re.findall(r"^\| `(\w+)` \| (.*) \|$", section(text, "Root attributes"), flags=re.MULTILINE)
    assert described == list(ATTRIBUTES.items())
    shared = re.search(r"The scales of ([^.]*) stand in the root group", text.replace("\n", " "))
    assert shared is not None
    assert re.findall(r"`(\w+)`", shared[1]) == list(SHARED_DIMENSIONS)


def test_every_dataset_written_is_in_the_layout_and_the_reverse(file: Any, tmp_path: Path) -> None:
    with h5py.File(soil_file(tmp_path)) as other:
        written = datasets(file).keys() | datasets(other).keys()
    assert {pattern(path) for path in written} == {field.path for field in STORED}


def test_every_array_has_a_checksum(file: Any) -> None:
    """Large ones that of gzip, small ones that of the object header in which they stand."""
    for dataset in datasets(file).values():
        if dataset.ndim and dataset.size:
            compact = dataset.id.get_create_plist().get_layout() == h5py.h5d.COMPACT
            assert compact or (dataset.compression, dataset.shuffle) == ("gzip", True)


def test_a_large_array_is_compressed() -> None:
    values = np.arange(COMPACT_BYTES // 8 + 1, dtype=np.float64)
    image = write_labelled_hdf5(
        LabelledFile({}, {"n": Labelled(values, ("n",), {})}, {"a/b": Labelled(values, ("n",), {})})
    )
    with h5py.File(io.BytesIO(image)) as file:
        assert (file["a/b"].compression, file["a/b"].shuffle) == ("gzip", True)
        assert np.array_equal(file["a/b"], values)


@pytest.mark.parametrize(
    ("kind", "expected"),
    [("length", "mm"), ("density", "t/mm3"), ("load", "kN; kN mm"), ("stress", "kN/mm2"), ("velocity", "1/kN")],
)
def test_units_are_those_of_the_deck(kind: Any, expected: Any) -> None:
    assert unit_text(kind, Units("mm", "kN", "t")) == expected
