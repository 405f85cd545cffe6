"""What solves points: shared structure, a process of its own, limits."""
