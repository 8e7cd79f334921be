"""Runs the scripts of <python_controller>, inside the interpreter of a process with robots. C++ calls it (script_group.cpp); docs/scripts.md
has the interface for scripts. Rows of all arrays are robots, in the order of the space."""

import ast
import json
import os
import pickle
import sys
import types

np = None  # loaded with the first script; reading a declaration does not need it
NUMBERS = "biuf"  # kinds of NumPy types that a state may have


class ScriptError(Exception):
    """A mistake in a script whose text names file and line."""


def read(path, file):
    with open(path, encoding="utf-8-sig") as script:
        text = script.read()
    return text, compile(text, file, "exec", dont_inherit=True)


def declaration(path, file):
    """The parameters that a script declares: [(name, [(field, [(kind, text)])])]. The script is read and not run."""
    text, _ = read(path, file)
    for node in ast.parse(text, file).body:
        call = getattr(node, "value", None)
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "parameters":
            if call.args or any(one.arg is None for one in call.keywords):
                raise ScriptError(f"{file}:{call.lineno}: parameters(name=…) takes a declaration for each name")
            return [(one.arg, fields(one, file)) for one in call.keywords]
    return []


def fields(keyword, file):
    try:
        declared = ast.literal_eval(keyword.value)
        if not isinstance(declared, dict):
            declared = {"default": declared}
        return [(str(field), [plain(value) for value in (values if isinstance(values, (list, tuple)) else [values])])
                for field, values in declared.items()]
    except ValueError:
        raise ScriptError(f"{file}:{keyword.value.lineno}: the parameter '{keyword.arg}' must be declared by numbers, texts and booleans alone, "
                          "since programs read the declaration without running the script") from None


def plain(value):
    if isinstance(value, bool):
        return "boolean", "true" if value else "false"
    if isinstance(value, (int, float)):
        return "number", repr(value)
    if isinstance(value, str):
        return "text", value
    raise ValueError(value)


class Arrays(dict):
    """Arrays of devices by type, made when the script asks for them."""

    def __init__(self, make):
        super().__init__()
        self._make = make

    def __missing__(self, key):
        self[key] = self._make(key)
        return self[key]


class State:
    """What the robots keep between steps: arrays with a row for each robot, of numbers or booleans."""

    def __init__(self, count):
        object.__setattr__(self, "_count", count)

    def __setattr__(self, name, value):
        # A copy in C's order: two names never share memory, and sums have the same order whatever the count of robots.
        value = np.array(value, order="C")
        if value.ndim == 0:
            value = np.full(self._count, value)
        if value.dtype.kind not in NUMBERS:
            raise TypeError(f"the state '{name}' has the type {value.dtype}; it must have numbers or booleans")
        if value.shape[0] != self._count:
            raise ValueError(f"the state '{name}' has {value.shape[0]} rows for {self._count} robots")
        self.__dict__[name] = value

    def names(self):
        return sorted(name for name in self.__dict__ if name != "_count")

    def row(self, k):
        return {name: np.array(self.__dict__[name][k], order="C") for name in self.names()}


class Robots:
    """Some robots of a script, as it sees them."""

    def __init__(self, native, rows=None):
        self._native = native
        self.ids, self.keys = native.ids(), native.keys()
        self.places = {key: k for k, key in enumerate(self.keys)}
        self.state = State(len(self.ids))
        for name in sorted(rows[0]) if rows else ():
            setattr(self.state, name, np.stack([row[name] for row in rows]))
        self.columns = {type: native.columns(type) for type in native.sensors()}
        self.row_columns = {type: native.row_columns(type) for type in native.sensors()}
        self.actuator_columns = {type: native.actuator_columns(type) for type in native.actuators()}

    def __len__(self):
        return len(self.ids)

    def begin(self):
        """Forgets the readings and settings of the step before."""
        self._native.begin()
        self.tick, self.time, self.tick_seconds = self._native.tick(), self._native.time(), self._native.tick_seconds()
        self.sensors = Arrays(self._native.read)
        self.actuators = Arrays(self._settings)

    def _settings(self, type):
        if type not in self.actuator_columns:
            raise KeyError(f"the robots have no actuator '{type}'; they have: {', '.join(self.actuator_columns)}")
        # NaN leaves an actuator as it is.
        return np.full((len(self), len(self.actuator_columns[type])), np.nan)

    def commit(self):
        for type, values in self.actuators.items():
            self._native.set(type, np.ascontiguousarray(values, dtype=float))

    def rows(self, type):
        return self._native.rows(type)

    def row_ids(self, type):
        return self._native.row_ids(type)

    def uniform(self, low=0.0, high=1.0, columns=None):
        numbers = self._native.uniform(low, high, columns or 1)
        return numbers if columns else numbers[:, 0]

    def gaussian(self, mean=0.0, deviation=1.0, columns=None):
        numbers = self._native.gaussian(mean, deviation, columns or 1)
        return numbers if columns else numbers[:, 0]

    def log(self, robot, text):
        self._native.log(robot, str(text))


class Script:
    """The script of an entry of <controllers>, with the robots of this process that have it."""

    def __init__(self, path, file, parameters):
        global np
        import numpy
        np = numpy
        self.file, self.folder = file, os.path.dirname(os.path.abspath(path))
        self.rows = {}  # state by the keys of robots; older than that of `robots` for those
        self.robots = None  # of the last step
        self.checked = None
        _, code = read(path, file)
        self.module = types.ModuleType("controller")
        self.module.__file__ = path
        self.module.parameters = lambda **_: types.SimpleNamespace(**parameters)
        if self.folder not in sys.path:
            sys.path.insert(0, self.folder)
        exec(code, self.module.__dict__)
        if not callable(getattr(self.module, "step", None)):
            raise ScriptError(f"{file}: the script has no function step(robots)")
        self.plain = self._plain()

    def _call(self, name, robots):
        robots.begin()
        if name == "step" or hasattr(self.module, name):
            getattr(self.module, name)(robots)
        robots.commit()

    # The next functions get robots of C++. All but gather get one robot, or its key.
    def add(self, native):
        robots = Robots(native)
        self._call("init", robots)
        self.rows[robots.keys[0]] = robots.state.row(0)

    def destroy(self, native):
        self._scatter()
        self._call("destroy", Robots(native, [self.rows[native.keys()[0]]]))

    def remove(self, key):
        self._scatter()
        self.rows.pop(key, None)

    def has_state(self, key):
        return bool(self.rows.get(key)) or getattr(self.module, "stateless", False)

    def gather(self, native):
        """The robots of the next steps."""
        self._scatter()
        rows = [self.rows[key] for key in native.keys()]
        for robot, row in zip(native.ids(), rows):
            if row.keys() != rows[0].keys():
                raise ScriptError(f"{self.file}: the robot '{robot}' has other names in its state than others; make all of it in init(robots)")
        self.robots = Robots(native, rows)

    def step(self):
        self._call("step", self.robots)

    def _scatter(self):
        if self.robots is None:
            return
        for k, key in enumerate(self.robots.keys):
            self.rows[key] = self.robots.state.row(k)
        self.robots = None

    def save(self, key, tick):
        if self.checked != tick:
            self._require_nothing_else()
            self.checked = tick
        place = self.robots.places.get(key) if self.robots else None
        row = self.rows[key] if place is None else self.robots.state.row(place)
        head = [[name, value.dtype.str, list(value.shape)] for name, value in row.items()]
        return json.dumps(head).encode() + b"\n" + b"".join(value.tobytes() for value in row.values())

    def load(self, key, saved):
        self._scatter()
        head, _, numbers = saved.partition(b"\n")
        row, first = {}, 0
        try:
            for name, kind, shape in json.loads(head):
                kind = np.dtype(kind)
                end = first + kind.itemsize * int(np.prod(shape, dtype=int))
                if kind.kind not in NUMBERS or end > len(numbers):
                    raise ValueError(name)
                row[name] = np.frombuffer(numbers[first:end], kind).reshape(shape).copy()
                first = end
            if first != len(numbers):
                raise ValueError("its length")
        except (ValueError, TypeError) as error:
            raise ScriptError(f"saved state: it is no state of a script in Python: {error}") from None
        self.rows[key] = row

    def _plain(self):
        """The values of global variables by name, as far as they are plain."""
        values = {}
        for name, value in self.module.__dict__.items():
            if name.startswith("__") or not isinstance(value, (bool, int, float, str, bytes, list, dict, set, tuple, np.ndarray, np.generic)):
                continue
            try:
                values[name] = pickle.dumps(value)
            except Exception:  # it holds what is no plain value
                continue
        return values

    def _require_nothing_else(self):
        """A run goes on from the state alone, so no global variable may have changed."""
        now = self._plain()
        for name in now.keys() | self.plain.keys():
            if now.get(name) != self.plain.get(name):
                raise ScriptError(f"{self.file}: the global variable '{name}' has changed since the start of the script and would not be "
                                  "restored; keep it in robots.state")


def text_of(error, file):
    """An exception as one line with file and line of the script."""
    if isinstance(error, ScriptError):
        return str(error)
    if isinstance(error, SyntaxError) and error.lineno is not None:
        return f"{error.filename}:{error.lineno}: {error.msg}"
    if isinstance(error, OSError) and error.filename:
        return f"cannot read '{error.filename}': {error.strerror}"
    place, trace = None, error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == file:
            place = trace.tb_lineno
        trace = trace.tb_next
    said = error.args[0] if isinstance(error, KeyError) and len(error.args) == 1 and isinstance(error.args[0], str) else str(error)
    return (f"{file}:{place}: " if place else "") + type(error).__name__ + (f": {said}" if said else "")
