"""The model stage: from a checked deck to blocks, supports and loads as arrays."""

from mbla.model.build import build_model
from mbla.model.model import Model

__all__ = ["Model", "build_model"]
