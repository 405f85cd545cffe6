"""Courses of walls: bond patterns, random units, openings and what spans them, gables, junctions, buttresses."""
