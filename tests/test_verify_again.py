"""Paths followed anew by ``mbla verify --again``, and beside others at ``accuracy: reference``: what they show."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from mbla.cli import main
from mbla.process.run_options import RunOptions
from mbla.results.exit_status import exit_code
from mbla.results.findings import NOT_CHECKED
from mbla.results.listing.history_words import history_words
from mbla.results.listing.listing import listing, verification_lines
from mbla.results.record.json_record import verification_json
from mbla.results.results import CaseResult, Results
from mbla.results.verification.asked import Found, held_against_deck
from mbla.results.verification.history import held_against_paths, paths_again
from mbla.run import run
from mbla.solution.flow.settings import ratios_beside, second_ratio
from mbla.solution.solution import PathByStiffness, Status
from mbla.verify import rebuilt, recomputed, verify_file
from tests.decks.folder import BENCHMARKS
from tests.line import BLOCK
from tests.results.changed_files import written

SLIDES = BLOCK.replace("flow_rule: associative", "flow_rule: non_associative").replace("h: 2", "h: 1")
STATICS = 0.5
"""load factor at which the block slides, whatever its joint's stiffness"""


def run_of(folder: Path, text: str, *overrides: str) -> Results:
    deck = folder / "deck.yaml"
    deck.write_text(text, encoding="utf-8")
    return run(deck, RunOptions(overrides=overrides, force=True))


@pytest.fixture(scope="module")
def slides(tmp_path_factory: pytest.TempPathFactory) -> Results:
    return run_of(tmp_path_factory.mktemp("slides"), SLIDES)


@pytest.fixture(scope="module")
def reference(tmp_path_factory: pytest.TempPathFactory) -> Results:
    return run_of(tmp_path_factory.mktemp("reference"), SLIDES, "analysis.accuracy=reference")


def forged(results: Results, change: Callable[[Results], Results]) -> Results:
    """A file in which all that follows from what was changed is as a run would write it."""
    changed = change(results)
    again = recomputed(changed, None)
    return replace(again, exit_code=exit_code(again.cases, again.notices))


def with_load(results: Results, share: float) -> Results:
    """The state at a share of the load factor, with the history from which its joints come to it without sliding."""
    (case,) = results.cases
    own, solution = case.solution.mechanics, case.solution
    assert own is not None
    assert own.stiffness is not None
    at_rest = [own.contact_forces[:, 0].mean(), 0.0, 0.0]
    forces = at_rest + share * (own.contact_forces - at_rest)
    remembered = forces + own.stiffness[:, [0, 1, 1]] * own.contact_velocities
    low = replace(own, load_factor=share * own.load_factor, contact_forces=forces, remembered=remembered)
    path = tuple(replace(step, load_factor=share * step.load_factor) for step in solution.path)
    solution = replace(solution, mechanics=low, path=path, path_last=share * solution.path_last)
    return replace(results, cases=(replace(case, solution=solution),))


def test_a_history_that_is_not_that_of_the_loading_is_found_by_a_path_followed_anew_alone(
    slides: Results, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(tmp_path, forged(slides, lambda results: with_load(results, 0.5)))
    plain, differences = verify_file(path)
    assert (differences, plain.exit_code, plain.cases[0].status) == ((), 0, Status.SOLVED)
    assert main(["verify", "--again", str(path)]) == 4
    says = " ".join(capsys.readouterr().out.split())
    assert "differs: push: the path followed anew" in says
    assert "the file has 0.25 g" in says


def test_a_sound_history_is_confirmed_and_without_a_path_followed_anew_said_not_to_be_checked(
    slides: Results, tmp_path: Path
) -> None:
    path = written(tmp_path, slides)
    plain, differences = verify_file(path)
    assert NOT_CHECKED in verification_json(plain, differences)["not_verified"]
    assert " ".join(NOT_CHECKED.split()) in words_of(plain)
    found, differences = verify_file(path, anew=True)
    assert (differences, found.exit_code) == ((), 0)
    (again,) = verification_json(found, differences)["paths_again"]
    assert (again["ratio"], again["ratio_in_file"]) == (1.0, 0.4)
    assert again["load_factor"] == pytest.approx(STATICS, rel=1e-3)  # it still rises where the path ends
    assert NOT_CHECKED not in verification_json(found, differences)["not_verified"]
    assert "push: the path followed anew, by other steps" in words_of(found)


def words_of(results: Results) -> str:
    return " ".join(" ".join(verification_lines(results, ())).split())


def test_what_has_no_path_is_said_to_have_none(tmp_path: Path) -> None:
    results = run_of(tmp_path, BLOCK)
    assert history_words(results) == ()
    deck, _ = rebuilt(results, {})
    assert deck is not None
    assert paths_again(deck, results.assembly, results.cases[0]) == ()
    assert history_words(replace(results, paths_again=())) == ("no path of elastic joints to follow anew: push",)


def test_reference_follows_joints_of_two_other_stiffnesses(reference: Results, slides: Results) -> None:
    rows = reference.cases[0].solution.path_by_stiffness
    assert [row.ratio for row in rows] == [0.2, 1.0]
    assert [row.load_factor for row in rows] == pytest.approx([STATICS, STATICS], rel=1e-3)
    assert "With joints of 0.2 and 1 of their stiffness in shear: 0.5 g, 0.5 g; within ±" in listing(reference)
    assert slides.cases[0].solution.path_by_stiffness == ()  # standard follows the path of the deck alone


def test_a_path_that_an_accuracy_asks_for_is_missed(reference: Results, slides: Results) -> None:
    def told(results: Results, *rows: PathByStiffness) -> str:
        deck, _ = rebuilt(results, {})
        assert deck is not None
        return " ".join(held_against_deck(deck, results.assembly, beside(results, *rows), done=True).differences)

    assert "the deck asks for the paths of joints of other stiffnesses" in told(reference)
    assert "other stiffnesses than the deck leads to" in told(slides, PathByStiffness(0.3, STATICS))
    far_off = PathByStiffness(0.2, STATICS), PathByStiffness(1.0, 0.8 * STATICS)
    assert "the load factor is solved, and joints of other stiffnesses" in told(reference, *far_off)


def beside(results: Results, *rows: PathByStiffness) -> CaseResult:
    """The case with other figures of joints of other stiffnesses."""
    (case,) = results.cases
    return replace(case, solution=replace(case.solution, path_by_stiffness=rows))


def test_a_load_factor_of_other_joints_is_found_again_or_differs(reference: Results) -> None:
    deck, _ = rebuilt(reference, {})
    assert deck is not None
    case = beside(reference, PathByStiffness(0.2, 0.48), PathByStiffness(1.0, STATICS))
    found, paths = Found(), paths_again(deck, reference.assembly, case)
    held_against_paths(found, reference.model, case, paths)
    assert [path.agrees for path in paths] == [False, True]
    assert ["the file has 0.48 g with 0.2" in words for words in found.differences] == [True]


@pytest.mark.parametrize(
    ("ratio", "beside", "second"), [(0.4, (0.2, 1.0), 1.0), (1.0, (0.2, 0.4), 0.4), (0.2, (0.4, 1.0), 1.0)]
)
def test_other_stiffnesses_are_none_of_the_deck(ratio: float, beside: tuple[float, ...], second: float) -> None:
    assert (ratios_beside(ratio), second_ratio(ratio)) == (beside, second)


@pytest.mark.long
@pytest.mark.parametrize(
    "name",
    [
        "beam_on_three_supports",  # a reaction that is nothing
        "leaning_block_rough_wall",  # joints of another stiffness do not show their greatest load
        "plank_in_clamp",  # and move the load factor by 2 %
        "groove_dilatancy",
        "two_piers",
    ],
)
def test_files_of_runs_are_agreed_with(name: str, tmp_path: Path) -> None:
    run(BENCHMARKS[name], RunOptions(folder=tmp_path))
    found, differences = verify_file(tmp_path / f"{name}.h5", anew=True)
    assert (differences, found.unconfirmed) == ((), ())
    assert found.paths_again
