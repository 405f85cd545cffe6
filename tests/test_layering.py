"""The stages import only from the stages to their left, and foreign libraries have one door each, but for a few."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import pytest

import mbla

PACKAGE = Path(mbla.__file__).parent
STAGES = (
    "deck",
    "questions",
    "model",
    "contacts",
    "assembly",
    "program",
    "solution",
    "soil_mesh",
    "results",
    "codes",
    "sweeps",
)
WHOLE_LINE = ("api", "check", "run", "verify")
"""modules beside the stages that call all of them: only what runs decks again and again stands to their right"""
SHARED = ("arrays", "errors", "process")
DOORS = {
    "yaml": "deck/text/reader.py",
    "pint": "deck/units.py",
    "meshio": "model/geometry/meshio_files.py",
    "ezdxf": "model/geometry/dxf.py",
    "manifold3d": "contacts/overlaps.py",
    "clarabel": "solution/cone_solvers/clarabel_adapter.py",
    "cvxopt": "solution/linear_algebra/cholmod_factors.py",
    "qdldl": "solution/linear_algebra/qdldl_factors.py",
    "h5py": "results/hdf5/result_file.py",
    "paraview": "results/vtu/standard_views.py",
    "pyvista": "results/pictures/renderer.py",
    "vtk": "results/pictures/renderer.py",
    "imageio_ffmpeg": "results/pictures/animation.py",
    "PIL": "results/pictures/animation.py",
    "matplotlib": "results/pictures/page.py",
    "jinja2": "results/report/report.py",
    "plotly": "results/view3d/view.py",
    "pandas": "results/tables/table.py",
    "pyarrow": "results/tables/formats.py",
    "dask": "sweeps/engine/cluster.py",
    "distributed": "sweeps/engine/cluster.py",
}
KINDS_IN = {"deck/sections/blocks.py": "mbla.model.blocks", "deck/sections/loads.py": "mbla.model.loads"}
"""the exception to the order of stages: the files of the deck that ask for the kinds of things that it is made of, and
where they are at home"""
KINDS_BEFORE = {"mbla.model.blocks": set[str](), "mbla.model.loads": {"deck/sections/blocks.py"}}
"""loads choose blocks by positions that kinds of items give them, and are made after these"""
GIVEN_TO_KINDS = {
    "deck/__init__.py",
    "deck/expressions.py",
    "deck/kinds/__init__.py",
    "deck/kinds/kinds.py",
    "deck/kinds/load_key.py",
    "deck/kinds/positions.py",
    "deck/quantities.py",
    "deck/section.py",
    "deck/sections/__init__.py",
    "deck/sections/any_load.py",
    "deck/sections/assessment.py",
    "deck/sections/contacts.py",
    "deck/sections/fill.py",
    "deck/sections/geometry_file.py",
    "deck/sections/placement.py",
    "deck/sections/selectors.py",
    "deck/sections/soil.py",
    "deck/sections/supports.py",
    "deck/sections/vehicles.py",
    "deck/suggestions.py",
    "deck/text/__init__.py",
    "deck/text/sources.py",
    "deck/text/tree.py",
    "deck/units.py",
}
"""files of the deck that kinds are made of, by themselves or through others: none of them knows of a kind"""
EVERYWHERE = {"numpy", "scipy", "shapely", "pydantic"}
"""libraries without a door"""
DISTRIBUTIONS = {"yaml": "pyyaml", "PIL": "pillow", "vtkmodules": "vtk", "imageio_ffmpeg": "imageio-ffmpeg"}
"""names that libraries are installed by, where they are not those that they are imported by"""
NOT_INSTALLED = {"paraview": "the script that pvbatch runs"}
DEPENDENCIES = PACKAGE.parent / "schemas" / "dependencies.md"
SECOND_DERIVATION = "solution/verification/"
GIVEN_TO_IT = {
    "program/yield_conditions/limits.py": "strengths as data",
    "program/resultants/shapes.py": "outlines of interfaces",
    "program/resultants/friction_curve.py": "radius and shape of the friction curve of an outline",
    "program/reductions/steps.py": "what reductions did, as data",
    "solution/solution.py": "the claim",
    "solution/thresholds.py": "what counts as solved",
    "solution/full_model/lifted.py": "the claim on rigid bodies",
    "solution/full_model/contact_modes.py": "modes, of which none is judged",
    "solution/pushover/curve_rows.py": "rows of a curve and why it ends",
    "solution/pushover/record.py": "rows of a pushover",
    "solution/further/further.py": "the claim of further results",
    "solution/further/geometric_safety/geometric_safety.py": "the claim of a factor of safety",
    "solution/further/geometric_safety/reference_pressure.py": "loads under a pressure in all joints",
    "solution/further/sensitivity/slopes.py": "the claim of slopes",
    "solution/further/soil_range/soil_path.py": "the claim of paths in soil",
    "solution/further/strengthening/strengthening.py": "what may be added to a structure",
    "solution/further/sensitivity/structures.py": "a structure with another parameter",
    "solution/pushover/pushover.py": "the claim of a pushover",
    "solution/modes/modes.py": "the claim of modes",
    "solution/time_history/frames.py": "frames of a time history",
    "solution/linear_algebra/superlu.py": "signs of pivots, by which modes are counted",
    "solution/linear_algebra/qdldl_factors.py": "the order of elimination for these",
    "solution/linear_algebra/pattern.py": "patterns of matrices for these",
    "solution/time_history/history.py": "the claim of a time history",
    "solution/time_history/step_rows.py": "rows of a time history and why it ends",
}
"""files of program and solution that the verification sees, by itself or through others, and what they are: no matrix,
no law and no proof of the solver"""
FILES = sorted(PACKAGE.rglob("*.py"))


@cache
def imports_of(path: Path) -> dict[str, bool]:
    """Full names of what a file imports, wherever in it, and whether at run time or for type checkers only."""
    text = path.read_text(encoding="utf-8")
    nodes = list(ast.walk(ast.parse(text)))
    guards = [node for node in nodes if isinstance(node, ast.If)] if "TYPE_CHECKING" in text else []
    for_types = {below for node in guards if "TYPE_CHECKING" in ast.dump(node.test) for below in ast.walk(node)}
    names: dict[str, bool] = {}
    for node in nodes:
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            found = [str(node.module)] if isinstance(node, ast.ImportFrom) else [alias.name for alias in node.names]
            names |= {name: names.get(name, False) or node not in for_types for name in found}
    return names


def test_stages_import_from_the_left_and_each_library_has_one_door() -> None:
    wrong = []
    for path in FILES:
        place = str(path.relative_to(PACKAGE))
        stage = path.relative_to(PACKAGE).parts[0]
        allowed = {*SHARED, *STAGES[: STAGES.index(stage) + 1]} if stage in STAGES else set()
        allowed |= {*WHOLE_LINE} if stage == "sweeps" else set()
        for name, at_run_time in imports_of(path).items():
            package, *rest = name.split(".")
            if name == KINDS_IN.get(place) or name.startswith(f"{KINDS_IN.get(place)}."):
                continue
            if allowed and package == "mbla" and rest and rest[0] not in allowed:
                wrong.append(f"{place} imports {name}")
            if at_run_time and DOORS.get(package, place) != place:
                wrong.append(f"{place} imports {name}, whose door is {DOORS[package]}")
    assert wrong == []


def importers() -> dict[str, list[str]]:
    """Files that import each library at run time, by the name that it is installed by; pydantic_core is pydantic."""
    found: dict[str, set[str]] = {}
    for path in FILES:
        for name, at_run_time in imports_of(path).items():
            library = name.split(".")[0].removesuffix("_core")
            if at_run_time and library not in {"mbla", *sys.stdlib_module_names, *NOT_INSTALLED}:
                found.setdefault(DISTRIBUTIONS.get(library, library), set()).add(str(path.relative_to(PACKAGE)))
    return {library: sorted(files) for library, files in found.items()}


def importers_in_words(files: Sequence[str]) -> str:
    """The one file that imports a library, else the folders that have such files, in the order of the program."""
    folders = {file.split("/")[0] for file in files if "/" in file}
    return f"`{files[0]}`" if len(files) == 1 else ", ".join(name for name in (*STAGES, "process") if name in folders)


def test_the_page_of_dependencies_says_who_imports_each() -> None:
    table = DEPENDENCIES.read_text(encoding="utf-8").split("\n\n")[1].splitlines()[2:]
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table]
    named = {name: row for row in rows for name in re.findall(r"[\w-]+", row[0].split(" (")[0])}
    found = importers()
    assert found.keys() <= named.keys()
    for name, (*_, imported_by) in named.items():
        told = imported_by if name in found else imported_by.partition(";")[0]
        assert told == (importers_in_words(found[name]) if name in found else "nothing in mbla"), name
    assert {name for name, files in found.items() if len(files) > 1} == EVERYWHERE


def seen_from(folder: str) -> set[str]:
    """Files of a folder, and all that they import at run time, by themselves or through others."""
    paths = {str(path.relative_to(PACKAGE)): path for path in FILES}
    seen, rest = set[str](), [place for place in paths if place.startswith(folder)]
    assert rest
    while rest:
        place = rest.pop()
        if place in seen:
            continue
        seen.add(place)
        for name in (name for name, at_run_time in imports_of(paths[place]).items() if at_run_time):
            file = name.removeprefix("mbla.").replace(".", "/")
            rest += [found for found in (f"{file}.py", f"{file}/__init__.py") if found in paths]
    return seen


@pytest.mark.parametrize("home", KINDS_IN.values())
def test_kinds_are_made_of_leaves_of_the_deck(home: str) -> None:
    """Kinds register with the deck: what they import of it must not need them."""
    seen = seen_from(f"{home.removeprefix('mbla.').replace('.', '/')}/")
    assert {place for place in seen if place.startswith("deck/")} <= GIVEN_TO_KINDS | KINDS_BEFORE[home]


def test_what_is_claimed_is_judged_by_a_second_derivation() -> None:
    """What the verification imports, and what that imports, is its own, given to it, or of the stages before."""
    seen = seen_from(SECOND_DERIVATION)
    later = {place for place in seen if place.startswith(("program/", "solution/", "results/", "sweeps/"))}
    assert {place for place in later if not place.startswith(SECOND_DERIVATION)} == set(GIVEN_TO_IT)


def test_superlu_has_one_door() -> None:
    users = {str(path.relative_to(PACKAGE)) for path in FILES if "splu(" in path.read_text(encoding="utf-8")}
    assert users == {"solution/linear_algebra/superlu.py"}


def test_every_folder_of_the_package_is_a_stage() -> None:
    folders = {path.name for path in PACKAGE.iterdir() if path.is_dir() and path.name != "__pycache__"}
    assert folders == {*STAGES, "cli", "process"}


def test_top_level_of_the_project() -> None:
    root = Path(__file__).parents[1]
    made = {"build", "dist", "__pycache__"}
    names = {path.name for path in root.iterdir() if not path.name.startswith(".") and path.name not in made}
    left = {name for name in names if not name.endswith((".out", ".egg-info"))}
    assert left == {"pyproject.toml", "mbla", "decks", "schemas", "tests", "README.md"}


def test_help_imports_nothing_heavy() -> None:
    """``mbla --help`` answers in the time that Python itself takes to start."""
    code = (
        "import sys\n"
        "import mbla.cli\n"
        "from mbla.cli import build_parser\n"
        "build_parser().format_help()\n"
        "print(*sorted({name.split('.')[0] for name in sys.modules}))"
    )
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    heavy = {"numpy", "scipy", "yaml", "pydantic", "pint", "meshio", "h5py", "clarabel", "shapely", "manifold3d", "vtk"}
    assert not heavy & set(loaded)


def test_a_faulty_deck_imports_numpy_and_nothing_heavier(tmp_path: Path) -> None:
    """Its faults are told at once; what computes takes longer to import than the deck to read."""
    deck = tmp_path / "faulty.yaml"
    deck.write_text("mbla: 1\n", encoding="utf-8")
    code = (
        "import sys\n"
        "from mbla.cli import main\n"
        f"status = main(['run', {str(deck)!r}])\n"
        "print(status, *sorted({name.split('.')[0] for name in sys.modules}))"
    )
    status, *loaded = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout.split()
    assert status == "3"
    heavy = {"scipy", "meshio", "ezdxf", "h5py", "clarabel", "shapely", "manifold3d", "matplotlib", "vtk"}
    assert not heavy & set(loaded)
