"""The files of a diagram: all of them appear together, or the earlier ones stay."""

from __future__ import annotations

from mbla.results.files import OutputFolder
from mbla.sweeps.interaction.picture import draw_study
from mbla.sweeps.interaction.records import study_csv, study_json
from mbla.sweeps.interaction.study import Study
from mbla.sweeps.measure.study_files import PICTURES, record_text, without_pictures


def write_study(study: Study, out: OutputFolder) -> list[str]:
    """Write CSV, JSON and the diagram to a folder that is open; why there is no diagram, or nothing."""
    out.write_text(f"{out.stem}.csv", study_csv(study))
    remark = without_pictures()
    for ending in () if remark else PICTURES:
        with out.writing(f"{out.stem}.{ending}") as path:
            draw_study(path, study)
    record = study_json(study, tuple(sorted((*out.names, f"{out.stem}.json"))))
    out.write_text(f"{out.stem}.json", record_text(record))
    return [remark] if remark else []
