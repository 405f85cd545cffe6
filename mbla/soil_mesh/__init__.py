"""Soil mesh stage: corners of soil cells are moved to where the soil slips, in the plane of extrusion.

A mesh of rigid cells lets soil slip along its edges alone: its load factor is an upper one for the continuum, and does
not come down to it by smaller cells, which add no direction to slip in. Moved corners do. The stage solves the
kinematic program of a planar scene (:mod:`~mbla.soil_mesh.planar_scene`, :mod:`~mbla.soil_mesh.planar_program`) and
moves corners where that makes the load factor smaller (:mod:`~mbla.soil_mesh.moving`).
"""
