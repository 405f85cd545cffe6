import io
from pathlib import Path

import pytest

from mbla.errors import FileError
from mbla.results.status_file import HEADER, StatusFile, status_line
from mbla.solution.solution import IterationRecord

RECORD = IterationRecord(3, 17, 0.14534567, 1.25e-7, 2e-9, 3e-10, 0.99, 1.2345)


def test_columns_stand_under_their_names() -> None:
    line = status_line("push_x", RECORD)
    names = dict(zip(HEADER.split(), line.split(), strict=True))
    assert names == {
        "case": "push_x",
        "program": "3",
        "iteration": "17",
        "load_factor": "1.45345670e-01",
        "gap": "1.25e-07",
        "primal": "2.00e-09",
        "dual": "3.00e-10",
        "step": "9.9e-01",
        "seconds": "1.234",
    }
    assert len(line) == len(HEADER)


def test_every_line_is_flushed(tmp_path: Path) -> None:
    path = tmp_path / "arch.sta"
    with path.open("w", encoding="utf-8") as stream:
        status = StatusFile(stream, "arch.yaml")
        status.add("push_x", RECORD)
        lines = path.read_text().splitlines()
        assert lines[1:] == [HEADER, status_line("push_x", RECORD)]
        status.remark("push_x: solved\nat last")
        assert path.read_text().splitlines()[-1] == "# push_x: solved at last"


def test_full_disk_is_a_file_error() -> None:
    class Full(io.StringIO):
        name = "arch.sta"

        def write(self, text: str) -> int:
            raise OSError(28, "No space left on device")

    with pytest.raises(FileError, match=r"arch\.sta: No space left"):
        StatusFile(Full(), "arch.yaml")
