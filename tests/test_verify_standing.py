"""``mbla verify`` confirms no verdict on standing that the file does not prove: it disagrees, or says so."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from mbla.process.run_options import RunOptions
from mbla.results.exit_status import exit_code
from mbla.results.hdf5.content import unverified_kinds
from mbla.results.listing.listing import verification_lines
from mbla.results.outcome import unproved_words
from mbla.results.quantities.quantity import UNVERIFIED
from mbla.results.record.json_record import verification_json
from mbla.results.results import Results
from mbla.run import run
from mbla.solution.solution import Standing, StandingResult, Status
from mbla.solution.verification.verify import FALL_NOT_SHOWN, FALL_SHOWN, NOT_SHOWN, NOTHING_ACTS, SHOWN
from mbla.verify import verify_file
from tests.decks.folder import BENCHMARKS
from tests.line import BLOCK
from tests.results.changed_files import with_case, written

YES, SELF_STRESS, NO, DOUBTFUL = Standing.YES, Standing.SELF_STRESS, Standing.NO, Standing.DOUBTFUL
LOCKED = "it cannot be solved and stand only by self-stress, or not at all"
NOT_BROUGHT_ABOUT = "forces under the dead load alone do not come from the displacements of the blocks"


@pytest.fixture(scope="module")
def originals(tmp_path_factory: pytest.TempPathFactory) -> dict[Standing, Results]:
    """Runs without dilatancy that stand, stand only by self-stress and do not stand, as they were written."""
    folder = tmp_path_factory.mktemp("standing")
    decks = {SELF_STRESS: BENCHMARKS["bar_between_walls"], NO: BENCHMARKS["incline_too_steep"]}
    decks[YES] = folder / "block.yaml"
    decks[YES].write_text(BLOCK.replace("associative}", "non_associative}"), encoding="utf-8")
    found = {}
    for verdict, deck in decks.items():
        out = folder / verdict.name
        found[verdict] = run(deck, RunOptions(folder=out))
        assert verify_file(out / f"{deck.stem}.h5")[1] == ()
        standing = found[verdict].cases[0].solution.standing
        assert standing is not None
        assert standing.verdict is verdict
    return found


def judged(results: Results, tmp_path: Path) -> tuple[Results, tuple[str, ...]]:
    """What ``verify`` makes of a forged file; as bad of one that has all that follows from what was forged, too."""
    again, disagreements = verify_file(written(tmp_path, results))
    consistent = replace(again, exit_code=exit_code(again.cases, again.notices))
    both, others = verify_file(written(tmp_path, consistent))
    assert others or not both.cases[0].checks.verified or unproved_words(both.cases)
    assert both.exit_code in (4, 5)
    return again, disagreements


def told(verdict: Standing, results: Results, *, proof: bool = False) -> StandingResult:
    """A standing that was not found, with the proof of another one or none."""
    own = results.cases[0].solution.standing
    assert own is not None
    return replace(own, verdict=verdict) if proof else StandingResult(verdict, None, "so it was told")


@pytest.mark.every(3)
@pytest.mark.parametrize(
    ("verdict", "forged", "proof", "words"),
    [
        (YES, DOUBTFUL, True, SHOWN),
        pytest.param(YES, SELF_STRESS, True, SHOWN, marks=pytest.mark.long),
        (YES, SELF_STRESS, False, LOCKED),
        (YES, NO, True, FALL_NOT_SHOWN),
        pytest.param(YES, NO, False, FALL_NOT_SHOWN, marks=pytest.mark.long),
        (SELF_STRESS, YES, False, NOT_SHOWN),
        pytest.param(SELF_STRESS, NO, False, FALL_NOT_SHOWN, marks=pytest.mark.long),
        (NO, YES, False, FALL_SHOWN),
        pytest.param(NO, SELF_STRESS, False, FALL_SHOWN, marks=pytest.mark.long),
        pytest.param(NO, DOUBTFUL, False, FALL_SHOWN, marks=pytest.mark.long),
    ],
)
def test_a_verdict_that_the_file_refutes_or_lacks_the_proof_of_is_disagreed_with(
    verdict: Standing,
    forged: Standing,
    proof: bool,
    words: str,
    originals: dict[Standing, Results],
    tmp_path: Path,
) -> None:
    results = originals[verdict]
    status = Status.NO_EQUILIBRIUM if verdict is NO else Status.SOLVED
    changed = with_case(results, standing=told(forged, results, proof=proof), status=status, reason="")
    again, disagreements = judged(changed, tmp_path)
    assert again.exit_code == 4
    assert any(words in text for text in (*disagreements, *again.cases[0].checks.failures))
    assert disagreements


def test_a_doubt_is_marked_and_a_load_factor_that_rests_on_it_not_confirmed(
    originals: dict[Standing, Results], tmp_path: Path
) -> None:
    """Of a structure that stands, without the proof."""
    results = originals[YES]
    changed = with_case(results, standing=told(DOUBTFUL, results), status=Status.SOLVED, reason="")
    again, disagreements = judged(changed, tmp_path)
    assert disagreements == ()
    assert again.exit_code == 4
    (words,) = unproved_words(again.cases)
    assert "is not verified, the run reported 'doubtful'; statements on the live load presume" in words
    assert words in verification_json(again, disagreements)["not_verified"]
    assert "presume that it stands" in " ".join("\n".join(verification_lines(again, disagreements)).split())
    with h5py.File(written(tmp_path, changed)) as file:
        name = f"cases/{again.cases[0].load_case.name}/standing/verdict"
        assert file[name].attrs["verification"] == f"not verified: {UNVERIFIED['standing']}".encode()


def test_a_doubt_of_what_stands_only_by_self_stress_is_marked(
    originals: dict[Standing, Results], tmp_path: Path
) -> None:
    """It has no load factor that could rest on it."""
    results = originals[SELF_STRESS]
    assert results.cases[0].solution.mechanics is None
    again, _ = judged(with_case(results, standing=told(DOUBTFUL, results)), tmp_path)
    assert again.exit_code == 4
    (words,) = unproved_words(again.cases)
    assert words.endswith("is not verified, the run reported 'doubtful'")


@pytest.mark.long
def test_a_structure_that_falls_is_not_made_doubtful_without_a_word(
    originals: dict[Standing, Results], tmp_path: Path
) -> None:
    """Without the motion that shows its fall there is no answer, and the doubt is not verified."""
    results = originals[NO]
    changed = with_case(results, standing=told(DOUBTFUL, results), certificate=None, status=Status.NOT_VERIFIED)
    again, _ = judged(changed, tmp_path)
    assert again.exit_code == 4
    assert len(unproved_words(again.cases)) == 1


def test_proved_verdicts_are_not_marked(originals: dict[Standing, Results], tmp_path: Path) -> None:
    for verdict in (YES, NO):
        results = originals[verdict]
        assert UNVERIFIED["standing"] not in unverified_kinds(results)
        assert unproved_words(results.cases) == ()
        with h5py.File(written(tmp_path, results)) as file:
            name = f"cases/{results.cases[0].load_case.name}/standing/verdict"
            assert "verification" not in file[name].attrs
    assert UNVERIFIED["standing"] in unverified_kinds(originals[SELF_STRESS])


@pytest.mark.every(2)
@pytest.mark.parametrize("kept", [True, False])
def test_a_structure_that_stands_is_not_made_to_fall(
    kept: bool, originals: dict[Standing, Results], tmp_path: Path
) -> None:
    """With its forces and mechanism or without."""
    results = originals[YES]
    changed: dict[str, Any] = {"standing": None, "status": Status.NO_EQUILIBRIUM, "reason": ""}
    if not kept:
        changed |= dict.fromkeys(("mechanics", "associative", "least"))
    again, disagreements = judged(with_case(results, **changed), tmp_path)
    assert again.cases[0].status is Status.NOT_VERIFIED
    assert FALL_NOT_SHOWN in again.cases[0].checks.failures
    assert disagreements


def test_forces_that_would_have_to_be_locked_in_prove_nothing(
    originals: dict[Standing, Results], tmp_path: Path
) -> None:
    """They balance the dead load of the bar between two walls, and no displacement brings them about."""
    results = originals[SELF_STRESS]
    dead_load = results.cases[0].load_case.dead_load
    forces = np.array(results.contacts.frames @ np.array([0.0, 0.0, 1.0]))
    assert np.abs(forces[:, 0]).max() == pytest.approx(0.0)
    forces *= np.abs(dead_load[0, 2]) / len(forces)
    bodies = results.contacts.bodies[results.contacts.interface_of_point]
    forces *= np.where(bodies[:, :1] == 0, -1.0, 1.0)
    forces[:, 0] = 2.0 * np.linalg.norm(forces, axis=1)
    standing = replace(told(YES, results), forces=forces, settlement=np.zeros_like(dead_load))
    again, disagreements = judged(with_case(results, standing=standing), tmp_path)
    *_, failure = again.cases[0].checks.failures
    assert failure == NOT_BROUGHT_ABOUT
    assert disagreements


def test_where_nothing_acts_nothing_falls(tmp_path: Path) -> None:
    deck = tmp_path / "deck.yaml"
    deck.write_text(BLOCK.replace("{live:", "{dead: [{gravity: none}], live:"), encoding="utf-8")
    results = run(deck, RunOptions(overrides=("parameters.c=1e4",)))
    assert verify_file(tmp_path / "deck.out" / "deck.h5")[1] == ()
    again, disagreements = verify_file(written(tmp_path, with_case(results, standing=told(DOUBTFUL, results))))
    assert again.cases[0].checks.failures == (NOTHING_ACTS,)
    assert disagreements


def test_bounds_of_associative_flow_presume_no_standing(tmp_path: Path) -> None:
    deck = tmp_path / "deck.yaml"
    deck.write_text(BLOCK, encoding="utf-8")
    results = run(deck, RunOptions())
    again, disagreements = verify_file(written(tmp_path, with_case(results, standing=told(DOUBTFUL, results))))
    assert disagreements == ()
    assert again.exit_code == 0
    assert unproved_words(again.cases) == (
        "push: whether it stands under its dead load alone is not verified, the run reported 'doubtful'",
    )
