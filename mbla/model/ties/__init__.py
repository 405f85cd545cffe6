"""Ties: what holds blocks together beside joints, as the deck lays it out and as it moves."""
