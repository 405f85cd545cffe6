"""What forces ask of the units themselves, which the programs take as rigid and unbreakable."""
