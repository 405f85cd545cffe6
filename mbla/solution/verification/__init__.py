"""Everything that a solution claims, recomputed by code that did not compute it, without a solver."""
