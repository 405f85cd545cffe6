"""Interfaces: geometry, resultants, thrust, modes and relative motion; and what the search for contacts reports."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.contacts.contacts import ContactReport, Contacts
from mbla.results.collapse.collapse import Collapse
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion, relative_motion
from mbla.results.collapse.thrust import Thrust
from mbla.results.quantities.answers import claimed_collapse
from mbla.results.quantities.group import Field, Group
from mbla.results.quantities.model import joined
from mbla.results.quantities.points import declare_figures
from mbla.results.record.scene import Scene, Values, as_text

SCENE = Group[Scene](lambda scene: scene, table="interfaces")
CONTACTS = Group[Contacts](lambda scene: scene.contacts, file="contacts", table="interfaces")
REPORT = Group[ContactReport](lambda scene: scene.contacts.report, file="contacts/report")
THRUST = Group[Thrust](lambda scene: scene.thrust, table="interfaces")
COLLAPSE = Group[Collapse](
    lambda scene: scene.collapse,
    claim=claimed_collapse,
    file="cases/*/interfaces",
    table="interfaces",
    part="mechanics",
)
_MOTION = Group[InterfaceMotion](lambda scene: scene.interfaces, table="interfaces")


def mode_names(_: Scene) -> list[str]:
    """What numbers of modes stand for."""
    return [mode.name.lower() for mode in InterfaceMode]


@SCENE.quantity("table interfaces thrust hinges", dims="interface")
def interface(scene: Scene) -> IntArray:
    """Number of the interface, from 0."""
    return np.arange(len(scene.contacts))


CONTACTS.fields(
    Contacts,
    joint_names=Field("joint laws in use", "used_joint"),
    point_start=Field("first contact point", "interface_bound", rule="start of point"),
    outline=Field("how many of its points form the outer boundary, in order", "interface"),
    bodies=Field(
        "bodies a and b: blocks, then grounds",
        "interface pair",
        rule="index of body",
        files="table interfaces thrust hinges",
    ),
)


@SCENE.quantity("table", dims="interface pair")
def body_names(scene: Scene) -> Values:
    """Names of bodies a and b."""
    bodies = range(len(scene.model.blocks) + len(scene.model.grounds))
    return as_text([scene.model.body_name(body) for body in bodies])[scene.contacts.bodies]


CONTACTS.fields(
    Contacts,
    joints=Field(
        "joint law, as row of joint_names",
        "interface",
        rule="index of used_joint",
        files="table interfaces",
        names=lambda scene: scene.contacts.joint_names,
    ),
)


@SCENE.quantity("table", dims="interface")
def point_count(scene: Scene) -> IntArray:
    """Its contact points."""
    return np.diff(scene.contacts.point_start)


CONTACTS.fields(
    Contacts,
    areas=Field("area", "interface", unit="area", files="table interfaces"),
    centroids=Field("centroid", "interface axis", unit="length", files="table"),
    normals=Field("unit normal from a to b", "interface axis", files="table interfaces"),
    gaps=Field(
        "greatest distance of the faces, negative: overlap", "interface", unit="length", files="table interfaces"
    ),
)


declare_figures(SCENE, "table interfaces thrust hinges", "interface", lambda scene: scene.contacts)


@THRUST.quantity("table interfaces thrust", dims="interface axis", unit="force")
def resultant_forces(thrust: Thrust) -> FloatArray:
    """Resultant on body b."""
    return thrust.forces


@SCENE.quantity("table interfaces", dims="interface axis", unit="moment")
def resultant_moments(scene: Scene) -> FloatArray | None:
    """Moment on body b about the centroid of the interface."""
    return scene.moments


@THRUST.quantity("table interfaces thrust", dims="interface", unit="force")
def normal_forces(thrust: Thrust) -> FloatArray:
    """Normal part of the resultant, compression positive."""
    return thrust.normal_forces


@THRUST.quantity("table interfaces thrust", dims="interface", unit="force")
def shear_forces(thrust: Thrust) -> FloatArray:
    """Size of its part along the interface."""
    return thrust.shear_forces


@THRUST.quantity("table interfaces thrust", dims="interface", unit="moment")
def torsions(thrust: Thrust) -> FloatArray:
    """Moment about the normal through the centroid."""
    return thrust.torsions


@THRUST.quantity("table interfaces", dims="interface axis", unit="length")
def thrust_points(thrust: Thrust) -> FloatArray:
    """Where the resultant acts in the plane of the interface; none where it is not pressed."""
    return thrust.points


@THRUST.quantity("table interfaces thrust", dims="interface")
def eccentricity(thrust: Thrust) -> FloatArray:
    """Of it: 0 central, 1 at the edge, more only with tension."""
    return thrust.eccentricity


@THRUST.quantity("table interfaces thrust", dims="interface")
def friction_use(thrust: Thrust) -> FloatArray:
    """Shear over what friction and cohesion allow, without torsion; none where they allow none and none acts."""
    return thrust.friction_use


@SCENE.quantity("table interfaces thrust", dims="interface")
def torsion_use(scene: Scene) -> FloatArray | None:
    """Shear and torsion together over what the interface carries of both."""
    return scene.torsion_use


@COLLAPSE.quantity("table interfaces", dims="interface", names=mode_names)
def modes(collapse: Collapse) -> IntArray:
    """Mode: 0 stick, 1 slide, 2 open, 3 hinge, 4 twist, 5 crush; follows from the mechanism."""
    return collapse.interfaces.modes


@_MOTION.quantity("interfaces", dims="interface")
def slides(motion: InterfaceMotion) -> BoolArray:
    """1 where closed points slide, whatever the mode."""
    return motion.slides


@_MOTION.quantity("interfaces", dims="interface")
def crushes(motion: InterfaceMotion) -> BoolArray:
    """1 where closed points crush, whatever the mode."""
    return motion.crushes


@COLLAPSE.quantity("table", dims="interface axis", unit="velocity")
def translations(collapse: Collapse) -> FloatArray:
    """Velocity of b relative to a at the centroid."""
    return collapse.interfaces.translation


@COLLAPSE.quantity("table", dims="interface axis", unit="rotation")
def rotations(collapse: Collapse) -> FloatArray:
    """Angular velocity of b relative to a."""
    return collapse.interfaces.rotation


@COLLAPSE.quantity("table interfaces", dims="interface")
def work(collapse: Collapse) -> FloatArray:
    """Power dissipated; that of the live load is the load factor."""
    return collapse.work.dissipated


@COLLAPSE.quantity("table", dims="interface axis", unit="length", rule="open")
def hinge_points(collapse: Collapse) -> FloatArray:
    """A point on the axis of a hinge, nan for other modes."""
    return collapse.interfaces.hinge_points


@COLLAPSE.quantity("table", dims="interface axis", rule="open")
def hinge_directions(collapse: Collapse) -> FloatArray:
    """Its direction, by the right hand for b against a, nan for other modes."""
    return collapse.interfaces.hinge_directions


@SCENE.quantity("table", dims="interface axis")
def certificate_translations(scene: Scene) -> FloatArray | None:
    """No equilibrium: velocity of b relative to a in the motion that proves it."""
    found = scene.certificate
    return None if found is None else relative_motion(scene.model, scene.contacts, found)[0]


@SCENE.quantity("table", dims="interface axis", unit="per_length")
def certificate_rotations(scene: Scene) -> FloatArray | None:
    """No equilibrium: angular velocity in it."""
    found = scene.certificate
    return None if found is None else relative_motion(scene.model, scene.contacts, found)[1]


REPORT.fields(
    ContactReport,
    slivers=Field("bodies of surfaces left out", "sliver pair", rule="index of body"),
    sliver_widths=Field("their width relative to block size", "sliver"),
    near_misses=Field("bodies of near misses", "near_miss pair", rule="index of body"),
    near_miss_gaps=Field("their distance relative to block size", "near_miss"),
    overlaps=Field("blocks that overlap", "overlap pair", rule="index of body"),
    overlap_depths=Field("the depth relative to block size", "overlap"),
    overlap_swallows=Field("1 where one reaches through half of the other", "overlap"),
    unchecked=Field("overlaps not judged", "unchecked_pair pair", rule="index of body"),
    fixed_contacts=Field("contacts between fixed bodies, left out"),
    open_interfaces=Field("interfaces whose joint law is open, left out"),
    glued=Field("bodies of internal interfaces of glued bodies", "glued_interface pair", rule="index of body"),
    held=Field("blocks that do not move because they are glued to a support", "held_block", rule="index of block"),
    isolated=Field("blocks without contact", "isolated_block", rule="index of block"),
)


@REPORT.quantity(dims="unsupported_bound", rule="start of unsupported_block")
def unsupported_start(report: ContactReport) -> IntArray:
    """First block of each part that reaches no support."""
    return starts(np.array([len(part) for part in report.unsupported], dtype=np.int64))


@REPORT.quantity(dims="unsupported_block", rule="index of block")
def unsupported_blocks(report: ContactReport) -> IntArray:
    """Blocks of these parts."""
    return joined(report.unsupported)
