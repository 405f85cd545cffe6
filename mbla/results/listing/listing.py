"""The listing: what was asked, what the model is, what was found; ``mbla show`` prints it from the .h5 alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from mbla.results.hdf5.content import as_told
from mbla.results.listing.answers import series_lines, worst_words
from mbla.results.listing.case_words import case_lines
from mbla.results.listing.contact_words import contact_lines
from mbla.results.listing.figure_words import figures
from mbla.results.listing.model_words import (
    header_lines,
    model_lines,
    notice_lines,
    settings_lines,
)
from mbla.results.listing.summary import warning_lines
from mbla.results.listing.text import counted, entry, heading, number, sentence
from mbla.results.listing.verdict_words import verdict
from mbla.results.outcome import unproved_words
from mbla.results.results import Results
from mbla.results.series import series_of, told_cases

ANOTHER_POSITION = (
    "Of these positions the worst has a section of its own above, and so have those without a result; "
    "mbla report {}.h5 --case {} tells another, output: {{positions: all}} in the deck tells all."
)


def listing(results: Results, *, every_position: bool = False) -> str:
    """The whole listing, at most 100 columns wide, with a newline at its end.

    every_position : sections of every position of a travelling load, not only of the worst
    """
    lines = [
        *header_lines(results),
        *settings_lines(results),
        *model_lines(results.model),
        *contact_lines(results.model, results.contacts),
        *notice_lines(results.notices),
    ]
    told = results.cases if every_position else told_cases(results.cases)
    for case in told:
        lines += case_lines(results.model, results.contacts, case)
    for series in series_of(results.cases):
        lines += series_lines(results.model, series)
        if len(told) < len(results.cases):
            lines += sentence(ANOTHER_POSITION.format(Path(results.deck.name).stem, series.cases[0].load_case.name))
    lines += _recap(results)
    return "\n".join(line.rstrip() for line in lines) + "\n"


def verification_lines(results: Results, disagreements: Sequence[str]) -> list[str]:
    """What ``mbla verify`` prints: figures recomputed for every case, and where the file says otherwise."""
    lines = [f"{results.deck.name}: recomputed from the file alone, no solver"]
    for case in results.cases:
        lines += heading(f"Load case {case.load_case.name}") + figures(results.model, case)
    lines += heading("Summary")
    lines += [line for case in results.cases for line in entry(case.load_case.name, verdict(results.model, case))]
    lines += sentence(f"not verified, but as the run told it: {'; '.join(as_told(results))}")
    lines += [line for text in unproved_words(results.cases) for line in sentence(text)]
    lines += [line for text in disagreements for line in sentence(f"differs: {text}")]
    of_file = [notice.message for notice in results.notices if notice.identifier == "run-stopped"]
    lines += [line for text in of_file for line in sentence(text)]
    if not disagreements:
        lines += sentence("all else in the file agrees with what was recomputed")
    return lines


def _recap(results: Results) -> list[str]:
    lines = heading("Summary")
    for case in told_cases(results.cases):
        lines += entry(case.load_case.name, verdict(results.model, case))
    lines += [line for series in series_of(results.cases) for line in sentence(worst_words(results.model, series))]
    left_out = len(results.model.load_cases) - len(results.cases)
    if left_out:
        lines += sentence(f"{counted(left_out, 'load case')} of the deck not run")
    lines += warning_lines(results)
    seconds = _seconds(results.time)
    return lines + sentence(f"exit status {results.exit_code}" + (f"; {seconds}" if seconds else ""))


def _seconds(time: Mapping[str, float]) -> str:
    """Of every stage, and in brackets of its parts."""
    said = {stage: f"{stage.split('/')[-1]} {number(round(value, 3))} s" for stage, value in time.items()}
    parts = {stage: [said[part] for part in said if part.startswith(f"{stage}/")] for stage in said}
    whole = [stage for stage in said if "/" not in stage]
    return ", ".join(said[stage] + (f" ({', '.join(parts[stage])})" if parts[stage] else "") for stage in whole)
