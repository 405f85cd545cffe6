"""Writes the generated tables of schemas/results.md anew: ``python -m tests.results.results_page``.

Each section has an introduction by hand, then what is generated, which begins with the first table or subheading.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from mbla.deck.units import Units
from mbla.results.hdf5.layout import ATTRIBUTES
from mbla.results.quantities.quantity import NOT_VERIFIED, Quantity, unit_text
from mbla.results.quantities.registry import STORED
from mbla.results.record import check_record
from mbla.results.record.json_record import RUN
from mbla.results.record.objects import Key, keys_of
from mbla.results.tables.table import unit_in
from mbla.results.tables.tables import TABLES
from mbla.results.vtu.arrays import COLUMNS, OTHERS, names_of_arrays
from mbla.sweeps.interaction.study import INTERACT_RECORD
from mbla.sweeps.tables.sweep_json import SWEEP_RECORD
from mbla.sweeps.tables.sweep_table import AFTER, POINT, STATE

PAGE = Path(__file__).parents[2] / "schemas" / "results.md"

OWN_WORDS = "parameters of the design, in the order of the sweep file, with their angles where they are directions"
RESULT_WORDS = "results, load case by load case: `CASE.` stands before the key path where several are solved"


RECORD: tuple[Key, ...] = (
    *keys_of(RUN),
    *keys_of(check_record.MODEL, "model."),
    Key("needs", "object", "`mbla check`: what reaches the solver, by load case"),
    Key("needs.*", "object", "of a load case"),
    Key("needs.*.*", "integer", "counts by name"),
    Key("needs.*.solver", "string", "who solves its programs"),
    *keys_of(check_record.NEEDS, "needs.*."),
)
"""keys of the record of a run, and those of ``mbla check`` alone"""
CELLS = {
    "blocks": "blocks as polyhedra, in their order; no two share a point",
    "frames": "(…_frame_NNN.vtu) the same after a finite motion, from as built to as drawn, which STEM_CASE.pvd plays; "
    "(…_pushed_NNN.vtu) where they are at the steps of a pushover, which STEM_CASE_pushed.pvd plays; "
    "(…_history_NNN.vtu) in time, the end with no velocity (nan), which STEM_CASE_history.pvd plays",
    "forces": "(…_history_forces_NNN.vtu) contact points that bear in time as vertices where they are, which "
    "STEM_CASE_history_forces.pvd plays",
    "contacts": "contact points as vertices",
    "interfaces": "interfaces as polygons, by their outer boundary; holes are not drawn, areas and forces count them",
    "thrust": "points of application of resultants as vertices, outside a joint its edge; thrust lines between them",
    "hinges": "axes of interfaces that open about one, as lines where they stay closed; about a corner as points",
    "loads": "loads and reactions as vertices where they act",
    "ties": "ties, struts and rings as lines, one for each stretch; strips and fill as vertices where they act",
    "modes": "blocks as polyhedra, with the shape of each mode of vibration, `mode_1` and so on",
    "modes_after": "the same after a time history, with the blocks where it left them",
    "supports": "ground as slabs under what stands on it, fixed blocks, guided blocks, as polyhedra",
}
"""files by what their names end in, and their cells"""


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


def described(file: str, on: str) -> dict[str, Quantity]:
    """Every array that a file may hold, by name; one without forces or without a mechanism holds fewer."""
    quantities: Sequence[Quantity] = [each for each in COLUMNS.get((file, on), ()) if file in each.files]
    return {name: each for each in (*quantities, *OTHERS.get((file, on), ())) for name, _ in names_of_arrays(each)}


def arrays_table() -> str:
    """The tables of schemas/results.md; units as in a deck in m, N, kg."""
    lines = ["| file | cells |", "|---|---|"]
    lines += [f"| …_{file}.vtu | {cells} |" for file, cells in CELLS.items()]
    lines += ["", "| file, on | array | components | units | content |", "|---|---|---|---|---|"]
    for file in CELLS:
        for on in ("points", "cells"):
            for name, each in described(file, on).items():
                count = 3 if "axis" in each.dims else 1
                unit = unit_text(each.unit, Units())
                lines.append(f"| {file}, {on} | `{name}` | {count} | {unit} | {each.words} |")
    return "\n".join(lines) + "\n"


def tables_page() -> str:
    """Every table with its columns, as it stands in schemas/results.md; units as in a deck in m, N, kg."""
    lines: list[str] = []
    for kind in TABLES.values():
        lines += [f"### `{kind.name}`", "", f"One row for {kind.words}.", ""]
        lines += ["| column | type | unit | meaning |", "|---|---|---|---|"]
        for column in kind.columns:
            lines.append(f"| `{column.name}` | {column.kind} | {unit_in(column, Units()) or '–'} | {column.words} |")
        lines.append("")
    return "\n".join(lines)


def keys_page(keys: Sequence[Key]) -> str:
    """Keys of a record as a Markdown table."""
    units = {key: "" if key.unit == "1" else f" [{unit_text(key.unit, Units())}]" for key in keys}
    rows = [f"| `{key.path}` | {key.kind}{units[key]} | {key.words} |" for key in keys]
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
