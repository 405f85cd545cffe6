"""Sections of vaults written down anew: circles with joints at equal angles."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray


def joints_of_circle(radius: float, thickness: float, half_angle: float, courses: int) -> FloatArray:
    """Joints (courses + 1, 2, 2) from the left springing: distance to the right of the middle, height."""
    angles = np.linspace(-half_angle, half_angle, courses + 1)
    centre = -radius * np.cos(half_angle)
    rays = np.stack([np.sin(angles), np.cos(angles)], axis=1)
    return np.stack([rays * reach + [0, centre] for reach in (radius, radius + thickness)], axis=1)


def areas_and_centroids(joints: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Area of each course's profile, and its centroid's distance from the middle (signed), by shoelace sums."""
    profile = np.stack([joints[:-1, 0], joints[1:, 0], joints[1:, 1], joints[:-1, 1]], axis=1)
    after = np.roll(profile, -1, axis=1)
    cross = profile[..., 0] * after[..., 1] - profile[..., 1] * after[..., 0]
    area = cross.sum(axis=1) / 2
    centroid = ((profile[..., 0] + after[..., 0]) * cross).sum(axis=1) / (6 * area)
    return np.abs(area), centroid
