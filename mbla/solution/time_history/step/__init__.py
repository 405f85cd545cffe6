"""The step of a structure in time: from poses and velocities to the next, joints elastic, contacts renewed."""
