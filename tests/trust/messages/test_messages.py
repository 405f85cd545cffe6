"""Errors cannot be made without an identifier; each identifier has a test, and an entry.

The sentences are in ``sentences.txt``, and may be mended there: ``pytest --update`` writes those of the cases that run.

The full form brings about every error, deck, sweep file and command alike, and asks ``mbla explain`` for what was
printed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import mbla
from mbla.results.explanations import explanations, find_explanations
from mbla.results.failures import lines_of
from tests import faulty_decks, faulty_sweeps
from tests.faulty_decks import DECKS
from tests.faulty_sweeps import SWEEPS
from tests.trust.counts import record_counts
from tests.trust.messages.cases import CASES
from tests.trust.messages.source import NOT_PRINTED, PRINTED_BY, identifiers, sites

TOLD = Path(__file__).with_name("sentences.txt")
BRACKETED = re.compile(r"  \[([a-z]+(?:-[a-z0-9]+)*)\]$")
LONG = frozenset(
    {
        "result_of_zeros",
        "result_of_an_earlier_layout",
        "nothing_expected",
        "load_case_that_the_deck_lacks",
        "picture_as_a_text",
        "picture_of_an_unknown_kind",
        "pictures_in_one_file",
        "status_of_another_version",
        "machine_without_opengl",
    }
)
"""cases that solve, draw or open much: in the full form only"""


def identifier_of(line: str) -> str:
    """What stands in brackets at the end of a line."""
    found = BRACKETED.search(line)
    assert found, line
    return found[1]


def exercised() -> Iterator[str]:
    """Identifiers of all lines that tests expect."""
    for file in (*DECKS.values(), *SWEEPS.values()):
        yield from map(identifier_of, file.faults)
    yield from (case.identifier for case in CASES.values())


def expected() -> dict[str, list[str]]:
    """The lines of every case, by the name of its function; {folder} is its folder."""
    blocks = [block.splitlines() for block in TOLD.read_text(encoding="utf-8").split("\n\n")]
    return {name: [line[2:] for line in lines] for name, *lines in blocks}


def told(name: str, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> list[str]:
    """The lines that a case brings about, the help of argparse left out."""
    capsys.readouterr()
    try:
        CASES[name].bring(folder, monkeypatch)
    except SystemExit:
        pass
    except Exception as error:
        return [line for lines in lines_of(error) for line in lines.splitlines()]
    return [line for line in capsys.readouterr().err.splitlines() if not line.startswith(("usage:", " "))]


def check_case(
    name: str, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], update: bool
) -> list[str]:
    """The lines of a case, which are those expected."""
    with monkeypatch.context() as patch:
        lines = told(name, folder, patch, capsys)
    found = [line.replace(str(folder), "{folder}").encode("utf-8", "backslashreplace").decode() for line in lines]
    if update:
        texts = sorted({**expected(), name: found}.items())
        blocks = ("\n".join([each, *(f"  {line}" for line in told), ""]) for each, told in texts if each in CASES)
        TOLD.write_text("\n".join(blocks), encoding="utf-8")
    assert found == expected()[name]
    assert identifier_of(lines[-1]) == CASES[name].identifier
    return lines


def test_no_error_is_made_without_an_identifier() -> None:
    made = sites()
    assert len(made) > 400  # the walk finds them
    without = [site for site in made if site.identifier is None and not site.handed_on]
    # a table of messages by the names of pydantic gives their identifiers on
    assert [(site.file, site.line) for site in without] == []
    package = Path(mbla.__file__).parent
    for identifier, file in PRINTED_BY.items():
        assert identifier in (package / file).read_text(encoding="utf-8")


def test_every_identifier_is_explained() -> None:
    assert {name for name in identifiers() if name not in explanations()} == set()


def test_no_error_is_explained_that_cannot_occur() -> None:
    errors = {name for name, entry in explanations().items() if entry.kind in ("error", "error in a deck")}
    told_in_rows = {"point-beyond-limit", "point-given-up"}  # reasons of points of a sweep
    assert errors - told_in_rows <= identifiers()


def test_every_identifier_has_a_test() -> None:
    assert identifiers() - NOT_PRINTED - {"deck-invalid"} - set(exercised()) == set()
    assert CASES.keys() == expected().keys()


@pytest.mark.parametrize("name", [name for name in CASES if name not in LONG])
def test_identifier_and_text(
    name: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    pytestconfig: pytest.Config,
) -> None:
    check_case(name, tmp_path, monkeypatch, capsys, pytestconfig.getoption("--update"))


@pytest.mark.trust
def test_every_error_as_it_is_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], pytestconfig: pytest.Config
) -> None:
    update = pytestconfig.getoption("--update")
    lines: list[str] = []
    for name in CASES:
        folder = tmp_path / name
        folder.mkdir()
        lines.append("\n".join(check_case(name, folder, monkeypatch, capsys, update)))
    for faulty in (faulty_decks, faulty_sweeps):
        assert faulty.sentences() == faulty.SENTENCES.read_text(encoding="utf-8")
    refusals = [*(faulty_decks.refusal_of(path)[1] for path in DECKS), *map(faulty_sweeps.refusal_of, SWEEPS)]
    lines += [fault.line() for error in refusals for fault in error.faults]
    for line in lines:
        assert identifier_of(line) in [entry.identifier for entry in find_explanations(line)], line
    kinds = {identifier_of(line) for line in lines}
    assert kinds == identifiers() - NOT_PRINTED - {"deck-invalid"}
    record_counts(
        "messages",
        80,
        "No error is made without one of the stable identifiers; each identifier has an entry in `mbla explain`, found "
        "by the printed line, and at least one test of its exact text, with its place where it is about a deck or a "
        "sweep file",
        {
            "places in the program that make a message or an error": len(sites()),
            "identifiers": len(kinds),
            "identifiers with an entry": len(kinds & explanations().keys()),
            "printed errors compared with their exact text": len(lines),
        },
    )
