"""Conditions on resultants of whole interfaces, torsion and crushing: associative, and beside elastic joints."""
