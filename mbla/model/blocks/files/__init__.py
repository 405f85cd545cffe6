"""Blocks and surfaces from files; imported when an item or a support names a file."""
