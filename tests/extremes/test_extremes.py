"""Numbers at their extremes: no red line, bounds of tiny factors, many load cases.

Half of the short scenes, and of those that take long a sample, are long tests; ``pytest -m trust tests/extremes`` runs
the rest.
"""

from __future__ import annotations

import importlib
import io
import math
import pkgutil
import time
from pathlib import Path

import pytest

import tests.extremes
from mbla.deck import read_deck
from mbla.process.run_options import RunOptions
from mbla.results.status_file import StatusFile
from mbla.run import solve_deck
from tests.extremes.outcome import Scene, outcome_of

EVERY = 6
"""of the scenes that take long one of so many is taken by long tests"""


def all_scenes() -> list[Scene]:
    """Scenes of all modules of this folder that have ``SCENES``, in the order of their names."""
    found = [module.name for module in pkgutil.iter_modules(tests.extremes.__path__)]
    modules = [importlib.import_module(f"tests.extremes.{name}") for name in found if not name.startswith("test_")]
    return [scene for module in modules for scene in getattr(module, "SCENES", ())]


SCENES = all_scenes()
TAKEN = [*[scene for scene in SCENES if not scene.long][::2], *[scene for scene in SCENES if scene.long][::EVERY]]
LEFT = [scene for scene in SCENES if scene not in TAKEN]


def name_of(scene: Scene) -> str:
    return f"{scene.family}: {scene.name}"


@pytest.mark.long
def test_names_are_different() -> None:
    assert len({name_of(scene) for scene in SCENES}) == len(SCENES)


@pytest.mark.parametrize(
    "scene",
    [
        *(pytest.param(scene, id=name_of(scene), marks=pytest.mark.long) for scene in TAKEN),
        *(pytest.param(scene, id=name_of(scene), marks=pytest.mark.trust) for scene in LEFT),
    ],
)
def test_no_red_line(scene: Scene) -> None:
    outcome = outcome_of(scene)
    assert not outcome.is_red, (outcome.verdict, outcome.got, scene.expected, outcome.status, outcome.words)


WALLS = {scene.name: scene for scene in SCENES if scene.family == "friction" and "wall, assoc" in scene.name}


@pytest.mark.long
@pytest.mark.parametrize("friction", ["1.0e-12", "1.0e-9", "1.0e-6"])
def test_bounds_of_a_wall_that_hardly_rubs(friction: str) -> None:
    """Uncharged for what its forces leave unbalanced, the static bound at 1e-12 was 1.2e-12.

    The least forces alone carried 9.93e-13 there, below the bound: the load factor is the one that was proved.
    """
    outcome = outcome_of(WALLS[f"wall, associative, friction {friction}"])
    assert outcome.static is not None
    assert outcome.kinematic is not None
    assert outcome.static <= float(friction) <= outcome.kinematic
    assert outcome.got is not None
    assert outcome.static <= outcome.got <= outcome.kinematic


DIRECTIONS = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.5}}
blocks:
  - box: {group: block, material: stone, min: [-0.5, -0.5, 0], max: [0.5, 0.5, 0.2]}
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
analysis: {flow_rule: associative}
load_cases:
"""


@pytest.mark.long
def test_a_block_pushed_in_many_directions_and_sizes(tmp_path: Path) -> None:
    """Thirteen sizes of the load, from a millionth to a million, each in another direction."""
    count = 100
    angles = [2 * math.pi * k / count for k in range(count)]
    sizes = [10.0 ** (k % 13 - 6) for k in range(count)]
    lines = [
        f"  case_{k}: {{live: [{{acceleration: [{size * math.cos(angle)!r}, {size * math.sin(angle)!r}, 0]}}]}}"
        for k, (angle, size) in enumerate(zip(angles, sizes, strict=True))
    ]
    path = tmp_path / "cases.yaml"
    path.write_text(DIRECTIONS + "\n".join(lines) + "\n", encoding="utf-8")
    results = solve_deck(read_deck(path), RunOptions(), StatusFile(io.StringIO(), "cases"), None, time.perf_counter())
    assert [case.load_case.name for case in results.cases] == [f"case_{k}" for k in range(count)]
    for case, size in zip(results.cases, sizes, strict=True):
        assert case.status == "solved"
        assert case.solution.mechanics is not None
        assert case.solution.mechanics.load_factor == pytest.approx(0.5 / size, rel=1e-6)
