"""The kinds of loads, by the key that the deck gives them. A new one is a file, a key of ``Load`` and a line here."""

from __future__ import annotations

from mbla.model.loads.force import force_load, moment_load
from mbla.model.loads.gravity import acceleration_load, gravity_load
from mbla.model.loads.line import line_load
from mbla.model.loads.load_kind import LoadKind
from mbla.model.loads.pressure import pressure_load
from mbla.model.loads.table import table_load
from mbla.model.loads.vehicle import vehicle_load

LOAD_KINDS: dict[str, LoadKind] = {
    "gravity": gravity_load,
    "acceleration": acceleration_load,
    "force": force_load,
    "moment": moment_load,
    "line": line_load,
    "pressure": pressure_load,
    "vehicle": vehicle_load,
    "table": table_load,
}
