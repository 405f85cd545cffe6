"""``mbla verify`` on rows of a pushover: what is changed, left out or of another deck, and what ``--again`` adds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.errors import FileError
from mbla.process.run_options import RunOptions
from mbla.results.exit_status import exit_code
from mbla.results.findings import NOT_FOLLOWED
from mbla.results.listing.listing import verification_lines
from mbla.results.record.json_record import verification_json
from mbla.results.results import Results
from mbla.run import run
from mbla.solution.pushover.record import PushedRows, RowPoints
from mbla.verify import rebuilt, recomputed, verify_file
from tests.line import BLOCK
from tests.results.changed_files import change, changing, written
from tests.results.listing.sections.test_pushover import TABLE

ROCKS = (
    "parameters.mu=0.8",
    "joints.rough={friction: 2}",  # of no interface
    "load_cases.push.pushover={step: 0.05, until: 0.2, error: false}",
)
SLIDES = (
    "analysis.flow_rule=non_associative",
    "parameters.h=1",
    "load_cases.push.pushover={step: 0.01, until: 0.05, error: true}",
)
Change = Callable[[PushedRows], PushedRows]


def run_of(folder: Path, *overrides: str) -> Results:
    (deck := folder / "deck.yaml").write_text(BLOCK, encoding="utf-8")
    return run(deck, RunOptions(overrides=overrides, force=True))


@pytest.fixture(scope="module")
def rocks(tmp_path_factory: pytest.TempPathFactory) -> Results:
    """A block that rocks, by five rows."""
    return run_of(tmp_path_factory.mktemp("rocks"), *ROCKS)


@pytest.fixture(scope="module")
def slides(tmp_path_factory: pytest.TempPathFactory) -> Results:
    """A block that slides, by six rows, with their errors."""
    return run_of(tmp_path_factory.mktemp("slides"), *SLIDES)


def forged(results: Results, change: Change, **others: object) -> Results:
    """A file with other rows of its pushover, and all that follows from them as a run would write it."""
    (case,) = results.cases
    deck, _ = rebuilt(results, {})
    pushover = case.solution.further.pushover
    assert pushover.rows is not None
    pushover = replace(pushover, rows=change(pushover.rows), **others)  # type: ignore[arg-type]
    case = case.with_further(replace(case.solution.further, pushover=pushover), ())
    again = recomputed(replace(results, cases=(case,)), deck)
    return replace(again, exit_code=exit_code(again.cases, again.notices))


def said_of(folder: Path, results: Results, *, anew: bool = False) -> str:
    """What verification says of a file: that something differs, is not confirmed, or nothing."""
    found, differences = verify_file(written(folder, results), anew=anew)
    assert (found.exit_code == 0) is not bool(differences or found.unconfirmed)
    return "; ".join([*(f"differs: {each}" for each in differences), *found.unconfirmed])


def chosen(rows: PushedRows, kept: Sequence[int]) -> PushedRows:
    """Some of the rows."""
    names = ("load_factors", "shifts", "turns", "fallen", "energies", "errors", "jumps", "unsolved")
    bounds = rows.point_start
    points = np.concatenate([np.arange(bounds[row], bounds[row + 1]) for row in kept]).astype(int)
    return replace(
        rows,
        **{name: getattr(rows, name)[kept] for name in names},
        point_start=np.append(0, np.cumsum(np.diff(bounds)[kept])),
        points=RowPoints(**{name: values[points] for name, values in vars(rows.points).items()}),
    )


def without(*left_out: int) -> Change:
    return lambda rows: chosen(rows, [row for row in range(len(rows)) if row not in left_out])


def with_energies(column: int, factor: float) -> Change:
    def change(rows: PushedRows) -> PushedRows:
        energies = rows.energies.copy()
        energies[:, column] *= factor
        return replace(rows, energies=energies)

    return change


def with_last(name: str, value: float) -> Change:
    def change(rows: PushedRows) -> PushedRows:
        values = getattr(rows, name).copy()
        values[-1] = value
        return replace(rows, **{name: values})

    return change


def test_a_pushover_as_it_was_made_is_agreed_with(rocks: Results, tmp_path: Path) -> None:
    assert said_of(tmp_path, forged(rocks, lambda rows: rows)) == ""


@pytest.mark.every(2)
@pytest.mark.parametrize(
    ("change", "says"),
    [
        (without(2), "before step 2 the pushover has no row where its deck asks for one"),
        (without(4), "rows are missing"),
        (with_energies(0, 0.9), "the live work up to step 4"),
        (with_energies(4, 0.9), "the energy that the dead load gains up to step 4"),
        (lambda rows: replace(rows, energies=0.5 * rows.energies), "is not that of its poses and load factors"),
        (with_last("fallen", 1.0), "blocks that fall without the rest are not verified; the file says: 1"),
    ],
)
def test_what_the_rows_do_not_show(change: Change, says: str, rocks: Results, tmp_path: Path) -> None:
    assert says in said_of(tmp_path, forged(rocks, change))


def test_points_of_another_joint_law_of_the_deck(rocks: Results, tmp_path: Path) -> None:
    """A law of more friction, with which the block would stick at the same place at a greater load."""

    def change(rows: PushedRows) -> PushedRows:
        return replace(rows, points=replace(rows.points, laws=np.ones_like(rows.points.laws)))

    assert "step 1 of the pushover has contact points with a joint law" in said_of(tmp_path, forged(rocks, change))


def with_points(name: str, to: Callable[[np.ndarray], np.ndarray]) -> Change:
    """Rows with other values of their contact points."""
    return lambda rows: replace(rows, points=replace(rows.points, **{name: to(getattr(rows.points, name))}))


def test_frames_of_points_that_are_not_orthonormal(rocks: Results, tmp_path: Path) -> None:
    """A normal that is longer finds the same forces on a joint that is as much softer."""
    file = forged(rocks, with_points("frames", lambda frames: frames * 1.01))
    assert "step 1 of the pushover has contact points whose frames are not of unit vectors" in said_of(tmp_path, file)


@pytest.mark.every(2)
@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("laws", 7, "damaged: cases/push/pushed/law points outside the joint laws, or the ties, of the deck"),
        ("laws", -5, "damaged: cases/push/pushed/law points outside"),
        ("bodies", -5, "damaged: cases/push/pushed/bodies points outside the 2 bodies"),
        ("bodies", 2, "damaged: cases/push/pushed/bodies points outside the 2 bodies"),
        ("bodies", -1, "damaged: cases/push/pushed/law points outside"),
    ],
)
def test_points_of_bodies_and_laws_that_are_not_there(
    name: str, value: int, says: str, rocks: Results, tmp_path: Path
) -> None:
    """The file is refused, by the name of the array."""
    path = written(tmp_path, rocks)
    change(path, f"cases/push/pushed/{'law' if name == 'laws' else name}", value)
    with pytest.raises(FileError, match=says):
        verify_file(path)


def test_what_the_rows_take_from_the_run_is_marked(rocks: Results, tmp_path: Path) -> None:
    with changing(written(tmp_path, rocks)) as file:
        group = file["cases/push/pushed"]
        marked = {name for name in group if "verification" in group[name].attrs}
    assert marked == {"areas", "at_zero", "fallen", "host", "stiffness"}


def test_friction_that_loads_do_not_pay_for(slides: Results, tmp_path: Path) -> None:
    assert "the energy that friction, ties and crushing take" in said_of(
        tmp_path, forged(slides, with_energies(1, 1.1))
    )


def test_friction_that_is_left_out_is_energy_that_goes_nowhere(slides: Results, tmp_path: Path) -> None:
    says = said_of(tmp_path, forged(slides, with_energies(1, 0.5)))
    assert "0.5 of the energy of the pushover is lost where blocks drop is not verified" in says


@pytest.mark.parametrize(("name", "word"), [("jumps", "it jumps there"), ("unsolved", "none was found there")])
def test_a_reason_for_rows_that_are_missing_is_not_confirmed(
    name: str, word: str, rocks: Results, tmp_path: Path
) -> None:
    def change(rows: PushedRows) -> PushedRows:
        counts = getattr(rows, name).copy()
        counts[3] = 1
        return without(2)(replace(rows, **{name: counts}))

    says = said_of(tmp_path, forged(rocks, change))
    assert says == f"push: that the pushover has no row before step 2 is not verified; the file says: {word}"


def test_rows_of_another_deck(slides: Results, tmp_path: Path) -> None:
    rows = run_of(tmp_path, *SLIDES, "parameters.mu=0.4", "load_cases.push.pushover.error=false")
    other = rows.cases[0].solution.further.pushover.rows
    assert other is not None
    assert "violate the joint law" in said_of(tmp_path, forged(slides, lambda _: other))


def test_that_rows_are_those_of_the_way_is_said_not_to_be_checked(rocks: Results, tmp_path: Path) -> None:
    path = written(tmp_path, rocks)
    plain, differences = verify_file(path)
    assert NOT_FOLLOWED in verification_json(plain, differences)["not_verified"]
    found, differences = verify_file(path, anew=True)
    words = " ".join(" ".join(verification_lines(found, differences)).split())
    assert "push: the pushover followed anew has 4 steps and ends because the displacement asked for" in words
    assert NOT_FOLLOWED not in verification_json(found, differences)["not_verified"]
    (again,) = verification_json(found, differences)["pushovers_again"]
    assert (again["steps"], again["steps_in_file"], again["agrees"]) == (4, 4, True)
    assert again["off"] < 1e-9


def at_half_the_load(results: Results) -> Change:
    """Rows in which the block sticks where it has slid to, at half of the load factor: forces in balance, and a history
    by which elastic joints have just these.
    """
    (block,), weight = results.model.blocks.centroids, 9.81 * float(results.model.blocks.masses[0])

    def change(rows: PushedRows) -> PushedRows:
        points, factors = rows.points, rows.load_factors.copy()
        forces, history = points.forces.copy(), points.history.copy()
        for row, pose in enumerate(rows.poses):
            own = slice(int(rows.point_start[row]), int(rows.point_start[row + 1]))
            if not row:
                continue
            factors[row] *= 0.5
            rest = np.zeros_like(forces[own])
            rest[:, 0] = weight / len(rest)
            forces[own] = 0.5 * (rest + forces[own])
            ends = [points.arms[own, side] for side in (0, 1)]
            on = int(points.bodies[own][0, 1] == 0)  # the side of the block; the other is the ground
            ends[on] = block + pose.shift[0] + ends[on] @ pose.rotation[0].T
            offsets = np.einsum("nij,nj->ni", points.frames[own], ends[1] - ends[0])
            stiffness = points.areas[own, 1:] * rows.stiffness[[0, 1, 1]]
            history[own] = forces[own] + stiffness * offsets
        energies = rows.energies * np.array([0.5, 0.5, 1.0, 1.0, 1.0])
        points = replace(points, forces=forces, history=history)
        return replace(rows, load_factors=factors, energies=energies, points=points)

    return change


def test_a_history_with_balance_kept_is_found_by_following_the_pushover_anew_alone(
    slides: Results, tmp_path: Path
) -> None:
    file = forged(slides, at_half_the_load(slides))
    assert said_of(tmp_path, file) == ""
    says = said_of(tmp_path, file, anew=True)
    assert "differs: push: the pushover followed anew has 5 steps" in says
    assert "load factors of the file are up to 50 % off" in says


@pytest.mark.every(2)
@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ((lambda rows: replace(rows, errors=rows.errors + 0.01), with_energies(1, 0.99)), "its energies, its errors"),
        (
            (lambda rows: replace(rows, errors=np.full(len(rows), np.nan)), with_last("jumps", 1)),
            "its errors, where it jumps",
        ),
    ],
    ids=["errors and energies", "no errors and a jump"],
)
def test_what_only_the_way_knows_is_found_by_following_it_anew(
    changes: tuple[Change, Change], what: str, slides: Results, tmp_path: Path
) -> None:
    one, other = changes
    file = forged(slides, lambda rows: other(one(rows)))
    assert said_of(tmp_path, file) == ""
    assert f"not as in the file: {what}" in said_of(tmp_path, file, anew=True)


def test_what_is_not_confirmed_is_by_following_the_pushover_anew(tmp_path: Path) -> None:
    """A stone that falls off a table that is drawn away, the most of which is gone at first."""
    nearly = TABLE.replace("{group: table, material: stone, min: [0,", "{group: table, material: stone, min: [0.08,")
    text = nearly.replace("amount: 0.12, step: 0.04", "amount: 0.04, step: 0.01")
    (deck := tmp_path / "deck.yaml").write_text(text, encoding="utf-8")
    results = run(deck, RunOptions(force=True))
    assert "blocks that fall without the rest are not verified; the file says: 1" in said_of(tmp_path, results)
    assert said_of(tmp_path, results, anew=True) == ""
