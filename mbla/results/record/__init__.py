"""Every quantity that a result holds or reports, described once; result file, JSON, tables and VTU files render it."""
