"""Spaces of observations and actions: Gymnasium's where it is installed, otherwise what agents need of them."""

import numpy as np

try:
    from gymnasium.spaces import Box
except ImportError:

    class Box:
        """What gymnasium.spaces.Box is, as far as agents need it: arrays of a shape between low and high."""

        def __init__(self, low, high, shape, dtype=np.float64):
            self.shape, self.dtype = tuple(shape), np.dtype(dtype)
            self.low = np.broadcast_to(np.asarray(low, dtype), self.shape)
            self.high = np.broadcast_to(np.asarray(high, dtype), self.shape)
            self._random = np.random.default_rng()

        def seed(self, seed=None):
            self._random = np.random.default_rng(seed)
            return [seed]

        def sample(self):
            """Uniform between bounds; beyond one bound exponential, without bounds normal, as Gymnasium does."""
            below, above = np.isfinite(self.low), np.isfinite(self.high)
            numbers = self._random.normal(size=self.shape)
            tail = self._random.exponential(size=self.shape)
            low, high = np.where(below, self.low, 0), np.where(above, self.high, 0)
            numbers = np.where(below & ~above, low + tail, np.where(above & ~below, high - tail, numbers))
            return np.where(below & above, self._random.uniform(low, np.maximum(low, high)), numbers).astype(self.dtype)

        def contains(self, x):
            x = np.asarray(x)
            return bool(np.can_cast(x.dtype, self.dtype) and x.shape == self.shape and np.all(x >= self.low) and np.all(x <= self.high))

        __contains__ = contains

        def __eq__(self, other):
            return (isinstance(other, Box) and self.shape == other.shape and self.dtype == other.dtype
                    and np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high))

        def __repr__(self):
            return f"Box({self.low.min(initial=np.inf)}, {self.high.max(initial=-np.inf)}, {self.shape}, {self.dtype})"
