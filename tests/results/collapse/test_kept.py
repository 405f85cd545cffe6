from dataclasses import dataclass

from mbla.results.collapse.collapse import kept


@dataclass(frozen=True)
class Record:
    value: int


def test_found_once_for_the_same_records_and_anew_for_others() -> None:
    calls = []

    @kept
    def doubled(record: Record, times: int) -> int:
        calls.append(times)
        return times * record.value

    one, equal = Record(3), Record(3)
    assert [doubled(one, 2), doubled(one, 2), doubled(one, 4), doubled(equal, 2)] == [6, 6, 12, 6]
    assert calls == [2, 4, 2]


def test_nothing_is_kept_of_records_that_are_gone() -> None:
    """Their identities are given to others, whose results would be wrong."""

    @kept
    def value(record: Record) -> int:
        return record.value

    found = []
    for number in range(100):
        found.append(value(Record(number)))
    assert found == list(range(100))


def test_by_name_it_is_found_every_time() -> None:
    """Only arguments by position are known again."""
    calls = []

    @kept
    def doubled(record: Record, times: int) -> int:
        calls.append(times)
        return times * record.value

    one = Record(3)
    assert [doubled(one, times=2), doubled(one, times=2)] == [6, 6]
    assert calls == [2, 2]
