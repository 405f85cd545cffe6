"""Survivors that no test can kill, with the reason: they are no other program, or not a worse one.

Each is named by module, text of its line, and change.
"""

from __future__ import annotations

EXPLAINED: dict[tuple[str, str, str], str] = {
    (
        "mbla/solution/verify_range.py",
        "return verified(solution.lower, -1.0), verified(solution.upper, 1.0)",
        "1.0 -> 2.0",
    ): "only its sign counts",
    (
        "mbla/solution/residuals.py",
        "capacity = np.where(crushable, limits.compression, 0.0)",
        "0.0 -> 1.0",
    ): "multiplied by a crushing that is none there",
    (
        "mbla/solution/verify_standing.py",
        "HIDDEN = 1e6",
        "1000000.0 -> 1000001.0",
    ): "a millionth more of a limit that is a rough one",
    (
        "mbla/solution/certificate.py",
        "n_parts, label = connected_components(graph, directed=False)",
        "False -> True",
    ): "directed graphs are connected weakly unless said otherwise",
}
