"""What holds a structure: ground planes and surfaces, blocks that do not move, guided blocks."""
