"""Every quantity that a result holds or reports, declared once; result file, JSON, tables and meshes render them."""

from mbla.results.quantities import registry as registry  # all are declared in one order, whoever asks for one
