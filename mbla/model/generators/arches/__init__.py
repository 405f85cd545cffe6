"""What arches and bridges are made of: sections of voussoirs, prisms across the width, piers."""
