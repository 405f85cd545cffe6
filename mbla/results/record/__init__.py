"""Every quantity that a result holds or tells, described once; result file, JSON, tables and VTU files render it."""
