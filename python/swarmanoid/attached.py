"""A running experiment, looked at and steered from this program."""

import atexit
import dataclasses
import inspect
import weakref

import numpy as np

from . import _module
from .entities import Entities
from .simulation import place_words


class State(Entities):
    """A run at one tick: arrays of its own, which cannot be written and stay as they are while the run goes on.

    tick. time: s since the start. x, y, z: m, qx ... qw: unit quaternions, (entities,) each. attributes: all numbers of all
    entities beside their poses; `attribute` finds those that one looks for. last: no tick follows. real_time_factor:
    simulated seconds in a second, of late. hash: as the last line of `swarmanoid run` has it.
    """

    def __init__(self, run, values):
        # The rows are those of the run.
        self._space, self.ids, self.kinds, self._index = run._space, run.ids, run.kinds, run._index
        self.__dict__.update(values)

    def __repr__(self):
        return f"<State of tick {self.tick}, {len(self.ids)} entities, hash {self.hash}>"


@dataclasses.dataclass(frozen=True)
class Answer:
    """What came of a request. tick: at which it took effect. text: "paused at tick 12"."""

    tick: int
    text: str


@dataclasses.dataclass(frozen=True)
class Readings:
    """Of a device: names and units of its values ("colour": 0xRRGGBB, "yes/no": 1 or 0, "": a plain number)."""

    names: tuple
    units: tuple
    values: np.ndarray


@dataclasses.dataclass(frozen=True)
class RobotStatus:
    """The inside of a robot after the control step of `tick`: id of its controller, what that says of itself, the state of
    its state machine, and the readings of its sensors and actuators by type."""

    tick: int
    controller: str
    text: str
    state: str
    sensors: dict
    actuators: dict


_open = weakref.WeakSet()


@atexit.register
def _close_all():
    # Threads of DDS must not outlive the interpreter.
    for run in list(_open):
        run.close()


class AttachedRun(Entities):
    """A run as a cluster that goes on beside this program, which looks on and is never waited for: `attach` makes it.

    `state()` is the newest state that has come, `wait()` the next one, and a loop over the run all that differ. A state is a
    copy. Requests are those of `swarmanoid control`: they return an Answer once they took effect, raise ValueError for
    what is refused, and RunError without an answer. When the run has ended, `wait` returns None, loops end, and requests
    raise RunError; so does `wait` if the run failed.
    """

    def __init__(self, module_run):
        self._run = module_run
        super().__init__(module_run)
        self._taken = 0  # the number of the newest state that was returned
        self._stale = 0  # states up to this number may be older than the latest request
        _open.add(self)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Leaves the run, which goes on."""
        self._run.close()

    @property
    def experiment(self):
        """Its name."""
        return self._run.experiment

    @property
    def seed(self):
        return self._run.seed

    @property
    def tick_seconds(self):
        return self._run.tick_seconds

    @property
    def max_ticks(self):
        """Of the experiment; 0: it goes on until somebody stops it."""
        return self._run.max_ticks

    # ---- looking ----

    def state(self, timeout=10.0):
        """The newest state that has come, at first and after a request one that has what was asked. timeout: s for such a one,
        then TimeoutError."""
        if self._run.states <= self._stale:
            self._run.wait(0, self._stale, 0, timeout)
        values = self._run.state()
        if values is None:
            raise _module.RunError(self._run.failure or "the run ended before it told a state")
        self._taken = values.pop("number")
        return State(self, values)

    def wait(self, tick=0, timeout=None):
        """A state that `state` and `wait` have not returned yet, of this tick or a later one; None if the run ended before.

        timeout: s, None: as long as it takes; then TimeoutError. A run that is quicker than the states that were asked for
        (`hz`) skips ticks. One that is paused tells its state again for some seconds after a request of anybody, who may
        have moved entities in it, and then nothing until the next one.
        """
        if not self._run.wait(self._taken, self._stale, tick, -1.0 if timeout is None else timeout):
            return None
        return self.state()

    def __iter__(self):
        shown = None
        while (state := self.wait()) is not None:
            if state.hash != shown or state.last:
                yield state
            if state.last:
                return
            shown = state.hash

    @property
    def is_over(self):
        """No state comes any more."""
        return self._run.is_over

    def status(self):
        """How the run goes, a dict: phase ("waiting", "running", "paused", "finished", or "unknown" before anything was heard),
        tick, speed_wanted (0: as fast as possible), real_time_factor, ticks_per_second, ended (why, if somebody asked for it), and
        processes: dicts of name, process ("host:pid"), tick, late_s, doing."""
        return self._run.status()

    def robot(self, entity, timeout=10.0):
        """The RobotStatus of a robot by its id. From the first call on the run tells it, 30 times a second at most; timeout: s
        for the first one."""
        told = self._run.robot(self.index(entity), timeout)
        for devices in ("sensors", "actuators"):
            told[devices] = {name: Readings(tuple(names), tuple(units), values)
                             for name, (names, units, values) in told[devices].items()}
        return RobotStatus(**told)

    # ---- steering: each request of `swarmanoid control` is a method, too, such as run.step(5) and run.move("fb_0", (1, 2, 0)) ----

    def control(self, *words, **options):
        """What `swarmanoid control` does with these words and options: control("step", 5), control("reset", seed=7)."""
        given = {name: str(value) for name, value in options.items() if value is not None}
        answer = Answer(*self._run.control([str(word) for word in words], given))
        # A state that was sent before may still be on its way.
        self._stale = self._run.states + 1
        return answer


def _method_of(verb):
    """The method for a row of the table of requests. A pose is two arguments: position (m) and orientation (degrees)."""
    arguments = []
    for parameter in verb["parameters"]:
        default = None if parameter["optional"] else inspect.Parameter.empty
        if parameter["type"] == "pose":
            arguments += [("position", default), ("orientation", (0, 0, 0))]
        else:
            arguments.append((parameter["name"], default))
    signature = inspect.Signature([inspect.Parameter(name, inspect.Parameter.POSITIONAL_OR_KEYWORD, default=default)
                                   for name, default in [("self", inspect.Parameter.empty), *arguments]])

    def method(self, *words, **named):
        bound = signature.bind(self, *words, **named)
        bound.apply_defaults()
        values, texts, options = bound.arguments, [], {}
        for parameter in verb["parameters"]:
            name = parameter["name"]
            if parameter["type"] == "pose":
                texts.append(place_words(values["position"], values["orientation"]))
            elif values[name] is None:
                continue
            elif parameter["is_option"]:
                options[name] = values[name]
            else:
                texts.append(repr(float(values[name])) if parameter["type"] == "number" else values[name])
        return self.control(verb["name"], *texts, **options)

    method.__name__ = verb["name"].replace("-", "_")
    method.__qualname__ = f"AttachedRun.{method.__name__}"
    method.__signature__ = signature
    method.__doc__ = f"{verb['help']}. As `swarmanoid control {verb['form']}`."
    return method


for _verb in _module.control_verbs():
    setattr(AttachedRun, _verb["name"].replace("-", "_"), _method_of(_verb))


def attach(experiment="", *, domain=None, key="", interface="", peers=(), discovery_server="", insecure=False, hz=30.0,
           wait=0.0, timeout=10.0):
    """Joins a run as a cluster that goes on, as `swarmanoid attach` does; returns an AttachedRun.

    experiment: its name; not needed if one runs on this machine. domain, key, interface, peers, discovery_server, insecure:
    as the options of that command, for runs of other machines; an access grant is taken from SWARMANOID_SHARE. hz: states a second
    at most, up to 30. wait: s for a run to begin. timeout: s for it to be heard.

    Raises ValueError if there is no such run or no way to it, TimeoutError if it is not heard, RunError if it just ended.
    """
    if not 0.01 <= hz <= 30:
        raise ValueError(f"hz is the number of states a second, 0.01 to 30; it is {hz}")
    return AttachedRun(_module.AttachedRun(experiment, domain, str(key), interface, list(peers), discovery_server, insecure,
                                           float(hz), float(wait), float(timeout)))
