"""What a scene knows of a case without a result."""

from dataclasses import replace

from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.scene import scene_of
from mbla.solution.solution import Status
from tests.results.synthetic import tower_results


def test_how_unique_forces_are_is_asked_of_results_only() -> None:
    """The best that was reached is drawn, and nothing is said of other forces."""
    results = tower_results()
    solved = scene_of(results, results.cases[0], PictureOptions(), "forces")
    assert solved.force_freedom is not None
    stopped = scene_of(results, replace(results.cases[0], status=Status.NOT_VERIFIED), PictureOptions(), "forces")
    assert stopped.forces[0] is not None
    assert stopped.force_freedom is None
    assert not any("one possible state" in line or "unique" in line for line in stopped.words_of("forces"))


def test_without_forces_there_are_no_lines_of_thrust() -> None:
    results = tower_results()
    falls = scene_of(results, results.cases[1], PictureOptions(), "forces")
    assert falls.forces[0] is None
    assert falls.thrust is None
    assert falls.thrust_lines == []
    assert falls.joint_use is None
