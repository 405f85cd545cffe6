"""What the keys of the record of a diagram mean, and the columns of its CSV; a section each of schemas/results.md."""

from __future__ import annotations

from mbla.results.records.description import Key

_ANGLE = "degrees; azimuth from +x towards +y, or angle of two loads: A times cosine, B times sine"

INTERACT_RECORD: tuple[Key, ...] = (
    Key("mbla", "string", "version of the program"),
    Key("deck", "string", "file name of the deck"),
    Key("title", "string", "title of the deck"),
    Key("created", "string", "date of the run, UTC, ISO 8601"),
    Key("exit_code", "integer", "exit status: that of the gravest point; 5 where no point has a load factor"),
    Key("set", "list", "values that `--set` and the like changed in the deck, `key.path=value`"),
    Key("set[]", "string", "one of them"),
    Key("flow_rule", "string", "as of the deck"),
    Key("kind", "string", "`direction` or `two_loads`"),
    Key("case", "string?", "load case whose live load is turned; null for two loads"),
    Key("loads", "list?", "names of the two load cases; null for directions"),
    Key("loads[]", "string", "a name"),
    Key(
        "azimuth", "string?", "from what directions are counted: from +x, or from those of the deck; null for two loads"
    ),
    Key("axes", "list", "what the two axes of the diagram are"),
    Key("axes[]", "string", "in words"),
    Key("closed", "boolean", "the angles go all around"),
    Key("units", "object", "length, force and mass of the deck"),
    Key("units.length", "string", "unit"),
    Key("units.force", "string", "unit"),
    Key("units.mass", "string", "unit"),
    Key("points", "list", "points of the diagram, in the order of their angles"),
    Key("points[]", "object", "a point"),
    Key("points[].angle", "number", _ANGLE),
    Key("points[].status", "string?", "as of a load case; null where the point was not solved"),
    Key("points[].verified", "boolean", "it has a verified answer, which may be that there is no load factor"),
    Key("points[].exit_code", "integer", "exit status that `mbla run` of this point ends with"),
    Key("points[].load_factor", "number?", "null where there is none that is verified"),
    Key("points[].factors", "list", "the load factor along the two axes: times cosine and sine of the angle"),
    Key("points[].factors[]", "number?", "a factor"),
    Key("points[].associative_load_factor", "number?", "of associative flow"),
    Key("points[].static_bound", "number?", "proved: associative flow carries it"),
    Key("points[].kinematic_bound", "number?", "proved: no flow rule carries more"),
    Key("points[].half_plane", "list?", "power of each of the two loads in the mechanism that bounds this point"),
    Key("points[].half_plane[]", "number", "a power, over that of the live load"),
    Key("points[].mechanism", "string?", "class of the mechanism"),
    Key("points[].reason", "string?", "why there is no verified load factor"),
    Key("points[].time", "number?", "seconds by the clock"),
    Key("least", "object?", "least load factor of the points"),
    Key("least.load_factor", "number", "its value"),
    Key("least.angles", "list", "where it is reached"),
    Key("least.angles[]", "number", "degrees"),
    Key("greatest", "object?", "greatest load factor of the points"),
    Key("greatest.load_factor", "number", "its value"),
    Key("greatest.angles", "list", "where it is reached"),
    Key("greatest.angles[]", "number", "degrees"),
    Key("domain", "object?", "what the bounds of associative flow prove together; null where no point has bounds"),
    Key("domain.flow_rule", "string", "associative"),
    Key("domain.inner", "list", "corners of the convex hull of safe points"),
    Key("domain.inner[]", "list", "factors along the axes"),
    Key("domain.inner[][]", "number", "a factor"),
    Key("domain.outer", "list", "corners of what the half-planes of all mechanisms leave"),
    Key("domain.outer[]", "list", "factors along the axes"),
    Key("domain.outer[][]", "number", "a factor"),
    Key("domain.cut_off", "boolean", "the outer polygon ends at an edge that no mechanism draws"),
    Key("domain.gap", "number?", "area between the polygons over that of the outer one; null where it is not bounded"),
    Key("domain.convex", "boolean", "no safe point lies beyond a bound"),
    Key("domain.crossings", "list", "safe points beyond bounds, which must not be"),
    Key("domain.crossings[]", "object", "one"),
    Key("domain.crossings[].angle", "number", "ray of the bound that is passed, degrees"),
    Key("domain.crossings[].safe", "number", "angle of the safe point, degrees"),
    Key("domain.crossings[].share", "number?", "relative distance beyond it"),
    Key("domain.least_everywhere", "number?", "load factor carried at every angle, also between the points"),
    Key("words", "list", "what was asked and what follows"),
    Key("words[]", "string", "a sentence"),
    Key("provenance", "object", "versions and machine, as of the result files"),
    Key("provenance.*", "any", "a version or a name"),
    Key("time", "number", "seconds by the clock, of the whole"),
    Key("files", "list", "names of the files of the diagram"),
    Key("files[]", "string", "a file"),
)


def interact_record_page() -> str:
    """The keys as a Markdown table."""
    rows = [f"| `{path}` | {kind} | {words} |" for path, kind, words in (key.item for key in INTERACT_RECORD)]
    return "\n".join(["| key | type | meaning |", "|---|---|---|", *rows]) + "\n"
