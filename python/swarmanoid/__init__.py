"""Swarmanoid experiments in this process, with NumPy arrays.

>>> import swarmanoid
>>> simulation = swarmanoid.Simulation("configs/diffusion_10.xml", {"framework.seed": 3})
>>> simulation.step(100)
True
>>> simulation.positions().shape
(14, 3)
>>> simulation.finish().hash
'...'

The results have the bits of `swarmanoid run` of the same file. One simulation a thread; several may live side by side.
Lengths are metres, angles radians, orientations that are given as three angles degrees as in experiment files.
"""

import os as _os
import pathlib as _pathlib
import sys as _sys

# The libraries of the simulator find their mathematical functions among themselves, not in the libm of Python: results
# do not depend on the processor then.
_flags = _sys.getdlopenflags()
_sys.setdlopenflags(_os.RTLD_NOW | _os.RTLD_LOCAL | _os.RTLD_DEEPBIND)
try:
    from . import _module
finally:
    _sys.setdlopenflags(_flags)

from ._module import ActivityError, ConfigurationError, Robot, Robots, RunError  # noqa: E402
from .attached import AttachedRun, State, attach  # noqa: E402
from .environment import Environment  # noqa: E402
from .runs import Run, Study  # noqa: E402
from .simulation import Simulation, Summary, controller  # noqa: E402

__version__ = _module.__version__
__all__ = ["ActivityError", "AttachedRun", "ConfigurationError", "Environment", "Robot", "Robots", "Run", "RunError", "Simulation",
           "State", "Study", "Summary", "attach", "controller", "samples", "ParallelEnvironment"]


def samples():
    """The folder of the sample experiments: of the installation, or of the source tree."""
    source = _pathlib.Path(__file__).resolve().parents[2] / "configs"
    return source if source.is_dir() else _pathlib.Path(__file__).parents[4] / "share/swarmanoid/configs"


def __getattr__(name):
    # Loads PettingZoo and Gymnasium where they are installed, which takes its time.
    if name == "ParallelEnvironment":
        from .pettingzoo_environment import ParallelEnvironment

        return ParallelEnvironment
    raise AttributeError(f"module 'swarmanoid' has no attribute '{name}'")
