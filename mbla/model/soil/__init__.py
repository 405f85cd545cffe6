"""Soil as rigid cells: the region that it fills, its triangles, the blocks that they are, and what holds them."""
