"""What a deck asks of a load case besides: standing, sensitivity, geometric factor of safety, assessment by a code."""

from __future__ import annotations

from mbla.results.assessment import Figure
from mbla.results.quantities.group import Field, Group
from mbla.results.record.scene import Scene
from mbla.solution.further.geometric_safety.geometric_safety import GeometricSafety
from mbla.solution.further.sensitivity.slopes import Slope
from mbla.solution.further.soil_range.soil_path import SoilPath
from mbla.solution.solution import PROVED_STANDING, StandingResult

STANDING = Group[StandingResult](lambda scene: scene.solved.solution.standing, file="cases/*/standing", part="standing")
SENSITIVITY = Group[tuple[Slope, ...]](
    lambda scene: scene.solved.solution.further.sensitivity or None,
    file="cases/*/sensitivity",
    files="table",
    table="sensitivity",
    rows="slope_row",
    part="sensitivity",
)
GEOMETRIC_SAFETY = Group[GeometricSafety](
    lambda scene: scene.solved.solution.further.geometric_safety,
    file="cases/*/geometric_safety",
    part="geometric_safety",
)
SOIL_RANGE = Group[tuple[SoilPath, ...]](
    lambda scene: scene.solved.solution.further.soil_range or None,
    file="cases/*/soil_range",
    rows="soil_path",
    part="soil_range",
    unverified="soil",
)

STANDING.fields(
    StandingResult,
    verdict=Field(
        "whether it stands under its dead load alone: yes, no, only by self-stress, doubtful",
        unverified="standing",
        proved=tuple(verdict.value for verdict in PROVED_STANDING),
    ),
)


@STANDING.quantity(dims="falling_block", rule="index of block", unverified="falls")
def falls(standing: StandingResult) -> list[int]:
    """The block that falls or would fall first; no entry where none does."""
    return [] if standing.block is None else [standing.block]


STANDING.fields(
    StandingResult,
    reason=Field("why, in words", rule="open", unverified="words"),
    contact_forces=Field(
        "contact forces, and behind them those of ties, under the dead load alone, from the stress-free assembly",
        "carrier direction",
        unit="force",
        part="standing proof",
        attribute="forces",
    ),
    settlement=Field(
        "displacements and rotations that bring them about on joints of unit stiffness",
        "block component",
        unit="displacement",
        part="standing proof",
    ),
)
SENSITIVITY.fields(
    Slope,
    parameter=Field(
        "key path of a parameter in the deck; dead load or live load: a factor on it; tie and a name: its capacity"
    ),
    value=Field("its value, in the unit of the row"),
    unit=Field("its unit; empty for plain numbers"),
    slope=Field("derivative of the associative load factor by it; nan: not known", rule="open"),
    elasticity=Field("relative change of that load factor over that of the parameter", rule="open"),
    side=Field(
        "side of the value on which the slope holds: both, above, below; kink: above, the slope below in the remark",
    ),
    remark=Field("what else is to be said of it"),
)
GEOMETRIC_SAFETY.fields(
    GeometricSafety,
    sizes=Field("size of all joints over their own at which the dead load stands, and at which it falls", "safety_end"),
    pressed=Field(
        "pressure on all joints in the problem that shows it, over the dead load per area of joints", "safety_end"
    ),
    load_factors=Field("load factor of that problem: it stands where this is not below the pressure", "safety_end"),
    forces=Field(
        "contact forces of that problem at the points of the shrunk joints", "safety_end point direction", unit="force"
    ),
    mechanisms=Field("mechanisms of that problem", "safety_end block component", unit="velocities"),
    solves=Field("programs that were solved for it", unverified="course"),
    verified=Field("1 where forces and mechanisms show that it stands at the first size and falls at the second"),
)

SOIL_RANGE.fields(
    SoilPath,
    share=Field("tan ψ of the soil over tan φ on a path of elastic joints; those of masonry slide without dilatancy"),
    load_factor=Field("the greatest load factor on it; nan: none was found", rule="open"),
    status=Field("of that load factor, as verified by the run"),
    reason=Field("why it is not solved; empty where it is"),
)


def _assessed(scene: Scene) -> tuple[Figure, ...] | None:
    found = scene.solved.assessment
    return None if found is None else found.figures


ASSESSMENT = Group[tuple[Figure, ...]](_assessed, file="cases/*/assessment", rows="assessment_row", part="assessed")
ASSESSMENT.fields(
    Figure,
    limit_state=Field("SLD, SLV or SLC; empty: for all of them"),
    symbol=Field("figure of an assessment by a code"),
    value=Field("its value; nan: not known", rule="open"),
    unit=Field("its unit"),
    article=Field("article of the code that it is of"),
    words=Field("what it is"),
)
