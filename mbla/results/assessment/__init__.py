"""What codes ask of a mechanism: spectra, articles, and the figures of a load case."""
