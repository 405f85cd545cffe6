"""schemas/results.md against what is written: its tables name what runs leave in their files, and nothing else."""

from __future__ import annotations

import csv
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from contextlib import chdir
from pathlib import Path
from typing import Any

import h5py
import pytest

from mbla.cli import main
from mbla.deck.content import OutputSection
from tests.line import BLOCK
from tests.results.outputs import soil_file, write_outputs
from tests.results.results_md import PAGE, section, table, tables
from tests.results.results_page import renewed
from tests.results.synthetic import full_results

PUSHED = (
    BLOCK.replace("flow_rule: associative", "flow_rule: non_associative")
    .replace("mu: 0.5, b: 1", "mu: 0.8, b: 1")
    .replace("push: {live", "push: {pushover: {step: 0.2}, live")
)
DATASET_TYPES = {"float": "float64", "int": "int64", "bool": "uint8", "byte": "uint8"}
VTK_KINDS = (
    *("blocks", "frames", "forces", "contacts", "interfaces", "thrust", "hinges", "loads", "ties"),
    *("modes", "modes_after", "supports"),
)


@pytest.fixture(scope="module")
def full(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of all files of results in which everything has a value."""
    folder = tmp_path_factory.mktemp("full")
    write_outputs(full_results(), folder, "tower", force=False, output=OutputSection())
    return folder


@pytest.fixture(scope="module")
def pushed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the files of a real run."""
    folder = tmp_path_factory.mktemp("pushed")
    (folder / "pushed.yaml").write_text(PUSHED, encoding="utf-8")
    with chdir(folder):
        assert main(["run", "pushed.yaml"]) == 0
    return folder / "pushed.out"


@pytest.fixture(scope="module")
def soil(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Result file of a run with soil of cells."""
    return soil_file(tmp_path_factory.mktemp("soil"))


def test_generated_tables_of_the_page_are_those_of_the_program() -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert renewed(page) == page, "write it anew: python -m tests.results.results_page"


# --- HDF5 ---------------------------------------------------------------------------------------------------------


def datasets(file: h5py.File) -> dict[str, Any]:
    """Datasets by the path that the page has for them, without dimension scales."""
    found: list[Any] = []
    file.visititems(lambda path, item: found.append(item) if isinstance(item, h5py.Dataset) else None)
    return {re.sub(r"^/cases/[^/]+/", "/cases/*/", item.name): item for item in found if not item.is_scale}


def text(value: Any) -> str:
    return value.decode("utf-8") if isinstance(value, bytes) else str(value)


@pytest.fixture(scope="module")
def described() -> dict[str, tuple[str, ...]]:
    rows = {path: rest for path, *rest in table("Datasets")}
    assert len(rows) == len(table("Datasets"))
    return {path: tuple(rest) for path, rest in rows.items()}


def test_every_dataset_is_as_the_page_says(
    full: Path, pushed: Path, soil: Path, described: dict[str, tuple[str, ...]]
) -> None:
    written: set[str] = set()
    for path in (full / "tower.h5", pushed / "pushed.h5", soil):
        with h5py.File(path) as file:
            for name, dataset in datasets(file).items():
                kind, dims, unit, content = described[name]
                assert (", ".join(dimension.label for dimension in dataset.dims) or "–") == dims, name
                assert (dataset.dtype.kind == "S") if kind == "text" else dataset.dtype == DATASET_TYPES[kind], name
                assert ("_Encoding" in dataset.attrs) == (kind == "text"), name
                assert text(dataset.attrs["units"]) == unit, name
                assert content.startswith(text(dataset.attrs["long_name"])), name
                assert text(dataset.attrs.get("verification", "")) in content, name
                written.add(name)
    assert written == described.keys()


def test_root_attributes_and_version(full: Path) -> None:
    with h5py.File(full / "tower.h5") as file:
        assert [name for name, _ in table("Root attributes")] == sorted(file.attrs, key=order_on_page)
        assert PAGE.read_text(encoding="utf-8").startswith(f"# Result files, layout version {file.attrs['version']}\n")
        assert f"layout, {file.attrs['version']};" in section("Root attributes")
        assert text(file.attrs["filetype"]) in section("Root attributes")


def order_on_page(attribute: str) -> int:
    return section("Root attributes").index(f"`{attribute}`")


def test_dimensions_of_the_root_group(full: Path, described: dict[str, tuple[str, ...]]) -> None:
    told = re.search(r"The scales of (.*?) stand in the root group", section("How it is stored").replace("\n", " "))
    assert told is not None
    with h5py.File(full / "tower.h5") as file:
        scales = {name for name, item in file.items() if isinstance(item, h5py.Dataset)}
        assert set(re.findall(r"`(\w+)`", told[1])) == scales
        forms = {text(form) for form in file["model/tie_forms"][()]}
    told_forms = set(re.findall(r"\w+", described["/model/tie_forms"][3].partition(" (")[0])) - {"or"}
    assert forms <= told_forms
    told = re.search(r"`tie` is (.*?\))", section("How it is stored").replace("\n", " "))
    assert told is not None
    assert told_forms <= set(re.findall(r"\w+", told[1]))


def part_of(content: str) -> str:
    found = re.search(r"\(part: ([\w ]+)\)", content)
    return found[1] if found else ""


def test_parts_are_named_and_whole(full: Path, pushed: Path, soil: Path, described: dict[str, tuple[str, ...]]) -> None:
    named = {name for row in table("Parts") for name in re.findall(r"`([^`]+)`", row[0].join("``"))}
    parts: dict[str, set[str]] = {}
    for path, (*_, content) in described.items():
        parts.setdefault(part_of(content), set()).add(path)
    answers = ("mechanics", "associative", "least", "torsion", "level")
    general = {re.sub(rf"^({'|'.join(answers)}) (?!lock)", "… ", part) for part in parts if part}
    assert general == named
    for written in (full / "tower.h5", pushed / "pushed.h5", soil):
        with h5py.File(written) as file:
            for case in file["cases"]:
                one = {name for name in described if name.replace("*", case) in file}
                assert {name for name in parts[""] if "*" not in name} <= one
                for part in parts.keys() - {""}:
                    assert parts[part] <= one or not parts[part] & one, (case, part, parts[part] - one)


# --- files for ParaView, exported tables ----------------------------------------------------------------------------


def arrays_of(path: Path) -> Iterator[tuple[str, str, str]]:
    """Place, name and components of the arrays of a VTU file."""
    for place, tag in (("points", "PointData"), ("cells", "CellData")):
        for found in ElementTree.parse(path).iter(tag):
            yield from ((place, each.attrib["Name"], each.get("NumberOfComponents", "1")) for each in found)


def kind_of(path: Path) -> str:
    """Kind of a VTU file as the page has it: by the end of its name."""
    found = re.search(r"_(frame|pushed|modes_after|[a-z]+)(_\d+)?$", path.stem)
    assert found is not None
    return "frames" if found[1] in ("frame", "pushed", "history") else found[1]


def test_arrays_for_paraview(full: Path, pushed: Path) -> None:
    kinds, arrays = tables("Files for ParaView")
    assert tuple(re.sub(r"^…_(\w+)\.vtu$", r"\1", name) for name, _ in kinds) == VTK_KINDS
    told: dict[tuple[str, str], dict[str, str]] = {}
    for at, name, components, *_ in arrays:
        file, place = at.split(", ")
        told.setdefault((file, place), {})[name] = components
    seen: dict[tuple[str, str], set[str]] = {at: set() for at in told}
    for path in (*full.glob("*.vtu"), *pushed.glob("*.vtu")):
        for place, name, components in arrays_of(path):
            assert told[kind_of(path), place][name] == components, (path.name, name)
            seen[kind_of(path), place].add(name)
    labels = {row[1] for row in arrays if re.search(r"number of the \w+ in its item|composite item", row[4])}
    assert {at: names | labels & set(told[at]) for at, names in seen.items()} == {at: set(told[at]) for at in told}


def test_exported_tables(full: Path, tmp_path: Path) -> None:
    with chdir(tmp_path):
        assert main(["export", str(full / "tower.h5"), "-o", "."]) == 0
    titles = re.findall(r"(?m)^### `(\w+)`$", section("Exported tables"))
    assert {path.stem.removeprefix("tower_") for path in tmp_path.glob("*.csv")} == set(titles)
    for title in titles:
        with (tmp_path / f"tower_{title}.csv").open(encoding="utf-8", newline="") as file:
            head = next(csv.reader(file))
        rows = table(f"`{title}`")
        assert head == [name if unit == "–" else f"{name} [{unit}]" for name, _, unit, _ in rows]
