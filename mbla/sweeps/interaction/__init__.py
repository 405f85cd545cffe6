"""Load factor over the direction of a load, or over the shares of two loads, a sweep over an angle::

    deck ──> question ──> points ──> domain ──> table, diagram

``study.py`` puts the parts together, reports and draws.
"""
