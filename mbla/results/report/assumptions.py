"""What a report takes for granted, in sentences for a reader who did not make the model."""

from __future__ import annotations

import math

import numpy as np

from mbla.model.model import Joint
from mbla.results.listing.text import number
from mbla.results.results import Results

SLIDING = {
    "associative": "A joint that slides is lifted by its friction angle (associative flow). The load factor is proved "
    "from both sides; joints that slide without lifting carry no more, and may carry less.",
    "non_associative": "A joint slides without lifting.",
    "dilatancy": "A joint that slides is lifted by the dilatancy of its joint law.",
    "livesley": "A joint that slides is lifted by its friction angle (associative flow); a second calculation shows "
    "whether a mechanism without lifting has the same load factor.",
}
"""by flow rule"""
BY_PATH = (
    "The load is raised from the stress-free structure, and the load factor is the greatest on that way. A structure "
    "that was moved or shaken before may carry less: where a smaller load factor was found it is given as least found, "
    "and the smaller of both is the one to design with."
)
STILL = "Equilibrium is that of the geometry as drawn: displacements before collapse are taken as small"
MOVED = "; pushovers alone follow the structure as it moves"
IN_TIME = (
    "In time blocks have their masses and joints are elastic: they press, open and slide without dilatancy, stiff as "
    "the deck says. All supports move as one with the base; blocks are followed as far as they move. How strongly "
    "vibration is damped is an assumption, too; near overturning small changes decide, and what one record does says "
    "little of others."
)


def assumptions(results: Results) -> list[str]:
    """Blocks, joints, sliding, supports, loads and geometry, a sentence or two each."""
    model, cases = results.model, results.cases
    pushed = any(case.solution.further.pushover.curve for case in cases)
    in_time = any(case.load_case.time_history is not None for case in cases)
    multiplied = [case for case in cases if case.load_case.question.multiplies]
    grounds = "Ground and fixed blocks are rigid and do not move, unless a load case says that a support gives way"
    grounds += f"{'; in time they move as the base does' * in_time}."
    live = "The dead load acts in full. The live load grows in proportion, up to the load factor times what is given."
    said = [
        "Blocks are rigid and do not break: the structure opens, slides and crushes at its joints alone.",
        *(_joint_words(joint, f"{model.units.force}/{model.units.length}2") for joint in model.joints.values()),
        *dict.fromkeys(SLIDING[case.solution.flow_rule] for case in cases if case.load_case.time_history is None),
        *([BY_PATH] if any(case.by_path for case in cases) else []),
        grounds,
        *([live] if multiplied else []),
        f"{STILL}{MOVED * pushed}." if any(case.load_case.has_load_factor for case in cases) or not in_time else "",
        IN_TIME if in_time else "",
        "Strengths, friction and loads count as given: no partial factor is applied to them but those of a code that "
        "is named.",
    ]
    return [words for words in said if words]


def _joint_words(joint: Joint, stress: str) -> str:
    """Friction with its angle, and strengths, of which most are none."""
    cohesion = f"cohesion {number(joint.cohesion)} {stress}" if joint.cohesion else "no cohesion"
    tension = f"tensile strength {number(joint.tensile_strength)} {stress}" if joint.tensile_strength else "no tension"
    crushes = f"compressive strength {number(joint.compressive_strength)} {stress}"
    unlimited = "compression without limit, so that crushing is not examined"
    return (
        f"Joints {joint.name}: friction coefficient {number(joint.friction)} "
        f"({math.degrees(math.atan(joint.friction)):.0f} degrees), {cohesion}, {tension}, "
        f"{unlimited if np.isinf(joint.compressive_strength) else crushes}."
    )
