"""Tests of the motion of the base."""
