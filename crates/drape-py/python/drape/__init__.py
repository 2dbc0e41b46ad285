"""From measured fabric to moving cloth.

Fabrics are fitted to the curves of a laboratory (`fit`), scenes are read (`Scene`) or built
(`SceneBuilder`), run (`Scene.run`) or stepped (`Simulation`), and stored runs are opened again (`open`). Files of
others are converted (`convert`), and fabrics are written for other programs (`Fabric.export`). All numbers are in SI; y is
up.
"""

from importlib.metadata import version as _version

from ._builder import SceneBuilder
from ._convert import Converted, convert
from ._errors import (
    Edit,
    Error,
    InputError,
    InternalError,
    Mistake,
    NoEntryError,
    NoFrameError,
    OutputError,
    RunWarning,
    SolverError,
    UsageError,
)
from ._fit import (
    Curve,
    Fabric,
    Fit,
    Fits,
    Parameter,
    Parameters,
    Sheet,
    fit,
    fit_all,
    read_sheet,
)
from ._instruments import cases, drapemeter, validate
from ._run import Frames, Run, View, open, view
from ._scene import Frame, Progress, Scene, Simulation, Step, resume

__all__ = [
    "Converted",
    "Curve",
    "Edit",
    "Error",
    "Fabric",
    "Fit",
    "Fits",
    "Frame",
    "Frames",
    "InputError",
    "InternalError",
    "Mistake",
    "NoEntryError",
    "NoFrameError",
    "OutputError",
    "Parameter",
    "Parameters",
    "Progress",
    "Run",
    "RunWarning",
    "Scene",
    "SceneBuilder",
    "Sheet",
    "Simulation",
    "SolverError",
    "Step",
    "UsageError",
    "View",
    "cases",
    "convert",
    "drapemeter",
    "fit",
    "fit_all",
    "open",
    "read_sheet",
    "resume",
    "validate",
    "view",
]

__version__ = _version("drape-sim")
