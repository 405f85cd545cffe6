import json
import os
import signal
import subprocess
import sys
import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from mbla.errors import FileError
from mbla.results.disk import PREFIX
from mbla.results.files import OutputFolder, earlier_files


def run(folder: Path, force: bool = False, text: str = "new", extra: Sequence[str] = (), stem: str = "arch") -> None:
    """A whole run that writes STEM.h5, STEM.json, STEM.sta and ``extra``."""
    with OutputFolder(folder, stem, force) as out:
        with out.open_live(f"{stem}.sta") as live:
            live.write(text)
        for name in extra:
            out.write_text(name, text)
        out.write_bytes(f"{stem}.h5", text.encode())
        out.write_text(f"{stem}.json", json.dumps({"files": [*out.names, f"{stem}.json"]}))


def fail(folder: Path, error: type[BaseException]) -> None:
    """A run that breaks off after its last file."""
    with OutputFolder(folder, "arch", force=True) as out:
        out.open_live("arch.sta").write("new")
        out.write_text("arch.h5", "new")
        out.path("arch_x_blocks.vtu")
        raise error


def content(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in sorted(folder.iterdir())}


def temporaries(folder: Path) -> list[str]:
    return [path.name for path in folder.iterdir() if path.name.startswith(PREFIX)]


def test_nothing_is_in_place_before_the_end(tmp_path: Path) -> None:
    with OutputFolder(tmp_path, "arch") as out:
        out.write_text("arch.h5", "x")
        assert not (tmp_path / "arch.h5").exists()
        assert (tmp_path / "arch.h5") not in tmp_path.iterdir()
    assert content(tmp_path) == {"arch.h5": "x"}
    assert out.names == ("arch.h5",)


def test_live_file_grows_under_its_own_name(tmp_path: Path) -> None:
    with OutputFolder(tmp_path, "arch") as out:
        stream = out.open_live("arch.sta")
        stream.write("line 1\n")
        stream.flush()
        assert (tmp_path / "arch.sta").read_text() == "line 1\n"


@pytest.mark.parametrize("suffix", ["h5", "json", "lst", "sta"])
def test_earlier_result_is_refused_and_untouched(tmp_path: Path, suffix: str) -> None:
    earlier = tmp_path / f"arch.{suffix}"
    earlier.write_text("old")
    with pytest.raises(FileError, match="--force") as caught:
        run(tmp_path)
    assert str(earlier) in str(caught.value)
    assert content(tmp_path) == {earlier.name: "old"}


def test_file_of_another_deck_with_the_same_name_is_refused(tmp_path: Path) -> None:
    (tmp_path / "arch_push_blocks.vtu").write_text("of another deck")
    with pytest.raises(FileError, match=r"arch_push_blocks\.vtu"):
        run(tmp_path, extra=["arch_push_blocks.vtu"])
    assert content(tmp_path) == {"arch_push_blocks.vtu": "of another deck"}


def test_stale_files_of_the_earlier_result_go_and_foreign_ones_stay(tmp_path: Path) -> None:
    run(tmp_path, extra=["arch_x_blocks.vtu", "arch_y_blocks.vtu", "arch_y.pvd"])
    (tmp_path / "arch_z_blocks.vtu").write_text("mine")
    (tmp_path / "notes.txt").write_text("mine")
    run(tmp_path, force=True, extra=["arch_x_blocks.vtu"])
    names = set(content(tmp_path))
    assert names == {"arch.h5", "arch.json", "arch.sta", "arch_x_blocks.vtu", "arch_z_blocks.vtu", "notes.txt"}


@pytest.mark.parametrize(
    "listed",
    [["../secret.vtu"], ["/etc/passwd"], ["notes.txt"], ["archive.h5"], ["arch_a/../b.vtu"], "arch.h5", [1, None], {}],
)
def test_list_of_earlier_files_cannot_name_others(tmp_path: Path, listed: Any) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    (tmp_path / "archive.h5").write_text("mine")
    (tmp_path / "arch.json").write_text(json.dumps({"files": listed}))
    assert earlier_files(tmp_path, "arch") == ()


@pytest.mark.parametrize("text", ["", "{", "[]", "{}", '{"files": null}'])
def test_damaged_list_of_earlier_files_is_no_list(tmp_path: Path, text: str) -> None:
    (tmp_path / "arch.json").write_text(text)
    assert earlier_files(tmp_path, "arch") == ()


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt, SystemExit])
def test_failed_run_leaves_the_earlier_result(tmp_path: Path, error: type[BaseException]) -> None:
    run(tmp_path, text="old", extra=["arch_x_blocks.vtu"])
    before = content(tmp_path)
    with pytest.raises(error):
        fail(tmp_path, error)
    assert content(tmp_path) == before


@pytest.mark.parametrize("failing", range(6))
def test_failure_while_putting_in_place_is_undone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failing: int
) -> None:
    run(tmp_path, text="old", extra=["arch_y.pvd"])
    before = content(tmp_path)
    replace, calls = Path.replace, []

    def flaky(self: Path, target: Path) -> Any:
        calls.append(target)
        if len(calls) == failing + 1:
            raise OSError(28, "No space left on device")
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", flaky)
    with pytest.raises(FileError, match="No space left on device"):
        run(tmp_path, force=True, text="new", extra=["arch_x.pvd"])
    monkeypatch.undo()
    assert content(tmp_path) == before


def test_unwritten_file_is_an_error_that_names_it(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"arch\.h5"), OutputFolder(tmp_path, "arch") as out:
        out.path("arch.h5")
    assert content(tmp_path) == {}


def other_writer(out: OutputFolder) -> None:
    """A writer of another stage, with a FileError of its own."""
    with out.writing("arch_x.vtu") as path:
        try:
            raise OSError(28, "No space left on device")
        except OSError as error:
            raise FileError("file-not-written", f"{path}: full") from error


def test_error_of_another_writer_names_the_file_not_the_temporary(tmp_path: Path) -> None:
    with OutputFolder(tmp_path, "arch") as out:
        with pytest.raises(FileError, match=r"arch_x\.vtu: No space left") as caught:
            other_writer(out)
        out._names.clear()
    assert PREFIX not in str(caught.value)


def test_folder_where_a_file_should_be(tmp_path: Path) -> None:
    (tmp_path / "arch.h5").mkdir()
    with pytest.raises(FileError, match="is a folder"):
        run(tmp_path, force=True)


@pytest.mark.parametrize("name", ["a/b.vtu", "../b.vtu", ".mbla-x", ""])
def test_only_plain_names(tmp_path: Path, name: str) -> None:
    with OutputFolder(tmp_path, "arch") as out, pytest.raises(ValueError, match="plain file name"):
        out.path(name)


# --- killed runs --------------------------------------------------------------------------------------------------

KILLED = """
    import os, signal, sys
    from pathlib import Path
    from mbla.results.files import OutputFolder
    replace, calls = Path.replace, []
    def deadly(self, target):
        calls.append(target)
        if len(calls) == int(sys.argv[2]):
            os.kill(os.getpid(), signal.SIGKILL)
        return replace(self, target)
    Path.replace = deadly
    with OutputFolder(Path(sys.argv[1]), "arch", True) as out:
        out.open_live("arch.sta").write("killed")
        out.write_text("arch.h5", "killed")
        out.write_text("arch.lst", "killed")
    os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs a process that can be killed")
@pytest.mark.parametrize("moment", [1, 2, 3, 4, 5])
def test_next_run_restores_what_a_killed_one_left_half_done(tmp_path: Path, moment: int) -> None:
    for suffix in ("sta", "h5", "lst"):
        (tmp_path / f"arch.{suffix}").write_text("old")
    script = textwrap.dedent(KILLED)
    done = subprocess.run([sys.executable, "-c", script, str(tmp_path), str(moment)], check=False)
    assert done.returncode == -signal.SIGKILL
    assert temporaries(tmp_path)
    with pytest.raises(FileError):
        run(tmp_path)
    assert content(tmp_path) == {"arch.sta": "old", "arch.h5": "old", "arch.lst": "old"}


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs a process that can be killed")
def test_complete_result_of_a_killed_process_stays(tmp_path: Path) -> None:
    for suffix in ("sta", "h5", "lst"):
        (tmp_path / f"arch.{suffix}").write_text("old")
    subprocess.run([sys.executable, "-c", textwrap.dedent(KILLED), str(tmp_path), "99"], check=False)
    assert content(tmp_path) == {"arch.sta": "killed", "arch.h5": "killed", "arch.lst": "killed"}


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs a process that can be killed")
@pytest.mark.parametrize("moment", [2, 3])
def test_first_run_that_was_killed_is_in_nobodys_way(tmp_path: Path, moment: int) -> None:
    subprocess.run([sys.executable, "-c", textwrap.dedent(KILLED), str(tmp_path), str(moment)], check=False)
    assert (tmp_path / "arch.sta").exists()
    run(tmp_path)
    assert set(content(tmp_path)) == {"arch.h5", "arch.json", "arch.sta"}


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs a process that can be killed")
def test_a_file_that_replaced_one_of_a_killed_run_stays(tmp_path: Path) -> None:
    subprocess.run([sys.executable, "-c", textwrap.dedent(KILLED), str(tmp_path), "2"], check=False)
    (tmp_path / "mine").write_text("mine")
    (tmp_path / "mine").replace(tmp_path / "arch.sta")
    with pytest.raises(FileError, match="--force"):
        run(tmp_path)
    assert content(tmp_path) == {"arch.sta": "mine"}


# --- what comes between ---------------------------------------------------------------------------------------------


def interrupt_at(monkeypatch: pytest.MonkeyPatch, function: str, call: int) -> None:
    """SIGINT arrives while this method of paths is at work for that many a time."""
    whole, calls = getattr(Path, function), []

    def interrupted(self: Path, *arguments: Any, **options: Any) -> Any:
        done = whole(self, *arguments, **options)
        if self.name.startswith(PREFIX) or PREFIX in str(arguments):
            calls.append(self)
            if len(calls) == call:
                signal.raise_signal(signal.SIGINT)
        return done

    monkeypatch.setattr(Path, function, interrupted)


@pytest.mark.parametrize("call", range(1, 9))
@pytest.mark.parametrize("function", ["replace", "unlink"])
def test_an_interruption_leaves_the_earlier_result_or_the_new_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, function: str, call: int
) -> None:
    run(tmp_path, text="old", extra=["arch_y.pvd"])
    before = content(tmp_path)
    interrupt_at(monkeypatch, function, call)
    try:
        run(tmp_path, force=True, text="new")
    except KeyboardInterrupt:
        monkeypatch.undo()
        now = content(tmp_path)
        assert now == before or (now["arch.h5"], now["arch.sta"], len(now)) == ("new", "new", 3)


def test_earlier_files_that_cannot_be_put_back_wait_for_the_next_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run(tmp_path, text="old")
    before = content(tmp_path)
    replace = Path.replace

    def refused(self: Path, target: Path) -> Any:
        if "-new-arch.h5" in self.name or "-earlier-" in self.name:
            raise OSError(5, "Input/output error")
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", refused)
    with pytest.raises(FileError) as caught:
        run(tmp_path, force=True, text="new")
    monkeypatch.undo()
    assert caught.value.__notes__ == [f"{tmp_path}: is not as it was before; the next run into it puts that right"]
    monkeypatch.setattr("mbla.results.disk._process_exists", lambda _: False)
    with pytest.raises(FileError, match="--force"):
        run(tmp_path)
    assert content(tmp_path) == before


# --- two at once ----------------------------------------------------------------------------------------------------


def test_a_second_run_of_the_same_deck_is_refused(tmp_path: Path) -> None:
    with OutputFolder(tmp_path, "arch") as first:
        first.open_live("arch.sta").write("first")
        with pytest.raises(FileError, match=rf"arch\.h5: process {os.getpid()} on .* is at work on it"):
            run(tmp_path, force=True)
        run(tmp_path, stem="wall")
    assert content(tmp_path)["arch.sta"] == "first"
    assert set(content(tmp_path)) == {"arch.sta", "wall.h5", "wall.json", "wall.sta"}


def test_where_there_are_no_locks_runs_go_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fcntl = pytest.importorskip("fcntl")

    def none(descriptor: int, operation: int) -> None:
        raise OSError(38, "Function not implemented")

    monkeypatch.setattr(fcntl, "flock", none)
    run(tmp_path)
    assert set(content(tmp_path)) == {"arch.h5", "arch.json", "arch.sta"}
