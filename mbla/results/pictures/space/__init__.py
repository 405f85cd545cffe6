"""Spatial pictures: what is drawn as plain arrays, the camera, the renderer, and the sheet with words around it."""

from mbla.results.pictures.space.renderer import can_draw as can_draw
