"""CAD parts read by the OpenCASCADE that cadquery-ocp brings (the extra [cad]), for packages built without the component.

What src/cad/occt does in C++: triangles that know their faces, edges as polylines, names, and the way back to the exact shape.
"""
from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepTools import BRepTools
from OCP.Extrema import Extrema_ExtAlgo, Extrema_ExtFlag
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.GeomAPI import GeomAPI_ProjectPointOnCurve, GeomAPI_ProjectPointOnSurf
from OCP.gp import gp_Pnt, gp_Vec
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE, TopAbs_FORWARD, TopAbs_REVERSED, TopAbs_SOLID
from OCP.TopExp import TopExp, TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Shape, TopoDS_Vertex
from OCP.TopTools import TopTools_IndexedDataMapOfShapeListOfShape, TopTools_IndexedMapOfShape

from ._errors import BadInput, BadGeometry
from ._ocp_document import Document, read_document

SHARP, TANGENT, SEAM, OPEN = range(4)  # hexwright::CadEdgeClass
PLANE, CYLINDER, CONE, SPHERE, TORUS, SPLINE, OTHER = range(7)  # hexwright::CadSurfaceKind
PROBES = (0.1, 0.3, 0.5, 0.7, 0.9)  # an edge's ends make normals doubtful

Point = tuple[float, float, float]


def _point(p: Any) -> Point:
    return (p.X(), p.Y(), p.Z())


def _explore(shape: TopoDS_Shape, kind: Any) -> Iterator[TopoDS_Shape]:
    it = TopExp_Explorer(shape, kind)
    while it.More():
        yield it.Current()
        it.Next()
