"""What soil of cells and water in it press with on blocks, as objects of the JSON record."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.results.collapse.soil_pressure import SoilPressure, soil_pressures, water_pressures
from mbla.results.quantities.group import Field
from mbla.results.record.objects import Object
from mbla.results.record.scene import Scene


@dataclass(frozen=True)
class EarthPressure:
    """Of one soil, or the water in it, on the blocks of one group: with the forces of the result, or at rest."""

    soil: str
    at_rest: bool
    pressure: SoilPressure


EARTH_PRESSURE = Object[EarthPressure]()
_PRESSURE = EARTH_PRESSURE.of(lambda each: each.pressure)

EARTH_PRESSURE.fields(EarthPressure, soil=Field("name of the soil"))
_PRESSURE.fields(
    SoilPressure,
    group=Field("group of the blocks"),
    water=Field("it is that of the water in the soil; joints of the soil press with effective stress"),
)
EARTH_PRESSURE.fields(
    EarthPressure,
    at_rest=Field("under the dead load alone, as the structure stands; else with the forces of the result"),
)
_PRESSURE.fields(SoilPressure, force=Field("on the blocks", "vector", "force"))


@_PRESSURE.key("a coordinate", unit="length")
def point(pressure: SoilPressure) -> list[float] | None:
    """Centre of pressure; null where nothing presses."""
    return None if np.isnan(pressure.point).any() else pressure.point.tolist()


def earth_pressures(scene: Scene) -> list[EarthPressure]:
    """With the forces of the result, then at rest; nothing without soil of cells."""
    model, contacts, standing = scene.model, scene.contacts, scene.solved.solution.standing
    states = {False: None if scene.result is None else scene.result.contact_forces}
    states[True] = None if standing is None or standing.forces is None else standing.forces[: len(contacts.points)]
    water = water_pressures(model, scene.solved.load_case)
    return [
        EarthPressure(model.soils[each.soil].name, at_rest, each)
        for at_rest, forces in states.items()
        if forces is not None
        for each in (*soil_pressures(model, contacts, forces), *water)
    ]
