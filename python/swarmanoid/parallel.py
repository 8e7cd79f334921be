"""Learning: a swarm as agents of PettingZoo's parallel interface."""

import numpy as np

from .environment import Environment

# Neither package is needed. Where they are installed, their wrappers and learners know the environment by its class, and
# spaces are theirs.
try:
    from pettingzoo import ParallelEnv as _Interface
except ImportError:
    _Interface = object
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


class ParallelEnvironment(_Interface):
    """Each robot of an <external_controller> an agent with the id of the robot, all of which act at once: a
    pettingzoo.ParallelEnv.

    Parameters as for Environment. done: returns bool for the whole swarm, or (possible agents,): who is done leaves `agents`,
    and its actuators keep what they were told. action_low, action_high: bounds of the action space, a number or one for each
    column, in the units of the actuators, which cut what they cannot do; none if they are not given.

    `observation_columns` and `action_columns` name the numbers of an observation and an action.
    """

    metadata = {"name": "swarmanoid_v0", "render_modes": [], "is_parallelizable": True}
    render_mode = None

    def __init__(self, file, settings=None, *, action_low=-np.inf, action_high=np.inf, **options):
        self._environment = Environment(file, settings, **options)
        robots = self._environment.robots
        self.possible_agents = list(robots.ids)
        self.agents = []
        self._row = {agent: row for row, agent in enumerate(self.possible_agents)}
        self.observation_columns = _columns(robots.columns, self._environment.sensor_types or robots.sensors)
        self.action_columns = _columns(robots.actuator_columns, self._environment.actuator_types or robots.actuators)
        observations, actions = len(self.observation_columns), len(self.action_columns)
        # One object for each agent, always the same: learners seed it.
        self.observation_spaces = {agent: Box(-np.inf, np.inf, (observations,), np.float64) for agent in self.possible_agents}
        low, high = (np.broadcast_to(np.asarray(bound, float), (actions,)) for bound in (action_low, action_high))
        self.action_spaces = {agent: Box(low.copy(), high.copy(), (actions,), np.float64) for agent in self.possible_agents}
        self.state_space = Box(-np.inf, np.inf, (len(self.possible_agents) * observations,), np.float64)
        self._actions = np.zeros((len(self.possible_agents), actions))
        self._observations = None

    def observation_space(self, agent):
        return self.observation_spaces[agent]

    def action_space(self, agent):
        return self.action_spaces[agent]

    @property
    def simulation(self):
        """That of the episode."""
        return self._environment.simulation

    @property
    def num_agents(self):
        return len(self.agents)

    @property
    def max_num_agents(self):
        return len(self.possible_agents)

    @property
    def unwrapped(self):
        return self

    def reset(self, seed=None, options=None):
        """Starts an episode, with the next seed if none is given; returns (observations, infos) by agent."""
        self._observations, info = self._environment.reset(seed=seed, options=options)
        self.agents = list(self.possible_agents)
        self._actions[:] = 0
        return self._by_agent(self._observations), {agent: dict(info) for agent in self.agents}

    def step(self, actions):
        """actions: of each of `agents`. Returns (observations, rewards, terminations, truncations, infos) by agent, for those who
        acted; who is at its end is not among `agents` any more."""
        if not self.agents:
            raise RuntimeError("the episode is over, or has not begun; call reset")
        if missing := [agent for agent in self.agents if agent not in actions]:
            raise KeyError(f"no action of {', '.join(missing)}; each of `agents` acts in each step")
        if others := [str(agent) for agent in actions if agent not in self.agents]:
            raise KeyError(f"actions of {', '.join(others)}, not among `agents`; who is done acts no more")
        for agent in self.agents:
            action = np.asarray(actions[agent], dtype=float)
            if action.shape != self._actions.shape[1:]:
                raise ValueError(f"'{agent}': an action of the shape {action.shape}; it takes {self._actions.shape[1:]}")
            self._actions[self._row[agent]] = action
        self._observations, rewards, ended, cut, _ = self._environment.step(self._actions)
        results = (self._by_agent(self._observations), self._by_agent(rewards.tolist()), self._by_agent(ended.tolist()),
                   self._by_agent(cut.tolist()), {agent: {} for agent in self.agents})
        self.agents = [agent for agent in self.agents if not (results[2][agent] or results[3][agent])]
        return results

    def state(self):
        """The observations of all possible agents, one behind the other."""
        if self._observations is None:
            raise RuntimeError("no episode has begun; call reset")
        return self._observations.ravel().copy()

    def render(self):
        """Draws nothing: visualisers show the experiment (docs/visualisers.md)."""

    def close(self):
        self._environment.close()

    def _by_agent(self, rows):
        return {agent: rows[self._row[agent]] for agent in self.agents}


def _columns(columns, types):
    return [f"{type_}.{column}" for type_ in types for column in columns[type_]]
