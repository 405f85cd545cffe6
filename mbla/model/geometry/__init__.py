"""Geometry files: one reader per file, registered by extension."""
