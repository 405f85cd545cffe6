"""Bounds of the associative load factor: forces and mechanisms repaired until they prove it, and what is claimed."""
