"""Quantities of a load case that the result file holds: loads, answers, checks, and how it was solved."""

from __future__ import annotations

from mbla.results.record.quantity import (
    CLAIMED,
    COURSE,
    FALLS,
    PASSED,
    SEARCHES,
    STANDING,
    TIMES,
    WORDS,
    Quantity,
    at,
    flag,
    real,
    text,
    whole,
)
from mbla.solution.solution import PROVED_STANDING

ANSWERS = {
    "mechanics": ("", "by the deck's flow rule"),
    "associative": ("/associative", "by the associative flow rule, where that is not the deck's"),
    "lower": ("/lower", "the least for the mechanism found"),
    "upper": ("/upper", "the greatest for the mechanism found"),
    "peak": ("/peak", "the greatest of the load path, passed before the structure comes to rest"),
    "outer": ("/outer", "with the circumscribed friction polyhedron"),
    "level": ("/level", "of the level table with the load across, by the associative flow rule"),
}
"""answers of a solution: group below the load case, and whose forces and velocities they are"""
REDUCED = {
    "unknowns": "velocities in the programs with live load",
    "cones": "friction cones in these, one a contact point",
    "entries": "entries of their equilibrium matrices, other than zero",
    "largest": "unknowns of the largest of them",
}
"""sizes that a reduction changes"""


def _messages(place: str, words: str, dimension: str, told: str = "") -> tuple[Quantity, ...]:
    """Columns of what a solution says of itself, sentence by sentence."""
    identifier = text("identifier", f"{words}: stable identifier, as `mbla explain` takes it", dimension)
    return at(place, identifier, text("message", f"{words}: in words", dimension), part="solution", told=told)


def _answer(part: str, group: str, whose: str) -> tuple[Quantity, ...]:
    told = PASSED if part == "peak" else ""
    convex = "convex contact model:"
    return (
        *at(
            f"cases/*{group}",
            real("load_factor", f"load factor, {whose}"),
            real(
                "contact_forces",
                "contact force N, T1, T2 on body b in the point's frame, compression positive",
                "force",
                "point direction",
            ),
            real(
                "contact_velocities",
                "velocity of body b relative to a in the point's frame, opening positive",
                "velocity",
                "point direction",
                told=told,
            ),
            real(
                "mechanism",
                "velocity and angular velocity about the centroid, live load power = 1",
                "velocities",
                "block component",
                told=told,
            ),
            whole("modes", "contact mode: 0 stick, 1 slide, 2 open, 3 crush", "point", told=told),
            real(
                "residual",
                "by how much these forces and velocities violate the joint law at most, nan where nothing moves",
                open=True,
            ),
            part=part,
        ),
        *at(
            f"cases/*{group}",
            real(
                "resultants",
                f"{convex} N, T1, T2 and moments about normal, tangent 1, tangent 2 at the centroid, on body b",
                "load",
                "interface component",
            ),
            *(
                real(
                    f"{name}_motions",
                    f"{convex} motion of the interface that {name} allows it, dual to the resultants",
                    "velocities",
                    "interface component",
                )
                for name in ("torsion", "crushing")
            ),
            part=f"{part} resultants",
        ),
    )


OF_CASE: tuple[Quantity, ...] = (
    *at(
        "cases/*",
        real("dead_load", "dead force and moment about the centroid", "load", "block component"),
        real("live_load", "live force and moment about the centroid", "load", "block component"),
        text("dead_words", "dead loads in words", "dead_item"),
        text("live_words", "live loads in words", "live_item"),
    ),
    *at(
        "cases/*/travel",
        text("series", "name of the load case in the deck, of which this is one position"),
        whole("number", "number of the position, from 1"),
        whole("count", "positions on the path"),
        real("load_points", "where each axle stands, or the only force", "length", "axle axis"),
        real("distances", "of each from the beginning of the path, the first one first", "length", "axle"),
        real("forces", "force of each; off the path it does not act", "force", "axle axis"),
        whole("carrying_blocks", "the block that carries each; -1 off the path", "axle"),
        part="travel",
    ),
    *at(
        "cases/*/tilt",
        real("turning_axis", "unit vector about which the table turns, by the right hand", "1", "axis"),
        real("fixed", "dead load that does not turn", "load", "block component"),
        real("turning", "dead load that turns, while the table is level", "load", "block component"),
        real("across", "the same after a turn of 90 degrees", "load", "block component"),
        real("angle", "angle of collapse, to which live_load leads; nan: none, or see tangent", "degree", open=True),
        real("upright", "proved multiple of `across` that the level table bears, inf: any, nan: not known", open=True),
        flag("tangent", "1 where the load factor is the tangent of the angle"),
        part="tilt",
    ),
    *at(
        "cases/*/settlement",
        whole("blocks", "fixed blocks that give way under this case", "settling_block", index_of="block"),
        real(
            "motions",
            "their velocity and angular velocity in the unit motion of the support",
            "motion",
            "settling_block component",
        ),
        flag("turns", "1: the support turns, its reaction is a moment"),
        text("words", "the settlement in words"),
        real(
            "reference",
            "reaction at rest, a force or a moment; reaction = reference - load factor x unit",
            "load",
            open=True,
        ),
        real("unit", "unit of the loss of reaction", "load"),
        part="settlement",
    ),
    *at(
        "cases/*",
        real(
            "reaction", "reaction of the support at which the structure follows it, positive against the motion", "load"
        ),
        part="reaction",
    ),
    *at(
        "cases/*",
        text("status", "status of the case after verification"),
        text(
            "claimed_status",
            "status that the solver stage claimed, which figures can lower and not raise",
            told=CLAIMED,
        ),
        text("flow_rule", "flow rule of load_factor, contact_forces and mechanism"),
        text("contact_model", "concave, or convex: interface resultants"),
        flag("stress_blocks", "1 where interfaces crush as fields of stress do"),
        text("scheme", "how a flow without normality was solved; empty: associative", told=COURSE),
        text("reason", "why it is not plainly solved, in words", told=WORDS),
        real("seconds", "time of the solver stage", "time", told=TIMES),
        whole("sides", "of the friction polyhedron, 0: circular cone"),
        part="solution",
    ),
    *_messages("cases/*/remarks", "what a reader of the figure must know", "remark", told=WORDS),
    *(each for part, (group, whose) in ANSWERS.items() for each in _answer(part, group, whose)),
    *at(
        "cases/*",
        whole(
            "parts",
            "rigid part of each block, 0 at rest, 1 the heaviest; follows from the mechanism",
            "block",
        ),
        part="mechanics",
    ),
    *at(
        "cases/*/interfaces",
        whole(
            "modes",
            "mode: 0 stick, 1 slide, 2 open, 3 hinge, 4 twist, 5 crush; follows from the mechanism",
            "interface",
        ),
        real("translations", "velocity of b relative to a at the centroid", "velocity", "interface axis"),
        real("rotations", "angular velocity of b relative to a", "rotation", "interface axis"),
        real(
            "hinge_points", "a point on the axis of a hinge, nan for other modes", "length", "interface axis", open=True
        ),
        real(
            "hinge_directions",
            "its direction, by the right hand for b against a, nan for other modes",
            "1",
            "interface axis",
            open=True,
        ),
        real(
            "work",
            "power dissipated; that of the live load is the load factor",
            "1",
            "interface",
        ),
        part="mechanics",
    ),
    *at(
        "cases/*",
        real(
            "certificate",
            "no equilibrium: motion in which the dead load does work and no joint resists",
            "motion",
            "block component",
        ),
        part="certificate",
    ),
    *at(
        "cases/*",
        real(
            "certificate_torsion_motions",
            "convex contact model: motion of the interfaces by torsion that belongs to the certificate",
            "motion",
            "interface component",
        ),
        real(
            "certificate_crushing_motions",
            "convex contact model: motion of the interfaces by crushing that belongs to the certificate",
            "motion",
            "interface component",
        ),
        part="certificate motions",
    ),
    *at(
        "cases/*",
        real(
            "lock",
            "unbounded: contact forces within the yield conditions that balance the live load alone",
            "force",
            "point direction",
        ),
        part="lock",
    ),
    *at(
        "cases/*/level",
        real(
            "lock",
            "level table: contact forces within the yield conditions that balance the load across alone",
            "force",
            "point direction",
        ),
        part="level lock",
    ),
    *at(
        "cases/*",
        real("spread", "least and greatest load factor of several tries that did not agree", "1", "end", told=SEARCHES),
        part="spread",
    ),
    *at(
        "cases/*",
        real(
            "asked",
            "gap or residual that the deck asks for, of a case that is approximate for no other reason",
        ),
        part="asked",
    ),
    *at(
        "cases/*",
        real(
            "force_ranges",
            "least and greatest normal force at the load factor, inf: unlimited, nan: not found",
            "force",
            "interface end",
            open=True,
            told=SEARCHES,
        ),
        part="force_ranges",
    ),
    *at(
        "cases/*/standing",
        text(
            "verdict",
            "whether it stands under its dead load alone: yes, no, only by self-stress, doubtful",
            told=STANDING,
            proved=tuple(verdict.value for verdict in PROVED_STANDING),
        ),
        whole(
            "falls",
            "the block that falls or would fall first; no entry where none does",
            "falling_block",
            index_of="block",
            told=FALLS,
        ),
        text("reason", "why, in words", told=WORDS),
        part="standing",
    ),
    *at(
        "cases/*/standing",
        real(
            "contact_forces",
            "contact forces under the dead load alone, from the stress-free assembly",
            "force",
            "point direction",
        ),
        real(
            "settlement",
            "displacements and rotations that bring them about on joints of unit stiffness",
            "displacement",
            "block component",
        ),
        part="standing proof",
    ),
    *at(
        "cases/*/size",
        whole("dimension", "2 where it was solved as planar, else 3"),
        whole("mirror_planes", "planes of symmetry that were used besides"),
        whole("parts", "parts that cannot interact, solved apart"),
        whole("free_blocks", "blocks with unknowns"),
        whole("contact_points", "contact points with unknowns"),
        whole("dropped_points", "contact points that cannot matter, or follow from others by symmetry"),
        part="size",
        told=COURSE,
    ),
    *at(
        "cases/*/reductions",
        text("name", "planar, mirror, parts, unloaded, points, or glued", "reduction"),
        text("state", "applied, nothing found, switched off, would change the answer", "reduction"),
        whole("found", "contact points or blocks left out, or parts taken apart or reduced", "reduction"),
        *(
            whole(f"{name}_{when}", f"{words}, {when} it", "reduction")
            for when in ("before", "after")
            for name, words in REDUCED.items()
        ),
        part="reductions",
        told=COURSE,
    ),
    *at(
        "cases/*/path",
        whole("step", "step of the load path", "path_row"),
        real("load_factor", "load factor there", "1", "path_row", open=True),
        whole("open", "contact points open", "path_row"),
        whole("slide", "contact points sliding", "path_row"),
        real("residual", "how badly the state fits the law", "1", "path_row", open=True),
        part="solution",
        told=COURSE,
    ),
    *at(
        "cases/*",
        real("equilibrium_residual", "largest unbalanced force over mean block weight", open=True),
        real("yield_violation", "largest excess over the joint's strength over mean block weight", open=True),
        real("tension_violation", "largest tension beyond the tensile strength over mean block weight", open=True),
        real("penetration", "largest closing velocity over largest contact speed", open=True),
        real("complementarity_residual", "share of the power balance left unexplained under the flow rule", open=True),
        real("slip_residual", "the part of it that sliding against friction leaves unexplained", open=True),
        real("live_power", "live load times mechanism, should be 1", open=True),
        real("power_balance", "dissipation minus external power over the larger of the two", open=True),
        real("static_bound", "lower bound of the associative load factor", open=True),
        real("kinematic_bound", "upper bound of the associative load factor", open=True),
        real("gap", "relative distance of the two bounds", open=True),
        real(
            "peak_load_factor",
            "verified greatest load factor of the load path, where above the load factor",
            open=True,
        ),
        part="solution",
    ),
    *at(
        "cases/*",
        real(
            "least_load_factor",
            "least load factor that was found; the load factor where that is the only one",
            open=True,
        ),
        real("greatest_load_factor", "the greatest of them, inf: there is no limit", open=True),
        part="extent",
    ),
    *at(
        "cases/*",
        real(
            "range", "verified least and greatest load factor for the mechanism found, nan: none", "1", "end", open=True
        ),
        flag("verified", "1 where everything is within tolerance"),
        part="solution",
    ),
    *_messages("cases/*/failures", "what is not", "failure"),
    *at(
        "cases/*/programs",
        whole("program", "number of the program, from 1", "program_row"),
        text("kind", "what it is for", "program_row"),
        text("status", "its status", "program_row"),
        real("load_factor", "its load factor", "1", "program_row", open=True),
        real("change", "relative change of the load factor", "1", "program_row", open=True),
        whole("iterations", "its iterations", "program_row"),
        real("seconds", "its time", "time", "program_row", open=True),
        text("solver", "mbla, clarabel or highs; empty: steps of the joint law", "program_row"),
        text(
            "factorization",
            "library that factorised its linear systems; empty: none",
            "program_row",
        ),
        part="solution",
        told=COURSE,
    ),
    *at(
        "cases/*",
        text("solver", "solver asked for, as analysis.solver"),
        part="solution",
    ),
    *at(
        "cases/*/iterations",
        whole("program", "number of the program", "iteration_row"),
        whole("iteration", "iteration within it", "iteration_row"),
        real("load_factor", "load factor at this iteration", "1", "iteration_row", open=True),
        real("gap", "relative gap of the program", "1", "iteration_row", open=True),
        real("primal_residual", "primal residual of the program", "1", "iteration_row", open=True),
        real("dual_residual", "dual residual of the program", "1", "iteration_row", open=True),
        real("step", "length of the step taken", "1", "iteration_row", open=True),
        real("seconds", "time since the program began", "time", "iteration_row", open=True),
        part="solution",
        told=COURSE,
    ),
)
"""``parts`` and ``interfaces`` are written for others to read; mbla finds them anew from forces and mechanism, so that
nothing can contradict these"""
