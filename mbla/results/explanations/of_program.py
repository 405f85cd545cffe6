"""What the contact model is known to get wrong for the joints in use."""

from __future__ import annotations

from mbla.results.explanations.explanation import Explanation

_MORE = "scheme: auto crushes as stress blocks do; or more contact points (contacts.points.per_edge or spacing)."

OF_PROGRAM = (
    Explanation(
        "eccentric-crushing-overstated",
        "warning",
        "Compressive strength at contact points of corners alone overstates interfaces under eccentric load.",
        "On the unsafe side: a rectangle bears N (1 + 2 e/b) <= fc A, a stress block N <= fc A (1 - 2 e/b), with "
        "eccentricity e and width b.",
        "A flow rule, scheme, form or solver that knows no conditions on interfaces: each contact point is limited to "
        "its share of the area, and corners have the longest lever arm.",
        _MORE,
    ),
    Explanation(
        "crushing-at-points",
        "notice",
        "Compressive strength limits each contact point to its share of the area.",
        "With n parts along a length h, moments exceed those of a rectangular stress block by at most "
        "(fc + ft) b h2/(8 n2): on the unsafe side by that much.",
        "Such a flow rule, scheme, form or solver, with several points along the edges.",
        f"{_MORE} Compare two numbers of points.",
    ),
)
