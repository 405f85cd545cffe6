"""Section across a vault: its joints on the intrados and on the extrados."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.items.vaults import VaultItem
from mbla.model.generators.curves import named_curve


@dataclass(frozen=True)
class VaultSection:
    """Joints of a vault across its courses, from the left springing.

    joints   : (courses + 1, 2, 2) intrados and extrados point of each joint, x and z
    forwards : (courses + 1, 2)    direction of travel there, at right angles to the joint
    """

    joints: FloatArray
    forwards: FloatArray


def vault_section(item: VaultItem, span: float) -> VaultSection:
    """The section of a vault over a span."""
    curve = named_curve(item.shape, span, item.rise, item.embrace)
    parameters = curve.divide(item.courses, item.thickness / 2)
    offsets = np.broadcast_to([0.0, item.thickness], (len(parameters), 2))
    return VaultSection(curve.points(parameters, offsets), curve.forwards(parameters))
