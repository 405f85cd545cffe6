"""What is remarked on the state that is shown, last of all on a load case."""

from __future__ import annotations

from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.soil_mesh import soil_mesh_remarks
from mbla.results.collapse.ties import brittle_remarks
from mbla.solution.solution import Solution

OF_STATE = frozenset({"brittle-ties", "soil-mesh", "soil-mesh-scatters", "soil-mesh-of-others"})


def state_remarks(model: Model, load_case: LoadCase, solution: Solution) -> tuple[Message, ...]:
    """Of ties that break and of soil of cells."""
    return (*brittle_remarks(model.of_case(load_case), solution), *soil_mesh_remarks(load_case))
