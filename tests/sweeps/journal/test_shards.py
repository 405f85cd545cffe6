"""Shards have every point once between them, and a run without shards counts what any of them finished."""

from __future__ import annotations

from pathlib import Path

from mbla.sweeps.journal import journal_name, journals_in, merged, open_journal
from mbla.sweeps.plan import Task
from tests.sweeps.journal.points import HEADER, as_read, point

POINTS = {point(number)[0].key: point(number) for number in range(1, 21)}
TASKS = [task for task, _ in POINTS.values()]
EXPECTED = {key: as_read(outcome) for key, (_, outcome) in POINTS.items()}


def run(folder: Path, name: str, tasks: tuple[Task, ...], *, resume: bool = False) -> None:
    with open_journal(folder / name, HEADER, resume=resume, force=False) as journal:
        for task in tasks:
            if task.key not in journal.finished:
                journal.add(*POINTS[task.key])


def test_journals_are_found_in_order_and_nothing_else_is(tmp_path: Path) -> None:
    names = ["journal.csv", "journal.2-of-3.csv", "journal.1-of-10.csv", "journal.2-of-10.csv", "journal.10-of-10.csv"]
    for name in (*reversed(names), "journal.csv.bak", ".journal.csv.lock", "journal.0-of-2.csv", "sweep.csv"):
        (tmp_path / name).touch()
    assert [path.name for path in journals_in(tmp_path)] == names
    assert journals_in(tmp_path / "missing") == ()
    assert journal_name(2, 3) == "journal.2-of-3.csv"


def test_what_shards_of_any_number_finished_counts_once(tmp_path: Path) -> None:
    run(tmp_path, journal_name(1, 2), tuple(TASKS[0::2])[:6])
    run(tmp_path, journal_name(3, 5), tuple(TASKS[2::5]), resume=True)
    run(tmp_path, "journal.csv", tuple(TASKS), resume=True)
    assert merged(journals_in(tmp_path), HEADER) == EXPECTED
    rows = [line for path in journals_in(tmp_path) for line in path.read_bytes().splitlines()[2:]]
    assert len(rows) == len(TASKS)  # nothing was solved again
    assert (
        len(merged([tmp_path / "journal.csv"], HEADER)) == len(TASKS) - 6 - 3
    )  # of 3, 8, 13, 18 the first shard had 3


def test_a_torn_row_of_a_shard_is_solved_again_and_its_journal_left_alone(tmp_path: Path) -> None:
    shard = tmp_path / journal_name(1, 1)
    run(tmp_path, shard.name, tuple(TASKS[:3]))
    shard.write_bytes(shard.read_bytes()[:-1])
    before = shard.read_bytes()
    run(tmp_path, "journal.csv", tuple(TASKS[:3]), resume=True)
    assert shard.read_bytes() == before
    assert merged([tmp_path / "journal.csv"], HEADER).keys() == {TASKS[2].key}


def test_to_begin_anew_removes_what_shards_left_and_a_shard_only_its_own(tmp_path: Path) -> None:
    for part in (1, 2):
        run(tmp_path, journal_name(part, 2), tuple(TASKS[part : part + 1]))
    with open_journal(tmp_path / journal_name(1, 2), HEADER, resume=False, force=True) as journal:
        assert journal.finished == {}
    assert len(merged(journals_in(tmp_path), HEADER)) == 1
    with open_journal(tmp_path / "journal.csv", HEADER, resume=False, force=True) as journal:
        assert journal.finished == {}
    assert [path.name for path in journals_in(tmp_path)] == ["journal.csv"]
