"""From what the solver sees back to the full model: forces, velocities, modes and resultants on blocks and points."""
