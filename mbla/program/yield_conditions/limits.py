"""Limits of the contact points: joint laws times each point's share of the interface area."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray


@dataclass(frozen=True)
class YieldLimits:
    """Per contact point, all (n_points,).

    friction    : coefficient μ [-]
    dilatancy   : tangent of the dilatancy angle, 0 ... μ [-]
    cohesion    : shear force carried without normal force [force]
    tension     : tensile force carried [force]
    compression : compressive force carried, inf where unlimited [force]
    """

    friction: FloatArray
    dilatancy: FloatArray
    cohesion: FloatArray
    tension: FloatArray
    compression: FloatArray

    def scaled(self, factor: FloatArray | float) -> YieldLimits:
        """The same limits with forces multiplied by a factor, one for all points or (n_points,)."""
        return YieldLimits(
            self.friction, self.dilatancy, self.cohesion * factor, self.tension * factor, self.compression * factor
        )

    def at_most(self, most: float) -> YieldLimits:
        """The same with no finite strength above a force that nothing comes near."""
        compression = np.where(np.isfinite(self.compression), np.minimum(self.compression, most), np.inf)
        cohesion, tension = np.minimum(self.cohesion, most), np.minimum(self.tension, most)
        return YieldLimits(self.friction, self.dilatancy, cohesion, tension, compression)

    def without_crushing(self, points: BoolArray) -> YieldLimits:
        """The same where some points, (n_points,), do not crush by themselves."""
        return replace(self, compression=np.where(points, np.inf, self.compression))

    def dilatancy_by(self, flow_rule: str) -> FloatArray:
        """Tangent of the dilatancy angle that a flow rule asks of every contact point, (n_points,)."""
        return {
            "associative": self.friction,
            "non_associative": np.zeros_like(self.friction),
            "livesley": np.zeros_like(self.friction),
            "dilatancy": self.dilatancy,
        }[flow_rule]
