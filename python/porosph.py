"""Reads the runs of Porosph into numpy arrays.

    import porosph
    run = porosph.open_run("results/foundation")
    last = run.frame(-1)
    last["EffectiveStress", "YY"]     # one number per particle [Pa]
    last.points                       # x, y of each particle [m]
    run.history["A.Displacement_Y"]   # over run.history["time"]
    grid = porosph.read_grid("grid.vti")   # of `porosph grid`: one number per node, row by row from below

Needs Python 3.11, numpy and the Python modules of VTK (Debian: python3-vtk9; else the package vtk). Units are SI, stress is
positive in tension. Frames are VTK data sets as well: pyvista.wrap(last.data) shows one.
"""
import csv
import json
import pathlib
import tomllib
import xml.etree.ElementTree

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader


def open_run(folder):
    """The run of a folder, or of a .pvd file in it."""
    path = pathlib.Path(folder)
    return Run(path.parent if path.suffix == ".pvd" else path)


class Run:
    """What a run has left in its folder. Files are read when they are asked for."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        series = self.folder / "particles.pvd"
        entries = xml.etree.ElementTree.parse(series).iter("DataSet")
        frames = [(float(e.get("timestep")), self.folder / e.get("file")) for e in entries if e.get("part", "0") == "0"]
        self.times = numpy.array([time for time, _ in frames])
        self._files = [file for _, file in frames]

    def __len__(self):
        return len(self._files)

    def __iter__(self):
        return (self.frame(i) for i in range(len(self)))

    def frame(self, number=-1, *, time=None):
        """A frame by its number, or the one nearest to a time [s]."""
        if time is not None:
            number = int(numpy.argmin(numpy.abs(self.times - time)))
        return Frame(self._files[number], float(self.times[number]))

    @property
    def case(self):
        """The complete case, as a dict."""
        return tomllib.loads((self.folder / "case.toml").read_text())

    @property
    def summary(self):
        """How the run ended: summary.json, as a dict."""
        return json.loads((self.folder / "summary.json").read_text())

    @property
    def history(self):
        """What the probes recorded: an array for "time" and for each "PROBE.QUANTITY"."""
        with open(self.folder / "history.csv", newline="") as file:
            names, *rows = csv.reader(file)
        columns = numpy.array(rows, dtype=float).reshape(-1, len(names)).T
        return dict(zip(names, columns))


def read_grid(file):
    """What `porosph grid` has written."""
    return Grid(pathlib.Path(file))


class _Fields:
    """The point data of a VTK data set: values["PorePressure"] is an array of one row per point,
    values["EffectiveStress", "YY"] one component of it."""

    def __init__(self, file, reader):
        reader.SetFileName(str(file))
        reader.Update()
        self.data = reader.GetOutput()
        if self.data.GetNumberOfPoints() == 0:
            raise OSError(f"{file} holds no points, or cannot be read")

    def __len__(self):
        return self.data.GetNumberOfPoints()

    @property
    def fields(self):
        """Name and components of each array."""
        arrays = self.data.GetPointData()
        return {arrays.GetArrayName(i): _components(arrays.GetArray(i)) for i in range(arrays.GetNumberOfArrays())}

    def __getitem__(self, name):
        name, component = name if isinstance(name, tuple) else (name, None)
        array = self.data.GetPointData().GetArray(name)
        if array is None:
            raise KeyError(f"no field {name}; there are {', '.join(self.fields)}")
        values = vtk_to_numpy(array)
        if component is None:
            return values
        if component not in _components(array):
            raise KeyError(f"{name} has no component {component}; it has {', '.join(_components(array))}")
        return values[:, _components(array).index(component)]

    def tensor(self, name):
        """A stress or strain as a 3 x 3 matrix per particle, for numpy.linalg."""
        xx, yy, zz, xy, yz, xz = self[name].T
        return numpy.stack([numpy.stack(row, -1) for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))], -2)

    def principal(self, name):
        """Principal values of a tensor, the largest first, one row per particle."""
        return numpy.linalg.eigvalsh(self.tensor(name))[:, ::-1]



class Frame(_Fields):
    """The particles at one time."""

    def __init__(self, file, time):
        super().__init__(file, vtkXMLUnstructuredGridReader() if file.suffix == ".vtu" else vtkXMLPolyDataReader())
        self.time = time  # s

    @property
    def points(self):
        """x, y of each particle [m]."""
        return vtk_to_numpy(self.data.GetPoints().GetData())[:, :2]


class Grid(_Fields):
    """Values at the nodes of a grid, NaN outside of the soil. grid.rows(values) has one row of the picture per row."""

    def __init__(self, file):
        super().__init__(file, vtkXMLImageDataReader())
        columns, rows, _ = self.data.GetDimensions()
        self.shape = rows, columns
        x, y, _ = self.data.GetOrigin()
        spacing = self.data.GetSpacing()[0]
        self.x, self.y = x + spacing * numpy.arange(columns), y + spacing * numpy.arange(rows)  # m

    def rows(self, values):
        return values.reshape(self.shape)


def _components(array):
    count = array.GetNumberOfComponents()
    return [array.GetComponentName(i) or "" for i in range(count)] if count > 1 else []
