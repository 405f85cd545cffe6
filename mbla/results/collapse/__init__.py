"""What follows from forces and velocities: modes of interfaces, rigid parts, work, motion as drawn, resultants."""
