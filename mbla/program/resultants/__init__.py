"""Conditions on the resultants of whole interfaces: torsion under uniform pressure, crushing as stress blocks."""
