"""The range of load factors without normality of a structure with soil of cells."""
