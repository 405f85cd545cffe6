"""What counts as solved, and as a result at all: every threshold once, for the schemes and for the verification.

- associative flow: the load factor lies between its proved bounds, and they are no further apart than 1e-5. Forces and
  mechanism then fit the law to 1e-4;
- flow without normality: no bound proves the factor, only its residuals. The largest is at most 1e-6: solved;
  1e-4: solved, with a warning among the results' notices; 1e-2: approximate; beyond: not verified. Unbalanced forces
  count as solved up to 1e-5 with every flow rule.
"""

from __future__ import annotations

EXACT_RESIDUAL = 1e-6
"""Residual of the joint law, relative as in the verification, up to which a state fits it without a warning."""

SOLVED_RESIDUAL = 1e-4
"""Residual up to which a factor counts as solved; without a proof the results warn of it from ``EXACT_RESIDUAL`` on."""

APPROXIMATE_RESIDUAL = 1e-2
"""Residual up to which a factor is approximate; beyond, it is not a result."""

SOLVED_EQUILIBRIUM = 1e-5
"""Unbalanced force up to which a factor counts as solved: the forces must carry it to as many digits as bounds give."""

LIVE_POWER_DEVIATION = 1e-6
"""Deviation of the live power from 1: a mechanism of another size is another one."""

GAP_TOLERANCE = 1e-5
"""Greatest relative distance of static and kinematic bound at which an associative factor counts as verified."""

BOUNDS_ROUNDING = 1e-9
"""Bounds that cross by no more than this, relative to the load factor, count as equal."""

LOCKED_IN = 1e4
"""Normal force, over the total dead load, that would have to be locked in to hold a structure that a motion with
rounding says to fall."""

ZERO_FACTOR = 1e-3
"""Load factors below this share of dead over live load are taken for that share in relative measures."""

STILL = 1e-12
"""Velocity over the largest of the motion that is rounding: where no contact point moves more, no joint does."""

NEAR_ZERO = 1e-5
"""Load factors below this share of dead over live load count as that share: what of them forces can tell from zero is a
share of 2e-9, a residual of 1e-6 of a hundred thousandth is far within that, and elastic joints leave some 3e-6."""
