"""Tests of structures in time."""
