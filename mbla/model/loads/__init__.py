"""Loads of a case as forces and moments on blocks, about their centroids; one kind of load per file."""

from mbla.model.loads.kinds import LOAD_KINDS as LOAD_KINDS
from mbla.model.loads.load_case import build_load_cases as build_load_cases
from mbla.model.loads.load_kind import LoadSite as LoadSite
