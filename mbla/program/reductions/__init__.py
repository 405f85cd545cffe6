"""Reductions: planar, mirrored and separate parts found by themselves, with the exact way back to the whole model."""

from mbla.program.reductions.reduce import ModelSize, Reduced, reduce_program, unreduced

__all__ = ["ModelSize", "Reduced", "reduce_program", "unreduced"]
