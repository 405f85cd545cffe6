import io
from dataclasses import replace
from pathlib import Path

import pytest

from mbla.errors import FileError
from mbla.results.status_file import HEADER, HISTORY_HEADER, StatusFile, history_line, status_line
from mbla.solution.solution import IterationRecord
from mbla.solution.time_history.progress import TimeProgress

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


def test_steps_in_time_have_columns_of_their_own(tmp_path: Path) -> None:
    step = TimeProgress(1.25, 25.0, 625, 1250, 3e-5, 2e-14, 36, 4, 1, 12.3456)
    names = dict(zip(HISTORY_HEADER.removeprefix("#").split(), history_line("quake", step).split(), strict=True))
    assert names == {
        "case": "quake",
        "time": "1.250000",
        "step": "625",
        "newton": "1250",
        "residual": "3.00e-05",
        "balance": "2.00e-14",
        "pressing": "36",
        "halved": "4",
        "missed": "1",
        "seconds": "12.346",
    }
    path = tmp_path / "arch.sta"
    with path.open("w", encoding="utf-8") as stream:
        status = StatusFile(stream, "arch.yaml")
        for each in (step, step, replace(step, half=True)):
            status.add("quake", each)
    lines = path.read_text(encoding="utf-8").splitlines()[2:]
    assert [line.split()[0] for line in lines] == ["#", "quake", "quake", "#", "quake/half"]


def test_full_disk_is_a_file_error() -> None:
    class Full(io.StringIO):
        name = "arch.sta"

        def write(self, text: str) -> int:
            raise OSError(28, "No space left on device")

    with pytest.raises(FileError, match=r"arch\.sta: No space left"):
        StatusFile(Full(), "arch.yaml")
