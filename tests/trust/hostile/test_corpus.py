"""Every file that fuzzing found to break the program is answered as it should be; a new find is a file in ``corpus/``.

Files are named by what was wrong with the program's answer, and end in their kind: ``.deck``, ``.sweep``, ``.obj``, ...
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.trust.hostile import subject

CORPUS = sorted((Path(__file__).parent / "corpus").iterdir())


@pytest.mark.parametrize("path", CORPUS, ids=lambda path: path.name)
def test_a_file_that_broke_the_program_once(path: Path, tmp_path: Path) -> None:
    subject.prepare_folder(tmp_path)
    assert subject.give(path.suffix[1:], path.read_bytes(), tmp_path) in ("DeckError", "accepted")
