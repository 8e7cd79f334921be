"""An experiment in this process."""

import dataclasses

import numpy as np

from . import _module
from .entities import Entities


@dataclasses.dataclass(frozen=True)
class Summary:
    """How a run ended. `hash`: of the final state, as the last line of `swarmanoid run` has it."""

    ticks: int
    entities: int
    hash: str
    wall_s: float
    real_time_factor: float
    failed: bool


def _text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple, np.ndarray)):
        return ", ".join(_text(part) for part in value)
    return repr(float(value)) if isinstance(value, (float, np.floating)) else str(value)


def place_words(position, orientation):
    """A place as `swarmanoid control` reads it: the same bits."""
    return ",".join(repr(float(number)) for number in (*position, *orientation))


def controller(label):
    """Decorates a class whose objects control robots: <label id="..."> in <controllers> of an experiment file.

    The class has `control_step(self, robot)`, called every tick, and may have `init(self, robot, parameters)`
    (<parameters> as a dict of texts), `destroy(self, robot)`, `status(self)` (shown beside the robot), and
    `get_state(self)` with `set_state(self, state)` for checkpoints. A class that is defined again replaces the first one.
    """

    def register(type_):
        _module.register_controller(label, type_)
        return type_

    return register


class Simulation(Entities):
    """An experiment at a tick, 0 at first.

    file: of the experiment. settings: changes of it as for `--set`, such as {"framework.seed": 3}.
    output: folder for what functions and visualisations write. threads: that share the sensors, 0: as many as cores are
    free; their number changes no bit. restore: a checkpoint to go on from. hash_log: file for one hash a tick.
    real_time: factor of the pace, 0: as fast as possible.

    Raises ConfigurationError with all mistakes of the file, one a line (file:line:column), ActivityError if somebody's
    code fails, ValueError for what cannot be done.
    """

    def __init__(self, file, settings=None, *, output=".", visualisations=False, threads=1, checkpoint_every=0,
                 restore="", hash_log="", real_time=0.0):
        pairs = [(str(path), _text(value)) for path, value in dict(settings or {}).items()]
        self._simulation = _module.Simulation(str(file), pairs, str(output), visualisations, threads, checkpoint_every,
                                              str(restore), str(hash_log), real_time)
        super().__init__(self._simulation)
        self._summary = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._summary is None:
            self.finish()

    # ---- time ----

    def step(self, ticks=1):
        """Controllers, physics: `ticks` ticks on. False once the experiment is over."""
        return self._simulation.step(ticks)

    def run(self):
        """To the end of the experiment; returns its Summary."""
        while self._simulation.step(1000):
            pass
        return self.finish()

    def finish(self):
        """Ends controllers and functions; returns the Summary. Later calls return the same."""
        if self._summary is None:
            self._summary = Summary(**self._simulation.finish())
        return self._summary

    @property
    def tick(self):
        return self._simulation.tick

    @property
    def time(self):
        """Seconds since the start of the experiment."""
        return self._simulation.time

    @property
    def tick_seconds(self):
        return self._simulation.tick_seconds

    @property
    def max_ticks(self):
        """Of the experiment; 0: it goes on until somebody stops it."""
        return self._simulation.max_ticks

    @property
    def arena(self):
        """Its size (x, y, z), m."""
        return self._simulation.arena

    def hash(self):
        """Of the present state: 16 hexadecimal digits."""
        return self._simulation.hash()

    # ---- the space: arrays over all entities, in the order of `ids` ----

    @property
    def x(self):
        """Positions along x, m, (entities,): a view that follows the simulation. The same holds for y, z, qx, qy, qz, qw."""
        return self._simulation.x

    @property
    def y(self):
        return self._simulation.y

    @property
    def z(self):
        return self._simulation.z

    @property
    def qx(self):
        return self._simulation.qx

    @property
    def qy(self):
        return self._simulation.qy

    @property
    def qz(self):
        return self._simulation.qz

    @property
    def qw(self):
        return self._simulation.qw

    @property
    def attributes(self):
        """All numbers of all entities beside their poses: a view. `attribute` finds those that one looks for."""
        return self._simulation.attributes

    # ---- changes between two steps: part of the experiment ----

    def move(self, entity, position, orientation=(0, 0, 0), overlap=False):
        """Puts a movable entity elsewhere. position: m. orientation: degrees about x, y and z. overlap: accept a position where
        another body stands; the engine pushes the two apart."""
        self._simulation.move(entity, position, orientation, overlap)

    def add(self, entity, position, orientation=(0, 0, 0)):
        """Puts an entity that waits, or the next one of a <reserve>, into the arena; returns its id."""
        return self._simulation.add(entity, position, orientation)

    def remove(self, entity):
        self._simulation.remove(entity)

    def set_attribute(self, entity, name, value, element=0):
        self._simulation.set_attribute(entity, name, value, element)

    # ---- robots that Python steers ----

    @property
    def robots(self):
        """The robots of each <external_controller>, by its id.

        `.sensors[type]`: readings, (robots, columns), views that `sense` brings up to date. `.actuators[type]`: what the
        next step tells the actuators, writable. `.columns[type]`: names of the columns. `.rows(type)`: for sensors whose
        readings differ in number (cameras, radio), an array (readings, columns) for each robot; `.row_columns[type]`: their
        names, `.row_ids(type)`: the ids of the entities that the rows are about.
        """
        return self._simulation.robots

    def sense(self):
        """Brings the sensors of these robots to the present tick; a step would do so, too, before controllers run."""
        self._simulation.sense()
