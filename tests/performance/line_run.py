"""One ``mbla run`` in a process of its own, seconds of the processor by stage; prints one JSON object.

::

    python tests/performance/line_run.py DECK [options of mbla run]

A run that leaves no results prints nothing and ends with the exit status of the command. Needs nothing but the
standard library and the mbla that is imported, so that it measures another checkout as well: ``PYTHONPATH=CHECKOUT``.

The clock that mbla reads for its own records is exchanged for one that counts the seconds of the processor and stands
still while modules are imported; what takes time outside these records is timed from here.
"""

from __future__ import annotations

import builtins
import contextlib
import importlib
import json
import resource
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

STARTED_PROCESSOR = time.process_time()

PARTS = ("assemble", "programs", "repair", "standing", "verify")
"""Parts of the stage ``solve`` that the results name; ``between`` is what is left of it."""


class Clock:
    """Seconds of the processor without those spent on imports."""

    def __init__(self) -> None:
        self.imports = STARTED_PROCESSOR  # the interpreter itself
        self._depth = 0
        self._import = builtins.__import__

    def __call__(self) -> float:
        return time.process_time() - self.imports

    def importing(self, *arguments: Any, **keywords: Any) -> Any:
        """``__import__``; only the outermost one is timed."""
        if self._depth:
            return self._import(*arguments, **keywords)
        self._depth, begin = 1, time.process_time()
        try:
            return self._import(*arguments, **keywords)
        finally:
            self._depth = 0
            self.imports += time.process_time() - begin


CLOCK = Clock()


class Line:
    """What is timed from outside, and the results."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self.results: Any = None

    def around(self, owner: Any, name: str, stage: str) -> None:
        """Time a function or a method wherever ``owner`` calls it."""
        function: Callable[..., Any] = getattr(owner, name)

        def measured(*arguments: Any, **keywords: Any) -> Any:
            with self._stage(stage):
                return function(*arguments, **keywords)

        setattr(owner, name, measured)

    @contextlib.contextmanager
    def _stage(self, stage: str) -> Iterator[None]:
        begin = CLOCK()
        try:
            yield
        finally:
            self.seconds[stage] = self.seconds.get(stage, 0.0) + CLOCK() - begin

    def keep(self, owner: Any, name: str) -> None:
        """Keep what a function returns: the results."""
        function: Callable[..., Any] = getattr(owner, name)

        def kept(*arguments: Any, **keywords: Any) -> Any:
            self.results = function(*arguments, **keywords)
            return self.results

        setattr(owner, name, kept)


def measured(arguments: list[str]) -> dict[str, Any]:
    """Run the command and say where its time went."""
    builtins.__import__ = CLOCK.importing
    time.perf_counter = CLOCK
    clock = time.monotonic()
    line = Line()

    import mbla.results.write as written
    from mbla.cli import main
    from mbla.results.files import OutputFolder

    run_deck = importlib.import_module("mbla.run")  # the name in the package is the function
    line.around(written, "listing", "listing")
    line.around(written, "write_results_hdf5", "hdf5")
    line.around(written, "results_json", "json")
    line.around(OutputFolder, "__exit__", "place")
    line.keep(run_deck, "write_results")
    code = main(["run", *arguments, "-q"])
    if line.results is None:  # interrupted, or refused: said by the command itself
        raise SystemExit(code)
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return {
        "exit_code": code,
        "clock": time.monotonic() - clock + STARTED_PROCESSOR,
        "processor": usage.ru_utime + usage.ru_stime,
        "peak_mb": usage.ru_maxrss / 1024,
    } | _of_results(line)


def _of_results(line: Line) -> dict[str, Any]:
    results, seconds = line.results, dict(line.seconds)
    spent = results.time
    cases = results.cases
    programs = [program for case in cases for program in case.solution.programs]
    parts = {part: spent.get(f"solve/{part}", 0.0) for part in PARTS}
    parts["programs"] = sum(program.seconds for program in programs)
    failure = spent.get("write/failure", 0.0)
    stages = {
        "import": CLOCK.imports,
        "read": spent["read"],
        "contacts": spent["contacts"],
        **parts,
        "between": spent["solve"] - sum(parts.values()),
        "failure": failure,
        "vtu": spent["write"] - failure,
        **{stage: seconds.get(stage, 0.0) for stage in ("listing", "hdf5", "json", "place")},
    }
    return {
        "blocks": len(results.model.blocks),
        "points": len(results.contacts.points),
        "status": " ".join(case.status.value for case in cases),
        "load_factors": [
            None if case.solution.mechanics is None else case.solution.mechanics.load_factor for case in cases
        ],
        "least_forces": sum(program.seconds for program in programs if program.kind == "least forces"),
        "iterations": sum(program.iterations for program in programs),
        "stages": stages,
    }


if __name__ == "__main__":
    sys.stdout.write(json.dumps(measured(sys.argv[1:])) + "\n")  # to whoever started it
