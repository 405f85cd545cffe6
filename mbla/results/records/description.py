"""What the keys of the JSON records mean, as one table; it makes a section of schemas/results.md and a test holds it.

A path names keys with full stops between them; ``[]`` is each item of a list, ``*`` each key that the deck names. Types
are those of JSON; a question mark: or null, where there is no such value.
"""

from __future__ import annotations

from mbla.results.records.failure_description import FAILURE, part_keys
from mbla.results.records.failure_description import MECHANISM as _MECHANISM
from mbla.results.records.key import Key
from mbla.results.records.reactions_json import reaction_keys
from mbla.results.records.reduction_json import reduction_keys

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
    Key("notices[].severity", "string", "notice or warning"),
    Key("notices[].identifier", "string", "stable identifier, as `mbla explain` takes it"),
    Key("notices[].message", "string", "in words"),
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
    Key("model.title", "string", "title of the deck"),
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
    Key("model.glued_interfaces", "integer", "interfaces inside of rigid bodies, left out"),
    Key("model.glued_blocks", "integer", "blocks glued to others"),
    Key("model.rigid_bodies", "integer", "bodies that they form"),
    Key("model.held_blocks", "integer", "blocks that do not move because they are glued to a support"),
)

CASE = (
    Key("cases[].name", "string", "load case"),
    Key("cases[].status", "string", "status after verification"),
    Key("cases[].reason", "string?", "why it is not plainly solved"),
    Key("cases[].remarks", "list", "what a reader of the figure must know"),
    Key("cases[].remarks[]", "string", "a sentence"),
    Key("cases[].flow_rule", "string", "flow rule of the load factor"),
    Key("cases[].scheme", "string?", "how a flow without normality was solved"),
    Key("cases[].load_factor", "number?", "load factor; null where the case has no result"),
    Key(
        "cases[].least_load_factor",
        "number?",
        "least load factor that was found; the load factor where that is the only one",
    ),
    Key("cases[].greatest_load_factor", "number?", "the greatest of them; null besides: there is no limit"),
    Key("cases[].angle", "number?", "tilting table: angle of collapse", "degree"),
    Key("cases[].angle_bounds", "list?", "tilting table: angle certainly borne, angle certainly not"),
    Key("cases[].angle_bounds[]", "number?", "an angle", "degree"),
    Key("cases[].reaction", "object?", "settlement: reaction of the support; forces, or moments where it turns"),
    Key("cases[].reaction.value", "number?", "as the structure follows it, positive against the motion", "load"),
    Key("cases[].reaction.lower_bound", "number?", "verified lower bound by associative flow", "load"),
    Key("cases[].reaction.upper_bound", "number?", "verified upper bound by associative flow", "load"),
    Key("cases[].reaction.at_rest", "number?", "of the support that has not moved yet", "load"),
    Key("cases[].reaction.unit", "number?", "what load factor 1 takes from it", "load"),
    Key("cases[].reaction.kind", "string", "force or moment"),
    Key("cases[].factor_unique", "boolean?", "whether the load factor is the only one; null: not known"),
    Key("cases[].range", "list?", "verified least and greatest load factor for the mechanism found"),
    Key("cases[].range[]", "number?", "an end; null: not verified"),
    Key(
        "cases[].peak", "number?", "verified greatest load factor of the load path, where it lies above the load factor"
    ),
    Key("cases[].spread", "list?", "least and greatest load factor of several tries that did not agree"),
    Key("cases[].spread[]", "number", "an end"),
    Key("cases[].best_iterate", "object?", "the best that was reached where the case has no result"),
    Key("cases[].best_iterate.load_factor", "number?", "its load factor, which is none"),
    Key("cases[].best_iterate.residuals", "object", "as `residuals`"),
    Key("cases[].best_iterate.residuals.*", "number?", "as in `residuals`"),
    Key("cases[].static_bound", "number?", "verified lower bound of the associative load factor"),
    Key("cases[].kinematic_bound", "number?", "verified upper bound of it"),
    Key("cases[].gap", "number?", "relative distance of the two"),
    Key(
        "cases[].asked",
        "number?",
        "gap or residual that the deck asks for, of a case that is approximate for no other reason",
    ),
    Key("cases[].associative_load_factor", "number?", "by associative flow"),
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
    Key("cases[].standing.verdict", "string", "yes, only by self-stress, no, doubtful"),
    Key("cases[].standing.block", "string?", "the block that falls or would fall first"),
    Key("cases[].standing.reason", "string?", "why"),
)

VERIFICATION = (
    Key("cases[].verified", "boolean", "whether everything is within tolerance"),
    Key("cases[].failures", "list", "what is not"),
    Key("cases[].failures[]", "string", "a sentence"),
    Key("cases[].equilibrium_residual", "number?", "largest unbalanced force over mean block weight"),
    Key("cases[].yield_violation", "number?", "largest excess over the joint's strength over mean block weight"),
    Key("cases[].tension_violation", "number?", "largest tension beyond the tensile strength over mean block weight"),
    Key("cases[].penetration", "number?", "largest closing velocity over largest contact speed"),
    Key("cases[].complementarity_residual", "number?", "share of the power balance left unexplained by the flow rule"),
    Key("cases[].slip_residual", "number?", "the part of it that sliding against friction leaves unexplained"),
    Key("cases[].live_power", "number?", "live load times mechanism, should be 1"),
    Key("cases[].power_balance", "number?", "dissipation minus external power over the larger of the two"),
    Key("cases[].residuals", "object", "the first six of these once more"),
    Key("cases[].residuals.*", "number?", "equilibrium, yield, tension, penetration, complementarity, slip"),
)

EFFORT = (
    Key("cases[].programs", "integer", "programs solved"),
    Key("cases[].iterations", "integer", "their iterations"),
    Key("cases[].solver", "object", "who solved them"),
    Key("cases[].solver.asked", "string?", "as in analysis.solver"),
    Key("cases[].solver.used", "list", "solvers that took programs"),
    Key("cases[].solver.used[]", "string", "a solver"),
    Key("cases[].solver.factorization", "list", "libraries that factorised their linear systems"),
    Key("cases[].solver.factorization[]", "string", "a library"),
    Key("cases[].size", "object?", "what reached the solver"),
    Key("cases[].size.dimension", "integer", "2 where it was solved as planar, else 3"),
    Key("cases[].size.mirror_planes", "integer", "planes of symmetry that were used"),
    Key("cases[].size.parts", "integer", "parts that cannot interact, solved apart"),
    Key("cases[].size.free_blocks", "integer", "blocks with unknowns"),
    Key("cases[].size.contact_points", "integer", "contact points with unknowns"),
    Key("cases[].size.dropped_points", "integer", "contact points that cannot matter, or follow by symmetry"),
    *reduction_keys("cases[].reductions"),
    Key("cases[].path", "list", "steps of the load path that was followed"),
    Key("cases[].path[]", "object", "a step"),
    Key("cases[].path[].step", "integer", "number of the step"),
    Key("cases[].path[].load_factor", "number?", "load factor there"),
    Key("cases[].path[].open", "integer", "contact points open"),
    Key("cases[].path[].slide", "integer", "contact points sliding"),
    Key("cases[].path[].residual", "number?", "how badly the state fits the law"),
    Key("cases[].time", "object", "what it took"),
    Key("cases[].time.total", "number?", "time of the solver stage", "time"),
    Key("cases[].time.solver", "number?", "time of the programs in it", "time"),
)

MECHANISM = (
    Key(_MECHANISM, "object?", "how it fails; null where the case has no result"),
    Key(
        f"{_MECHANISM}.class",
        "string",
        "in a word: sliding, twisting, overturning (parts turn on what rests), hinging (they hinge on each other), "
        "sliding and hinging, opening",
    ),
    Key(f"{_MECHANISM}.open", "integer", "contact points that open"),
    Key(f"{_MECHANISM}.slide", "integer", "contact points that slide"),
    Key(f"{_MECHANISM}.crush", "integer", "contact points that crush"),
    Key(f"{_MECHANISM}.stick", "integer", "contact points that do none of these"),
    Key(f"{_MECHANISM}.interfaces", "object", "interfaces by mode"),
    Key(f"{_MECHANISM}.interfaces.*", "integer", "interfaces that stick, slide, open, hinge, twist, crush"),
    Key(f"{_MECHANISM}.hinges", "integer", "interfaces that hinge"),
    Key(f"{_MECHANISM}.reach", "string", "local, partial or global"),
    Key(f"{_MECHANISM}.moving_blocks", "integer", "free blocks that move"),
    Key(f"{_MECHANISM}.moving_weight_share", "number", "their share of the weight of the free blocks"),
    Key(f"{_MECHANISM}.moving_parts", "integer", "rigid parts that move"),
    Key(f"{_MECHANISM}.parts", "list", "the heaviest of them, at most 100"),
    *part_keys(f"{_MECHANISM}.parts"),
    *FAILURE,
    Key(f"{_MECHANISM}.work", "object", "powers, with unit power of the live load"),
    Key(f"{_MECHANISM}.work.live", "number", "load factor times the power of the live load"),
    Key(f"{_MECHANISM}.work.dead", "number", "of the dead load, negative where weights are lifted"),
    Key(f"{_MECHANISM}.work.friction", "number", "dissipated by sliding under friction"),
    Key(f"{_MECHANISM}.work.cohesion", "number", "dissipated by sliding against cohesion"),
    Key(f"{_MECHANISM}.work.normal", "number", "dissipated by normal forces"),
    Key(f"{_MECHANISM}.work.joints", "object", "dissipated by joint law"),
    Key(f"{_MECHANISM}.work.joints.*", "number", "in the interfaces of a joint law"),
    Key(f"{_MECHANISM}.work.groups", "object", "of the loads by group"),
    Key(f"{_MECHANISM}.work.groups.*", "object", "of a group"),
    Key(f"{_MECHANISM}.work.groups.*.live", "number", "of the live load on it"),
    Key(f"{_MECHANISM}.work.groups.*.dead", "number", "of the dead load on it"),
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
    Key("model.near_misses", "integer", "`mbla check`: pairs of bodies that nearly touch"),
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
RUN_RECORD: tuple[Key, ...] = (*RUN, *MODEL, *CASE, *VERIFICATION, *EFFORT, *MECHANISM, *SERIES, *POSITIONS)
"""keys of the record of a run"""
RECORD: tuple[Key, ...] = (*RUN_RECORD, *CHECK)


def record_page() -> str:
    """The keys as a Markdown table, as it stands in schemas/results.md."""
    rows = ["| key | type | meaning |", "|---|---|---|"]
    return (
        "\n".join([*rows, *(f"| `{path}` | {kind} | {words} |" for path, kind, words in (k.item for k in RECORD))])
        + "\n"
    )
