"""From a checked sweep file to the points of its design::

    content ──> axes ──────────> constraints ──> points
                ways.py (values of a parameter)
                sampling.py (quantiles)

``build.py`` puts the parts together. Nothing in a design depends on the
machine: drawn quantiles come from a seed and from names alone, and values are rounded to 12 significant digits, which
hides the last digits of mathematical libraries.
"""
