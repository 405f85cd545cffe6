"""Geometry of arch bridges: arches with what carries them, and masonry on them."""
