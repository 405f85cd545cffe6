"""The layout of the HDF5 result file as one table: it feeds the writer, the reader's checks and schemas/results.md.

A ``*`` in a path stands for the name of a load case.
"""

from __future__ import annotations

from collections.abc import Iterable

from mbla.deck.units import Units
from mbla.results.hdf5.case_fields import CASE_FIELDS
from mbla.results.hdf5.field import COURSE, FILES, NOT_VERIFIED, TIMES, VERSIONS, Field, notice_fields, unit_text
from mbla.results.hdf5.model_fields import MODEL_FIELDS

FILETYPE = "mbla results"
VERSION = 6
"""raised by one with every change that an older reader would misread"""

ATTRIBUTES = {
    "filetype": f'"{FILETYPE}"',
    "version": f"version of this layout, {VERSION}; a reader checks it first",
    "mbla_version": "version of the program that ran the analysis",
    "created": "date of the run, UTC, ISO 8601; the only thing that differs between two runs of one deck and its times",
    "deck_sha256": "hash of the effective deck: sources and overrides",
    "complete": "1; 0 of a run that was stopped: load cases that were done before",
}
"""attributes of the root group"""

SHARED_DIMENSIONS = (
    "block",
    "block_bound",
    "vertex",
    "corner",
    "face",
    "face_bound",
    "interface",
    "interface_bound",
    "point",
    "group",
    "member",
    "position",
    "joint",
    "ground",
    "axis",
    "direction",
    "component",
    "pair",
)
"""dimensions with their scale in the root group, where every group sees it; that of others is beside their dataset"""

RUN_FIELDS: tuple[Field, ...] = (
    *notice_fields("notices", "all remarks of the run"),
    Field("provenance/names", "text", ("entry",), "1", "programs, libraries, platform", told=VERSIONS),
    Field("provenance/values", "text", ("entry",), "1", "their versions", told=VERSIONS),
    Field("provenance/setting_names", "text", ("setting",), "1", "analysis settings in effect"),
    Field("provenance/setting_values", "text", ("setting",), "1", "their values"),
    Field("provenance/stage_names", "text", ("stage",), "1", "stages of the run", told=TIMES),
    Field("provenance/stage_seconds", "float", ("stage",), "time", "time of each stage", told=TIMES),
    Field("provenance/files", "text", ("file",), "1", "names of the files of this run", told=FILES),
    Field("provenance/exit_code", "int", (), "1", "exit status of the run"),
    Field(
        "provenance/not_done",
        "text",
        ("case",),
        "1",
        "load cases not done by a stopped run",
        part="stopped",
        told=COURSE,
    ),
)
"""what the run itself left: remarks, versions, settings, times"""

LAYOUT: tuple[Field, ...] = (*MODEL_FIELDS, *CASE_FIELDS, *RUN_FIELDS)


def fields_of_case(name: str) -> tuple[tuple[str, Field], ...]:
    """Path and field of every dataset of one load case."""
    return tuple((f.path.replace("*", name), f) for f in LAYOUT if "*" in f.path)


COMMON_FIELDS: tuple[Field, ...] = tuple(f for f in LAYOUT if "*" not in f.path)


def fields_of(cases: Iterable[str]) -> tuple[tuple[str, Field], ...]:
    """The same of everything that a file with these cases may hold, in the order of writing."""
    common = tuple((field.path, field) for field in COMMON_FIELDS)
    return common + tuple(pair for name in cases for pair in fields_of_case(name))


def layout_table() -> str:
    """The datasets as a Markdown table, as it stands in schemas/results.md; units as in a deck in m, N, kg."""
    lines = ["| dataset | type | dimensions | units | content |", "|---|---|---|---|---|"]
    for field in LAYOUT:
        content = field.long_name + (f" (part: {field.part})" if field.part else "")
        content += f"; {NOT_VERIFIED.format(field.told)}" if field.told else ""
        content += f" (verified where it is {' or '.join(field.proved)})" if field.proved else ""
        dims = ", ".join(field.dims) or "–"
        lines.append(f"| `/{field.path}` | {field.kind} | {dims} | {unit_text(field.unit, Units())} | {content} |")
    return "\n".join(lines) + "\n"
