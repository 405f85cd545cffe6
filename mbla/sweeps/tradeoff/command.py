"""``mbla tradeoff``: from its options to the study and its files."""

from __future__ import annotations

from typing import Any

from mbla.deck import Deck
from mbla.results.files import OutputFolder
from mbla.run_options import RunOptions
from mbla.sweeps.measure.study_files import written
from mbla.sweeps.tradeoff.knobs import asked_rungs
from mbla.sweeps.tradeoff.ladder_run import Limits, Report
from mbla.sweeps.tradeoff.records import study_json
from mbla.sweeps.tradeoff.study import Study, file_name, study_deck
from mbla.sweeps.tradeoff.write import write_study


def tradeoff(
    deck: Deck, run: RunOptions, options: Any, report: Report | None
) -> tuple[Study, dict[str, Any], list[str]]:
    """Measure a deck and write the files; the study, its JSON record, and remarks.

    A study that was interrupted is written as far as it came, but never over an earlier one.

    options : ``knob`` and ``setting`` texts, ``wanted_error``, ``time_limit``, ``run_limit`` [s] or None

    Raises as ``study_deck`` does; FileError where files are in the way or cannot be written.
    """
    asked = asked_rungs(options.knob, options.setting)
    limits = Limits(options.time_limit, options.run_limit, run.threads)
    stem = file_name(deck.path)
    out = OutputFolder(run.folder_for(deck.path), stem, run.force, beside=True)
    names = (f"{stem}.csv", f"{stem}.json")
    out.refuse(*names)
    with out:
        study = study_deck(deck, run.overrides, run.cases, asked, options.wanted_error, limits, report)
        remarks = written(out, names, study.interrupted, lambda: write_study(study, out))
    return study, study_json(study, out.names), remarks
