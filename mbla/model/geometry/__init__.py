"""Geometry of blocks from files and drawings: readers, welding, repair."""
