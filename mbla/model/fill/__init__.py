"""Fill above arches and vaults: its weight, what it does to blocks that move sideways, how loads on it spread."""
