"""Blocks as solids: polyhedra, what is measured on them, what makes them unfit, and how blocks are made of them."""
