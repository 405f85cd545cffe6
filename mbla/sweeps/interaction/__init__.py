"""Load factor over the direction of a load, or over the shares of two loads::

    deck ──> question ──> points ──> domain ──> table, diagram
             direction.py            domain.py
             two_loads.py

The points go through the workers of parameter sweeps (:mod:`mbla.sweeps`); ``command.py`` puts the parts
together.
"""
