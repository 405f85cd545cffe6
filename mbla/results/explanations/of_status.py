"""Statuses of load cases, verdicts on standing, modes of joints."""

from __future__ import annotations

from mbla.results.collapse.interface_modes import TOGETHER
from mbla.results.explanations.explanation import Explanation
from mbla.results.outcome import CLEAN_RESIDUAL
from mbla.solution.verification.verify import APPROXIMATE_RESIDUAL, GAP_TOLERANCE, SOLVED_RESIDUAL

OF_STATUS = (
    Explanation(
        "solved",
        "status of a load case",
        "The load factor is verified.",
        f"Associative flow: it lies between proved bounds at most {GAP_TOLERANCE:g} of it apart. Other flow: forces "
        f"and velocities fit the joint law to {CLEAN_RESIDUAL:g}, or to {SOLVED_RESIDUAL:g} with a warning.",
        "The solver ended, and verification recomputed everything from model, contacts and solution.",
        "Without associative flow the factor need not be unique: read the range, and the standing.",
    ),
    Explanation(
        "approximate",
        "status of a load case",
        "The load factor is a result, but a rough one.",
        f"Associative flow: proved bounds up to {APPROXIMATE_RESIDUAL:g} of it apart, or a polyhedral bracket wider "
        f"than {GAP_TOLERANCE:g}. Other flow: residuals up to {APPROXIMATE_RESIDUAL:g}, so that the factor is good to "
        "about that share.",
        "The solver stalled, a scheme did not come to rest, or a second opinion came to no answer; or the deck asks "
        "for no more: accuracy: draft, a wide gap, a large residual.",
        "Decide with the kinematic bound, which holds all the same. accuracy: standard or reference, another solver or "
        "scheme, or more sides of a polyhedron may solve it. Exit status 4, but 0 where bounds or residuals are within "
        "the gap or residual that the deck asks for (asked in JSON).",
    ),
    Explanation(
        "not-verified",
        "status of a load case",
        "There is no load factor: what was found does not hold.",
        "The best iterate is shown with its residuals and must not be used. The kinematic bound of the associative "
        "factor, where there is one, limits every load factor from above.",
        f"Residuals above {APPROXIMATE_RESIDUAL:g}, bounds further apart than that, a proof that does not hold, or a "
        "second opinion that contradicts.",
        "Look at the failures under verification. Try another scheme or solver, accuracy: reference, or a simpler "
        "model. Exit status 4.",
        aliases=("not_verified",),
    ),
    Explanation(
        "no-equilibrium",
        "status of a load case",
        "The dead load alone is not carried: the structure falls without any live load.",
        "There is no load factor. A motion proves it, in which the dead load does more work than the joints dissipate.",
        "Missing contacts or supports, too little friction, a wrong unit; or the structure really falls.",
        "Look at the motion: the block that falls first shows what is missing. Read near-misses, isolated-blocks and "
        "unsupported-parts. Exit status 5.",
        aliases=("no_equilibrium",),
    ),
    Explanation(
        "unbounded",
        "status of a load case",
        "No multiple of the live load brings the structure down.",
        "There is no load factor; forces prove it that balance the live load alone within the friction of the joints.",
        "Friction locks the structure in the direction of the load, mostly with associative flow, which lifts what "
        "slides; or the live load presses the structure onto its supports.",
        "Check the direction of the live load. Without dilatancy (flow_rule: non_associative) joints may still give "
        "way. Exit status 5.",
    ),
    Explanation(
        "iteration-limit",
        "status of a load case",
        "The solver ran out of iterations.",
        "There is no load factor; a kinematic bound, where there is one, holds.",
        "An ill-conditioned program, or a low limit of iterations.",
        "Another solver, accuracy: reference, or a higher limit. Exit status 4.",
        aliases=("iteration_limit",),
    ),
    Explanation(
        "time-limit",
        "status of a load case",
        "The time that was allowed ran out.",
        "There is no load factor; a kinematic bound, where there is one, holds.",
        "--time-limit or analysis.time_limit, which hold for all load cases together.",
        "Give more time, run single cases with --case, use symmetry or accuracy: draft. Exit status 7.",
        aliases=("time_limit",),
    ),
    Explanation(
        "numerical-error",
        "status of a load case",
        "The solver failed numerically.",
        "There is no load factor.",
        "Loads or strengths of very different sizes, blocks of very different weights, slivers.",
        "Another solver; look at the block sizes, densities and strengths in the listing. Exit status 4.",
        aliases=("numerical_error",),
    ),
)

OF_STANDING = (
    Explanation(
        "standing-yes",
        "standing",
        "The dead load is carried from the stress-free assembly.",
        "The load factor counts from a state that comes about by itself.",
        "Forces and displacements were found that bring each other about, and are verified.",
        "Nothing.",
        aliases=("yes",),
    ),
    Explanation(
        "only-by-self-stress",
        "standing",
        "The structure stands only by forces locked in before it is loaded.",
        "Without associative flow its load factor is no collapse load and is not given as one.",
        "Blocks are held between others by friction alone, as a bar clamped between walls; nothing presses them there.",
        "If they were built in under pressure, model that pressure as a dead load. Else provide a bearing.",
        aliases=("only by self-stress",),
    ),
    Explanation(
        "standing-no",
        "standing",
        "The structure does not stand under its dead load.",
        "There is no load factor.",
        "See no-equilibrium; the block that falls first is named.",
        "See no-equilibrium.",
        aliases=("no",),
    ),
    Explanation(
        "standing-doubtful",
        "standing",
        "Whether the structure stands without forces locked in could not be decided.",
        "The load factor presumes that it does.",
        "It stands by a hair: springs of different stiffness in the joints give different verdicts.",
        "Vary friction and geometry a little; treat the factor as that of a structure at its limit.",
        aliases=("doubtful",),
    ),
)

OF_MODES = (
    Explanation(
        "stick",
        "mode",
        "Nothing moves in the joint.",
        f"Motions up to {TOGETHER:g} of the largest contact speed count as none: less is not known.",
        "Normal force, and shear below friction.",
        "Nothing.",
    ),
    Explanation(
        "slide",
        "mode",
        "The joint slides along its surface.",
        "Friction is used up there and dissipates; without dilatancy it does not lift.",
        "Shear as large as friction allows.",
        "More friction, or dowels, raise the factor where sliding has a large share of the work.",
    ),
    Explanation(
        "open",
        "mode",
        "The joint opens: all its contact points, or without tilting.",
        "Nothing is carried there but tensile strength.",
        "No compression is left.",
        "Ties across the joint raise the factor.",
    ),
    Explanation(
        "hinge",
        "mode",
        "Some contact points open, others stay closed: the joint turns about an axis.",
        "The resultant passes at the axis, mostly an edge. With blocks of unlimited strength it stands on a line.",
        "The line of thrust has reached the edge of the joint.",
        "Thicker blocks raise the factor; a compressive strength moves the hinge inwards and lowers it.",
    ),
    Explanation(
        "twist",
        "mode",
        "The joint slides by turning about its normal.",
        "contact_model: concave with points at corners overstates its torsion, by 85 % for a square.",
        "A load beside the shear centre of the joint.",
        "contact_model: convex, or contacts.points.inset.",
    ),
    Explanation(
        "crush",
        "mode",
        "Points of the joint close into each other, and none opens; at a hinge those beside its axis do.",
        "The compressive strength is reached over the part that closes, and dissipates.",
        "Much compression over little area.",
        "A greater compressive strength, or a wider joint, raises the factor.",
    ),
)
