"""The files of a study: all of them appear together, or the earlier ones stay."""

from __future__ import annotations

from mbla.results.files import OutputFolder
from mbla.sweeps.measure.study_files import PICTURES, record_text, without_pictures
from mbla.sweeps.tradeoff.picture import draw_trade
from mbla.sweeps.tradeoff.records import study_csv, study_json
from mbla.sweeps.tradeoff.study import Study


def write_study(study: Study, out: OutputFolder) -> list[str]:
    """Write CSV, JSON and pictures to a folder that is open; why there are no pictures, or nothing."""
    stem = out.stem
    out.write_text(f"{stem}.csv", study_csv(study))
    remark = without_pictures()
    if not remark:
        for trade, advised in zip(study.trades, study.advices, strict=False):
            for ending in PICTURES:
                with out.writing(f"{stem}_{trade.name}.{ending}") as path:
                    draw_trade(path, f"{study.deck}: {study.title}", trade, advised.sentence)
    record = study_json(study, tuple(sorted((*out.names, f"{stem}.json"))))
    out.write_text(f"{stem}.json", record_text(record))
    return [remark] if remark else []
