"""Modes of vibration of a structure about the state in which its elastic joints carry its dead load."""
