"""Pairs of results of one deck with one thing changed: what is found to differ, and nothing else."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.cli import main
from mbla.results.diff.cases import angle_between
from mbla.results.diff.comparison import compare_results
from mbla.results.diff.matching import match_blocks
from mbla.results.diff.words import comparison_text
from mbla.results.results import Results
from mbla.run import RunOptions, run
from mbla.solution.solution import Status
from tests.line import BLOCK
from tests.results.changed_files import changing
from tests.results.synthetic import tower_results

TWO = """\
mbla: 1
units: {length: m}
materials: {stone: {density: "2000 kg/m^3"}}
joints: {dry: {friction: 0.6, cohesion: "1 kPa"}}
blocks:
  - box: {group: pile, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: pile, material: stone, min: [0, 0, 1], max: [1, 1, 2.2]}
  - box: {group: other, material: stone, min: [3, 0, 0], max: [4, 1, 1]}
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
  pull: {live: [{force: ["-1 kN", 0, 0], on: {group: other, index: 0}, at: ["3.5 m", "0.5 m", "0.5 m"]}]}
analysis: {flow_rule: associative}
"""
MILLIMETRES = (
    TWO.replace("{length: m}", "{length: mm, force: kN, mass: t}")
    .replace("max: [1, 1, 1]", "max: [1000, 1000, 1000]")
    .replace("min: [0, 0, 1], max: [1, 1, 2.2]", "min: [0, 0, 1000], max: [1000, 1000, 2200]")
    .replace("min: [3, 0, 0], max: [4, 1, 1]", "min: [3000, 0, 0], max: [4000, 1000, 1000]")
)


def results_of(folder: Path, text: str, *overrides: str, name: str = "a", cases: tuple[str, ...] = ()) -> Results:
    """A deck run into ``name.out/deck.h5``."""
    path = folder / "deck.yaml"
    path.write_text(text, encoding="utf-8")
    options = RunOptions(folder / f"{name}.out", ("output.vtu=false", *overrides), cases)
    return run(path, options)


@pytest.fixture(scope="module")
def two(tmp_path_factory: pytest.TempPathFactory) -> Results:
    return results_of(tmp_path_factory.mktemp("two"), TWO)


def test_a_result_is_the_same_as_itself(two: Results) -> None:
    results = two
    found = compare_results(results, results)
    assert found.differing == 0
    assert not found.deck_diff
    for case in found.cases:
        assert case.mechanism.angle == pytest.approx(0.0, abs=1e-9)
        assert all(figure.difference == 0.0 for figure in (*case.answers, *case.figures))


def test_friction_changed(tmp_path: Path) -> None:
    """A block 1 x 2 slides at 0.4 with friction 0.4, lifting by it, and rocks at b/h = 0.5 with 0.6.

    Of the rocking motion the centroid takes ω (h/2, b/2), the inertia about the toe is m (b² + h²)/3:
    cos φ = (h/2 + μ b/2)/√((b² + h²)/3 (1 + μ²)).
    """
    first = results_of(tmp_path, BLOCK, "parameters.mu=0.4")
    second = results_of(tmp_path, BLOCK, "parameters.mu=0.6", name="b")
    found = compare_results(first, second)
    (case,) = found.cases
    assert case.differs
    assert found.differing == 1
    (answer,) = case.answers
    assert answer.values == pytest.approx((0.4, 0.5), abs=1e-6)
    assert answer.difference == pytest.approx(0.25, abs=1e-5)
    cosine = (1.0 + 0.4 * 0.5) / math.sqrt(5 / 3 * 1.16)
    assert case.mechanism.angle == pytest.approx(math.degrees(math.acos(cosine)), abs=1e-3)
    assert found.overrides == (("output.vtu=false", "parameters.mu=0.4"), ("output.vtu=false", "parameters.mu=0.6"))


def test_metres_and_millimetres_are_the_same(tmp_path: Path, two: Results) -> None:
    found = compare_results(two, results_of(tmp_path, MILLIMETRES, name="b"))
    assert found.differing == 0
    assert found.deck_diff  # the texts are not the same
    for case in found.cases:
        assert case.mechanism.angle == pytest.approx(0.0, abs=1e-3)


def test_blocks_in_another_order_are_matched_by_place(tmp_path: Path, two: Results) -> None:
    lines = TWO.splitlines(keepends=True)
    lines[5], lines[6] = lines[6], lines[5]
    found = compare_results(two, results_of(tmp_path, "".join(lines), name="b"))
    assert found.differing == 0
    for case in found.cases:
        assert case.mechanism.angle == pytest.approx(0.0, abs=1e-3)


def test_a_block_that_was_moved_is_matched_by_its_name(tmp_path: Path, two: Results) -> None:
    second = TWO.replace("min: [3, 0, 0], max: [4, 1, 1]", "min: [3, 0, 0], max: [4, 1, 1.2]")
    found = compare_results(two, results_of(tmp_path, second, name="b"))
    assert any(line.startswith("+") and "max: [4, 1, 1.2]" in line for line in found.deck_diff)
    assert found.cases[0].mechanism.angle == pytest.approx(0.0, abs=1e-3)


def test_another_structure_is_not_comparable(tmp_path: Path, two: Results) -> None:
    other = (
        TWO.replace("group: pile", "group: heap")
        .replace("min: [0, 0, 0], max: [1, 1, 1]", "min: [-9, -9, 0], max: [0, 0, 1]")
        .replace("min: [0, 0, 1], max: [1, 1, 2.2]", "min: [-9, -9, 1], max: [0, 0, 2]")
    )
    found = compare_results(two, results_of(tmp_path, other, name="b"))
    case = found.cases[0]
    assert case.mechanism.angle is None
    assert "of the volume has a match" in case.mechanism.compared


def test_a_case_that_is_not_verified(tmp_path: Path) -> None:
    first = results_of(tmp_path, BLOCK)
    case = replace(first.cases[0], status=Status.NOT_VERIFIED)
    second = replace(first, cases=(case,))
    found = compare_results(first, second)
    compared = found.cases[0]
    assert compared.differs
    assert math.isnan(compared.answers[0].values[1])  # the best iterate is no load factor
    assert compared.mechanism.angle is None
    assert compared.mechanism.compared == "B has no mechanism that is a result"
    assert "STATUS DIFFERS: solved in A, NOT VERIFIED in B" in comparison_text(found, ("a", "b"))


def test_motions_without_equilibrium_are_compared() -> None:
    results = tower_results()
    found = compare_results(results, results)
    falls = found.cases[1]
    assert falls.mechanism.compared == "motion without equilibrium"
    assert falls.mechanism.angle == pytest.approx(0.0, abs=1e-9)
    certificate = results.cases[1].solution.certificate
    assert certificate is not None
    solution = replace(results.cases[1].solution, certificate=-certificate)
    other = replace(results, cases=(results.cases[0], replace(results.cases[1], solution=solution)))
    assert compare_results(results, other).cases[1].mechanism.angle == pytest.approx(180.0)


def test_tolerance(tmp_path: Path) -> None:
    first, second = (results_of(tmp_path, BLOCK, f"parameters.mu={mu}", name=f"{mu}") for mu in (0.4, 0.4002))
    assert compare_results(first, second).differing == 1
    assert compare_results(first, second, 6e-4).differing == 0
    assert compare_results(first, second, 4e-4).differing == 1


# --- the command ---------------------------------------------------------------------------------------------------


def test_exit_status_and_json(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)  # lines have the paths as given
    for name, friction in (("a", "0.4"), ("b", "0.6")):
        results_of(tmp_path, BLOCK, f"parameters.mu={friction}", name=name)
    files = [str(Path(f"{name}.out", "deck.h5")) for name in "ab"]
    assert main(["diff", *files]) == 0
    text = capsys.readouterr().out
    assert "1 of 1 load case differs in status or answer" in text
    assert "push: DIFFERS; load factor 0.4 in A, 0.5 in B" in text
    assert all(len(line) <= 120 for line in text.splitlines())
    assert main(["diff", *files, "--fail"]) == 4
    assert main(["diff", files[0], files[0], "--fail"]) == 0
    assert main(["diff", *files, "--fail", "--tolerance", "0.3"]) == 0
    capsys.readouterr()
    assert main(["diff", *files, "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["differing"] == 1
    (case,) = record["cases"]
    assert case["answers"][0]["values"] == pytest.approx([0.4, 0.5], abs=1e-6)
    assert case["mechanism"]["angle"] == pytest.approx(math.degrees(math.acos(1.2 / math.sqrt(5 / 3 * 1.16))), abs=1e-3)


def test_files_that_cannot_be_compared(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    results_of(tmp_path, BLOCK)
    good = tmp_path / "a.out" / "deck.h5"
    text, old = tmp_path / "text.h5", tmp_path / "old.h5"
    text.write_text("no result", encoding="utf-8")
    old.write_bytes(good.read_bytes())
    with changing(old) as file:
        file.attrs["version"] = 1
    for bad, words in ((text, "not an HDF5 file"), (old, "layout version 1"), (tmp_path / "none.h5", "No such file")):
        for pair in ((good, bad), (bad, good)):
            assert main(["diff", *map(str, pair)]) == 6
            captured = capsys.readouterr()
            assert captured.out == ""
            assert words in captured.err
            assert len(captured.err.splitlines()) == 1
    assert main(["diff", str(good), str(good), "--tolerance", "-1"]) == 2


def test_the_angle_is_that_of_velocities_all_over_the_blocks(two: Results) -> None:
    """Both motions sampled on a grid in every box, as the kinetic energy weighs them."""
    blocks, rng = two.model.blocks, np.random.default_rng(3)
    u, v = rng.normal(size=(2, len(blocks), 6))
    products = np.zeros(3)
    nodes = (np.arange(40) + 0.5) / 40 - 0.5
    for b, density in enumerate(blocks.densities):
        corners = blocks.vertices[blocks.vertex_start[b] : blocks.vertex_start[b + 1]]
        arms = np.stack(np.meshgrid(*np.outer(np.ptp(corners, axis=0), nodes)), axis=-1).reshape(-1, 3)
        x, y = (motion[b, :3] + np.cross(motion[b, 3:], arms) for motion in (u, v))
        mass = density * blocks.volumes[b] / len(arms)
        products += mass * np.array([(x * y).sum(), (x * x).sum(), (y * y).sum()])
    matching = match_blocks(blocks, blocks, 1.0)
    expected = math.degrees(math.acos(products[0] / math.sqrt(products[1] * products[2])))
    assert angle_between(blocks, u, v, matching) == pytest.approx(expected, abs=0.02)


def test_a_case_of_one_file_only(tmp_path: Path, two: Results) -> None:
    first, second = two, results_of(tmp_path, TWO, cases=("push",))
    found = compare_results(first, second)
    assert found.only == (("pull",), ())
    assert found.differing == 1
    assert "pull: in A only" in comparison_text(found, ("a.h5", "b.h5"))
    assert compare_results(second, first).only == ((), ("pull",))
