"""A structure in time: implicit steps of its elastic joints with masses, from rest under its dead load."""
