"""Associative flow: the load factor proved from both sides, by forces and mechanisms repaired for the proof."""
