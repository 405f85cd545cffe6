"""What the keys of the record of a diagram mean, a section of schemas/results.md."""

from __future__ import annotations

from mbla.results.records.description import Key

INTERACT_RECORD: tuple[Key, ...] = (
    Key("mbla", "string", "version of the program"),
    Key("deck", "string", "file name of the deck"),
    Key("title", "string", "title of the deck"),
    Key("created", "string", "date of the run, UTC, ISO 8601"),
    Key("exit_code", "integer", "exit status: that of the gravest point; 5 where no point has a load factor"),
    Key("set", "list", "values that `--set` and the like changed in the deck, `key.path=value`"),
    Key("flow_rule", "string", "as of the deck"),
    Key("units", "object", "length, force and mass of the deck"),
    Key("provenance", "object", "versions and machine, as of the result files"),
    Key("kind", "string", "`direction` or `two_loads`"),
    Key("case", "string?", "load case whose live load is turned; null for two loads"),
    Key("loads", "list?", "names of the two load cases; null for directions"),
    Key(
        "azimuth", "string?", "from what directions are counted: from +x, or from those of the deck; null for two loads"
    ),
    Key("axes", "list", "what the two axes of the diagram are, in words"),
    Key("closed", "boolean", "the angles go all around"),
    Key("points", "list", "rows of the table, in the order of their angles; values by the names of its columns"),
    Key("least", "object?", "least load factor of the points, `load_factor`, and its `angles` in degrees"),
    Key("greatest", "object?", "greatest load factor of the points, likewise"),
    Key("domain", "object?", "what the bounds of associative flow prove together; null where no point has bounds"),
    Key("domain.flow_rule", "string", "associative"),
    Key("domain.inner", "list", "corners of the convex hull of safe points, factors along the axes"),
    Key("domain.outer", "list", "corners of what the half-planes of all mechanisms leave"),
    Key("domain.cut_off", "boolean", "the outer polygon ends at an edge that no mechanism draws"),
    Key("domain.gap", "number?", "area between the polygons over that of the outer one; null where it is not bounded"),
    Key("domain.convex", "boolean", "no safe point lies beyond a bound"),
    Key(
        "domain.crossings",
        "list",
        "safe points beyond bounds, which must not be: ray of the bound (`angle`), angle of the point (`safe`), "
        "relative distance (`share`)",
    ),
    Key("domain.least_everywhere", "number?", "load factor carried at every angle, also between the points"),
    Key("words", "list", "what was asked and what follows, in sentences"),
    Key("time", "number", "seconds by the clock, of the whole"),
    Key("files", "list", "names of the files of the diagram"),
)
