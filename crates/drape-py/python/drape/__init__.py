"""From measured fabric to moving cloth.

Fabrics are fitted to the curves of a laboratory (`fit`), scenes are read (`Scene`), run
(`Scene.run`) or stepped (`Simulation`), and stored runs are opened again (`open`). All numbers are
in SI; y is up.
"""

from ._errors import Error, InputError, Mistake, OutputError, SolverError, UsageError
from ._fit import Fabric, Fit, Parameter, Parameters, Sheet, fit, read_sheet
from ._instruments import cases, drapemeter, validate
from ._run import Frames, Run, View, open, view
from ._scene import Frame, Progress, Scene, Simulation, Step, resume

__all__ = [
    "Error",
    "Fabric",
    "Fit",
    "Frame",
    "Frames",
    "InputError",
    "Mistake",
    "OutputError",
    "Parameter",
    "Parameters",
    "Progress",
    "Run",
    "Scene",
    "Sheet",
    "Simulation",
    "SolverError",
    "Step",
    "UsageError",
    "View",
    "cases",
    "drapemeter",
    "fit",
    "open",
    "read_sheet",
    "resume",
    "validate",
    "view",
]
