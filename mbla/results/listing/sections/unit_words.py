"""What the forces that are shown ask of the units, in words."""

from __future__ import annotations

import math

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.questions.figures import significant
from mbla.results.demand.cracking import Cracking, cracking_of, stress_words
from mbla.results.demand.demand import Demand, demand_of
from mbla.results.listing.blocks import MOST_ROWS, Block, Paragraph, table_of
from mbla.results.listing.text import counted
from mbla.results.outcome import result_of
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
    if np.isinf(demand.pressure).any():
        says += " Joints without a compressive strength press units on edges."
    elif np.nanmax(demand.pressure) > 0.0:
        says += f" Greatest pressure on their joints: {_greatest(assembly, demand.pressure)}."
    if assembly.model.blocks.strengths is None:
        return [Paragraph(f"{says} Not checked: no material has a tensile_strength.")]
    cracking = cracking_of(assembly, case)
    if cracking is None:
        return [Paragraph(f"{says} Within the strengths that are given.")]
    return [Paragraph(f"{says} {_first_words(cracking)}"), *_table(assembly, demand, cracking)]


def _greatest(assembly: Assembly, found: FloatArray) -> str:
    """``1.3 MPa (wall[4])``."""
    block = int(np.nanargmax(found))
    unit = assembly.model.units.unit("stress")
    return f"{stress_words(found[block])} {unit} ({assembly.model.blocks.name(block)})"


def _first_words(cracking: Cracking) -> str:
    """Where the first unit would crack."""
    says = f"{counted(len(cracking.blocks), 'unit')} may crack"
    if not math.isnan(cracking.factor):
        says += f", with forces in proportion to the load the first at load factor {significant(cracking.factor, 4)}"
    return f"{says}; other forces in balance may ask for less."


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
