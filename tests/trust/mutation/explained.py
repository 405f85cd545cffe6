"""Survivors that no test can kill, with the reason: they are no other program, or not a worse one.

Each is named by module, text of its line, and change.
"""

from __future__ import annotations

EXPLAINED: dict[tuple[str, str, str], str] = {
    (
        "mbla/solution/verification/further_claims.py",
        "return verified(solution.lower, -1.0), verified(solution.upper, 1.0)",
        "1.0 -> 2.0",
    ): "only its sign counts",
    (
        "mbla/solution/verification/residuals.py",
        "capacity = np.where(crushable, limits.compression, 0.0)",
        "0.0 -> 1.0",
    ): "multiplied by a crushing that is none there",
    (
        "mbla/solution/verification/further_claims.py",
        "HIDDEN = 1e6",
        "1000000.0 -> 1000001.0",
    ): "a millionth more of a limit that is a rough one",
    (
        "mbla/solution/associative/certificate.py",
        "n_parts, label = connected_components(graph, directed=False)",
        "False -> True",
    ): "directed graphs are connected weakly unless said otherwise",
    (
        "mbla/solution/verification/further_claims.py",
        "if np.any(_lasting_excess(lock, limits) > scale.of_lighter(contacts, allowed)):",
        "_lasting_excess(lock, limits) > scale.of_lighter(contacts, allowed) -> "
        "_lasting_excess(lock, limits) >= scale.of_lighter(contacts, allowed)",
    ): "a rough limit met exactly; it is never zero, blocks without a live load have the mean of the others'",
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
        "mbla/contacts/report.py",
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
        "laws = {name: Joint(name, 0.0, compressive_strength=_crushes(law)) for name, law in model.joints.items()}",
        "0.0 -> 1.0",
    ): "of these laws only the names are read",
    (
        "mbla/contacts/convex.py",
        "return np.asarray(2 ** np.ceil(np.log2(np.maximum(counts, 4))), dtype=np.int64)",
        "4 -> 5",
    ): "more room in tables of corners that need less",
    (
        "mbla/contacts/convex.py",
        "clockwise = area < 0",
        "area < 0 -> area <= 0",
    ): "a polygon of no area is a line there and back: turned round it is the same, and so is what it leaves",
    (
        "mbla/contacts/convex.py",
        "return np.take_along_axis(points, source[..., None], axis=1), counts > 0",
        "0 -> 1",
    ): "never one: of what is cut two crossings are left with each run of corners, of what is not all corners",
    (
        "mbla/contacts/glue.py",
        "differs = np.abs(motions - motions[first[row]]).max(axis=(1, 2), initial=0.0) > AGREE * size",
        "np.abs(motions - motions[first[row]]).max(axis=(1, 2), initial=0.0) > AGREE * size"
        " -> np.abs(motions - motions[first[row]]).max(axis=(1, 2), initial=0.0) >= AGREE * size",
    ): "a rough limit met exactly; no guide is without a motion, so that it is above zero",
    (
        "mbla/contacts/third_block.py",
        "least, most = np.full(face.max() + 1, np.inf), np.full(face.max() + 1, -np.inf)",
        "1 -> 2",
    ): "room for one face more",
    (
        "mbla/contacts/search.py",
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
        "mbla/contacts/joints.py",
        "bed = np.abs(normals[:, 2]) > BED + ROUNDING",
        "np.abs(normals[:, 2]) > BED + ROUNDING -> np.abs(normals[:, 2]) >= BED + ROUNDING",
    ): "a rough limit met exactly",
    (
        "mbla/contacts/notices.py",
        "simpler = int((changes > SEEN).sum())",
        "changes > SEEN -> changes >= SEEN",
    ): "a rough limit met exactly",
    (
        "mbla/contacts/overlaps.py",
        "extents = np.zeros(len(facets))",
        "np.zeros -> np.ones",
    ): "read only where it is overwritten: at facets of the first blocks",
    (
        "mbla/contacts/overlaps.py",
        "if thickness > tolerance:",
        "thickness > tolerance -> thickness >= tolerance",
    ): "a rough limit met exactly",
    (
        "mbla/contacts/polygons.py",
        "rows = np.flatnonzero((counts >= width) & (counts < 2 * width))",
        "counts < 2 * width -> counts <= 2 * width",
    ): "rows of just twice the width are united again, whole, in the next round",
    (
        "mbla/contacts/polygons.py",
        "turned = signed_areas(corners[rows.ravel()], 3 * np.arange(len(rows) + 1)) < 0",
        "0 -> 1",
    ): "the library gives every triangle clockwise: all of them are turned, whatever their size",
    (
        "mbla/model/solids/measures.py",
        "convex = np.zeros(len(polyhedra), dtype=bool)",
        "np.zeros -> np.ones",
    ): "every entry is overwritten",
    (
        "mbla/model/solids/measures.py",
        "block_of_piece = np.zeros(labels.max() + 1, dtype=np.int64)",
        "np.zeros -> np.ones",
    ): "every entry is overwritten",
    (
        "mbla/model/geometry/surfaces.py",
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
        "mbla/model/geometry/surfaces.py",
        "codes[rows] = used + inverse.reshape(-1)",
        "1 -> 2",
    ): "of a shape, any negative number is the length that is left",
    (
        "mbla/model/geometry/gaps.py",
        "return np.flatnonzero(counts[inverse.reshape(-1)] == 1)",
        "1 -> 2",
    ): "of a shape, any negative number is the length that is left",
    (
        "mbla/model/geometry/dxf.py",
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
        "mbla/model/solids/polyhedra.py",
        "loops=(flat + vertex_start[:-1, None]).reshape(-1),",
        "1 -> 2",
    ): "of a shape, any negative number is the length that is left",
    (
        "mbla/model/solids/polyhedra.py",
        "[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], dtype=bool",
        "1 -> 2",
    ): "a truth value: 2 is true, too",
    (
        "mbla/model/geometry/gaps.py",
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
        "mbla/model/solids/defects.py",
        "multipliers = np.array([73856093, 19349663, 83492791, 2654435761], dtype=np.int64)",
        "19349663 -> 19349664",
    ): "another hash; cells are compared themselves where it is equal",
    (
        "mbla/model/solids/defects.py",
        "for number, face in zip(blocks.tolist(), (flat[first] - polyhedra.face_start[blocks]).tolist(), strict=True):",
        "True -> False",
    ): "both have an entry for each of the blocks",
    (
        "mbla/model/solids/facets.py",
        "closes = lengths < STEEPEST  # the faces go round a curve, all the way round they cancel each other",
        "lengths < STEEPEST -> lengths <= STEEPEST",
    ): "a limit that is a rough one, met exactly",
    (
        "mbla/model/solids/self_intersection.py",
        "slope = np.divide(along[:, 0], along[:, 1], out=np.zeros(len(along)), where=rises)",
        "np.zeros -> np.ones",
    ): "read only where it is overwritten",
    (
        "mbla/model/solids/self_intersection.py",
        "clear = np.linalg.norm(arms - share[:, None] * along, axis=1) > np.repeat(eps, counts)",
        "np.linalg.norm(arms - share[:, None] * along, axis=1) > np.repeat(eps, counts)"
        " -> np.linalg.norm(arms - share[:, None] * along, axis=1) >= np.repeat(eps, counts)",
    ): "a limit that is a rough one, met exactly",
    (
        "mbla/program/assemble.py",
        "return np.asarray(values, dtype=np.float64)[joint] if len(joint) else np.zeros(0)",
        "np.zeros -> np.ones",
    ): "an empty array",
    (
        "mbla/program/fixed_mechanism.py",
        "fixed = np.where(motion.opens, -limits.tension, np.where(motion.crushes, limits.compression, 0.0))",
        "0.0 -> 1.0",
    ): "read at points that open or crush alone",
    (
        "mbla/program/resultants/friction_limit.py",
        "sense, twist = np.where(trial[:, 2] < 0, -1.0, 1.0), np.abs(trial[:, 2])",
        "trial[:, 2] < 0 -> trial[:, 2] <= 0",
    ): "either sense of no twist",
    (
        "mbla/program/resultants/shapes.py",
        "rectangles, sides, axes = np.zeros(n, dtype=bool), np.zeros((n, 2)), np.zeros((n, 2, 2))",
        "np.zeros -> np.ones",
    ): "sides and axes of what is no rectangle, which nobody reads",
    (
        "mbla/program/resultants/assemble.py",
        "conditions = sum(int(np.count_nonzero(rows.cone_sizes > 1)) for rows in convex.conditions)",
        "1 -> 2",
    ): "no condition has a cone of dimension 2",
    (
        "mbla/program/program.py",
        "return values.reshape(-1, 3 if program.components == 2 else 6)",
        "1 -> 2",
    ): "numpy takes any negative number for the length that is left",
    (
        "mbla/program/reductions/guided.py",
        "row_of_block = np.full(len(model.blocks), -1, dtype=np.int64)",
        "-1 -> 1",
    ): "no fixed block is guided",
    (
        "mbla/program/reductions/guided.py",
        "ways = guides.motions / scaling.row.reshape(-1, 6)[row_of_block[guides.blocks]][:, :, None] / scaling.force",
        "guides.motions / scaling.row.reshape(-1, 6)[row_of_block[guides.blocks]][:, :, None] / scaling.force -> "
        "guides.motions / scaling.row.reshape(-1, 6)[row_of_block[guides.blocks]][:, :, None] * scaling.force",
    ): "ways of any length span the same space",
    (
        "mbla/program/reductions/guided.py",
        "basis = left[:, size > DEPENDENT * size.max(initial=0.0)]",
        "size > DEPENDENT * size.max(initial=0.0) -> size >= DEPENDENT * size.max(initial=0.0)",
    ): "a rough limit met exactly",
    (
        "mbla/program/reductions/guided.py",
        "n = projector.shape[0]",
        "0 -> 1",
    ): "a square matrix",
    (
        "mbla/program/reductions/guided.py",
        "count, label = connected_components(projector, directed=False)",
        "False -> True",
    ): "directed graphs are connected weakly unless said otherwise",
    (
        "mbla/program/reductions/mirror.py",
        "if length <= 1e-9 * largest**2 and length < 0.5:",
        "length <= 1e-09 * largest ** 2 -> length < 1e-09 * largest ** 2",
    ): "a rough limit met exactly",
    (
        "mbla/program/reductions/planar.py",
        "areas = (scene.areas + scene.areas[mirror.point_of]) / 2  # cuts and points left out may make them unlike",
        "2 -> 3",
    ): "areas become shares in the next line",
    (
        "mbla/program/reductions/planar.py",
        "interface = np.minimum(scene.interfaces, scene.interfaces[mirror.point_of])",
        "np.minimum -> np.maximum",
    ): "either number of an interface and its image names both",
    (
        "mbla/program/reductions/planar.py",
        "new = np.diff(interface[order], prepend=-1) != 0",
        "-1 -> 1",
    ): "the first point begins a group by the next line",
    (
        "mbla/program/reductions/planar.py",
        "new = np.diff(interface[order], prepend=-1) != 0",
        "1 -> 2",
    ): "the first point begins a group by the next line",
    (
        "mbla/program/reductions/planar.py",
        "new |= np.diff(place[order], prepend=-np.inf) > BEHIND",
        "-np.inf -> np.inf",
    ): "the first point begins a group by the line before",
    (
        "mbla/program/reductions/points.py",
        "return np.union1d(several_of_a_pair(scene), scene.interfaces[turns(scene) <= STRAIGHT_ON])",
        "turns(scene) <= STRAIGHT_ON -> turns(scene) < STRAIGHT_ON",
    ): "a rough limit met exactly",
    (
        "mbla/program/reductions/points.py",
        "flat = (scene.points[group] - scene.points[group[0]]) @ scene.frames[group[0], 1:].T / scene.length",
        "scene.points[group] - scene.points[group[0]] -> scene.points[group] + scene.points[group[0]]",
    ): "a hull stays what it is wherever it is moved",
    (
        "mbla/program/reductions/shares.py",
        "if np.all(np.abs(share - 1.0) <= ALIKE):",
        "np.abs(share - 1.0) <= ALIKE -> np.abs(share - 1.0) < ALIKE",
    ): "a rough limit met exactly",
    (
        "mbla/program/reductions/shares.py",
        "area = 1.0 / np.asarray(normals.T @ (1.0 / part.areas))",
        "1.0 -> 2.0",
    ): "areas become shares of their mean in the next lines",
    (
        "mbla/program/choice.py",
        "return np.asarray(np.isfinite(strengths)[contacts.joints] if len(contacts) else np.zeros(0, dtype=bool))",
        "np.zeros -> np.ones",
    ): "an empty array",
    (
        "mbla/program/choice.py",
        'turns[:] = np.einsum("ij,ij->i", step, step[following]) < 1 - STRAIGHT',
        "np.einsum('ij,ij->i', step, step[following]) < 1 - STRAIGHT -> "
        "np.einsum('ij,ij->i', step, step[following]) <= 1 - STRAIGHT",
    ): "a rough limit met exactly",
    (
        "mbla/program/static.py",
        "forces = sp.vstack([program.equilibrium_matrix, -half_lines, -shear])",
        "-shear -> shear",
    ): "a cone is the same seen from either side; its first entries are zero here",
    (
        "mbla/model/geometry/dxf.py",
        'raise GeometryFileError("geometry-file", f"is not a well-formed DXF file: {reason}"[:300]) from error',
        "300 -> 301",
    ): "one letter more of a message",
    (
        "mbla/model/geometry/gltf.py",
        "surfaces.append(own_vertices(placed, triangles.reshape(-1), 3 * np.arange(len(triangles) + 1), block))",
        "1 -> 2",
    ): "of a shape, any negative number is the length that is left",
    (
        "mbla/model/geometry/stl.py",
        "complete = True",
        "True -> False",
    ): "a file is read as text where its first word is solid, which sets it",
    (
        "mbla/model/geometry/stl.py",
        "triangles.reshape(-1, 3), np.array([0, 3 * n]), np.arange(3 * n), 3 * np.arange(n + 1), np.array([0, n])",
        "1 -> 2",
    ): "starts of faces beyond the last one are not looked at where parts are joined",
    (
        "mbla/contacts/facets.py",
        "_unite(outlines, faces, facet, (counts > 1) & ~joined, None)",
        "counts > 1 -> counts >= 1",
    ): "a face united with no other is that face; it takes time",
    (
        "mbla/contacts/refine.py",
        'points=np.einsum("gc,pcx->pgx", weights, spots).reshape(-1, 2),',
        "1 -> 2",
    ): "of a shape, any negative number is the length that is left",
    (
        "mbla/program/kinematic.py",
        "cut_off_p = _selection(np.where(p_column[rows.cut_off] >= 0, p_column[rows.cut_off], -1), "
        "beta[rows.cut_off], n_p)",
        "1 -> 2",
    ): "any negative number is no column",
}
