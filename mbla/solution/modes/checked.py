"""Modes of a load case as a further result: found, verified, and what a reader must know of them."""

from __future__ import annotations

from mbla.assembly.assembly import Assembly
from mbla.assembly.structure_at import StructureAt
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.solution.modes.find import modes_of
from mbla.solution.modes.modes import Modes
from mbla.solution.verification.leaning import left_out_share
from mbla.solution.verification.modes import checked_modes

SOFT = 1e-3
"""Sag over the mean size of blocks from which joints are told to be soft."""

ROUNDING = 1e-9
"""Share of an area that is none."""


def checked_modes_of(assembly: Assembly, load_case: LoadCase, count: int) -> tuple[Modes, tuple[Message, ...]]:
    """So many modes, verified, and remarks on them; or none, and a remark that says why."""
    there = StructureAt.as_built(assembly, load_case)
    modes, wrong = checked_modes(there, modes_of(there, count))
    remarks = [] if len(modes) else [no_modes(modes.reason)]
    remarks += [modes_wrong(words) for words in wrong]
    return modes, (*remarks, *modes_remarks(assembly.model.of_case(load_case), load_case, modes))


def no_modes(reason: str) -> Message:
    """The remark on why there are no modes."""
    return Message("no-modes", f"there are no modes of vibration: {reason}")


def modes_wrong(words: str) -> Message:
    """The remark on what is wrong with modes."""
    return Message("modes-not-verified", f"modes of vibration are not verified: {words}")


def modes_remarks(model: Model, load_case: LoadCase, modes: Modes) -> tuple[Message, ...]:
    """What a reader of modes must know although nothing is wrong, from the modes alone.

    model : as it may move under the load case
    """
    remarks = []
    if _gives_much(model, modes):
        share = left_out_share(model, load_case, modes)
        words = f"joints give by {modes.sag:.2g} {model.units.length} under the dead load, more than a thousandth of "
        words += "the size of blocks: weight that turns with the structure is left out, and takes about "
        words += f"{100.0 * share:.2g} % of its stiffness, so that periods are too short"
        remarks.append(Message("modes-soft", words))
    if parts := int(((modes.pressed > 0.0) & (modes.pressed < 1.0 - ROUNDING)).sum()):
        joints = "1 joint presses" if parts == 1 else f"{parts} joints press"
        words = f"{joints} on a part of their area at rest, for what they carry lies outside of their kern: that part, "
        words += "and periods with it, hang on where contact points lie"
        remarks.append(Message("modes-in-part", words))
    if loose := int(modes.loose.sum()):
        which = "1 block that joints do not hold has" if loose == 1 else f"{loose} blocks that joints do not hold have"
        remarks.append(Message("modes-loose-blocks", f"{which} motions without stiffness, which are no modes"))
    if 0 < len(modes) < load_case.modes:
        words = f"there are {len(modes)} modes of vibration, fewer than the {load_case.modes} asked for"
        remarks.append(Message("modes-fewer", words))
    return tuple(remarks)


def _gives_much(model: Model, modes: Modes) -> bool:
    """Whether joints give under the dead load by more than a thousandth of the mean size of the blocks that move."""
    return len(modes) > 0 and modes.sag > SOFT * float(model.blocks.sizes[model.free].mean())
