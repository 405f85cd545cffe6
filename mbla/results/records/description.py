"""What the keys of the JSON records mean, as one table; it makes a section of schemas/results.md and a test holds it.

A path names keys with full stops between them; ``[]`` is each item of a list, ``*`` each key that the deck names. Types
are those of JSON; a question mark: or null, where there is no such value. What the record describes is told by it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from mbla.deck.units import Units
from mbla.results.record.cases import CASE_COLUMNS
from mbla.results.record.quantity import Quantity, UnitKind, unit_text
from mbla.results.record.stored import STORED_BY_PATH

KINDS = {"float": "number?", "int": "integer", "bool": "boolean", "text": "string?"}
"""types in JSON: numbers must be finite there, and texts not empty"""


@dataclass(frozen=True)
class Key:
    """One key.

    kind : integer, number, string, boolean, object or list, with ``?`` where it may be null
    unit : of its number or numbers
    """

    path: str
    kind: str
    words: str
    unit: UnitKind = "1"

    @property
    def item(self) -> tuple[str, str, str]:
        """Path, type with its unit as in a deck in m, N, kg, and meaning."""
        kind = self.kind if self.unit == "1" else f"{self.kind} [{unit_text(self.unit, Units())}]"
        return self.path, kind, self.words


def _key(path: str, quantity: Quantity, kind: str = "") -> Key:
    return Key(path, kind or KINDS[quantity.kind], quantity.words, quantity.unit)


def _stored(owner: str, place: str, names: str) -> tuple[Key, ...]:
    """Keys that are quantities of the result file, a question mark behind those that may be null."""
    keys = []
    for name in names.split():
        quantity = STORED_BY_PATH[f"{place}/{name.rstrip('?')}"]
        kind = KINDS[quantity.kind].rstrip("?") + "?" * name.endswith("?")
        keys.append(_key(f"{owner}.{quantity.name}", quantity, kind))
    return tuple(keys)


def _of_columns() -> Iterable[Key]:
    """Single values of a load case."""
    for column in CASE_COLUMNS:
        quantity, path = column.quantity, f"cases[].{column.quantity.name}"
        if "json" not in column.files:
            continue
        if quantity.dims == ("sentence",):
            yield from (Key(path, "list", quantity.words), Key(f"{path}[]", "string", "a sentence"))
        elif quantity.dims:
            yield from (_key(path, quantity, "list?"), _key(f"{path}[]", quantity, "number?"))
        else:
            yield _key(path, quantity, "boolean?" if column.names else "")


def reduction_keys(place: str) -> tuple[Key, ...]:
    """What each reduction left out, in the list at ``place``."""
    held = "cases/*/reductions"
    sizes = (
        Key(f"{place}[].{when}.{name}", "integer", STORED_BY_PATH[f"{held}/{name}_{when}"].words)
        for when in ("before", "after")
        for name in ("unknowns", "cones", "entries", "largest")
    )
    return (
        Key(place, "list", "what each reduction left out, in the order in which they are applied"),
        Key(f"{place}[]", "object", "a reduction"),
        *_stored(f"{place}[]", held, "name state found"),
        *(Key(f"{place}[].{when}", "object", f"programs with live load {when} it") for when in ("before", "after")),
        *sizes,
    )


def reaction_keys(place: str) -> tuple[Key, ...]:
    """What supports carry, in the object at ``place``."""
    return (
        Key(place, "object?", "what the supports exert on the structure at collapse; null without a result"),
        Key(f"{place}.total", "object", "all of them together: unique, as it balances the loads"),
        *_wrench_keys(f"{place}.total"),
        Key(f"{place}.supports", "object", "one by one, which need not be unique"),
        Key(f"{place}.supports.*", "object", "of a ground plane, `GROUP (fixed blocks)` or `guides of GROUP`"),
        *_wrench_keys(f"{place}.supports.*"),
    )


def _wrench_keys(owner: str) -> tuple[Key, ...]:
    return (
        Key(f"{owner}.force", "list", "resultant force"),
        Key(f"{owner}.force[]", "number", "a component", "force"),
        Key(f"{owner}.moment", "list", "its moment about the origin"),
        Key(f"{owner}.moment[]", "number", "a component", "moment"),
    )


MECHANISM = "cases[].mechanism"
_YIELD = f"{MECHANISM}.yield_lines"
_LINES, _PLANES, _CRACKS = (f"{MECHANISM}.{name}" for name in ("hinge_lines", "sliding_planes", "cracks"))


def part_keys(owner: str) -> tuple[Key, ...]:
    """The keys of a rigid part, or a cluster of parts taken for one."""
    return (
        Key(f"{owner}[]", "object", "one of them"),
        Key(f"{owner}[].part", "integer", "number, from 1, the heaviest first"),
        Key(f"{owner}[].blocks", "integer", "its blocks"),
        Key(f"{owner}[].groups", "object", "its blocks by group"),
        Key(f"{owner}[].groups.*", "integer", "blocks of a group"),
        Key(f"{owner}[].weight", "number", "weight under standard gravity", "force"),
        Key(f"{owner}[].motion", "string", "turns or moves"),
        Key(f"{owner}[].axis_point", "list?", "where it turns: the point of its axis nearest to its centroid"),
        Key(f"{owner}[].axis_point[]", "number?", "a coordinate", "length"),
        Key(f"{owner}[].direction", "list", "unit vector of the axis by the right hand, or of the travel"),
        Key(f"{owner}[].direction[]", "number", "a component"),
    )


def _pair_keys(owner: str, act: str) -> tuple[Key, ...]:
    """What hinge lines, sliding planes and cracks have in common."""
    return (
        Key(f"{owner}[]", "object", "one of them"),
        Key(f"{owner}[].clusters", "list", f"the cluster that {act}, and the other; 0 is at rest"),
        Key(f"{owner}[].clusters[]", "integer", "a cluster"),
        Key(f"{owner}[].interfaces", "list", "its interfaces"),
        Key(f"{owner}[].interfaces[]", "integer", "number of an interface, from 0"),
    )


def _vector_keys(owner: str, item: str, unit: UnitKind, *names: tuple[str, str]) -> tuple[Key, ...]:
    """Keys of vectors by name, and of what they hold."""
    return tuple(
        key
        for name, words in names
        for key in (
            Key(f"{owner}[].{name}", "list", words),
            Key(f"{owner}[].{name}[]", "number", item, unit),
        )
    )


def _point_keys(owner: str, *names: tuple[str, str]) -> tuple[Key, ...]:
    return _vector_keys(owner, "a coordinate", "length", *names)


def _direction_keys(owner: str, *names: tuple[str, str]) -> tuple[Key, ...]:
    return _vector_keys(owner, "a component", "1", *names)


FAILURE: tuple[Key, ...] = (
    Key(
        f"{MECHANISM}.clusters_merged",
        "number",
        "share of the largest contact speed up to which rigid parts were taken for one; 0: none were",
    ),
    Key(f"{MECHANISM}.clusters", "list", "rigid parts as they are told, those that move, at most 100"),
    *part_keys(f"{MECHANISM}.clusters"),
    Key(_LINES, "list", "axes about which one cluster turns relative to another, that which moves most first"),
    *_pair_keys(_LINES, "turns"),
    *_point_keys(_LINES, ("start", "start of the line"), ("end", "its end")),
    Key(f"{_LINES}[].length", "number", "its length", "length"),
    *_direction_keys(_LINES, ("direction", "unit vector from start to end, for the first by the right hand")),
    Key(f"{_LINES}[].rotation", "number", "the largest relative angular velocity of its interfaces", "rotation"),
    Key(f"{_LINES}[].share", "number", "its largest contact speed over the largest of all"),
    Key(f"{_LINES}[].slides", "boolean", "whether closed points of it slide too"),
    Key(f"{_LINES}[].crushes", "boolean", "whether closed points of it crush too"),
    Key(f"{_LINES}[].shear_power_share", "number?", "share of the power put in that its shear forces dissipate"),
    Key(_PLANES, "list", "planes on which one cluster slides over another, that which dissipates most first"),
    *_pair_keys(_PLANES, "slides"),
    Key(f"{_PLANES}[].area", "number", "area of its interfaces", "area"),
    *_point_keys(_PLANES, ("centroid", "their centroid")),
    *_direction_keys(
        _PLANES,
        ("normal", "unit vector towards the cluster that slides"),
        ("direction", "unit vector in which it slides over the other"),
    ),
    Key(f"{_PLANES}[].twists", "boolean", "whether it slides by turning about the normal"),
    Key(f"{_PLANES}[].power_share", "number?", "share of the power put in that is dissipated there"),
    Key(f"{_PLANES}[].shear_power_share", "number?", "the same of the shear forces alone"),
    Key(f"{_PLANES}[].share", "number", "its largest contact speed over the largest of all"),
    Key(_CRACKS, "list", "open joints between two clusters, those that open most first"),
    *_pair_keys(_CRACKS, "moves away"),
    *_point_keys(_CRACKS, ("start", "centroid of its first interface"), ("end", "of its last")),
    Key(f"{_CRACKS}[].length", "number", "its length", "length"),
    Key(f"{_CRACKS}[].area", "number", "area of its interfaces", "area"),
    *_point_keys(_CRACKS, ("widest", "the contact point at which it opens most")),
    Key(f"{_CRACKS}[].share", "number", "opening speed there over the largest contact speed of all"),
    Key(
        f"{MECHANISM}.main_parts",
        "list",
        "the few parts as which it moves; the clusters where these are few",
    ),
    *part_keys(f"{MECHANISM}.main_parts"),
    Key(f"{MECHANISM}.main_parts_explain", "number", "share of the motion, of its square, that they explain"),
    Key(_YIELD, "list", "lines along which main parts break off, the longest first"),
    Key(f"{_YIELD}[]", "object", "one of them"),
    Key(f"{_YIELD}[].parts", "list", "the main parts on both sides; 0 is at rest and comes second"),
    Key(f"{_YIELD}[].parts[]", "integer", "a main part"),
    Key(f"{_YIELD}[].interfaces", "list", "its interfaces"),
    Key(f"{_YIELD}[].interfaces[]", "integer", "number of an interface, from 0"),
    Key(f"{_YIELD}[].points", "list", "its ends and corners, the lowest end first"),
    Key(f"{_YIELD}[].points[]", "list", "a point"),
    Key(f"{_YIELD}[].points[][]", "number", "a coordinate", "length"),
    Key(f"{_YIELD}[].length", "number", "its length", "length"),
    Key(f"{_YIELD}[].inclination", "number", "to the horizontal, from end to end", "degree"),
    Key(f"{_YIELD}[].off", "number", "distance of the interfaces from it over its length, root of the mean square"),
    Key(f"{MECHANISM}.force_freedom", "object?", "how unique the forces are; null where that was not determined"),
    Key(f"{MECHANISM}.force_freedom.ways", "integer", "ways in which equilibrium lets the forces vary; 0: unique"),
    Key(f"{MECHANISM}.force_freedom.determined", "integer", "interfaces whose resultant is the same in all of them"),
    Key(f"{MECHANISM}.enough", "object", "the part of the structure that is enough for this load factor"),
    Key(f"{MECHANISM}.enough.moving_blocks", "integer", "blocks that move"),
    Key(f"{MECHANISM}.enough.interfaces", "integer", "interfaces on them"),
    Key(f"{MECHANISM}.enough.bearing_blocks", "integer", "free blocks at rest that these touch"),
    Key(f"{MECHANISM}.enough.left_out_blocks", "integer", "free blocks at rest that touch nothing that moves"),
)

RUN = (
    Key("mbla", "string", "version of the program"),
    Key("deck", "string", "file name of the deck"),
    Key("deck_sha256", "string", "hash of the effective deck"),
    Key("created", "string", "date of the run, UTC, ISO 8601"),
    Key("exit_code", "integer", "exit status of the run"),
    Key("model", "object", "counts and totals of the model"),
    Key("cases", "list", "load cases that were run"),
    Key("cases[]", "object", "a load case"),
    Key("series", "list", "travelling loads: the load cases that are positions of one"),
    Key("settings", "object", "analysis settings in effect"),
    Key("settings.*", "string", "value of a setting"),
    Key("notices", "list", "remarks and warnings"),
    Key("notices[]", "object", "a remark"),
    *_stored("notices[]", "notices", "severity identifier message"),
    Key("notices[].case", "string", "load case that it is about; missing where it is about the whole run"),
    Key("time", "object", "by stage"),
    Key("time.*", "number", "time of a stage: read, contacts, solve, write; a part of one after a slash", "time"),
    Key("files", "list", "names of the files of the run"),
    Key("files[]", "string", "a file"),
    Key("complete", "boolean", "whether the run came to its end; false: cases are those that were done before"),
    Key("not_done", "list", "load cases that a stopped run did not come to"),
    Key("not_done[]", "string", "name of a load case"),
)

MODEL = (
    *_stored("model", "model", "title"),
    Key("model.units", "object", "units of the deck; all numbers are in them"),
    Key("model.units.length", "string", "unit of length"),
    Key("model.units.force", "string", "unit of force"),
    Key("model.units.mass", "string", "unit of mass"),
    Key("model.standing", "string?", "worst verdict of the cases on standing: yes, only by self-stress, no, doubtful"),
    Key("model.dimension", "integer", "2 where every case was solved as planar, else 3"),
    Key("model.blocks", "integer", "blocks"),
    Key("model.free_blocks", "integer", "blocks that can move"),
    Key("model.extents", "list", "lower and upper corner of the box around the blocks"),
    Key("model.extents[]", "list", "a corner"),
    Key("model.extents[][]", "number", "a coordinate", "length"),
    Key("model.total_volume", "number", "volume of all blocks", "volume"),
    Key("model.total_weight", "number", "their weight under standard gravity", "force"),
    Key("model.added_mass", "number", "mass that blocks carry along beside their own", "mass"),
    Key("model.interfaces", "integer", "interfaces"),
    Key("model.contact_points", "integer", "contact points"),
    Key("model.contact_area", "number", "area of all interfaces", "area"),
    Key("model.open_interfaces", "integer", "interfaces left out as their joint law is open"),
    Key("model.glued_interfaces", "integer", "internal interfaces of glued bodies"),
    Key("model.glued_blocks", "integer", "blocks glued to others"),
    Key("model.rigid_bodies", "integer", "bodies that they form"),
    Key("model.held_blocks", "integer", "blocks that do not move because they are glued to a support"),
)

CASE = (
    Key("cases[].name", "string", "load case"),
    *_of_columns(),
    Key("cases[].reaction", "object?", "settlement: reaction of the support; forces, or moments where it turns"),
    Key("cases[].reaction.value", "number?", "as the structure follows it, positive against the motion", "load"),
    Key("cases[].reaction.lower_bound", "number?", "verified lower bound by associative flow", "load"),
    Key("cases[].reaction.upper_bound", "number?", "verified upper bound by associative flow", "load"),
    Key("cases[].reaction.at_rest", "number?", "of the support that has not moved yet", "load"),
    Key("cases[].reaction.unit", "number?", "what load factor 1 takes from it", "load"),
    Key("cases[].reaction.kind", "string", "force or moment"),
    Key("cases[].best_iterate", "object?", "the best that was reached where the case has no result"),
    Key("cases[].best_iterate.load_factor", "number?", "its load factor, which is none"),
    Key("cases[].best_iterate.residuals", "object", "as `residuals`"),
    Key("cases[].best_iterate.residuals.*", "number?", "as in `residuals`"),
    Key("cases[].bracket", "object?", "polyhedral friction: associative load factors with two polyhedra"),
    Key("cases[].bracket.inner", "number?", "with the inscribed one"),
    Key("cases[].bracket.outer", "number?", "with the circumscribed one"),
    Key("cases[].bracket.sides", "integer", "their sides"),
    Key(
        "cases[].powers",
        "object?",
        "powers of live loads in the associative mechanism, by load case; 1 of its own",
    ),
    Key(
        "cases[].powers.*",
        "number?",
        "factors acting together, each times this, add up to kinematic_bound at most",
    ),
    Key("cases[].certificate", "string?", "what proves that there is no load factor: motion or forces"),
    Key("cases[].standing", "object?", "assessment of the dead load alone"),
    Key("cases[].residuals", "object", "the first six of these once more"),
    Key("cases[].residuals.*", "number?", "equilibrium, yield, tension, penetration, complementarity, slip"),
    *_stored("cases[].standing", "cases/*/standing", "verdict reason?"),
    Key("cases[].standing.block", "string?", "the block that falls or would fall first"),
)

EFFORT = (
    Key("cases[].solver", "object", "who solved them"),
    Key("cases[].solver.asked", "string?", "as in analysis.solver"),
    Key("cases[].solver.used", "list", "solvers that took programs"),
    Key("cases[].solver.used[]", "string", "a solver"),
    Key("cases[].solver.factorization", "list", "libraries that factorised their linear systems"),
    Key("cases[].solver.factorization[]", "string", "a library"),
    Key("cases[].size", "object?", "what reached the solver"),
    *_stored(
        "cases[].size",
        "cases/*/size",
        "dimension mirror_planes parts free_blocks contact_points dropped_points",
    ),
    *reduction_keys("cases[].reductions"),
    Key("cases[].path", "list", "steps of the load path that was followed"),
    Key("cases[].path[]", "object", "a step"),
    *_stored("cases[].path[]", "cases/*/path", "step load_factor? open slide residual?"),
    Key("cases[].time", "object", "what it took"),
    Key("cases[].time.total", "number?", "time of the solver stage", "time"),
    Key("cases[].time.solver", "number?", "time of the programs in it", "time"),
)

MECHANISM_KEYS = (
    Key(MECHANISM, "object?", "how it fails; null where the case has no result"),
    Key(
        f"{MECHANISM}.class",
        "string",
        "in a word: sliding, twisting, overturning (parts turn on the stationary blocks), hinging (they "
        "hinge on each other), sliding and hinging, opening",
    ),
    Key(f"{MECHANISM}.open", "integer", "contact points that open"),
    Key(f"{MECHANISM}.slide", "integer", "contact points that slide"),
    Key(f"{MECHANISM}.crush", "integer", "contact points that crush"),
    Key(f"{MECHANISM}.stick", "integer", "contact points that do none of these"),
    Key(f"{MECHANISM}.interfaces", "object", "interfaces by mode"),
    Key(f"{MECHANISM}.interfaces.*", "integer", "interfaces that stick, slide, open, hinge, twist, crush"),
    Key(f"{MECHANISM}.hinges", "integer", "interfaces that hinge"),
    Key(f"{MECHANISM}.reach", "string", "local, partial or global"),
    Key(f"{MECHANISM}.moving_blocks", "integer", "free blocks that move"),
    Key(f"{MECHANISM}.moving_weight_share", "number", "their share of the weight of the free blocks"),
    Key(f"{MECHANISM}.moving_parts", "integer", "rigid parts that move"),
    Key(f"{MECHANISM}.parts", "list", "the heaviest of them, at most 100"),
    *part_keys(f"{MECHANISM}.parts"),
    *FAILURE,
    Key(f"{MECHANISM}.work", "object", "powers, with unit power of the live load"),
    Key(f"{MECHANISM}.work.live", "number", "load factor times the power of the live load"),
    Key(f"{MECHANISM}.work.dead", "number", "of the dead load, negative where weights are lifted"),
    Key(f"{MECHANISM}.work.friction", "number", "dissipated by sliding under friction"),
    Key(f"{MECHANISM}.work.cohesion", "number", "dissipated by sliding against cohesion"),
    Key(f"{MECHANISM}.work.normal", "number", "dissipated by normal forces"),
    Key(f"{MECHANISM}.work.joints", "object", "dissipated by joint law"),
    Key(f"{MECHANISM}.work.joints.*", "number", "in the interfaces of a joint law"),
    Key(f"{MECHANISM}.work.groups", "object", "of the loads by group"),
    Key(f"{MECHANISM}.work.groups.*", "object", "of a group"),
    Key(f"{MECHANISM}.work.groups.*.live", "number", "of the live load on it"),
    Key(f"{MECHANISM}.work.groups.*.dead", "number", "of the dead load on it"),
    *reaction_keys("cases[].reactions"),
)

SERIES = (
    Key("series[]", "object", "a travelling load"),
    Key("series[].name", "string", "load case in the deck"),
    Key("series[].complete", "boolean", "whether every position was solved, none left out by name"),
    Key("series[].positions", "list", "in their order"),
    Key("series[].positions[]", "object", "a position"),
    Key("series[].worst", "object?", "the position with the least load factor; null where it is not known"),
)

CHECK = (
    Key("model.load_cases", "list", "`mbla check`: names of the load cases"),
    Key("model.load_cases[]", "string", "a load case"),
    Key("model.joints", "object", "`mbla check`: joint laws in use"),
    Key("model.joints.*", "object", "a joint law"),
    Key("model.joints.*.interfaces", "integer", "its interfaces"),
    Key("model.joints.*.area", "number", "their area", "area"),
    Key("model.slivers", "integer", "`mbla check`: common surfaces dropped as thinner than the tolerance"),
    Key("model.near_misses", "integer", "`mbla check`: near misses: pairs of bodies that nearly touch"),
    Key("model.overlaps", "integer", "`mbla check`: pairs of blocks that overlap"),
    Key("model.isolated_blocks", "list", "`mbla check`: blocks without contact"),
    Key("model.isolated_blocks[]", "string", "a block"),
    Key("model.unsupported_parts", "integer", "`mbla check`: parts that reach no support"),
    Key("needs", "object", "`mbla check`: what reaches the solver, by load case"),
    Key("needs.*", "object", "of a load case"),
    Key("needs.*.*", "integer", "counts by name"),
    Key("needs.*.solver", "string", "who solves its programs"),
    *reduction_keys("needs.*.reductions"),
)


def _position(owner: str) -> tuple[Key, ...]:
    """The keys of a position of a series."""
    return (
        Key(f"{owner}.case", "string", "load case"),
        Key(f"{owner}.position", "integer", "number of the position, from 1"),
        Key(f"{owner}.point", "list", "where the first axle stands, or the only force"),
        Key(f"{owner}.point[]", "number", "a coordinate", "length"),
        Key(f"{owner}.distance", "number", "its distance along the path, of which it may be off", "length"),
        Key(f"{owner}.block", "string?", "the block that carries it; null: it is off the path and does not act"),
        Key(f"{owner}.axles", "list", "all axles, the first one first"),
        Key(f"{owner}.axles[]", "object", "an axle"),
        Key(f"{owner}.axles[].point", "list", "as of the position"),
        Key(f"{owner}.axles[].point[]", "number", "a coordinate", "length"),
        Key(f"{owner}.axles[].distance", "number", "as of the position", "length"),
        Key(f"{owner}.axles[].block", "string?", "as of the position"),
        Key(f"{owner}.status", "string", "status"),
        Key(f"{owner}.load_factor", "number?", "load factor; null where there is none"),
    )


POSITIONS = (*_position("series[].positions[]"), *_position("series[].worst"))
RUN_RECORD: tuple[Key, ...] = (*RUN, *MODEL, *CASE, *EFFORT, *MECHANISM_KEYS, *SERIES, *POSITIONS)
"""keys of the record of a run"""
RECORD: tuple[Key, ...] = (*RUN_RECORD, *CHECK)


def record_page() -> str:
    """The keys as a Markdown table, as it stands in schemas/results.md."""
    rows = ["| key | type | meaning |", "|---|---|---|"]
    return (
        "\n".join([*rows, *(f"| `{path}` | {kind} | {words} |" for path, kind, words in (k.item for k in RECORD))])
        + "\n"
    )
