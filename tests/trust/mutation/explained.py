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
    (
        "mbla/model/convexity.py",
        "convex = np.zeros(len(polyhedra), dtype=bool)",
        "np.zeros -> np.ones",
    ): "every entry is overwritten",
    (
        "mbla/model/orientation.py",
        "block_of_piece = np.zeros(labels.max() + 1, dtype=np.int64)",
        "np.zeros -> np.ones",
    ): "every entry is overwritten",
    (
        "mbla/model/geometry/duplicate_faces.py",
        "codes = np.zeros(len(counts), dtype=np.int64)",
        "np.zeros -> np.ones",
    ): "every entry is overwritten",
    (
        "mbla/model/geometry/surfaces.py",
        "angles = np.zeros(len(surface.loops))",
        "np.zeros -> np.ones",
    ): "read only where it is overwritten",
    (
        "mbla/model/geometry/gltf_accessors.py",
        "return np.zeros((0, width))",
        "np.zeros -> np.ones",
    ): "has no entries",
    (
        "mbla/model/geometry/duplicate_faces.py",
        "codes[rows] = used + inverse.reshape(-1)",
        "1 -> 2",
    ): "of a shape, any negative number is the length that is left",
    (
        "mbla/model/geometry/edge_lengths.py",
        "return np.flatnonzero(counts[inverse.reshape(-1)] == 1)",
        "1 -> 2",
    ): "of a shape, any negative number is the length that is left",
    (
        "mbla/model/geometry/line_networks.py",
        "labels = connected_labels(pairs.reshape(-1, 2).astype(np.int64), len(points))",
        "1 -> 2",
    ): "of a shape, any negative number is the length that is left",
    (
        "mbla/model/geometry/stl.py",
        "return _geometry([np.array(each, dtype=np.float64).reshape(-1, 3, 3) for each in corners], names)",
        "1 -> 2",
    ): "of a shape, any negative number is the length that is left",
    (
        "mbla/model/geometry/surfaces.py",
        "part = rank[codes.reshape(-1)]",
        "1 -> 2",
    ): "of a shape, any negative number is the length that is left",
    (
        "mbla/model/polyhedra.py",
        "loops=(flat + vertex_start[:-1, None]).reshape(-1),",
        "1 -> 2",
    ): "of a shape, any negative number is the length that is left",
    (
        "mbla/model/polyhedra.py",
        "[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], dtype=bool",
        "1 -> 2",
    ): "a truth value: 2 is true, too",
    (
        "mbla/model/geometry/edge_lengths.py",
        "keys = np.minimum(tails, heads) * len(polyhedra.vertices) + np.maximum(tails, heads)",
        "np.minimum(tails, heads) * len(polyhedra.vertices) -> np.minimum(tails, heads) / len(polyhedra.vertices)",
    ): "the lesser vertex as a fraction below one: as good a number for an edge",
    (
        "mbla/model/geometry/surfaces.py",
        "keys = np.minimum(tails, heads) * len(surface.vertices) + np.maximum(tails, heads)",
        "np.minimum(tails, heads) * len(surface.vertices) -> np.minimum(tails, heads) / len(surface.vertices)",
    ): "the lesser vertex as a fraction below one: as good a number for an edge, in another order",
    (
        "mbla/model/geometry/surfaces.py",
        "random = np.random.default_rng(0).integers(0, 2**63, size=int(codes.max()) + 1, dtype=np.uint64)",
        "0 -> 1",
    ): "other random numbers",
    (
        "mbla/model/defects.py",
        "multipliers = np.array([73856093, 19349663, 83492791, 2654435761], dtype=np.int64)",
        "19349663 -> 19349664",
    ): "another hash; cells are compared themselves where it is equal",
    (
        "mbla/model/defects.py",
        "for number, face in zip(blocks.tolist(), (flat[first] - polyhedra.face_start[blocks]).tolist(), strict=True):",
        "True -> False",
    ): "both have an entry for each of the blocks",
    (
        "mbla/model/facets.py",
        "closes = lengths < STEEPEST  # the faces go round a curve, all the way round they cancel each other",
        "lengths < STEEPEST -> lengths <= STEEPEST",
    ): "a limit that is a rough one, met exactly",
    (
        "mbla/model/self_intersection.py",
        "slope = np.divide(along[:, 0], along[:, 1], out=np.zeros(len(along)), where=rises)",
        "np.zeros -> np.ones",
    ): "read only where it is overwritten",
    (
        "mbla/model/self_intersection.py",
        "clear = np.linalg.norm(arms - share[:, None] * along, axis=1) > np.repeat(eps, counts)",
        "np.linalg.norm(arms - share[:, None] * along, axis=1) > np.repeat(eps, counts)"
        " -> np.linalg.norm(arms - share[:, None] * along, axis=1) >= np.repeat(eps, counts)",
    ): "a limit that is a rough one, met exactly",
}
