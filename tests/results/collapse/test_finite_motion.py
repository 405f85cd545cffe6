"""Parts that stay together at their hinges when a mechanism is drawn with finite rotations."""

from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.results.collapse.finite_motion import MOST_PARTS, closed_motion, finite_motion
from mbla.results.collapse.motion import drawn_motion, movable_size, moved_contact_points, moved_vertices, screws
from mbla.results.pictures.scene import motion_as_drawn
from mbla.results.record.scene import scene_of
from mbla.results.results import Results
from mbla.results.vtu.vtu import write_frame_vtu
from mbla.run import RunOptions, run
from tests.results.synthetic import tower_results

DECKS = Path("decks")


@pytest.fixture(
    scope="module", params=["benchmarks/closed_forms/arch_20_voussoirs", "benchmarks/closed_forms/spreading_arch"]
)
def results(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Results:
    """Four hinges under an acceleration; three under a support that gives way sideways."""
    options = RunOptions(folder=tmp_path_factory.mktemp("arch"), overrides=("output.vtu=false",))
    return run(DECKS / f"{request.param}.yaml", options)


def parts_of(results: Results) -> tuple[Any, Any, Any]:
    case = results.cases[0]
    return results.model.of_case(case.load_case), results.contacts, case


def widest_hinge(results: Results, motion: FloatArray) -> float:
    """Largest distance between both sides of a contact point that does not open or slide, over the size."""
    model, contacts, case = parts_of(results)
    sides = [moved_contact_points(model, contacts, motion, side) for side in (0, 1)]
    still = np.linalg.norm(case.solution.mechanics.contact_velocities, axis=1)
    still = still <= 1e-6 * still.max()
    assert still.any()
    return float(np.linalg.norm(sides[1] - sides[0], axis=1)[still].max()) / movable_size(model)


@pytest.mark.parametrize("share", [0.3, 1.0])
def test_parts_do_not_come_apart_at_their_hinges(results: Results, share: float) -> None:
    model, contacts, case = parts_of(results)
    alone = share * drawn_motion(model, case)
    together = finite_motion(model, contacts, case, share)
    assert widest_hinge(results, alone) > 1e-3 * share
    assert widest_hinge(results, together) < 1e-5
    before, after = model.blocks.vertices[:8], moved_vertices(model.blocks, together)[:8]
    sizes = [np.linalg.norm(points[:, None] - points[None], axis=2) for points in (before, after)]
    assert sizes[1] == pytest.approx(sizes[0])
    far = [np.linalg.norm(moved_vertices(model.blocks, each) - model.blocks.vertices, axis=1).max() for each in
           (alone, together)]  # fmt: skip
    assert 0.5 * far[0] < far[1] < 1.5 * far[0]


@pytest.mark.parametrize("results", ["benchmarks/closed_forms/spreading_arch"], indirect=True)
def test_a_support_that_gives_way_keeps_its_direction(results: Results) -> None:
    model, contacts, case = parts_of(results)
    settlement = case.load_case.settlement
    assert settlement is not None
    travel = screws(finite_motion(model, contacts, case))[1][settlement.blocks]
    way = settlement.motions[:, :3] / np.linalg.norm(settlement.motions[:, :3], axis=1, keepdims=True)
    along = np.einsum("ni,ni->n", travel, way)
    assert (along > 0).all()
    assert travel == pytest.approx(along[:, None] * way, abs=1e-9)


def test_pictures_and_frames_for_paraview_move_parts_together(results: Results, tmp_path: Path) -> None:
    model, contacts, case = parts_of(results)
    together = finite_motion(model, contacts, case)
    assert motion_as_drawn(results, case, 1.0) == pytest.approx(together)
    write_frame_vtu(tmp_path / "frame.vtu", scene_of(results, case), 1.0)
    moved = moved_vertices(model.blocks, together) - model.blocks.vertices
    found = meshio.read(tmp_path / "frame.vtu").point_data["displacement"]
    assert np.abs(found).max() == pytest.approx(np.abs(moved).max())


def test_a_mechanism_that_does_not_reach_so_far_is_drawn_part_by_part(results: Results) -> None:
    """At ten times the usual size the arch would have to go through itself."""
    model, contacts, case = parts_of(results)
    alone = 10 * drawn_motion(model, case)
    assert closed_motion(model, contacts, alone, np.zeros(0, dtype=np.int64)) is alone


def test_one_part_alone_follows_its_screw(monkeypatch: pytest.MonkeyPatch) -> None:
    results = tower_results()
    model, contacts, case = parts_of(results)
    assert finite_motion(model, contacts, case) == pytest.approx(drawn_motion(model, case), abs=0)
    assert finite_motion(model, contacts, None) == pytest.approx(np.zeros((3, 6)), abs=0)


def test_of_very_many_parts_each_follows_its_own(results: Results, monkeypatch: pytest.MonkeyPatch) -> None:
    assert MOST_PARTS > 100
    monkeypatch.setattr("mbla.results.collapse.finite_motion.MOST_PARTS", 2)
    model, contacts, case = parts_of(results)
    assert finite_motion(model, contacts, case) == pytest.approx(drawn_motion(model, case), abs=0)
