"""Rows of a time history, one for each step of the deck: energies, what the step took, and why the history ends."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from mbla.arrays import FloatArray, IntArray


class HistoryEnd(StrEnum):
    """Why a time history ends."""

    NONE = ""
    DURATION = "the duration asked for is reached"
    COLLAPSE = "a block has fallen"
    DISPLACED = "the displacement asked for is reached"
    AT_REST = "the structure has come to rest"
    NO_REST = "its rest under the dead load was not found on elastic joints"
    LATE = "the time limit was reached"
    STOPPED = "the run was stopped"


@dataclass(frozen=True)
class StepRows:
    """Steps of a time history, (n + 1,) each; row 0 is the structure at rest. Energies in J since then.

    Energies are those half a step before the times given, with positions there too, and fulfil::

        kinetic + potential + contacts + friction + ties = base + forces + numerical

    times      : s, at the end of the steps
    kinetic    : of all bodies, in the frame of the base
    potential  : gained by the dead load
    elastic    : stored in joints and ties (part of what contacts, friction and ties took)
    friction   : taken along the joints: dissipated by sliding and stored
    contacts   : taken across the joints: stored, and lost in impacts, dashpots and crushing
    ties       : taken by ties: stored and dissipated
    base       : work of the motion of the base
    forces     : work of forces over time and of dead loads that turn with their blocks
    numerical  : of bodies that turn about changing axes, and of steps that become longer or shorter
    residuals  : largest velocity that a step leaves out of balance, over that of free fall in the step
    factorisations, small_steps : so far; steps that were made in the place of those of the deck: halved, and at impacts
    halved, missed : steps so far that were halved, and smallest ones that still did not converge
    pressing   : contact points that press
    """

    times: FloatArray
    kinetic: FloatArray
    potential: FloatArray
    elastic: FloatArray
    friction: FloatArray
    contacts: FloatArray
    ties: FloatArray
    base: FloatArray
    forces: FloatArray
    numerical: FloatArray
    residuals: FloatArray
    factorisations: IntArray
    small_steps: IntArray
    halved: IntArray
    missed: IntArray
    pressing: IntArray

    def __len__(self) -> int:
        return len(self.times)
