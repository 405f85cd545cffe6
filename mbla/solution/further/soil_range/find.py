"""The range of load factors without normality: paths on which soil slides with ψ = 0 and with ψ = φ.

How much soil dilates as it slips is seldom known, and changes on the way: ψ lies between 0 and φ. Joints of
masonry slide without dilatancy on both paths. Each is solved and verified as a load case of its own.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from mbla.assembly.assembly import Assembly
from mbla.model.model import Model
from mbla.solution.further.soil_range.soil_path import SHARES, SoilPath
from mbla.solution.sequence.solved_case import SolvedCase
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, Status


def soil_range_of(
    assembly: Assembly, settings: SolverSettings, answered: Callable[[Assembly, SolverSettings], SolvedCase]
) -> tuple[SoilPath, ...]:
    """Both paths, that with the least dilatancy first.

    answered : the load case of an assembly by other settings
    """
    update = {"flow_rule": "dilatancy", "scheme": "auto", "soil_range": False}
    own = replace(settings, search=0.0, torsion=False, analysis=settings.analysis.model_copy(update=update))
    found = []
    for share in SHARES:
        case = answered(replace(assembly, model=with_dilatancy(assembly.model, share)), own)
        value = case.load_factor if case.status in WITH_VALUE else math.nan
        why = "" if case.status is Status.SOLVED else case.solution.reason or next(iter(case.checks.failures), "")
        found.append(SoilPath(share, value, case.status.value, str(why)))
    return tuple(found)


def with_dilatancy(model: Model, share: float) -> Model:
    """The model with laws of soil that slide with a share of their friction, and all others without dilatancy."""
    of_soil = {name for soil in model.soils for name in (soil.joint, soil.wall_joint)}
    joints = {
        name: replace(law, dilatancy=share * law.friction if name in of_soil else 0.0)
        for name, law in model.joints.items()
    }
    return replace(model, joints=joints)
