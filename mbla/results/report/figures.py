"""The pictures of a report (its one door to the pictures): drawn to files in a passing folder, embedded as data."""

from __future__ import annotations

import base64
import tempfile
from dataclasses import dataclass
from pathlib import Path

from mbla.errors import UsageError
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult, Results
from mbla.results.words.verdict_words import verdict


@dataclass(frozen=True)
class Figure:
    """A picture with its caption and what it shows in words; ``source`` is a data URI."""

    source: str
    caption: str
    words: str


@dataclass(frozen=True)
class Figures:
    """The pictures of a case, or why there are none."""

    pictures: tuple[Figure, ...]
    missing: str = ""


def case_figures(results: Results, case: CaseResult) -> Figures:
    """Pictures of a case; where the extra or the machine's OpenGL is missing, the reason instead, to be shown."""
    from mbla.results.pictures.options import PictureOptions
    from mbla.results.pictures.plot import plot_results

    name = case.load_case.name
    words = f"The structure in load case {name}: {verdict(results.model.of_case(case.load_case), case)}"
    pictures: list[Figure] = []
    with tempfile.TemporaryDirectory(prefix="mbla-report-") as folder:
        try:
            paths = plot_results(results, Path(folder), "picture", PictureOptions(kinds=("mechanism",), case=name))
        except UsageError as error:
            return Figures((), str(error))
        pictures += [Figure(_data_uri(path), f"{_subject(case)} of load case {name}", words) for path in paths]
    return Figures(tuple(pictures))


def _subject(case: CaseResult) -> str:
    """What a picture of a case shows: a mechanism only where it is one of a known load."""
    if result_of(case) is not None:
        return "Mechanism"
    if case.solution.mechanics is not None:
        return "Best iterate, no result,"
    return "Motion that shows the lack of equilibrium" if case.solution.certificate is not None else "Structure at rest"


def _data_uri(path: Path) -> str:
    kinds = {".png": "image/png", ".svg": "image/svg+xml"}
    return f"data:{kinds[path.suffix]};base64,{base64.b64encode(path.read_bytes()).decode('ascii')}"
