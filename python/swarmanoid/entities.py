"""Entities in arrays, in the order of `ids`."""

import numpy as np


class Entities:
    """What a Simulation and a State of an attached run share: rows of arrays by id and kind.

    Subclasses have `x`, `y`, `z` (m), `qx` ... `qw`, each (entities,), and `attributes`, all numbers beside the poses.
    """

    def __init__(self, space):
        # Of the module: ids, kinds, slot(index, attribute), presence_slot(index).
        self._space = space
        self.ids = tuple(space.ids)
        self.kinds = tuple(space.kinds)
        self._index = {name: index for index, name in enumerate(self.ids)}

    def positions(self, kind=None):
        """m, (entities, 3), of all or of a kind ("footbot"); a copy."""
        chosen = slice(None) if kind is None else self.of_kind(kind)
        return np.stack([self.x[chosen], self.y[chosen], self.z[chosen]], axis=-1)

    def headings(self, kind=None):
        """Of the x axis of each entity about z, rad, -pi..pi; a copy."""
        chosen = slice(None) if kind is None else self.of_kind(kind)
        x, y, z, w = (values[chosen] for values in (self.qx, self.qy, self.qz, self.qw))
        return np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))

    def index(self, entity):
        """Of the entity with an id, in all arrays."""
        try:
            return self._index[entity]
        except KeyError:
            raise KeyError(f"no entity '{entity}'") from None

    def of_kind(self, kind):
        """Indices of the entities of a kind, ascending."""
        return np.array([index for index, other in enumerate(self.kinds) if other == kind], dtype=int)

    def attribute(self, name, entities=None):
        """An attribute ("led", "gripped", "colour"), (n, elements), of entities by id, or of all of a kind; a copy.

        entities: an id, a list of ids, or a kind. Raises KeyError for an entity without it, with the names it has.
        """
        if isinstance(entities, str):
            entities = [entities] if entities in self._index else self.of_kind(entities)
        elif entities is None:
            entities = range(len(self.ids))
        rows = []
        for entity in entities:
            first, count = self._space.slot(self.index(entity) if isinstance(entity, str) else int(entity), name)
            rows.append(np.arange(first, first + count))
        return self.attributes[np.array(rows, dtype=int)]

    def present(self):
        """Which entities are in the arena, (entities,) of bool; a copy."""
        first = self._space.presence_slot(0)
        return self.attributes[first : first + len(self.ids)] != 0
