"""What the forces that are shown ask of the units: tension by bending and by splitting, and pressure on their joints.

Contact forces need not be unique, so that the least demand over all admissible ones may be smaller.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.assembly.assembly import Assembly
from mbla.model.model import LoadCase
from mbla.results.collapse.collapse import kept
from mbla.results.demand.actions import Acting, actions_on_blocks, standing_alone
from mbla.results.demand.bearings import bearings_of, greatest_pressure
from mbla.results.demand.bending import tension_by_bending
from mbla.results.demand.boxes import Boxes, boxes_of
from mbla.results.demand.splitting import tension_by_splitting
from mbla.results.demand.width import in_plane_axes, width_of
from mbla.solution.solution import Mechanics


@dataclass(frozen=True)
class Demand:
    """Greatest stresses of each block, (n_blocks,) Pa; nan of blocks that are fixed, guided or glued to others, and of
    cells of soil.

    bending   : tension in its sections, 0 without any
    splitting : tension across its struts, 0 without any
    pressure  : even pressure on its joints
    crushing  : the same on joints that carry more than the compressive strength of its material
    """

    bending: FloatArray
    splitting: FloatArray
    pressure: FloatArray
    crushing: FloatArray


@kept
def demand_of(assembly: Assembly, load_case: LoadCase, mechanics: Mechanics) -> Demand:
    """Of the forces of one load case."""
    return demand_under(
        assembly, Acting(load_case, mechanics.load_factor, mechanics.contact_forces, mechanics.tie_forces)
    )


def demand_under(assembly: Assembly, acting: Acting) -> Demand:
    """Of any forces that balance the dead load and a multiple of the live load."""
    model, contacts = assembly.model.of_case(acting.load_case), assembly.contacts
    judged, boxes = standing_alone(model, contacts) & (model.soil_of_block < 0), _boxes(assembly)
    bearings = bearings_of(model, contacts, acting.contact_forces)
    actions = actions_on_blocks(model, contacts, acting, bearings)
    everywhere, strengths = np.ones(len(contacts), dtype=bool), _strengths_of_joints(assembly)
    beams = judged[:, None] & in_plane_axes(boxes.axes, _width(assembly, acting.load_case))
    return Demand(
        tension_by_bending(model.blocks, boxes, contacts, actions, beams),
        tension_by_splitting(model.blocks, boxes, contacts, bearings, judged),
        greatest_pressure(contacts, bearings, strengths, judged, everywhere),
        greatest_pressure(contacts, bearings, strengths, judged, _stronger_than_units(assembly)),
    )


@kept
def _boxes(assembly: Assembly) -> Boxes:
    return boxes_of(assembly.model.blocks)


@kept
def _width(assembly: Assembly, load_case: LoadCase) -> FloatArray | None:
    return width_of(assembly.model.of_case(load_case), assembly.contacts, load_case)


def _strengths_of_joints(assembly: Assembly) -> FloatArray:
    """Compressive strength of each interface, (n_interfaces,) Pa."""
    contacts = assembly.contacts
    of_joints = [assembly.model.joints[name].compressive_strength for name in contacts.joint_names]
    return np.asarray(np.array(of_joints)[contacts.joints])


def _stronger_than_units(assembly: Assembly) -> BoolArray:
    """Interfaces whose joint carries more than the material of one of their blocks, (n_interfaces,)."""
    model, contacts = assembly.model, assembly.contacts
    if model.blocks.strengths is None:
        return np.zeros(len(contacts), dtype=bool)
    of_units = np.append(model.blocks.strengths[:, 1], np.full(len(model.grounds), np.inf))
    return np.asarray(_strengths_of_joints(assembly) > of_units[contacts.bodies].min(axis=1))


def strength_use(assembly: Assembly, demand: Demand) -> FloatArray:
    """Greatest of the stresses over strengths of each block, (n_blocks,); nan where none is given."""
    strengths = assembly.model.blocks.strengths
    if strengths is None:
        return np.full(len(assembly.model.blocks), np.nan)
    tension = np.fmax(demand.bending, demand.splitting) / strengths[:, 0]
    pressure = np.where(np.isfinite(strengths[:, 1]), demand.crushing / strengths[:, 1], 0.0)
    return np.where(np.isfinite(strengths).any(axis=1), np.maximum(tension, pressure), np.nan)
