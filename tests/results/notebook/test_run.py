"""What Run and Case say of every kind of outcome: a figure that is no result does not look like one."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.errors import UsageError
from mbla.results.notebook.run import Run
from mbla.results.results import Results
from mbla.solution.solution import Status
from tests.results.synthetic import full_results, standing_at, tower_results


def one(status: Status = Status.SOLVED, **changes: Any) -> Run:
    results = tower_results()
    case = replace(results.cases[0], status=status)
    return Run(replace(results, cases=(replace(case, solution=replace(case.solution, **changes)),)))


def test_solved_case() -> None:
    case = Run(tower_results()).case("push_x")
    assert case.load_factor == 0.5
    assert case.verified
    assert case.reason == ""
    assert np.isnan(case.least_load_factor)
    assert np.isnan([case.angle, case.reaction]).all()
    assert case.mechanism is not None
    assert case.mechanism[1, 4] == 0.1
    assert case.summary == "push_x: collapses at 0.5 g, verified: 1 hinge; 1 of 2 free blocks moves as one rigid part"
    assert "0.5 g" in repr(case)
    assert case.certificate is None


@pytest.mark.parametrize("status", [each for each in Status if each not in (Status.SOLVED, Status.APPROXIMATE)])
def test_no_other_status_has_a_figure(status: Status) -> None:
    run = one(status)
    case = run.cases[0]
    assert np.isnan(run.load_factor)
    nothing = (case.mechanism, case.contact_forces, case.contact_modes, case.mechanics, case.thrust, case.collapse)
    assert nothing == (None,) * 6
    assert not case.verified
    assert case.reason
    assert case.record.solution.mechanics is not None


def test_case_without_equilibrium_has_its_motion() -> None:
    case = Run(tower_results()).case("fall")
    assert case.certificate is not None
    assert case.certificate[1, 2] == -1


def travelling(factors: list[float], status: Status = Status.SOLVED) -> Results:
    results = tower_results()
    case, cases = results.cases[0], []
    assert case.solution.mechanics is not None
    for number, factor in enumerate(factors, start=1):
        travel = standing_at(number, len(factors), np.zeros(3), 0.0)
        load_case = replace(case.load_case, name=f"train_{number}", question=travel)
        solution = replace(case.solution, mechanics=replace(case.solution.mechanics, load_factor=factor))
        cases.append(replace(case, load_case=load_case, solution=solution, status=Status.SOLVED))
    cases[-1] = replace(cases[-1], status=status)
    return replace(results, cases=tuple(cases))


def test_travelling_load_has_that_of_its_worst_position() -> None:
    run = Run(travelling([0.7, 0.4, 0.5]))
    assert run.load_factor == 0.4
    assert list(run.load_factors) == ["train_1", "train_2", "train_3"]
    assert run.representative_case is not None
    assert run.representative_case.name == "train_2"


def test_run_of_several_cases() -> None:
    run = Run(tower_results())
    assert len(run) == 2
    assert [case.name for case in run] == ["push_x", "fall"]
    assert not run.verified
    assert run.exit_code == 5
    assert run["fall"].status is Status.NO_EQUILIBRIUM
    with pytest.raises(UsageError, match="2 load cases"):
        run.picture()
    assert "near-miss" in [notice.identifier for notice in run.warnings]
    assert all(notice.severity == "warning" for notice in run.warnings)
    assert run.units == {"length": "m", "force": "N", "mass": "kg"}
    assert "push_x" in run.summary
    assert "push_x" in run.listing
    assert repr(run).startswith("<mbla run of tower.yaml")


def test_run_without_cases() -> None:
    run = Run(replace(tower_results(), cases=()))
    assert not run.verified
    assert run.representative_case is None
    assert "<table>" in run._repr_html_()
    with pytest.raises(UsageError, match="0 load cases"):
        _ = run.load_factor


def test_the_associative_load_factor_and_the_view_of_the_only_case() -> None:
    run = one()
    assert run.cases[0].associative_load_factor == 0.5
    assert run.show()._repr_html_() == run.cases[0].show()._repr_html_()
    assert np.isnan(one(associative=None).cases[0].associative_load_factor)
    with pytest.raises(UsageError, match="2 load cases"):
        Run(tower_results()).show()


def test_travelling_load_with_a_position_unknown_has_none() -> None:
    with pytest.raises(UsageError, match="train"):
        _ = Run(travelling([0.7, 0.4], Status.NOT_VERIFIED)).load_factor


def test_settlement_has_its_reaction() -> None:
    results = full_results()
    case = replace(results.cases[0], solution=replace(results.cases[0].solution, standing=None))
    run = Run(replace(results, cases=(case,)))
    assert run.cases[0].reaction == pytest.approx(30.0 - 0.5 * 20.0)
    assert run.cases[0].least_load_factor == 0.45


def test_tables_as_frames() -> None:
    frames = Run(tower_results()).to_frames(["cases", "blocks"])
    assert list(frames) == ["cases", "blocks"]
    assert frames["cases"]["load_factor"].tolist()[0] == 0.5
    with pytest.raises(UsageError, match="stones"):
        Run(tower_results()).to_frames(["stones"])
