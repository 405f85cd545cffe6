"""The table of metamorphic checks: what is done to a scene, and how its load factor may move, with the reason.

Under associative flow the load factor is the value of a convex program, unique, and

- whatever states the same mechanics in another way leaves it (EQUAL);
- whatever admits more forces, or fewer motions, never lowers it (RISES): static and kinematic theorem;
- whatever admits fewer forces, or more motions, never raises it (FALLS).

Without normality the factor is not unique and none of the monotonic statements is a theorem: more friction, glue or
strength may lower the factor that a scheme comes to rest on. What remains is EQUAL up to the choice of a state
(:mod:`tests.properties.comparisons`).
"""

from __future__ import annotations

from tests.properties import alterations, restatements
from tests.properties.alterations import with_joints
from tests.properties.comparisons import Relation, Transformation

E_, R_, F_ = Relation.EQUAL, Relation.RISES, Relation.FALLS
TABLE = (
    Transformation("translate", E_, "statics knows no origin", restatements.translate),
    Transformation(
        "rotate with gravity",
        E_,
        "statics knows no axes",
        restatements.rotate,
        any_flow=True,
        turn=restatements.turn_of,
    ),
    Transformation(
        "mirror",
        E_,
        "forces mirror as vectors, moments as axial vectors",
        restatements.mirror,
        any_flow=True,
        turn=restatements.reflection,
    ),
    Transformation("renumber blocks", E_, "names carry nothing", restatements.renumber, any_flow=True),
    Transformation(
        "reverse the order of interfaces", E_, "sums do not know their order", restatements.reverse_interfaces
    ),
    Transformation(
        "live load times 8", E_, "the factor is inversely proportional", restatements.live_load_times(8.0), 0.125, True
    ),
    Transformation(
        "every load as two named loads, combined",
        E_,
        "loads add up, whatever they are called",
        restatements.named_loads,
    ),
    Transformation(
        "densities, forces, strengths times 37",
        E_,
        "equilibrium and yield are homogeneous",
        restatements.heavier,
        any_flow=True,
    ),
    Transformation(
        "split a block into two glued",
        E_,
        "a rigid body is its parts; the corners of a divided interface have the same hull as before, "
        "and without strengths only the hull of the contact points counts",
        alterations.split(0.0),
        any_flow=True,
    ),
    Transformation("split it askew", E_, "the same", alterations.split(0.35)),
    Transformation(
        "refine contact points, no strengths",
        E_,
        "a force at a point within the hull is a sum of forces of the same direction at its corners: the cone of all "
        "is the same. In torsion too: it may still gather at the corners",
        alterations.refine(strengths=False),
        any_flow=True,
    ),
    Transformation(
        "refine contact points, strengths",
        F_,
        "each share of area of a point comes from the corners around it, so that the corners bear what the refined "
        "points bear; a theorem for triangles and parallelograms, whose corner shares the moments alone decide",
        alterations.refine(strengths=True),
    ),
    Transformation("without reductions", E_, "reductions are exact", restatements.unreduced),
    Transformation("another cone solver", E_, "the optimum is one", restatements.other_solver),
    Transformation("friction times 1.2", R_, "a wider cone", with_joints(lambda j, _: {"friction": 1.2 * j.friction})),
    Transformation(
        "cohesion added", R_, "more shear is borne", with_joints(lambda j, s: {"cohesion": j.cohesion + 0.1 * s})
    ),
    Transformation(
        "tensile strength added, with the cohesion it asks for",
        R_,
        "tension is borne",
        with_joints(
            lambda j, s: {
                "tensile_strength": j.tensile_strength + 0.1 * s,
                "cohesion": j.cohesion + 0.1 * s * j.friction,
            }
        ),
    ),
    Transformation(
        "compressive strength lowered",
        F_,
        "less compression is borne",
        with_joints(lambda j, s: {"compressive_strength": 0.8 * min(j.compressive_strength, 50.0 * s)}),
    ),
    Transformation("fix a block", R_, "fewer motions", alterations.fix_a_block),
    Transformation("open an interface", F_, "one force less", alterations.open_an_interface),
    Transformation(
        "convex contact model", F_, "conditions on resultants are added to those on points", alterations.convex_model
    ),
)
