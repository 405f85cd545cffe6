"""What a user would take instead of mbla, on the same contacts: general modelling, linear programs, COMPAS.

Each takes a structure as :class:`tests.performance.rivals.structure.Structure` holds it and gives an
:class:`~tests.performance.rivals.structure.Answer`.
"""
