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
    (
        "mbla/contacts/contacts.py",
        "return {name: int(count) for name, count in zip(self.joint_names, counts, strict=True)}",
        "True -> False",
    ): "there are as many counts as names: minlength, and joints are rows of the names",
    (
        "mbla/contacts/contacts.py",
        "return {name: float(area) for name, area in zip(self.joint_names, areas, strict=True)}",
        "True -> False",
    ): "there are as many areas as names: minlength, and joints are rows of the names",
    (
        "mbla/contacts/connectivity.py",
        "support = np.ones(max(n_blocks, int(bodies.max(initial=-1)) + 1), dtype=bool)",
        "1 -> 2",
    ): "room for one body more, or for as many as there are",
    (
        "mbla/contacts/glue.py",
        "if model.fixed[held].all():",
        "model.fixed[held].all -> model.fixed[held].any",
    ): "no fixed block is said to be held: only where none is are all of them fixed, and the copy is the model again",
    (
        "mbla/contacts/refine.py",
        'i, j = (index.ravel() for index in np.meshgrid(np.arange(parts + 1), np.arange(parts + 1), indexing="ij"))',
        "1 -> 2",
    ): "rows beyond the triangle are taken out by the next line",
    (
        "mbla/contacts/search.py",
        "laws = {name: Joint(name, 0.0) for name in model.joints}",
        "0.0 -> 1.0",
    ): "of these laws only the names are read",
    (
        "mbla/contacts/convex_clip.py",
        "return np.asarray(2 ** np.ceil(np.log2(np.maximum(counts, 4))), dtype=np.int64)",
        "4 -> 5",
    ): "more room in tables of corners that need less",
    (
        "mbla/contacts/between.py",
        "least, most = np.full(face.max() + 1, np.inf), np.full(face.max() + 1, -np.inf)",
        "1 -> 2",
    ): "room for one face more",
    (
        "mbla/contacts/given.py",
        "overlays = Overlays(given.bodies, nothing, origins, frames, sizes, np.zeros((n, 3)))",
        "3 -> 4",
    ): "a column that nobody reads",
    (
        "mbla/contacts/narrow_phase.py",
        "first = np.flatnonzero(np.diff(row, prepend=-1))",
        "1 -> 2",
    ): "any number that is no row will do",
    (
        "mbla/contacts/overlaps.py",
        "_LARGE = 20_000",
        "20000 -> 20001",
    ): "where one way of doing it takes over from another with the same result",
}
