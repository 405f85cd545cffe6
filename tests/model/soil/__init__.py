"""Soil as rigid cells."""
