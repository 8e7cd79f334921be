from typing import Any, Sequence

import numpy as np
import numpy.typing as npt

__version__: str

class ConfigurationError(ValueError): ...
class ActivityError(RuntimeError): ...
class RunError(RuntimeError): ...

class Robots:
    """The robots of one <external_controller>, in the order of the space."""

    @property
    def ids(self) -> list[str]: ...
    @property
    def sensors(self) -> dict[str, npt.NDArray[np.float64]]:
        """(robots, columns) by type of sensor: views that Simulation.sense brings up to date."""
    @property
    def actuators(self) -> dict[str, npt.NDArray[np.float64]]:
        """(robots, columns) by type of actuator: views; what stands in them is told in the next step."""
    @property
    def columns(self) -> dict[str, list[str]]:
        """Names of the columns of each sensor, or of its rows if it has no columns, and of each other actuator."""
    @property
    def actuator_columns(self) -> dict[str, list[str]]: ...
    @property
    def row_columns(self) -> dict[str, list[str]]: ...
    def rows(self, sensor: str) -> list[npt.NDArray[np.float64]]:
        """(readings, columns) for each robot. Raises KeyError for a sensor without rows."""
    def row_ids(self, sensor: str) -> list[list[str]]:
        """The ids of the entities that the rows of each robot are about: senders of packets, tags; empty if the sensor does not tell."""
    def __len__(self) -> int: ...

class Robot:
    """What a controller in Python sees of its robot."""

    @property
    def id(self) -> str: ...
    @property
    def kind(self) -> str: ...
    @property
    def tick(self) -> int: ...
    @property
    def time(self) -> float:
        """s since the start."""
    @property
    def tick_seconds(self) -> float: ...
    def read(self, sensor: str) -> npt.NDArray[np.float64]:
        """(columns,), or (readings, columns) for sensors that have only readings that differ in number."""
    def rows(self, sensor: str) -> npt.NDArray[np.float64]:
        """(readings, columns). Raises KeyError for a sensor without rows."""
    def row_ids(self, sensor: str) -> list[str]:
        """The ids of the entities that the rows are about; empty if the sensor does not tell."""
    def row_columns(self, sensor: str) -> list[str]: ...
    def set(self, actuator: str, values: Sequence[float]) -> None:
        """All columns of the actuator; it keeps them until it is told others."""
    def columns(self, device: str) -> list[str]: ...
    def uniform(self, low: float, high: float) -> float:
        """The next random number of this robot in this step, the same in every run."""
    def log(self, text: str) -> None: ...

class AttachedRun:
    def __init__(self, *arguments: Any) -> None: ...

class Simulation:
    def __init__(self, *arguments: Any) -> None: ...

def register_controller(label: str, type: type) -> None: ...
def check_study(folder: str) -> None: ...
