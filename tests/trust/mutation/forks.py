"""A pytest plugin that runs the body of each test once with the right program, then once for each mutant it reaches."""

from __future__ import annotations

import contextlib
import gc
import os
import resource
import select
import shutil
import signal
import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

from tests.trust.mutation.mutants import Mutant
from tests.trust.mutation.swapping import Swapper, wrong_codes

PASSED, FAILED, NOT_SWAPPED = 0, 1, 2


class Forks:
    """Which mutants live, and which a test noticed.

    longest : CPU seconds of a test with the right program, traced, beyond which it is left out

    Pytest runs twice, quick tests first: what they notice costs little, and most is noticed by one of them.
    """

    QUICK = 0.3
    """CPU seconds of a quick test"""

    PATIENCE = 10.0
    """CPU seconds of tests that do not notice a mutant, after which it counts as a survivor"""

    def __init__(self, mutants: Iterable[Mutant], longest: float) -> None:
        self.alive = list(mutants)
        self.killed: dict[Mutant, str] = {}
        self.reached: set[Mutant] = set()
        self.left_out: list[str] = []
        self.files = {str(mutant.path) for mutant in self.alive}
        self.longest = longest
        self.last_turn = False
        self.done: set[str] = set()
        self.spent: dict[Mutant, float] = {}
        self.swapper: Swapper | None = None

    def pytest_sessionstart(self) -> None:
        """Random examples that are the same each time, and kept nowhere."""
        from hypothesis import settings  # here: pytest wants to import it itself

        settings.register_profile("mutation", database=None, derandomize=True, deadline=None)
        settings.load_profile("mutation")

    @pytest.hookimpl(tryfirst=True)
    def pytest_pyfunc_call(self, pyfuncitem: pytest.Function) -> bool:
        """The body of a test, its fixtures made: in forked processes only."""
        test = pyfuncitem.nodeid
        if test in self.done or not self.alive:
            return True
        names = pyfuncitem._fixtureinfo.argnames
        arguments: dict[str, Any] = {name: pyfuncitem.funcargs[name] for name in names}
        folder = Folder(arguments.get("tmp_path"))
        body = lambda: pyfuncitem.obj(**arguments)  # noqa: E731
        lines: set[tuple[str, int]] = set()
        begun = _processor()
        passed = self._right(body, lines) and folder.restored()
        spent = _processor() - begun
        if not self.last_turn and not (passed and spent <= self.QUICK):
            return True
        self.done.add(test)
        if passed:
            reached = [one for one in self.alive if any((str(one.path), line) in lines for line in one.lines)]
            files = {file for file, _ in lines}
            reached += [one for one in self.alive if one.named and str(one.path) in files]
            self.reached.update(reached)
            reached = [one for one in reached if self.spent.get(one, 0.0) < self.PATIENCE]
            if spent <= self.longest:
                self._mutants(test, body, reached, folder, spent)
            elif reached:
                self.left_out.append(test)
        else:
            self.left_out.append(test)
        return True

    def _right(self, body: Callable[[], object], lines: set[tuple[str, int]]) -> bool:
        """Whether the right program passes; the lines it ran."""
        read, write = os.pipe()

        def traced() -> int:
            ran: set[tuple[str, int]] = set()
            sys.settrace(_tracer(self.files, ran))
            try:
                body()
            finally:
                sys.settrace(None)
            with os.fdopen(write, "w", encoding="utf-8") as pipe:
                pipe.writelines(f"{line}\t{file}\n" for file, line in ran)
            return PASSED

        status, said = _forked(traced, 600.0, read, write, cpu=0.0 if self.last_turn else 2.0 * self.QUICK)
        lines.update((file, int(line)) for line, file in (text.split("\t") for text in said.splitlines()))
        return status == PASSED

    def _mutants(
        self, test: str, body: Callable[[], object], reached: list[Mutant], folder: Folder, spent: float
    ) -> None:
        if not reached:
            return
        if self.swapper is None:
            self.swapper = Swapper(self.files)
            gc.freeze()  # pages that the forked processes need not copy; what is frozen is no longer found
        swapper, noticed = self.swapper, []

        def wrong(mutant: Mutant) -> int:
            if not swapper.put(mutant):
                return NOT_SWAPPED
            body()
            return PASSED

        limit = 30.0 + 20.0 * spent
        for mutant in reached:
            wrong_codes(mutant)  # compiled here, once for all tests
            begun = _processor()
            status, _ = _forked(lambda mutant=mutant: wrong(mutant), limit, cpu=2.0 + 3.0 * spent)  # type: ignore[misc]
            self.spent[mutant] = self.spent.get(mutant, 0.0) + _processor() - begun
            if folder.restored() and status not in (PASSED, NOT_SWAPPED):
                noticed.append(mutant)
        if not noticed:
            return
        status, _ = _forked(lambda: (body(), PASSED)[1], limit)
        if folder.restored() and status == PASSED:
            self.killed.update(dict.fromkeys(noticed, test))
            self.alive = [mutant for mutant in self.alive if mutant not in self.killed]
        else:
            self.left_out.append(test)


class Folder:
    """The folder of a test as its fixtures left it, before each run of its body."""

    def __init__(self, path: Path | None) -> None:
        self.path = path
        self.kept = None
        if path is not None:
            self.kept = path.with_name(path.name + ".kept")
            shutil.rmtree(self.kept, ignore_errors=True)
            shutil.copytree(path, self.kept, symlinks=True)

    def restored(self) -> bool:
        """Always true: said for the sake of conditions."""
        if self.path is not None and self.kept is not None:
            shutil.rmtree(self.path, ignore_errors=True)
            shutil.copytree(self.kept, self.path, symlinks=True)
        return True


def _processor() -> float:
    """Seconds of user time that processes forked here took, those that have ended."""
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def _tracer(files: set[str], ran: set[tuple[str, int]]) -> Callable[[FrameType, str, Any], Any]:
    def local(frame: FrameType, event: str, _: Any) -> Any:
        ran.add((frame.f_code.co_filename, frame.f_lineno))
        return local

    def new(frame: FrameType, event: str, _: Any) -> Any:
        return local(frame, event, None) if frame.f_code.co_filename in files else None

    return new


def _forked(
    work: Callable[[], int], limit: float, read: int | None = None, write: int | None = None, cpu: float = 0.0
) -> tuple[int, str]:
    """Exit status of a forked process that does the work, and what it wrote; negative where it had to be ended."""
    child = os.fork()
    if child == 0:
        status = FAILED
        with contextlib.suppress(BaseException):
            nowhere = os.open(os.devnull, os.O_RDWR)
            for stream in (0, 1, 2):
                os.dup2(nowhere, stream)
            if cpu:
                signal.signal(signal.SIGPROF, signal.SIG_DFL)
                signal.setitimer(signal.ITIMER_PROF, cpu)
            gc.disable()
            status = work()
        os._exit(status)
    if write is not None:
        os.close(write)
    end, said = time.monotonic() + limit, b""
    ending = os.pidfd_open(child)
    while True:
        watched = [ending] if read is None else [ending, read]
        ready, _, _ = select.select(watched, [], [], max(end - time.monotonic(), 0.0))
        if read is not None and read in ready:
            piece = os.read(read, 1 << 20)
            said += piece
            if piece:
                continue
            os.close(read)
            read = None
        elif ending in ready:
            break
        elif not ready:
            os.kill(child, signal.SIGKILL)
            break
    if read is not None:
        os.close(read)
    os.close(ending)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), said.decode("utf-8")
