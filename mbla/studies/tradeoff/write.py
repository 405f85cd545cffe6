"""The files of a study: all of them appear together, or the earlier ones stay."""

from __future__ import annotations

import json

from mbla.errors import UsageError
from mbla.results.files import OutputFolder
from mbla.results.pictures.page import matplotlib_parts
from mbla.studies.tradeoff.picture import draw_trade
from mbla.studies.tradeoff.records import study_csv, study_json
from mbla.studies.tradeoff.study import Study

PICTURES = ("png", "svg")


def write_study(study: Study, out: OutputFolder) -> list[str]:
    """Write CSV, JSON and pictures to a folder that is open; why there are no pictures, or nothing."""
    stem = out.stem
    out.write_text(f"{stem}.csv", study_csv(study))
    remark = _without_pictures()
    if not remark:
        for trade, advised in zip(study.trades, study.advices, strict=False):
            for ending in PICTURES:
                with out.writing(f"{stem}_{trade.name}.{ending}") as path:
                    draw_trade(path, f"{study.deck}: {study.title}", trade, advised.sentence)
    record = study_json(study, tuple(sorted((*out.names, f"{stem}.json"))))
    out.write_text(f"{stem}.json", json.dumps(record, indent=1, ensure_ascii=False, allow_nan=False) + "\n")
    return [remark] if remark else []


def _without_pictures() -> str:
    try:
        matplotlib_parts()
    except UsageError as error:
        return f"no pictures: {error}"
    return ""
