"""What the forces that are shown ask of the units, in words."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.assembly.assembly import Assembly
from mbla.model.wording import named
from mbla.results.collapse.force_freedom import force_freedom
from mbla.results.demand.bearings import HINGE
from mbla.results.demand.cracking import Cracking, cracking_of, first_words, stress_words
from mbla.results.demand.demand import Demand, demand_of
from mbla.results.listing.blocks import MOST_ROWS, Block, Paragraph, table_of
from mbla.results.listing.text import counted
from mbla.results.outcome import dimension_of, result_of
from mbla.results.results import CaseResult


def unit_blocks(assembly: Assembly, case: CaseResult) -> list[Block]:
    """The greatest stresses, and units that may crack; nothing of a case without a result."""
    mechanics = result_of(case)
    if mechanics is None:
        return []
    demand = demand_of(assembly, case.load_case, mechanics)
    if np.isnan(demand.bending).all():
        return []
    tension = [
        f"{what} {_greatest(assembly, found)}"
        for found, what in ((demand.bending, "bending"), (demand.splitting, "splitting"))
        if np.nanmax(found) > 0.0
    ]
    says = f"Greatest tension in units by {' and by '.join(tension)}." if tension else "No unit is in tension."
    if np.nanmax(demand.pressure) > 0.0:
        says += f" Greatest pressure on their joints: {_greatest(assembly, demand.pressure)}{_spread_words(assembly)}."
    if assembly.model.blocks.strengths is None:
        return [Paragraph(f"{says} Not checked: no material has a tensile_strength.")]
    cracking = cracking_of(assembly, case)
    if cracking is None:
        return [Paragraph(f"{says} Within the strengths that are given.")]
    return [Paragraph(f"{says} {_may_words(assembly, case, cracking)}"), *_table(assembly, demand, cracking)]


def _spread_words(assembly: Assembly) -> str:
    """What is assumed of joints that bear any pressure on their edge."""
    joints, contacts = assembly.model.joints, assembly.contacts
    hard = any(np.isinf(joints[contacts.joint_names[law]].compressive_strength) for law in np.unique(contacts.joints))
    return f"; a joint without a compressive strength presses on {100 * HINGE:g} % of it at least" * hard


def _greatest(assembly: Assembly, found: FloatArray) -> str:
    """``1.3 MPa (wall[4])``."""
    block = int(np.nanargmax(found))
    unit = assembly.model.units.unit("stress")
    return f"{stress_words(found[block])} {unit} ({assembly.model.blocks.name(block)})"


def _may_words(assembly: Assembly, case: CaseResult, cracking: Cracking) -> str:
    """How many units may crack, where the first would, and of which forces might ask for less."""
    says = f"{counted(len(cracking.blocks), 'unit')} may crack; {first_words(cracking)}."
    alone = cracking.blocks[_forces_unique(assembly, case)[cracking.blocks]]
    if not len(alone):
        return f"{says} Other forces in balance may ask for less."
    if len(alone) == len(cracking.blocks):
        return f"{says} Their forces are unique in this mechanism."
    which = named(alone, assembly.model.blocks.name)
    return f"{says} In this mechanism forces on {which} are unique; on the others those in balance may ask for less."


def _forces_unique(assembly: Assembly, case: CaseResult) -> BoolArray:
    """Blocks all of whose interfaces have unique resultants, (n_blocks,); none where that was not determined."""
    mechanics, contacts = case.solution.mechanics, assembly.contacts
    assert mechanics is not None  # a result
    freedom = force_freedom(assembly.glued(case.load_case), mechanics, dimension_of((case,)))
    unique = np.zeros(len(assembly.model.blocks) + len(assembly.model.grounds), dtype=bool)
    if not isinstance(freedom, str):
        unique[:] = True
        unique[contacts.bodies[~freedom.determined]] = False
    return unique[: len(assembly.model.blocks)]


def _table(assembly: Assembly, demand: Demand, cracking: Cracking) -> list[Block]:
    """Units beyond their strength, the worst first."""
    blocks, unit = assembly.model.blocks, assembly.model.units.unit("stress")
    chosen = cracking.blocks[:MOST_ROWS]
    columns = (demand.bending, demand.splitting, demand.pressure)
    rows = [
        [
            blocks.name(int(block)),
            *(stress_words(column[block]) for column in columns),
            stress_words(use),
        ]
        for block, use in zip(chosen, cracking.uses, strict=False)
    ]
    head = ["unit", f"bending [{unit}]", f"splitting [{unit}]", f"pressure [{unit}]", "over strength"]
    return table_of(head, rows, total=len(cracking.blocks))
