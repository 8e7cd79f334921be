"""Learning: a swarm as agents of PettingZoo's parallel interface."""

import numpy as np

from .environment import Environment
from .spaces import Box

# The package is not needed. Where it is installed, its wrappers and learners know the environment by its class.
try:
    from pettingzoo import ParallelEnv as _Interface
except ImportError:
    _Interface = object


class ParallelEnvironment(_Interface):
    """Each robot of an <external_controller> an agent with the id of the robot, all of which act at once: a
    pettingzoo.ParallelEnv.

    Parameters as for Environment. done: returns bool for the whole swarm, or (possible agents,): who is done leaves `agents`,
    and its actuators keep what they were told.

    `observation_columns` and `action_columns` name the numbers of an observation and an action.
    """

    metadata = {"name": "swarmanoid_v0", "render_modes": [], "is_parallelizable": True}
    render_mode = None

    def __init__(self, file, settings=None, **options):
        self._environment = Environment(file, settings, **options)
        robots = self._environment.robots
        self.possible_agents = list(robots.ids)
        self.agents = []
        self._row = {agent: row for row, agent in enumerate(self.possible_agents)}
        self.observation_columns = self._environment.observation_columns
        self.action_columns = self._environment.action_columns
        observations, actions = len(self.observation_columns), len(self.action_columns)
        # One object for each agent, always the same: learners seed it.
        self.observation_spaces = {agent: Box(-np.inf, np.inf, (observations,), np.float64) for agent in self.possible_agents}
        bounds = self._environment.single_action_space
        self.action_spaces = {agent: Box(bounds.low, bounds.high, (actions,), np.float64) for agent in self.possible_agents}
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
