"""Writes the generated tables of schemas/results.md anew: ``python -m tests.results.results_page``.

Each section has an introduction by hand, then what is generated, which begins with the first table or subheading.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from mbla.deck.units import Units
from mbla.results.hdf5.layout import ATTRIBUTES
from mbla.results.quantities.quantity import NOT_VERIFIED, unit_text
from mbla.results.quantities.registry import STORED
from mbla.results.record.keys import RECORD, Key
from mbla.results.tables.tables import tables_page
from mbla.results.vtu.arrays import arrays_table
from mbla.sweeps.interaction.study import INTERACT_RECORD
from mbla.sweeps.tables.sweep_json import SWEEP_RECORD
from mbla.sweeps.tables.sweep_table import AFTER, POINT, STATE

PAGE = Path(__file__).parents[2] / "schemas" / "results.md"

OWN_WORDS = "parameters of the design, in the order of the sweep file, with their angles where they are directions"
RESULT_WORDS = "results, load case by load case: `CASE.` stands before the key path where several are solved"


def attributes_table() -> str:
    """The attributes of the root group as a Markdown table."""
    rows = [f"| `{name}` | {words} |" for name, words in ATTRIBUTES.items()]
    return "\n".join(["| attribute | content |", "|---|---|", *rows]) + "\n"


def layout_table() -> str:
    """The datasets as a Markdown table, as it stands in schemas/results.md; units as in a deck in m, N, kg."""
    lines = ["| dataset | type | dimensions | units | content |", "|---|---|---|---|---|"]
    for field in STORED:
        content = field.words + (f" (part: {field.part})" if field.part else "")
        content += f"; {NOT_VERIFIED.format(field.unverified)}" if field.unverified else ""
        content += f" (verified where it is {' or '.join(field.proved)})" if field.proved else ""
        dims = ", ".join(field.dims) or "–"
        lines.append(f"| `/{field.path}` | {field.kind} | {dims} | {unit_text(field.unit, Units())} | {content} |")
    return "\n".join(lines) + "\n"


def keys_page(keys: Sequence[Key]) -> str:
    """Keys of a record as a Markdown table."""
    rows = [f"| `{path}` | {kind} | {words} |" for path, kind, words in (key.item for key in keys)]
    return "\n".join(["| key | type | meaning |", "|---|---|---|", *rows]) + "\n"


def sweep_columns_page() -> str:
    """The columns of the table of a sweep as a Markdown table."""
    own = [f"| `{column.name}` | {column.kind} | {column.unit or '–'} | {column.words} |" for column in (STATE, *AFTER)]
    return (
        "\n".join(
            [
                "| column | type | unit | content |",
                "|---|---|---|---|",
                f"| `{POINT.name}` | {POINT.kind} | – | {POINT.words} |",
                f"| … | any | of the deck | {OWN_WORDS} |",
                own[0],
                f"| … | any | of the deck | {RESULT_WORDS} |",
                *own[1:],
            ]
        )
        + "\n"
    )


def generated() -> dict[str, str]:
    """What is generated of each section, by its title."""
    return {
        "Root attributes": attributes_table(),
        "Files for ParaView": arrays_table(),
        "Datasets": layout_table(),
        "Exported tables": tables_page(),
        "JSON record": keys_page(RECORD),
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
