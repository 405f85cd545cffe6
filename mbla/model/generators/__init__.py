"""Generators: each turns an item of the deck into raw polyhedra."""
