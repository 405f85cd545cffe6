"""Files changed at random are refused in clear words, or are models; nothing else happens.

What was found to break the program once is kept in ``corpus/``, a file each, named by what was wrong with the answer;
it ends in its kind: ``.deck``, ``.sweep``, ``.obj``, ...
"""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.faulty_decks import FOLDER as FAULTY_DECKS
from tests.trust.counts import record_counts
from tests.trust.hostile import subject
from tests.trust.hostile.samples import seeds, small_files

FILES = 100_000
"""that the full check gives"""
CORPUS = sorted((Path(__file__).parent / "corpus").iterdir())
SEEDS = seeds()
DECKS = [seed for seed in SEEDS if seed[0] == "deck"]
REFUSED = set(small_files(FAULTY_DECKS))
VALID = [seed for seed in DECKS if seed[1] not in REFUSED]
SWEEPS = [seed for seed in SEEDS if seed[0] == "sweep"]
GEOMETRY = [seed for seed in SEEDS if seed[0] not in ("deck", "sweep")]
FAMILIES = (VALID, DECKS, SWEEPS, GEOMETRY)
"""what a file is made of: half of them are decks, and half of these are valid before they are changed"""


PIECES = (
    *(b"", b"\0", b"\xff", b"\n", b"\n  ", b" ", b": ", b"- ", b", ", b"[", b"]", b"{", b"}", b'"', b"'", b"#", b"&a "),
    *(b"*a", b"-1", b"0", b"1e308", b"1e309", b"1e-320", b"nan", b".inf", b"9" * 30, b"2147483648", b"4294967295"),
    *(b"~", b"true", b"=1/0", b"=9**9**9", b"../x", b"x" * 2000, b"[" * 200, b"mbla: 1\n", b"<", b"\0\0\x80\x7f"),
)
"""what is put into a file beside parts of its own"""
LENGTHS = (0, 1, 4, 30, 300)
"""of the part of a file that goes, or is repeated"""
WORD = re.compile(rb"[^\s,\[\]{}:<>\"]+")


@st.composite
def files(draw: st.DrawFn) -> tuple[str, bytes]:
    """Kind and content of a file changed up to five times: a word or another part of it gives way to something else."""
    kind, content = draw(st.sampled_from(draw(st.sampled_from(FAMILIES))))
    for _ in range(draw(st.integers(1, 5))):
        spans = [word.span() for word in WORD.finditer(content)] if draw(st.booleans()) else []
        spans = spans or [(at, at + draw(st.sampled_from(LENGTHS))) for at in (draw(st.integers(0, len(content))),)]
        begin, end = draw(st.sampled_from(spans))
        other = draw(st.integers(0, len(content)))
        own = content[other : other + draw(st.sampled_from(LENGTHS))]
        content = content[:begin] + draw(st.sampled_from((own, *PIECES))) + content[end:]
    return kind, content


def check_files(folder: Path, number: int) -> Counter[str]:
    """How so many changed files ended; what breaks the program is shrunk and told."""
    subject.prepare_folder(folder)
    ended: Counter[str] = Counter()

    @settings(
        max_examples=number, deadline=None, database=None, derandomize=True, suppress_health_check=list(HealthCheck)
    )
    @given(file=files())
    def is_answered(file: tuple[str, bytes]) -> None:
        ended[subject.give(*file, folder)] += 1

    is_answered()
    return ended


@pytest.mark.parametrize("path", CORPUS, ids=lambda path: path.name)
def test_a_file_that_broke_the_program_once(path: Path, tmp_path: Path) -> None:
    subject.prepare_folder(tmp_path)
    assert subject.give(path.suffix[1:], path.read_bytes(), tmp_path) in ("DeckError", "accepted")


def test_some_changed_files(tmp_path: Path) -> None:
    assert set(check_files(tmp_path, 40)) == {"DeckError", "accepted"}


def test_a_program_that_breaks_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*arguments: object) -> None:
        raise KeyError("stone")

    monkeypatch.setattr(subject, "read_deck", broken)
    with pytest.raises(KeyError, match="stone"):
        check_files(tmp_path, 40)


@pytest.mark.trust
def test_many_changed_files(tmp_path: Path) -> None:
    ended = check_files(tmp_path, FILES)
    record_counts(
        "hostile-fuzzing",
        32,
        "Decks, sweep files and geometry files changed at random are refused in one line per fault or read as models: "
        "no crash, no internal error, none takes more than 5 seconds of processor time",
        {"files changed at random": ended.total(), "of these taken as models": ended["accepted"]},
    )
