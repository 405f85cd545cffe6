"""Convex contact model: conditions on the six resultants of each interface."""

from mbla.program.resultants.assemble import ConvexProgram, assemble_convex, convex_form

__all__ = ["ConvexProgram", "assemble_convex", "convex_form"]
