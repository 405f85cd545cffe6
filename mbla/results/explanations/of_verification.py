"""What verification can find wrong, and the residuals and bounds that the listing shows."""

from __future__ import annotations

from mbla.results.explanations.explanation import Explanation
from mbla.results.outcome import CLEAN_RESIDUAL, UNIQUE
from mbla.solution.verification.verify import (
    APPROXIMATE_RESIDUAL,
    GAP_TOLERANCE,
    LIVE_POWER,
    SOLVED_EQUILIBRIUM,
    SOLVED_RESIDUAL,
)
from mbla.solution.verification.verify_lock import LASTING
from mbla.solution.verification.verify_peak import CARRIED
from mbla.solution.verification.verify_range import END_RESIDUAL
from mbla.solution.verification.verify_standing import UNBALANCED
from mbla.solution.verification.verify_tilt import SAME

_LIMITS = f"At most {SOLVED_RESIDUAL:g} counts as solved, {APPROXIMATE_RESIDUAL:g} as approximate."
_TRY = "Another scheme or solver, or accuracy: reference. Look for blocks of very different weight and for slivers."
_REPORT = "Report it with the deck: the answer does not fit what the program itself claims."
_STALLED = "The solver stopped before it was there."

OF_MAGNITUDES = (
    Explanation(
        "magnitudes-far-apart",
        "warning",
        "Loads of blocks, the strength of joints and the loads, friction and normal forces, or what slides an "
        "interface and what tips a block on it, lie so far apart that double precision is at its end.",
        "What light blocks carry is lost in the rounding of the forces on heavy ones: the load factor is not verified, "
        "or only roughly.",
        "Densities in a wrong unit, slivers as blocks, a strength, or a friction on narrow interfaces, that is meant "
        "to be unlimited.",
        "Correct the densities; glue slivers to their neighbours; give a joint that is not to fail `glued`, or a "
        "strength of some thousand times the stress instead of 1e9 times; friction of 1e3 holds like one of 1e6, "
        "and `frictionless` slides like one of 1e-9.",
        example="push: loads of blocks lie 1e+12 apart: beyond what sixteen digits hold apart",
    ),
    Explanation(
        "load-factor-rounding",
        "notice",
        "The load factor is so small beside dead over live load that forces cannot tell it from zero.",
        "Read it as zero to within the figure of the message; its digits mean nothing.",
        "Hardly any friction, a structure at the limit of what stands, or a live load far larger than the dead load "
        "on blocks that are next to weightless.",
        "None, where the structure has no margin; else look at the units of loads and densities.",
    ),
)

OF_RESIDUALS = (
    Explanation(
        "equilibrium-residual",
        "verification",
        "Largest unbalanced force (or moment over the lever arm) of a block, over the mean load of a block, or over "
        "what the block itself has to balance where that is less.",
        f"The load factor is good to about that share. At most {SOLVED_EQUILIBRIUM:g} counts as solved, "
        f"{APPROXIMATE_RESIDUAL:g} as approximate.",
        _STALLED,
        _TRY,
        aliases=("equilibrium residual", "equilibrium_residual"),
    ),
    Explanation(
        "yield-violation",
        "verification",
        "Largest excess of shear, tension or compression over its limit, over the mean load of a block.",
        f"The forces need that much more strength than there is: the factor may be too high. {_LIMITS}",
        _STALLED,
        _TRY,
        aliases=("yield violation", "yield_violation"),
    ),
    Explanation(
        "tension-violation",
        "figure",
        "The part of the yield violation that is tension beyond the tensile strength.",
        "As yield-violation.",
        _STALLED,
        _TRY,
        aliases=("tension violation", "tension_violation"),
    ),
    Explanation(
        "penetration",
        "verification",
        "Largest velocity with which bodies enter each other, or leave their guide, over the largest contact speed.",
        f"The mechanism is not quite possible: the factor may be off by about that share. {_LIMITS}",
        _STALLED,
        _TRY,
    ),
    Explanation(
        "complementarity-residual",
        "verification",
        "Share of the power balance that forces and velocities leave unexplained under the flow rule.",
        f"Forces and mechanism do not belong to each other by that share of the factor. {_LIMITS}",
        "A scheme without normality did not come to rest; joints open under force or slide with friction to spare.",
        _TRY,
        aliases=("complementarity residual", "complementarity_residual"),
    ),
    Explanation(
        "slip-residual",
        "figure",
        "The part of the complementarity residual that is sliding not against friction.",
        "As complementarity-residual.",
        "A scheme without normality did not come to rest.",
        _TRY,
        aliases=("slip residual", "slip_residual"),
    ),
    Explanation(
        "power-balance",
        "verification",
        "Difference of external and dissipated power, over the larger of the two.",
        f"The factor is good to about that share. {_LIMITS}",
        _STALLED,
        _TRY,
        aliases=("power balance", "power_balance"),
    ),
    Explanation(
        "live-power",
        "verification",
        "Power of the live load on the mechanism, which should be 1.",
        f"The mechanism has another size than it claims; {LIVE_POWER:g} is allowed.",
        _STALLED,
        _TRY,
        aliases=("live_power",),
    ),
    Explanation(
        "law-residual",
        "warning",
        f"Forces and velocities of a case without associative flow miss the joint law by more than {CLEAN_RESIDUAL:g}.",
        f"The load factor counts as solved up to {SOLVED_RESIDUAL:g}, but is good to about that share only.",
        "The scheme came near a state of the law, not quite to it.",
        "Nothing, if the share does not matter; else another scheme.",
    ),
)

OF_BOUNDS = (
    Explanation(
        "static-bound",
        "figure",
        "A load factor that repaired forces prove the structure to carry with associative flow.",
        "The associative factor is no less. It says nothing of flow without normality, whose factor may be lower.",
        "Forces in exact equilibrium inside every yield condition.",
        "Nothing.",
        aliases=("static bound", "static_bound", "associative, static bound"),
    ),
    Explanation(
        "kinematic-bound",
        "figure",
        "A load factor that a repaired mechanism proves the structure not to exceed.",
        "It limits the load factor of every flow rule from above, whatever the solver did.",
        "A compatible mechanism and the work of the loads in it.",
        "Use it to decide where there is no verified factor.",
        aliases=("kinematic bound", "kinematic_bound", "associative, kinematic bound"),
    ),
    Explanation(
        "gap",
        "figure",
        "Distance of static and kinematic bound, relative to the load factor.",
        f"Up to {GAP_TOLERANCE:g} an associative factor is solved, up to {APPROXIMATE_RESIDUAL:g} approximate.",
        "How sharply the program was solved; with polyhedral friction how many sides there are.",
        "Below the tolerance nothing.",
        aliases=("relative gap",),
    ),
    Explanation(
        "range",
        "figure",
        "Least and greatest load factor of a flow without normality for the mechanism found, each end verified.",
        f"Ends closer than {UNIQUE:g} are one figure. Other mechanisms may reach lower: the lower end is no proof of "
        f"the least. Each end fits the law to {END_RESIDUAL:g}.",
        "Without normality forces are not unique, and so is the load factor.",
        "Decide with the lower end; scheme: lowest searches for lower ones.",
        aliases=("range for this mechanism", "lower", "upper"),
    ),
    Explanation(
        "peak",
        "figure",
        "A greater load factor that the load path passes before the structure comes to rest at the one reported.",
        f"It is the collapse load: forces at it are verified to {CARRIED:g}. What is reported as load factor is what "
        "the structure still carries while it moves.",
        "The structure softens as it moves: wedged or clamped blocks come loose.",
        "Design with the lower of both where the load stays.",
    ),
    Explanation(
        "bounds-apart",
        "verification",
        f"Static and kinematic bound of the associative factor lie further apart than {GAP_TOLERANCE:g}.",
        "The factor lies between them; both hold.",
        _STALLED,
        _TRY,
    ),
    Explanation(
        "outside-bounds",
        "verification",
        "The load factor does not lie between its proved bounds.",
        "The bounds hold, the factor does not.",
        _STALLED,
        _TRY,
    ),
    Explanation(
        "above-kinematic-bound",
        "verification",
        "A load factor without normality exceeds the kinematic bound of the associative one.",
        "It cannot be: use the bound.",
        "A scheme ended in a state that is none of the law.",
        _TRY,
    ),
    Explanation(
        "bracket-not-proved",
        "verification",
        "The inscribed or the circumscribed friction polyhedron claims more than its forces or mechanism prove.",
        "The bracket of the true cone is not to be trusted; the bounds beside it hold.",
        "One of the two linear programs was not solved to the end.",
        _TRY,
    ),
)

OF_PROOFS = (
    Explanation(
        "collapse-not-proved",
        "verification",
        "The motion that should show the lack of equilibrium does not.",
        "Whether the dead load is carried is open.",
        "The structure stands or falls by a hair, or the solver stalled.",
        "Vary friction and geometry a little. " + _TRY,
    ),
    Explanation(
        "lock-not-proved",
        "verification",
        "The forces that should show that the structure locks do not.",
        f"Whether there is a load factor is open; up to {LASTING:g} of the live load may be left unbalanced.",
        "The structure locks by a hair, or the solver stalled.",
        "Vary friction and geometry a little. " + _TRY,
    ),
    Explanation(
        "standing-not-proved",
        "verification",
        "The forces, displacements or motion that should show that the structure stands, or falls, do not.",
        f"Whether it stands is open; {UNBALANCED:g} of the load of a block may be left unbalanced.",
        "The structure stands by a hair.",
        "Vary friction and geometry a little.",
    ),
    Explanation(
        "tilt-not-proved",
        "verification",
        "The loads at collapse are not those of the tilting table at the angle given.",
        f"The angle does not hold; loads may differ by {SAME:g}.",
        "The search for the angle did not settle.",
        _TRY,
    ),
    Explanation(
        "glued-blocks-part",
        "verification",
        "Blocks that are glued to each other move apart in the mechanism.",
        "The mechanism is not one of the structure.",
        "A damaged or edited result file.",
        _REPORT,
    ),
    Explanation(
        "wrong-resultants",
        "verification",
        "The stored resultants of interfaces are not those of the contact forces.",
        "The convex contact model cannot be verified.",
        "A damaged or edited result file.",
        _REPORT,
    ),
    Explanation(
        "run-stopped",
        "warning",
        "The result file is of a run that was stopped: it has the load cases that were done before.",
        "Their figures are as good as those of a whole run. mbla verify returns 4, as load cases are missing.",
        "A signal (Ctrl-C, a batch system at its time limit), too little memory or a defect of the program ended it.",
        "Run the deck again: a whole result takes the place of STEM.partial.h5, .lst and .json. mbla run --case solves "
        "single load cases.",
    ),
    Explanation(
        "verification-failed",
        "verification",
        "Verification found something wrong that has no identifier of its own.",
        "The message says what.",
        "See the message.",
        _REPORT,
    ),
)

OF_VERIFICATION = (*OF_RESIDUALS, *OF_MAGNITUDES, *OF_BOUNDS, *OF_PROOFS)
