"""How far the dead load alone is from the limit of what is carried."""
