from __future__ import annotations

from pathlib import Path

import pytest

from mbla.errors import FileError, UsageError
from mbla.results.disk import write_whole, writing_whole
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.plot import plot_results
from tests.results.synthetic import tower_results


def test_a_file_is_written_with_its_folders(tmp_path: Path) -> None:
    write_whole(tmp_path / "a" / "b" / "c.txt", b"whole")
    assert (tmp_path / "a" / "b" / "c.txt").read_bytes() == b"whole"
    assert [path.name for path in (tmp_path / "a" / "b").iterdir()] == ["c.txt"]


def test_the_temporary_name_has_the_suffix(tmp_path: Path) -> None:
    with writing_whole(tmp_path / "c.svg") as temporary:
        assert temporary.suffix == ".svg"
        assert temporary.parent == tmp_path
        temporary.touch()


def fail_half_way(path: Path, error: BaseException) -> None:
    with writing_whole(path) as temporary:
        temporary.write_text("half")
        raise error


@pytest.mark.parametrize(
    "error", [KeyboardInterrupt(), UsageError("extra-missing", ""), ValueError()], ids=lambda error: repr(error)
)
def test_a_failure_leaves_the_earlier_file(tmp_path: Path, error: BaseException) -> None:
    (tmp_path / "c.txt").write_text("earlier")
    with pytest.raises(type(error)):
        fail_half_way(tmp_path / "c.txt", error)
    assert [path.name for path in tmp_path.iterdir()] == ["c.txt"]
    assert (tmp_path / "c.txt").read_text() == "earlier"


def test_a_failure_removes_the_folders_that_it_made(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt):
        fail_half_way(tmp_path / "a" / "b" / "c.txt", KeyboardInterrupt())
    assert not list(tmp_path.iterdir())


def write_where_nothing_can_be(path: Path) -> None:
    with writing_whole(path) as temporary:
        try:
            (temporary / "no").touch()
        except OSError as error:
            raise FileError("file-not-written", f"{temporary}: {error.strerror}") from error


def test_errors_name_the_file_and_not_the_temporary_one(tmp_path: Path) -> None:
    path = tmp_path / "c.txt"
    with pytest.raises(FileError) as raised:
        write_where_nothing_can_be(path)
    assert str(raised.value) == f"{path}: No such file or directory"


def test_a_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="is a folder"):
        write_whole(tmp_path, b"")


def test_pictures_that_cannot_be_drawn_leave_no_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def missing() -> None:
        raise UsageError("extra-missing", "pictures need an extra that is not installed")

    monkeypatch.setattr("mbla.results.pictures.page.matplotlib_parts", missing)
    with pytest.raises(UsageError, match="extra"):
        plot_results(tower_results(), tmp_path / "pictures", "tower", PictureOptions())
    assert not list(tmp_path.iterdir())
