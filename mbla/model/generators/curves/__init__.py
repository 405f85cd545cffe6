"""Plane curves of arches and vaults. A new one is a file, a line here and a line in ``named.py``."""

from __future__ import annotations

from mbla.model.generators.curves.basket import Basket as Basket
from mbla.model.generators.curves.catenary import Catenary as Catenary
from mbla.model.generators.curves.circle import Circle as Circle
from mbla.model.generators.curves.circle import segmental as segmental
from mbla.model.generators.curves.curve import Curve as Curve
from mbla.model.generators.curves.ellipse import Ellipse as Ellipse
from mbla.model.generators.curves.named import SIDE_ANGLE as SIDE_ANGLE
from mbla.model.generators.curves.named import named_curve as named_curve
from mbla.model.generators.curves.pointed import Pointed as Pointed
from mbla.model.generators.curves.spline import Spline as Spline
