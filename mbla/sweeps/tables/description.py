"""What the keys of the record of a sweep mean, and how sweep.h5 is laid out; a section each of schemas/results.md."""

from __future__ import annotations

from mbla.results.records.key import Key
from mbla.sweeps.fragility_words import fragility_keys
from mbla.sweeps.tables.own_columns import AFTER, POINT, STATE

SWEEP_RECORD: tuple[Key, ...] = (
    Key("mbla", "string", "version of the program"),
    Key("sweep", "string", "file name of the sweep file"),
    Key("version", "integer", "version of this record and of sweep.h5; a reader checks it first"),
    Key("deck", "string", "base deck, as the sweep file names it"),
    Key("title", "string", "title of the sweep"),
    Key("created", "string", "date of the run, UTC, ISO 8601"),
    Key("exit_code", "integer", "exit status of the sweep: 0, or 8 where points failed"),
    Key("points", "object", "counts of points"),
    Key("points.all", "integer", "in the table"),
    Key("points.done", "integer", "with a verified answer for every load case"),
    Key("points.failed", "integer", "without"),
    Key("points.unfinished", "integer", "not solved yet"),
    Key("points.left_out", "integer", "of the design, left out by constraints; not in the table"),
    Key("design", "object", "how the points lie"),
    Key("design.dimensions", "list", "axes of the design, the slowest first"),
    Key("design.dimensions[]", "object", "an axis"),
    Key("design.dimensions[].name", "string", "parameter of a grid, or kind of a set of points"),
    Key("design.dimensions[].size", "integer", "positions along it"),
    Key("design.samples", "string?", "the axis whose points are a random sample of distributions"),
    Key("design.sampling", "string?", "random, latin_hypercube or sobol for that"),
    Key("design.places", "list?", "place of each row in the whole design, the last axis fastest; null: all are there"),
    Key("design.places[]", "integer", "a place, from 0"),
    Key("columns", "list", "columns of sweep.csv, in their order"),
    Key("columns[]", "object", "a column"),
    Key("columns[].name", "string", "its name"),
    Key("columns[].unit", "string", "unit; empty for plain numbers and text"),
    Key("columns[].words", "string", "what it is"),
    Key("columns[].kind", "string", "float, int, bool or text"),
    Key(
        "columns[].role",
        "string",
        "number, parameter, azimuth, elevation, state, result, exit_code, reason, tries or seconds",
    ),
    Key("columns[].dimension", "string", "of parameters: the axis along which they change"),
    Key("columns[].random", "boolean", "of parameters: they follow a distribution"),
    Key("columns[].case", "string", "of results: load case; empty for values of the whole run"),
    Key("columns[].path", "string", "of results: key path in the JSON record of the run"),
    *fragility_keys("fragility"),
    Key("notices", "list", "remarks and warnings"),
    Key("notices[]", "object", "a remark"),
    Key("notices[].severity", "string", "notice or warning"),
    Key("notices[].identifier", "string", "stable identifier"),
    Key("notices[].message", "string", "in words"),
    Key("time", "object", "what it took"),
    Key("time.total", "number", "the whole run by the clock", "time"),
    Key("files", "list", "names of the files of the sweep"),
    Key("files[]", "string", "a file"),
)

OWN_WORDS = "parameters of the design, in the order of the sweep file, with their angles where they are directions"
RESULT_WORDS = "results, load case by load case: `CASE.` stands before the key path where several are solved"


def sweep_record_page() -> str:
    """The keys as a Markdown table."""
    rows = [f"| `{path}` | {kind} | {words} |" for path, kind, words in (key.item for key in SWEEP_RECORD)]
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
