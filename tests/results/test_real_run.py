"""The results stage behind the real line: an arch that collapses by four hinges, and a wall of which a part slides."""

import re
from pathlib import Path

import numpy as np
import pytest

from mbla.results.collapse.collapse import collapse_of
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.listing.listing import listing
from mbla.results.results import Results
from mbla.run import RunOptions, run

ARCH = """\
mbla: 1
title: Semicircular arch
units: {length: m, force: kN, mass: t}
materials: {stone: {density: 2}}
joints: {dry: {friction: 0.65}}
blocks:
  - arch:
      {group: arch, material: stone, shape: semicircular, span: 1.85, thickness: 0.15, width: 0.3, voussoirs: 20,
       springers: blocks}
contacts: {joint: dry}
load_cases:
  push_x: {live: [{acceleration: [1, 0, 0]}]}
analysis: {flow_rule: associative}
output: {frames: 3}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("arch")
    (folder / "arch.yaml").write_text(ARCH, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def results(folder: Path) -> Results:
    return run(folder / "arch.yaml", RunOptions())


def test_four_hinges_alternate_between_intrados_and_extrados(results: Results) -> None:
    text = listing(results)
    assert re.search(r"Collapses at 0\.1493\d* g, verified: 4 hinges", text)
    assert re.findall(r"\b(intrados|extrados)$", text, flags=re.MULTILINE) == ["intrados", "extrados"] * 2


def test_reactions_at_both_springers_carry_the_weight(results: Results) -> None:
    rows = [line.split() for line in listing(results).splitlines() if line.startswith("  arch_springers[")]
    vertical = [float(row[3]) for row in rows]
    assert len(vertical) == 2
    free = results.model.free
    weight = -results.cases[0].load_case.dead_load[free, 2].sum()
    assert sum(vertical) == pytest.approx(weight, rel=1e-3)


def test_the_arch_falls_in_three_parts_that_turn_about_their_hinges(results: Results) -> None:
    """Outer parts turn about the hinges at their feet, the middle one about where the lines through its hinges meet."""
    case = results.cases[0]
    assert case.solution.mechanics is not None
    collapse = collapse_of(results.assembly, case.load_case, case.solution.mechanics)
    assert len(collapse.motions) == 3
    assert all(part.turns and abs(part.direction[1]) == pytest.approx(1) for part in collapse.motions)
    rows = np.flatnonzero(collapse.interfaces.modes == InterfaceMode.HINGE)
    points = collapse.interfaces.hinge_points[rows][:, [0, 2]]
    chain = sorted(collapse.motions, key=lambda part: part.blocks[0])
    centres = np.array([part.axis_point[[0, 2]] for part in chain])
    assert centres[0] == pytest.approx(points[0], abs=1e-6)
    assert centres[2] == pytest.approx(points[3], abs=1e-6)
    for foot, inner in ((points[0], points[1]), (points[3], points[2])):
        assert np.cross(np.append(inner - foot, 0), np.append(centres[1] - foot, 0)) == pytest.approx(0, abs=1e-6)
    work = collapse.work
    assert work.live + work.dead == pytest.approx(work.dissipated.sum(), abs=1e-6)
    assert work.dissipated == pytest.approx(0, abs=1e-6)
