"""What a run has left in its folder."""

import csv
import json
import pathlib


class Run:
    """The folder of a run: `swarmanoid.Run("runs/latest")`. Raises FileNotFoundError if it is none."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.manifest = json.loads((self.folder / "manifest.json").read_text())

    def _table(self, name, delimiter):
        path = self.folder / name
        try:
            import pandas
        except ImportError:
            with path.open(newline="") as file:
                return list(csv.DictReader(file, delimiter=delimiter))
        return pandas.read_csv(path, sep=delimiter)

    def events(self):
        """Who asked what and when: a pandas.DataFrame, or without pandas a list of dicts."""
        return self._table("events.csv", ",")

    def table(self, name, delimiter=","):
        """A table that a visualisation or experiment functions wrote, with a header line; likewise."""
        return self._table(name, delimiter)
