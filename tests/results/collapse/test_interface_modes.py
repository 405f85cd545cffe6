"""Modes of interfaces, and sums over their points."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.results.collapse.interface_modes import (
    InterfaceMode,
    InterfaceMotion,
    interface_motion,
    largest_by_interface,
    sum_by_interface,
)
from mbla.solution.solution import ContactMode, Mechanics
from mbla.solution.verification.statics import contact_velocities
from tests.results.synthetic import tower_contacts, tower_mechanics, tower_model

MODEL, CONTACTS, MECHANICS = tower_model(), tower_contacts(), tower_mechanics()
STICK, SLIDE, OPEN = ContactMode.STICK, ContactMode.SLIDE, ContactMode.OPEN
EDGE, CORNER, BED = np.array([1.0, 0.5, 1]), np.array([1.0, 1, 1]), np.array([0.5, 0.5, 1])


def turning(axis_point: Any, rotation: Any, velocity: Any = (0, 0, 0)) -> Mechanics:
    """The tower turns about a point, and moves besides; modes of its bed as the law without dilatancy has them."""
    mechanism = np.zeros((3, 6))
    arm = MODEL.blocks.centroids[1] - np.asarray(axis_point, float)
    mechanism[1, 3:] = rotation
    mechanism[1, :3] = np.asarray(velocity, float) + np.cross(mechanism[1, 3:], arm)
    velocities = contact_velocities(MODEL, CONTACTS, mechanism)
    speed = np.abs(velocities).max()
    modes = np.full(8, STICK)
    modes[np.hypot(velocities[:, 1], velocities[:, 2]) > 1e-9 * speed] = SLIDE
    modes[velocities[:, 0] > 1e-9 * speed] = OPEN
    return replace(MECHANICS, mechanism=mechanism, contact_velocities=velocities, modes=modes)


def motion_of(mechanics: Mechanics) -> InterfaceMotion:
    motion = interface_motion(MODEL, CONTACTS, mechanics)
    assert motion.modes[1] == InterfaceMode.STICK  # the brick stays in every case here
    return motion


@pytest.mark.parametrize(
    ("mechanics", "mode", "slides"),
    [
        (turning(EDGE, (0, 1, 0)), InterfaceMode.HINGE, False),
        (turning(CORNER, (-1, 1, 0)), InterfaceMode.HINGE, False),
        (turning(EDGE, (0, 1, 0), (0.5, 0, 0)), InterfaceMode.HINGE, True),
        (turning(EDGE, (0, 1, 0), (2, 0, 0)), InterfaceMode.SLIDE, True),  # slides more than it opens
        (turning(BED, (0, 0, 0), (1, 0, 0)), InterfaceMode.SLIDE, True),
        (turning(BED, (0, 0, 1)), InterfaceMode.TWIST, True),
        (turning((0.5, 1.1, 1), (0, 0, 1)), InterfaceMode.TWIST, True),  # centre within the circle of the corners
        (turning((0.5, 1.3, 1), (0, 0, 1)), InterfaceMode.SLIDE, True),
        (turning(BED, (0, 0, 0), (0, 0, 1)), InterfaceMode.OPEN, False),
        (turning((9, 0.5, 1), (0, 1, 0)), InterfaceMode.OPEN, False),  # its axis lies outside the bed
    ],
)
def test_modes_of_rigid_motions(mechanics: Mechanics, mode: InterfaceMode, slides: bool) -> None:
    motion = motion_of(mechanics)
    assert InterfaceMode(int(motion.modes[0])) is mode
    assert bool(motion.slides[0]) is slides
    assert motion.count(mode) == 1
    assert np.isfinite(motion.hinge_points[0]).all() == (mode is InterfaceMode.HINGE)
    assert np.isnan(motion.hinge_points[1]).all()


def test_the_axis_lies_in_the_interface_though_the_rotation_does_not() -> None:
    """The tower rocks about its edge and spins a little about the vertical."""
    motion = motion_of(turning(EDGE, (0, 1, 0.2)))
    assert InterfaceMode(int(motion.modes[0])) is InterfaceMode.HINGE
    assert motion.hinge_directions[0] == pytest.approx([0, 1, 0])


def test_where_one_side_crushes_the_axis_is_the_line_between() -> None:
    """Turning about the line x = 0.8 the edge x = 1 is pressed in and the edge x = 0 opens."""
    motion = motion_of(turning((0.8, 0.5, 1), (0, 1, 0)))
    assert InterfaceMode(int(motion.modes[0])) is InterfaceMode.HINGE
    assert motion.hinge_points[0] == pytest.approx([0.8, 0.5, 1])


def test_an_associative_hinge_that_slides_keeps_its_axis_at_the_edge() -> None:
    """With dilatancy the closed edge lifts too; the axis of the forces stays where the faces touch."""
    mechanics = turning(EDGE, (0, 1, 0), (0.3, 0, 0.3 * 0.65))
    modes = mechanics.modes.copy()
    modes[[1, 2]] = SLIDE  # as the associative rule counts them
    motion = motion_of(replace(mechanics, modes=modes))
    assert InterfaceMode(int(motion.modes[0])) is InterfaceMode.HINGE
    assert motion.hinge_points[0] == pytest.approx(EDGE)


def test_a_hinge_about_a_corner_has_no_length() -> None:
    ends = motion_of(turning(CORNER, (-1, 1, 0))).hinge_ends
    assert ends[0].tolist() == [CORNER.tolist(), CORNER.tolist()]


@pytest.mark.parametrize(("angle", "reach"), [(0.0, 0.5), (20.0, 0.5 * np.cos(np.radians(20.0)))])
def test_a_hinge_that_crushes_reaches_as_far_as_its_closed_points(angle: float, reach: float) -> None:
    """Its axis goes through (0.75, 0.5), the closed side x = 1 from y = 0 to y = 1; the mean of both is on it."""
    direction = np.array([np.sin(np.radians(angle)), np.cos(np.radians(angle)), 0])
    ends = motion_of(turning((0.75, 0.5, 1), direction)).hinge_ends[0]
    middle = np.array([0.75, 0.5, 1]) + 0.25 * direction[0] * direction
    assert ends == pytest.approx(middle + np.array([[-reach], [reach]]) * direction)


def test_a_hinge_that_slides_ends_where_its_faces_touch_though_its_axis_runs_off() -> None:
    """With dilatancy one end of the closed edge lifts more than the other, so that the tilt is askew to the edge."""
    mechanics = turning(EDGE, (0.1, 1, 0), (0.3, 0, 0.3))
    modes = mechanics.modes.copy()
    modes[[1, 2]] = SLIDE
    motion = motion_of(replace(mechanics, modes=modes))
    assert motion.hinge_directions[0, 0] == pytest.approx(0.1 / np.hypot(0.1, 1))
    assert motion.hinge_ends[0].tolist() == [[1, 0, 1], [1, 1, 1]]


# ---  ---------------------------------------------------------------------------------------------------------------


def test_sums_and_largest_of_each_interface() -> None:
    contacts, values = tower_contacts(), np.array([1.0, 2, 3, 4, -5, -6, -7, -8])
    assert sum_by_interface(contacts, values).tolist() == [10, -26]
    assert sum_by_interface(contacts, np.column_stack([values, values])).tolist() == [[10, 10], [-26, -26]]
    assert sum_by_interface(contacts, values > 2).tolist() == [2, 0]
    assert largest_by_interface(contacts, values).tolist() == [4, 0]
