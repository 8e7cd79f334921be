"""What runs and studies have left in their folders."""

import csv
import io
import json
import pathlib
import shutil
import sqlite3
import subprocess
import tempfile

import numpy as np

from . import _module


# Of tables: columns that are no numbers, whatever they look like.
_TEXTS = ("entity", "kind", "hash", "state", "failure", "host", "version", "checksum", "check", "user", "machine")


def _command():
    """The program `swarmanoid` of this installation, or of this build folder."""
    package = pathlib.Path(_module.__file__).parent
    for folder in (package.parents[1], package.parents[3]):
        if (folder / "bin/swarmanoid").is_file():
            return folder / "bin/swarmanoid"
    found = shutil.which("swarmanoid")
    if found is None:
        raise FileNotFoundError("the program swarmanoid is not installed beside this module, nor in PATH")
    return found


def _table(file, delimiter=","):
    """A pandas.DataFrame, or without pandas a dict of arrays by column: numbers where all fields are, texts otherwise."""
    try:
        import pandas
    except ImportError:
        rows = list(csv.reader(file, delimiter=delimiter))
        for number, row in enumerate(rows, 1):
            if len(row) != len(rows[0]):
                raise ValueError(f"line {number} of the table has {len(row)} fields, its header has {len(rows[0])}: {row}")
        columns = zip(*rows[1:]) if len(rows) > 1 else [[] for _ in rows[0]]
        return {name: np.array(column, dtype=str) if name in _TEXTS else _numbers(column) for name, column in zip(rows[0], columns)}
    # Numbers read back as the same bits.
    return pandas.read_csv(file, sep=delimiter, float_precision="round_trip", dtype={name: str for name in _TEXTS})


def _numbers(column):
    for kind in (np.int64, np.float64):
        try:
            return np.array([field if field or kind is np.int64 else "nan" for field in column], dtype=kind)
        except (ValueError, OverflowError):
            continue
    return np.array(column, dtype=str)


class Run:
    """The folder of a run: `swarmanoid.Run("runs/latest")`. Raises FileNotFoundError if it is none."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.manifest = json.loads((self.folder / "manifest.json").read_text())

    def events(self):
        """The requests of users, with their origin and time: a pandas.DataFrame, or without pandas a dict of arrays by column. None without requests."""
        return self.table("events.csv") if (self.folder / "events.csv").exists() else None

    def table(self, name, delimiter=","):
        """A table that a visualisation or experiment functions wrote, with a header line, as a data frame or dict."""
        with (self.folder / name).open(newline="") as file:
            return _table(file, delimiter)

    def journal(self, columns=("x", "y", "z"), entities="*", every=1, first=None, last=None):
        """What the journal of a run as a cluster has, as a data frame or dict: a row for each tick and entity in the arena.

        columns: x, y, z in m, alpha, beta, gamma in degrees, qx … qw, attributes as "led", their elements as "led[3]".
        entities: ids, with * and ?. every, first, last: which ticks. Raises ValueError with what `swarmanoid export` says.
        """
        words = ["export", str(self.folder.absolute()), "--columns=" + ",".join(columns), f"--entities={entities}", f"--every={every}"]
        for option, tick in (("--from", first), ("--until", last)):
            if tick is not None:
                words.append(f"{option}={tick}")
        with tempfile.TemporaryDirectory(prefix="swarmanoid_") as folder:
            path = pathlib.Path(folder) / "journal.csv"
            done = subprocess.run([_command(), *words, "--csv", str(path)], capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise ValueError(done.stderr.strip())
            with path.open(newline="") as file:
                return _table(file)


class Study:
    """The folder of a study: `swarmanoid.Study("results/aggregation")`. Raises FileNotFoundError if it is none, and ValueError if it is
    damaged: the results of each run are compared with their checksum."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        path = self.folder / "study.sqlite"
        if not path.is_file():
            raise FileNotFoundError(f"'{folder}' is no folder of a study: it has no study.sqlite")
        _module.check_study(str(self.folder))
        self._database = path.resolve().as_uri() + "?mode=ro"

    def _rows(self, query, values=()):
        database = sqlite3.connect(self._database, uri=True, timeout=60)
        try:
            cursor = database.execute(query, values)
            return [column[0] for column in cursor.description], cursor.fetchall()
        finally:
            database.close()

    def _frame(self, query):
        names, rows = self._rows(query)
        text = io.StringIO()
        csv.writer(text).writerows([names, *rows])
        text.seek(0)
        return _table(text)

    def table(self):
        """Factors, seed, tick, metrics of all runs that are done: a row for each run and tick that was measured. A pandas.DataFrame,
        or without pandas a dict of arrays by column. Also while the study goes on."""
        return self._frame("SELECT * FROM results ORDER BY point, seed, tick")

    def runs(self):
        """All runs with state, attempts, exit code, hash, wall time (s), most memory (bytes), host and factors, as a data frame or dict."""
        return self._frame("SELECT * FROM runs ORDER BY point, seed")

    def ways(self, point, seed):
        """Of <trajectories>: (ids of the entities, array (samples, entities, 2) in m; NaN while one is not in the arena)."""
        _, rows = self._rows("SELECT entities, samples, places FROM ways WHERE point = ? AND seed = ?", (point, seed))
        if not rows:
            raise KeyError(f"run {point}-{seed} has no trajectories")
        entities, samples, places = rows[0]
        ids = entities.split()
        return ids, np.frombuffer(places, dtype=np.float32).reshape(samples, len(ids), 2)

    def visits(self, metric, point, seed):
        """Of <coverage id="metric">: (array (rows, columns) of visits, side of a cell in m)."""
        _, rows = self._rows("SELECT columns, rows, cell_m, visits FROM grids WHERE metric = ? AND point = ? AND seed = ?", (metric, point, seed))
        if not rows:
            raise KeyError(f"run {point}-{seed} has no coverage '{metric}'")
        columns, count, cell_m, visits = rows[0]
        return np.frombuffer(visits, dtype=np.uint32).reshape(count, columns), cell_m
