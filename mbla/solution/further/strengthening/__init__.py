"""Ties that a structure needs to carry more, at least cost."""
