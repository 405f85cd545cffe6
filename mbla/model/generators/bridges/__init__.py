"""What bridges are made of besides arches: their outline, and coursed masonry cut to it."""
