"""Writes the generated tables of schemas/results.md anew: ``python -m tests.results.results_page``.

Each section has an introduction by hand, then what is generated, which begins with the first table or subheading.
"""

from __future__ import annotations

import re
from pathlib import Path

from mbla.results.hdf5.layout import layout_table
from mbla.results.record.keys import record_page
from mbla.results.tables.tables import tables_page
from mbla.results.vtu.arrays import arrays_table
from mbla.sweeps.interaction.study import INTERACT_RECORD
from mbla.sweeps.tables.sweep_json import SWEEP_RECORD, keys_page, sweep_columns_page

PAGE = Path(__file__).parents[2] / "schemas" / "results.md"


def generated() -> dict[str, str]:
    """What is generated of each section, by its title."""
    return {
        "Files for ParaView": arrays_table(),
        "Datasets": layout_table(),
        "Exported tables": tables_page(),
        "JSON record": record_page(),
        "Table of a sweep": sweep_columns_page(),
        "JSON record of a sweep": keys_page(SWEEP_RECORD),
        "JSON record of a diagram": keys_page(INTERACT_RECORD),
    }


def renewed(page: str) -> str:
    """The page with its generated parts as the program gives them."""
    sections = re.split(r"(?m)^(?=## )", page)
    for title, body in generated().items():
        row = next(i for i, section in enumerate(sections) if section.startswith(f"## {title}\n"))
        begin = re.search(r"(?m)^(\||###)", sections[row])
        introduction = sections[row] if begin is None else sections[row][: begin.start()]
        sections[row] = introduction.rstrip("\n") + "\n\n" + body.strip("\n") + "\n\n"
    return "".join(sections).rstrip("\n") + "\n"


if __name__ == "__main__":
    PAGE.write_text(renewed(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
