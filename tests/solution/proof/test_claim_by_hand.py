"""Which of the repaired forces and motions of one block are claimed: those that prove most."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.program import Program, assemble
from mbla.solution.proof.claim import with_proof
from mbla.solution.solution import Mechanics, Solution, Status
from tests.line import Line
from tests.solution.by_hand import claim, cube, loaded, on_ground, state

# A block 1 x 1 x 0.5 on the ground, friction 1/2, weight 32 and a push of 8 λ at its base: it slides and rises by μ.

DEAD, LIVE = (0, 0, -32, 0, 0, 0), (8, 0, 0, 0, -2, 0)
PATH = "mbla.solution.proof.claim."

both_models = pytest.mark.parametrize("interfaces", [False, True])


@pytest.fixture(scope="module")
def dry() -> Line:
    line = cube()
    case = loaded(line.load_case, DEAD, LIVE)
    return replace(line, load_case=case, program=assemble(line.model, line.contacts, case))


@pytest.fixture(autouse=True)
def mended(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Forces and velocities are repaired into what the test says."""
    of: dict[str, Any] = {"forces": None, "motions": [], "asked": 0}

    def mechanisms(program: Program, velocities: FloatArray) -> Iterator[FloatArray]:
        yield velocities
        more = [1.0] * (len(velocities) - 6)  # that of the interface
        for motion in of["motions"]:
            of["asked"] += 1
            blocks = replace(program, dead_load=program.dead_load[:6]).velocities(np.array([motion]))
            yield np.append(blocks, more)

    monkeypatch.setattr(PATH + "repaired_mechanisms", mechanisms)
    monkeypatch.setattr(PATH + "repaired_forces", lambda *_: of["forces"])
    return of


def slides(up: float) -> tuple[float, ...]:
    """For a live power of 1; it proves 32 times its rise."""
    return (0.125, 0.0, up, 0.0, 0.0, 0.0)


def given(line: Line, up: float = 0.25) -> Mechanics:
    return state(on_ground(line.model, line.contacts, (8, -4, 0)), np.array([slides(up)]), 2.0)


def claimed(line: Line, solution: Solution, interfaces: bool = False) -> Solution:
    solution = replace(solution, contact_model="convex" if interfaces else "concave")
    return with_proof(line.model, line.contacts, line.load_case, solution)


def rise(solution: Solution) -> float:
    """Of the mechanism that is claimed."""
    assert solution.associative is not None
    return float(solution.associative.mechanism[0, 2])


@both_models
def test_the_motion_of_the_least_bound_is_claimed(interfaces: bool, dry: Line, mended: dict[str, Any]) -> None:
    mended["motions"] = [(-0.125, 0, 0, 0, 0, 0), slides(0.2), slides(0.0625 + 1e-3), slides(0.125)]
    found = claimed(dry, claim(given(dry)), interfaces)
    assert rise(found) == pytest.approx(0.0625 + 1e-3)
    assert found.mechanics is found.associative
    mended["motions"] = [(-0.125, 0, 0, 0, 0, 0), slides(0.3)]
    assert rise(claimed(dry, claim(given(dry)), interfaces)) == pytest.approx(0.25)


def test_velocities_are_those_of_the_motion(dry: Line, mended: dict[str, Any]) -> None:
    mended["motions"] = [slides(0.0625)]
    found = claimed(dry, claim(given(dry))).associative
    assert found is not None
    assert found.mechanism.tolist() == [list(slides(0.0625))]
    assert found.contact_velocities[:, 0] == pytest.approx(0.0625)


def test_a_state_of_another_flow_rule_stays(dry: Line, mended: dict[str, Any]) -> None:
    mended["motions"] = [slides(0.0625)]
    other = given(dry, 0.0)
    found = claimed(dry, replace(claim(other), flow_rule="non_associative", associative=given(dry)))
    assert found.mechanics is other
    assert rise(found) == pytest.approx(0.0625)


def test_repaired_forces_are_claimed_with_what_they_carry(dry: Line, mended: dict[str, Any]) -> None:
    found = claimed(dry, claim(given(dry))).associative
    assert found is not None
    assert found.load_factor == 2.0
    assert found.contact_forces.tolist() == given(dry).contact_forces.tolist()
    program = dry.program
    mended["forces"] = program.scaling.scaled_forces(0.5 * found.contact_forces), 1.5 / program.scaling.live
    found = claimed(dry, claim(given(dry))).associative
    assert found is not None
    assert found.load_factor == pytest.approx(1.5)
    assert found.contact_forces == pytest.approx(0.5 * given(dry).contact_forces)


@pytest.mark.parametrize(("large", "off", "asked"), [(5, 0.9e-5, 0), (5, 1.1e-5, 1), (6, 0.9e-5, 1), (5, -1.0, 1)])
def test_large_models_are_content_with_a_mechanism_that_is_near(
    large: int, off: float, asked: int, dry: Line, mended: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of six rows."""
    monkeypatch.setattr(PATH + "LARGE", large)
    first = given(dry, 0.0625 * (1.0 + off))
    if off < 0:
        first = replace(first, mechanism=-first.mechanism)
    mended["forces"] = dry.program.scaling.scaled_forces(first.contact_forces), 2.0 / dry.program.scaling.live
    mended["motions"] = [slides(0.0625)]
    assert rise(claimed(dry, claim(first))) == pytest.approx(0.0625 * (1.0 + (off if asked == 0 else 0.0)), rel=1e-9)
    assert mended["asked"] == asked


def test_models_of_some_thousand_blocks_are_repaired(dry: Line, mended: dict[str, Any]) -> None:
    mended["motions"] = [slides(0.0625), slides(0.0625)]
    claimed(dry, claim(given(dry, 0.0625)))
    assert mended["asked"] == 2


@both_models
def test_the_first_motion_that_proves_a_fall_is_claimed(interfaces: bool, dry: Line, mended: dict[str, Any]) -> None:
    """Of a block pushed by 24 as well: it falls where it rises by half of what it slides."""
    line = replace(dry, load_case=loaded(dry.load_case, (24, 0, -32, 0, 0, 0), LIVE))
    at_rest = claim(None, Status.NO_EQUILIBRIUM, certificate=np.zeros((1, 6)))

    def fall(solution: Solution) -> list[list[float]]:
        certificate = claimed(line, solution, interfaces).certificate
        assert certificate is not None
        rows: list[list[float]] = certificate.tolist()
        return rows

    mended["motions"] = [(-2, 0, 1, 0, 0, 0), (2, 0, 1, 0, 0, 0), (4, 0, 3, 0, 0, 0)]
    assert fall(at_rest) == [[1, 0, 0.5, 0, 0, 0]]
    mended["motions"] = [(-2, 0, 1, 0, 0, 0), (2, 0, 0, 0, 0, 0)]
    assert fall(at_rest) == [[0, 0, 0, 0, 0, 0]]
    assert fall(replace(at_rest, certificate=np.array([(2.0, 0, 1, 0, 0, 0)]))) == [[1, 0, 0.5, 0, 0, 0]]


def test_nothing_is_claimed_where_there_is_nothing(dry: Line) -> None:
    for solution in (claim(None, Status.UNBOUNDED), replace(claim(given(dry)), associative=None)):
        assert claimed(dry, solution) == solution
