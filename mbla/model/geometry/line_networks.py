"""Fields that the lines of a drawing enclose between them, as in an elevation drawn joint by joint."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.geometry.geometry import GeometryFileError
from mbla.model.solids.measures import connected_labels

MEET = 1e-6
"""distance, relative to the extent of the lines, at which ends meet: drawings are kept in double precision"""
MOST_MEETINGS, SEGMENTS_AT_ONCE = 100_000, 20
"""of segments of lines, their common ends included: those of some twenty thousand stones drawn joint by joint"""


def enclosed_fields(lines: list[FloatArray]) -> tuple[list[FloatArray], int]:
    """Outlines (n, 2) of the bounded fields without other lines in them, and how many lines bound none.

    lines : (n, 2) each; they may cross and end on each other

    Fields are in order of their least corners, from the bottom, so that the order of the lines does not matter.

    Raises
    ------
    GeometryFileError
        for lines that meet each other far more often than those of a drawing
    MemoryError
        where the network does not fit in what may be written
    """
    import shapely

    points = _ends_joined(np.concatenate(lines), np.cumsum([len(line) for line in lines])[:-1])
    _refuse_tangle(points)
    try:
        network = shapely.unary_union([shapely.LineString(each) for each in points if np.ptp(each, axis=0).any()])
        fields, cuts, dangles, _ = shapely.polygonize_full([network])
    except shapely.GEOSException as error:
        if "bad_alloc" in str(error):
            raise MemoryError from error
        raise
    loose = sum(len(shapely.get_parts(part)) for part in (cuts, dangles))
    outlines = [np.asarray(shapely.get_coordinates(shapely.get_exterior_ring(each)))[:-1] for each in fields.geoms]
    corners = np.array([outline.min(axis=0) for outline in outlines]).reshape(-1, 2)
    return [outlines[row] for row in np.lexsort((corners[:, 0], corners[:, 1]))], int(loose)


def _refuse_tangle(lines: list[FloatArray]) -> None:
    """Refuse lines that meet more than ``MOST_MEETINGS`` times: few lines can enclose millions of fields."""
    import shapely

    segments = shapely.linestrings(np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in lines]))
    tree = shapely.STRtree(segments)
    meetings = 0
    for begin in range(0, len(segments), SEGMENTS_AT_ONCE):
        meetings += tree.query(segments[begin : begin + SEGMENTS_AT_ONCE], predicate="intersects").shape[1]
        if meetings > 2 * MOST_MEETINGS + len(segments):  # each is found from both sides, and every one meets itself
            words = f"has lines that meet each other more than {MOST_MEETINGS:,} times"
            raise GeometryFileError("geometry-too-large", words)


def _ends_joined(points: FloatArray, splits: np.typing.NDArray[np.int64]) -> list[FloatArray]:
    """Lines again, points that nearly coincide made equal."""
    from scipy.spatial import cKDTree

    reach = MEET * float(np.ptp(points, axis=0).max())
    pairs = cKDTree(points).query_pairs(reach, output_type="ndarray")
    labels = connected_labels(pairs.reshape(-1, 2).astype(np.int64), len(points))
    first = np.unique(labels, return_index=True)[1]
    return np.split(points[first[labels]], splits)
