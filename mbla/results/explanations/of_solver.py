"""What the solver stage remarks of its answers."""

from __future__ import annotations

from mbla.results.explanations.explanation import Explanation
from mbla.solution.associative.polyhedral import AGREE, AGREE_SHORT
from mbla.solution.part import SUSPECT

_OTHER = "Another scheme, or several with --set analysis.scheme=...; compare their load factors."

OF_NON_UNIQUE = (
    Explanation(
        "load-factor-not-unique",
        "notice",
        "Other states of the same law have other load factors.",
        "The figure is one of many; the kinematic bound limits all from above, nothing here proves the least.",
        "Sliding without normality: forces depend on how the structure was built and loaded.",
        "Read the range; search with scheme: lowest; allow for the spread (up to 10 % in walls with openings).",
    ),
    Explanation(
        "tries-disagree",
        "warning",
        "Several tries ended at different load factors.",
        "The figure may be off by as much as they lie apart.",
        "A scheme that cycles between states, or several interior paths.",
        _OTHER,
    ),
    Explanation(
        "law-missed",
        "notice",
        "The scheme ended near a state of the joint law, not in one.",
        "The load factor is good to about the share that the message gives; see law-residual.",
        "The steps did not come to rest within their number.",
        "More programs (analysis.proximal.max_programs), or another scheme.",
    ),
    Explanation(
        "associative-bounds-apart",
        "notice",
        "The proved bounds of the associative load factor are more than 1e-5 apart.",
        "Of the associative load factor given beside it; the one without normality is judged by its residuals alone. "
        "Of the two bounds the upper one holds for every flow rule.",
        "accuracy: draft, or a gap given in the deck; structures whose load factor is almost zero.",
        "accuracy: standard, where the associative load factor is wanted too.",
    ),
    Explanation(
        "range-not-computed",
        "notice",
        "The range of the load factor is not computed.",
        "How far the factor could range for this mechanism is not known.",
        "contact_model: convex; or a mechanism that misses the law by more than 1e-4.",
        "contact_model: concave gives a range, of its own law; a smaller residual, or accuracy: standard, a mechanism "
        "that it may be computed for.",
    ),
    Explanation(
        "range-not-found",
        "warning",
        "An end of the range of the load factor was not found.",
        "How far the factor could range in that direction is not known.",
        "The program for that end was not solved, or its forces miss the law.",
        _OTHER,
    ),
    Explanation(
        "range-not-verified",
        "warning",
        "An end of the range was found, but verification does not confirm it.",
        "It is not shown as verified; the load factor itself is judged apart.",
        "Its forces fit the mechanism less well than the factor's own.",
        _OTHER,
    ),
    Explanation(
        "force-range-not-found",
        "warning",
        "The range of normal forces was not found for some interfaces.",
        "None on the load factor.",
        "The program for these interfaces was not solved.",
        "Another solver.",
    ),
    Explanation(
        "least-forces-not-found",
        "notice",
        "Contact forces are those of the solver, not the least ones.",
        "None on the load factor; single forces depend on the solver.",
        "The program of least squares was not solved.",
        "Do not compare single forces with those of other runs.",
    ),
    Explanation(
        "lowest-search",
        "notice",
        "The search of scheme: lowest, what it tried and found.",
        "The figure is an upper bound of the least load factor without dilatancy, no proof of it.",
        "scheme: lowest.",
        "More seconds or another seed (analysis.lowest) may find lower ones.",
    ),
    Explanation(
        "lowest-search-not-begun",
        "warning",
        "The search for lower load factors did not begin.",
        "The figure is that of the scheme before it.",
        "The solution to start from does not fit the joint law.",
        _OTHER,
    ),
)

OF_PATH = (
    Explanation(
        "peak-on-path",
        "warning",
        "The structure stands under a greater load than the one at which it comes to rest once it moves.",
        "The peak is the collapse load, the lower figure what is left while the structure moves; see peak.",
        f"Looked for where the factor is below {SUSPECT:g} of the associative one.",
        "Design with the lower of both where the load stays.",
    ),
    Explanation(
        "peak-not-verified",
        "warning",
        "A peak of the load path was found, but its forces are not verified.",
        "It is not shown as the collapse load; the load factor reported is judged apart.",
        "Forces at the peak miss equilibrium or yield conditions.",
        "Use the load factor reported.",
    ),
    Explanation(
        "found-above-path",
        "notice",
        "The scheme came to a load factor above the load at which the structure no longer stands.",
        "The load factor given is a lower one, of the state at the end of the load path.",
        "Forces fit the joint law that no load brings about, as in joints that were open under the dead load.",
        "Nothing; the figure is on the safe side of the other.",
    ),
    Explanation(
        "path-not-seen",
        "warning",
        "Whether the structure stands on the way up to the load factor was not seen.",
        "It may collapse before: the figure may be on the unsafe side.",
        "No state of the load path was found somewhere on the way, or none under the dead load alone.",
        "See standing; scheme: path with more steps.",
    ),
    Explanation(
        "peak-not-seen",
        "warning",
        "The structure stands above the load factor, and where that ends was not seen.",
        "The collapse load may be higher than the figure, which is on the safe side.",
        "No state of the load path was found further up, or it goes on as far as it was followed.",
        "scheme: path with more steps.",
    ),
    Explanation(
        "peak-not-examined",
        "warning",
        "Whether the load rises above the load factor on its way was not examined.",
        "The load factor lies below 85 % of the associative one. The collapse load may be higher than the figure, "
        "which is on the safe side.",
        "accuracy: draft, or peak: false; or forces and velocities miss the law by more than 1e-4.",
        "accuracy: standard, or peak: true with a residual of 1e-4 or less.",
    ),
    Explanation(
        "below-passed-load",
        "warning",
        "The load factor lies below a load that the steps passed through.",
        "Between the two the structure moves to another state: it may not survive the way to the lower one.",
        "The structure gives way and comes to rest again.",
        "Look at the range and the peak; scheme: path follows the way.",
    ),
    Explanation(
        "locked-by-dilatancy",
        "notice",
        "With dilatancy friction locks the structure; without it joints give way.",
        "There is no associative factor and no kinematic bound: nothing limits the load factor from above.",
        "Joints that would have to lift what lies on them.",
        "Read the residuals; they alone speak for the factor.",
    ),
    Explanation(
        "proximal-for-published",
        "warning",
        "The published procedure could not start; the proximal scheme was used in its place.",
        "The figure is that of the proximal scheme.",
        "The structure locks with associative flow, so that there are no forces to start from.",
        "Nothing; do not cite the figure as that of the published procedure.",
    ),
    Explanation(
        "tilt-by-steps",
        "notice",
        "How the angle of a tilting table was found.",
        "The load factor is that of the change of loads from the level table; the angle is the figure to read.",
        "tilt in the live load.",
        "Nothing.",
    ),
    Explanation(
        "tilt-between-not-proved",
        "warning",
        "That the table does not collapse at a smaller angle was seen at some angles, not proved.",
        "A smaller angle of collapse is unlikely but possible.",
        "Loads that turn past the vertical, or cohesion.",
        "Ask for the load factor at chosen angles with gravity turned by hand.",
    ),
)

OF_OPINIONS = (
    Explanation(
        "second-opinion-agrees",
        "notice",
        "Another solver gives the same load factor.",
        f"The figures agree to {AGREE:g} ({AGREE_SHORT:g} where the other solver stopped early).",
        "second_opinion: true, or polyhedral friction.",
        "Nothing.",
    ),
    Explanation(
        "second-opinion-differs",
        "warning",
        "Another solver gives another load factor.",
        f"The case is not verified: figures of two solvers may differ by {AGREE:g} at most.",
        "One of the two has failed.",
        "The bounds say which: believe the figure between them. Report it with the deck.",
    ),
    Explanation(
        "second-opinion-missing",
        "warning",
        "Another solver came to no answer.",
        "The case is approximate at best, since nothing confirms it as was asked.",
        "A hard program, or a limit of time.",
        "accuracy: reference, or give more time.",
    ),
    Explanation(
        "polyhedral-bracket",
        "notice",
        "The factors with the inscribed and the circumscribed friction polyhedron.",
        "The factor of the circular cone lies between them.",
        "friction_cone: polyhedral.",
        "Raise analysis.sides to narrow it, or use friction_cone: circular.",
    ),
    Explanation(
        "livesley-confirms",
        "notice",
        "The associative forces bear a mechanism without dilatancy too.",
        "The associative factor holds for sliding without dilatancy.",
        "flow_rule: livesley.",
        "Nothing.",
    ),
    Explanation(
        "livesley-polyhedral",
        "warning",
        "The mechanism without dilatancy belongs to the forces by the law of the polyhedron, not of the cone.",
        "The factor holds to about the residual given.",
        "Few sides of the friction polyhedron.",
        "Raise analysis.sides.",
    ),
    Explanation(
        "livesley-overstates",
        "warning",
        "No mechanism without dilatancy belongs to the associative forces.",
        "The factor may overstate the collapse load: on the unsafe side.",
        "Joints slide and lift in the associative mechanism.",
        "flow_rule: non_associative.",
    ),
    Explanation(
        "solver-remark",
        "notice",
        "The solver remarks something that has no identifier of its own.",
        "The message says what.",
        "See the message.",
        "See the message.",
    ),
)

OF_SOLVER = (*OF_NON_UNIQUE, *OF_PATH, *OF_OPINIONS)
