"""What the contact model is known to get wrong for the joints in use."""

from __future__ import annotations

from mbla.results.explanations.explanation import Explanation

_MORE = "More contact points (contacts.points.per_edge or spacing), or contact_model: convex."

OF_PROGRAM = (
    Explanation(
        "eccentric-crushing-overstated",
        "warning",
        "Compressive strength at contact points of corners alone overstates interfaces under eccentric load.",
        "On the unsafe side: a rectangle bears N (1 + 2 e/b) <= fc A, a stress block only N <= fc A (1 - 2 e/b), with "
        "eccentricity e and width b.",
        "Each contact point is limited to its share of the area, and corners have the longest lever arm.",
        _MORE,
    ),
    Explanation(
        "crushing-at-points",
        "notice",
        "Compressive strength limits each contact point to its share of the area.",
        "With n parts along a length h, moments exceed those of a rectangular stress block by at most "
        "(fc + ft) b h2/(8 n2): on the unsafe side by that much.",
        "contact_model: concave with a compressive strength and several points along the edges.",
        f"{_MORE} Compare two numbers of points.",
    ),
    Explanation(
        "crushing-by-points",
        "warning",
        "Interfaces that are not convex or have holes crush point by point, although the model is convex.",
        "On the unsafe side for these interfaces under eccentric load.",
        "Stress blocks are known for convex outlines only.",
        "Divide such interfaces into convex ones.",
    ),
)
