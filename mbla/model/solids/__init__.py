"""Blocks as solids: polyhedra, their measures, their defects, and how blocks are built from them."""
