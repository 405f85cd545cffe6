"""No network; the wheel alone, in an empty environment, in the lowest versions that are allowed and in the newest."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from tests.decks.folder import DECKS, ROOT
from tests.line import BLOCK
from tests.trust.counts import record_counts

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
OF_USERS = ("cholmod", "pictures", "report", "tables", "dask")
"""extras; the others are for tests and benchmarks"""
GUARD = Path(__file__).parent / "guard"


def requirements(extras: Sequence[str]) -> list[str]:
    """Of mbla and of its extras, as ``pyproject.toml`` has them."""
    listed = [text for extra in extras for text in PROJECT["optional-dependencies"][extra]]
    return [text for text in (*PROJECT["dependencies"], *listed) if not text.startswith("mbla[")]


def uv(*arguments: str | Path) -> str:
    """What uv prints, which makes wheels and environments."""
    done = subprocess.run([sys.executable, "-m", "uv", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def wheel(folder: Path) -> Path:
    """The wheel, built from the sources into a folder."""
    uv("build", "--wheel", "--quiet", "--out-dir", folder, ROOT)
    (built,) = folder.glob("mbla-*.whl")
    return built


def environment(folder: Path, built: Path, resolution: str) -> Path:
    """A new environment with the wheel and what it asks for, and nothing else; its Python.

    What the wheel asks for is named beside it: only versions of what is named are chosen low.
    """
    uv("venv", "--quiet", "--python", sys.executable, folder)
    python, named, extras = folder / "bin" / "python", folder / "named.txt", OF_USERS
    wanted = [f"mbla[{','.join(extras)}] @ {built.as_uri()}", *requirements(extras)]
    named.write_text("\n".join(wanted) + "\n", encoding="utf-8")
    install = ("pip", "install", "--quiet", "--python", python, "--resolution", resolution)
    uv(*install, "--only-binary", ":all:", "--requirement", named)
    return python


def guarded(
    python: Path, arguments: Sequence[str], folder: Path, variables: Mapping[str, str]
) -> subprocess.CompletedProcess[str]:
    """Run Python in a folder, with every way to another machine refused and written to ``attempts.txt``."""
    paths = [str(GUARD), *filter(None, [variables.get("PYTHONPATH")])]
    guard = {"PYTHONPATH": os.pathsep.join(paths), "MBLA_ATTEMPTS": str(folder / "attempts.txt"), "MPLBACKEND": "agg"}
    everything = os.environ | dict(variables) | guard
    return subprocess.run([python, *arguments], cwd=folder, env=everything, capture_output=True, text=True, check=False)


def attempts_in(folder: Path) -> list[str]:
    """What was refused."""
    path = folder / "attempts.txt"
    return path.read_text(encoding="utf-8").splitlines() if path.exists() else []


CLAIM = (
    "mbla works from its wheel alone, without its sources and without a network, in the lowest versions of its "
    "dependencies that it allows and in the newest: decks with their expected load factors, pictures, report, tables, "
    "and a sweep in two processes"
)
LOADS = r"""<(?:script|img|iframe|source|video|embed)[^>]*\ssrc\s*=\s*["']?\s*(?:https?:)?//|<link[^>]*\shref\s*=\s*["']?(?!data:)[^"'\s]"""  # noqa: E501
"""elements of a page that fetch something; a link that a reader may follow is none"""
SOURCES = {"PYTHONPATH": str(ROOT)}
SWEEP = """\
mbla_sweep: 1
deck: decks/tutorials/block.yaml
parameters: {mu: {key: joints.dry.friction, values: [0.3, 0.5]}}
"""
EXPECTED = {
    "tutorials/block": 0,
    "benchmarks/formats/arch_from_dxf": 0,
    "benchmarks/formats/arch_from_vtu": 0,
    "benchmarks/closed_forms/dome_of_slices_falls": 5,
    "benchmarks/published/ferris_wall_3": 0,
}
"""decks whose load factors must be those that they expect, with their exit status; 5 where one falls"""
WALL, DOME = "out/ferris_wall_3.h5", "out/dome_of_slices_falls.h5"
BESIDE = (
    ("show", WALL),
    ("verify", WALL),
    ("plot", WALL, "--kind", "mechanism", "-o", "out/wall.svg"),
    ("plot", DOME, "--kind", "model", "-o", "out/dome.png"),
    ("plot", WALL, "--animate", "mp4", "-o", "out/films"),
    ("report", WALL, "-o", "out/wall.html"),
    ("export", WALL, "--csv", "--parquet", "-o", "out/tables"),
    ("sweep", "sweep.yaml", "-j", "2", "-q"),
)
"""commands that with those decks use every dependency at least once"""


def loads_of(page: str) -> list[str]:
    """What a page would fetch, outside of its scripts."""
    markup = re.sub(r"(<script[^>]*>).*?</script>", r"\1", page, flags=re.DOTALL)
    return re.findall(LOADS, markup) + re.findall(r"url\(\s*[\"']?(?:https?:)?//|@import", markup)


def test_the_page_of_dependencies_names_each_with_licence_and_reason() -> None:
    page = (ROOT / "schemas" / "dependencies.md").read_text("utf-8").splitlines()
    lines = [[cell.strip() for cell in line.split("|")[1:-1]] for line in page if line.startswith("| ")]
    for name in sorted({canonicalize_name(Requirement(text).name) for text in requirements(OF_USERS)}):
        named = re.compile(rf"(?<![\w-]){re.escape(name)}(?![\w])")
        rows = [row for row in lines if len(row) == len(lines[0]) and named.search(row[0])]
        assert rows, f"{name} is not in schemas/dependencies.md"
        assert all(all(row) for row in rows), name


def test_ways_to_other_machines_are_refused_and_written_down(tmp_path: Path) -> None:
    """192.0.2.1 is an address for documentation, which nobody has."""
    program = "import socket\ntry: socket.create_connection(('192.0.2.1', 9), 1)\nexcept OSError as e: print(e)"
    done = guarded(Path(sys.executable), ("-c", program), tmp_path, {})
    assert done.stdout.startswith("no network"), done.stderr
    assert attempts_in(tmp_path) == ["socket.getaddrinfo 192.0.2.1"]


@pytest.mark.long
def test_a_run_and_its_report_and_a_sweep_need_no_network(tmp_path: Path) -> None:
    """Dask asks for the way to a well-known machine to find the address of its own, unless it is told."""
    (tmp_path / "block.yaml").write_text(BLOCK, encoding="utf-8")
    (tmp_path / "sweep.yaml").write_text(SWEEP.replace("decks/tutorials/block.yaml", "block.yaml"), encoding="utf-8")
    report = ("report", "block.out/block.h5", "-o", "block.html")
    for arguments in (("run", "block.yaml", "-q"), report, ("sweep", "sweep.yaml", "-j", "2", "-q")):
        done = guarded(Path(sys.executable), ("-m", "mbla", *arguments), tmp_path, SOURCES)
        assert (done.returncode, done.stderr) == (0, ""), arguments
    assert attempts_in(tmp_path) == []
    assert loads_of((tmp_path / "block.html").read_text(encoding="utf-8")) == []


@pytest.mark.trust
def test_the_wheel_alone_in_lowest_and_newest_versions_without_a_network(tmp_path: Path) -> None:
    built = wheel(tmp_path)
    decks = {("run", f"decks/{deck}.yaml", "--expected", "-o", "out", "-q"): code for deck, code in EXPECTED.items()}
    asked = decks | dict.fromkeys(BESIDE, 0)
    packages = 0
    wrong: list[str] = []
    for resolution in ("lowest-direct", "highest"):
        place = tmp_path / resolution
        python, folder = environment(place / "environment", built, resolution), place / "work"
        shutil.copytree(DECKS, folder / "decks")
        (folder / "sweep.yaml").write_text(SWEEP, encoding="utf-8")
        where = guarded(python, ("-c", "import mbla; print(mbla.__file__)"), folder, {})
        assert where.stdout.startswith(str(place / "environment")), where.stdout + where.stderr
        for arguments, status in asked.items():
            ended = guarded(python, ("-m", "mbla", *arguments), folder, {})
            if ended.returncode != status:
                wrong.append(f"{resolution}: mbla {' '.join(arguments)}: {ended.returncode}: {ended.stderr}")
        wrong += [f"{resolution}: {attempt}" for attempt in attempts_in(folder)]
        assert loads_of((folder / "out/wall.html").read_text(encoding="utf-8")) == []
        packages += len(uv("pip", "list", "--quiet", "--format", "freeze", "--python", python).splitlines())
    assert wrong == []
    counts = {
        "environments": 2,
        "packages in them": packages,
        "commands": 2 * len(asked),
        "commands that failed": 0,
        "attempts to reach another machine": 0,
    }
    record_counts("supply", 100, CLAIM, counts)
