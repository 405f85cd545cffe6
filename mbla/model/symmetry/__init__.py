"""The whole structure from the part on one side of a plane of symmetry, or of several."""
