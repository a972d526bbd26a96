"""A plugin of Porosph for ParaView 5.11 and later: Tools > Manage Plugins > Load New, or in pvpython LoadPlugin(this file).
ParaView 5.11 with Python 3.11 (Debian 12) loads no plugin in Python before this line has been run in its Python shell:
    import inspect; inspect.getargspec = inspect.getfullargspec

Filters > Porosph > Porosph Invariants     p', q, s', t and principal stresses of the effective stress, compression positive, in kPa
Filters > Porosph > Porosph Section        values along a line, right up to walls and surfaces (ParaView's SPH interpolators are not)
File > Open, a case.toml                   outlines, supports, water levels and probes as blocks
"""
import tomllib

import numpy
from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase, smdomain, smhint, smproperty, smproxy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkMultiBlockDataSet, vtkPolyData


def particles_of(data):
    """The particles of a data set, or of the first block of one."""
    while data is not None and data.IsA("vtkCompositeDataSet"):
        data = data.GetBlock(0)
    if data is None or data.GetNumberOfPoints() == 0:
        raise RuntimeError("the input holds no particles")
    return data


def array_of(data, name):
    array = data.GetPointData().GetArray(name)
    if array is None:
        raise RuntimeError(f"the particles have no array {name}: the case's output.fields must name it")
    return vtk_to_numpy(array)


def add(data, name, values):
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    array.SetName(name)
    data.GetPointData().AddArray(array)


def invariants(stress):
    """Of symmetric tensors [Pa], XX YY ZZ XY YZ XZ, tension positive: s1 >= s2 >= s3, p', q, s', t with compression positive [kPa]."""
    xx, yy, zz, xy, yz, xz = -stress.T / 1e3
    tensor = numpy.stack([numpy.stack(row, -1) for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))], -2)
    s3, s2, s1 = numpy.linalg.eigvalsh(tensor).T
    q = numpy.sqrt(((s1 - s2) ** 2 + (s2 - s3) ** 2 + (s3 - s1) ** 2) / 2)
    return {"s1 [kPa]": s1, "s2 [kPa]": s2, "s3 [kPa]": s3, "p' [kPa]": (s1 + s2 + s3) / 3, "q [kPa]": q,
            "s' [kPa]": (s1 + s3) / 2, "t [kPa]": (s1 - s3) / 2}


@smproxy.filter(label="Porosph Invariants")
@smhint.xml('<ShowInMenu category="Porosph"/>')
@smproperty.input(name="Input", port_index=0)
@smdomain.datatype(dataTypes=["vtkPolyData", "vtkUnstructuredGrid", "vtkCompositeDataSet"], composite_data_supported=False)
class PorosphInvariants(VTKPythonAlgorithmBase):
    def __init__(self):
        super().__init__(nInputPorts=1, nOutputPorts=1, outputType="vtkPolyData")

    def FillInputPortInformation(self, port, info):
        info.Set(self.INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject")
        return 1

    def RequestData(self, request, inputs, outputs):
        data, output = particles_of(vtkDataObject.GetData(inputs[0], 0)), vtkPolyData.GetData(outputs, 0)
        output.SetPoints(data.GetPoints())
        vertices = vtkCellArray()
        for i in range(data.GetNumberOfPoints()):
            vertices.InsertNextCell(1, [i])
        output.SetVerts(vertices)
        output.GetPointData().ShallowCopy(data.GetPointData())
        for name, values in invariants(array_of(data, "EffectiveStress")).items():
            add(output, name, values)
        return 1


def weights_at(place, points, h):
    """Moving least squares, exact for linear fields, with the weights of a cubic spline of support 2 h."""
    offset = (points - place) / h
    r = numpy.hypot(*offset.T)
    weight = numpy.where(r < 1, 1 - 1.5 * r ** 2 + 0.75 * r ** 3, 0.25 * numpy.clip(2 - r, 0, None) ** 3)
    basis = numpy.column_stack([numpy.ones(len(points)), offset])
    first = numpy.linalg.pinv(basis * numpy.sqrt(weight)[:, None])[0]
    return first * numpy.sqrt(weight)


@smproxy.filter(label="Porosph Section")
@smhint.xml('<ShowInMenu category="Porosph"/>')
@smproperty.input(name="Input", port_index=0)
@smdomain.datatype(dataTypes=["vtkPolyData", "vtkUnstructuredGrid", "vtkCompositeDataSet"], composite_data_supported=False)
class PorosphSection(VTKPythonAlgorithmBase):
    """Points further than three quarters of a spacing from the nearest particle are left out; soils are not mixed."""

    def __init__(self):
        super().__init__(nInputPorts=1, nOutputPorts=1, outputType="vtkPolyData")
        self._ends, self._points = [[0.0, 0.0], [0.0, 1.0]], 200

    def FillInputPortInformation(self, port, info):
        info.Set(self.INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject")
        return 1

    @smproperty.doublevector(name="From", default_values=[0.0, 0.0])
    def SetFrom(self, x, y):
        self._ends[0] = [x, y]
        self.Modified()

    @smproperty.doublevector(name="To", default_values=[0.0, 1.0])
    def SetTo(self, x, y):
        self._ends[1] = [x, y]
        self.Modified()

    @smproperty.intvector(name="Points", default_values=200)
    @smdomain.intrange(min=2, max=100000)
    def SetNumberOfPoints(self, points):
        self._points = points
        self.Modified()

    def RequestData(self, request, inputs, outputs):
        data, output = particles_of(vtkDataObject.GetData(inputs[0], 0)), vtkPolyData.GetData(outputs, 0)
        points = vtk_to_numpy(data.GetPoints().GetData())[:, :2]
        h = array_of(data, "SmoothingLength")[0]
        reach = 0.75 * numpy.sqrt(array_of(data, "Mass")[0] / array_of(data, "Density")[0])
        soil = array_of(data, "SoilId")
        begin, end = (numpy.array(p) for p in self._ends)
        if self._points < 2 or not numpy.any(begin != end):
            raise RuntimeError("a section needs two ends that differ, and two points at least")
        along = numpy.linspace(0, numpy.linalg.norm(end - begin), self._points)
        kept, places, chosen = [], [], []
        for distance in along:
            place = begin + (end - begin) * distance / along[-1]
            apart = numpy.hypot(*(points - place).T)
            nearest = numpy.argmin(apart)
            if apart[nearest] > reach:
                continue
            near = numpy.flatnonzero((apart < 2 * h) & (soil == soil[nearest]))
            kept.append(distance)
            places.append([*place, 0.0])
            chosen.append((near, weights_at(place, points[near], h)))
        if not kept:
            raise RuntimeError("the section does not meet the soil")
        line = vtkPoints()
        line.SetData(numpy_to_vtk(numpy.array(places), deep=True))
        output.SetPoints(line)
        cells = vtkCellArray()
        cells.InsertNextCell(len(kept), list(range(len(kept))))
        output.SetLines(cells)
        arrays = data.GetPointData()
        for k in range(arrays.GetNumberOfArrays()):
            values = vtk_to_numpy(arrays.GetArray(k)).astype(float)
            add(output, arrays.GetArrayName(k), numpy.array([weights @ values[near] for near, weights in chosen]))
            array = output.GetPointData().GetArray(arrays.GetArrayName(k))
            for c in range(array.GetNumberOfComponents()):
                name = arrays.GetArray(k).GetComponentName(c)
                if name:
                    array.SetComponentName(c, name)
        add(output, "Distance [m]", numpy.array(kept))
        return 1


def lines(rings, closed):
    """Polylines, one per ring of x, y, with their number as a cell array Number."""
    data, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    for ring in rings:
        first = points.GetNumberOfPoints()
        for x, y in ring:
            points.InsertNextPoint(x, y, 0.0)
        ids = list(range(first, points.GetNumberOfPoints())) + ([first] if closed else [])
        cells.InsertNextCell(len(ids), ids)
    data.SetPoints(points)
    data.SetLines(cells)
    return data


def named(data, names):
    array = vtkStringArray()
    array.SetName("Name")
    for name in names:
        array.InsertNextValue(name)
    data.GetCellData().AddArray(array)
    return data


def scene_of(case):
    """Blocks of a case, by name."""
    soils, supports, probes = case["soil"], case.get("boundary", []), case.get("probe", [])
    rings = [(soil["name"], ring) for soil in soils for ring in [soil["polygon"], *soil.get("holes", [])]]
    x = [corner[0] for soil in soils for corner in soil["polygon"]]
    water = case.get("water", {})
    stretches = water.get("stretches", []) + ([{"level": water["level"]}] if "level" in water else [])
    stretches += [{"level": f["level"], "x_from": min(f["from"][0], f["to"][0]), "x_to": max(f["from"][0], f["to"][0])}
                  for f in water.get("face", []) if f["kind"] == "head" and "from" in f]
    levels = [[(max(s.get("x_from", min(x)), min(x)), s["level"]), (min(s.get("x_to", max(x)), max(x)), s["level"])] for s in stretches]
    marks = vtkPolyData()
    points, cells = vtkPoints(), vtkCellArray()
    for probe in probes:
        cells.InsertNextCell(1, [points.InsertNextPoint(*probe["position"], 0.0)])
    marks.SetPoints(points)
    marks.SetVerts(cells)
    return {"outlines": named(lines([ring for _, ring in rings], True), [name for name, _ in rings]),
            "supports": named(lines([(s["from"], s["to"]) for s in supports], False), [s["kind"] for s in supports]),
            "water": named(lines(levels, False), [f"{s['level']:g} m" for s in stretches]),
            "probes": named(marks, [probe["name"] for probe in probes])}


@smproxy.reader(name="PorosphCase", label="Porosph Case", extensions="toml", file_description="Case of Porosph")
class PorosphCase(VTKPythonAlgorithmBase):
    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkMultiBlockDataSet")
        self._file = None

    @smproperty.stringvector(name="FileName")
    @smdomain.filelist()
    @smhint.filechooser(extensions="toml", file_description="Case of Porosph")
    def SetFileName(self, name):
        if name != self._file:
            self._file = name
            self.Modified()

    def RequestData(self, request, inputs, outputs):
        with open(self._file, "rb") as file:
            case = tomllib.load(file)
        try:
            blocks = scene_of(case)
        except TypeError as error:  # text where a number stands
            raise RuntimeError(f"{self._file}: has values with units; open the case.toml that a run of it writes") from error
        output = vtkMultiBlockDataSet.GetData(outputs, 0)
        for i, (name, block) in enumerate(blocks.items()):
            output.SetBlock(i, block)
            output.GetMetaData(i).Set(output.NAME(), name)
        return 1
