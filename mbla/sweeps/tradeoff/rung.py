"""One rung of the ladder: a setting under a name."""

from __future__ import annotations

from dataclasses import dataclass, field

from mbla.sweeps.measure.setting import Setting


@dataclass(frozen=True)
class Rung:
    """A setting to be measured.

    name    : as a deck says it, ``accuracy: draft``
    setting : what is put into the deck
    unfit   : why it does not apply to this deck; empty where it does
    model   : what makes it another model than the deck's, in words; empty where it is the deck's
    spatial : tells nothing in a planar structure, with the reason; empty where it always does
    """

    name: str
    setting: Setting = field(default_factory=Setting)
    unfit: str = ""
    model: str = ""
    spatial: str = ""


REFERENCE = "accuracy: reference"
"""name of the rung that the others are held against"""
