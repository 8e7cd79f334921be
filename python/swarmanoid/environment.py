"""Learning: a swarm as a vectorised environment, with the calls and spaces of Gymnasium's vector environments."""

import functools

import numpy as np

from .simulation import Simulation


class Environment:
    """All robots of an <external_controller>, each an agent; one row an agent in all arrays.

    file, settings, threads: as for Simulation. sensors: types whose columns are the observation, in this order; None: all.
    actuators: types whose columns are the action, in this order. reward: called with the simulation and the robots after each
    step, returns (agents,). done: called as reward, returns bool, for the whole swarm or (agents,). max_ticks: an episode is cut
    there, or at that of the file if it comes first; 0: at that of the file. frame_skip: ticks a step.

    `step` returns (observations, rewards, terminations, truncations, infos); after an end, `reset` starts the next
    episode, with the next seed if none is given. action_low, action_high: bounds of the action space, a number or one for
    each column, in the units of the actuators, which cut what they cannot do; none if they are not given.

    `observation_space` and `action_space` are those of all agents, `single_observation_space` and `single_action_space` those
    of one: gymnasium.spaces.Box if Gymnasium is installed. `observation_columns` and `action_columns` name their numbers.
    """

    metadata = {"render_modes": []}
    render_mode = None

    def __init__(self, file, settings=None, *, controller=None, sensors=None, actuators=None, reward=None, done=None,
                 max_ticks=0, frame_skip=1, threads=1, action_low=-np.inf, action_high=np.inf):
        if frame_skip < 1:
            raise ValueError("frame_skip is the number of ticks in a step: at least 1")
        self.file, self.settings, self.threads = file, dict(settings or {}), threads
        self.controller, self.sensor_types, self.actuator_types = controller, sensors, actuators
        self.reward, self.done = reward, done
        self.max_ticks, self.frame_skip = max_ticks, frame_skip
        self._bounds = action_low, action_high
        self.simulation = None
        self._seed = int(self.settings.get("framework.seed", 1)) - 1
        self._start(self._seed + 1)

    def _start(self, seed):
        self._seed = seed
        self.simulation = Simulation(self.file, {**self.settings, "framework.seed": seed}, threads=self.threads)
        groups = self.simulation.robots
        if self.controller is None:
            if len(groups) != 1:
                raise ValueError(f"the experiment has {len(groups)} external controllers ({', '.join(groups) or 'none'}); "
                                 "name the one whose robots learn: controller=\"…\"")
            self.controller = next(iter(groups))
        if self.controller not in groups:
            raise ValueError(f"no external controller '{self.controller}'; there are: {', '.join(groups)}")
        self.robots = groups[self.controller]
        sensors, actuators = self.robots.sensors, self.robots.actuators
        for types, known, what in ((self.sensor_types, sensors, "sensor"), (self.actuator_types, actuators, "actuator")):
            for name in types or ():
                if name not in known:
                    raise ValueError(f"the robots have no {what} '{name}' with columns; they have: {', '.join(known)}")
        self._sensors = [sensors[name] for name in self.sensor_types or sensors]
        self._actuators = [actuators[name] for name in self.actuator_types or actuators]
        self.num_envs = len(self.robots)
        self.observation_shape = (self.num_envs, sum(part.shape[1] for part in self._sensors))
        self.action_shape = (self.num_envs, sum(part.shape[1] for part in self._actuators))
        self._last = min((ticks for ticks in (self.max_ticks, self.simulation.max_ticks) if ticks > 0), default=0)
        self._observations = np.empty(self.observation_shape)

    @property
    def observation_columns(self):
        return _columns(self.robots.columns, self.sensor_types or self.robots.sensors)

    @property
    def action_columns(self):
        return _columns(self.robots.actuator_columns, self.actuator_types or self.robots.actuators)

    # Always the same objects: learners seed them. Gymnasium is loaded for them only.
    @functools.cached_property
    def single_observation_space(self):
        return _box(-np.inf, np.inf, self.observation_shape[1:])

    @functools.cached_property
    def single_action_space(self):
        return _box(*self._bounds, self.action_shape[1:])

    @functools.cached_property
    def observation_space(self):
        return _box(-np.inf, np.inf, self.observation_shape)

    @functools.cached_property
    def action_space(self):
        return _box(*self._bounds, self.action_shape)

    def _observe(self):
        self.simulation.sense()
        first = 0
        for part in self._sensors:
            self._observations[:, first : first + part.shape[1]] = part
            first += part.shape[1]
        return self._observations.copy()

    def reset(self, *, seed=None, options=None):
        """Starts an episode; returns (observations, infos)."""
        if self.simulation.tick > 0 or (seed is not None and seed != self._seed):
            self.simulation.finish()
            self._start(self._seed + 1 if seed is None else int(seed))
        return self._observe(), {"seed": self._seed}

    def step(self, actions):
        """actions: (agents, columns) of the actuators, in their units."""
        actions = np.asarray(actions, dtype=float)
        if actions.shape != self.action_shape:
            raise ValueError(f"actions of the shape {actions.shape}; the agents take {self.action_shape}")
        first = 0
        for part in self._actuators:
            part[:] = actions[:, first : first + part.shape[1]]
            first += part.shape[1]
        goes_on = self.simulation.step(self.frame_skip)
        observations = self._observe()
        rewards = np.zeros(self.num_envs)
        if self.reward is not None:
            rewards[:] = self.reward(self.simulation, self.robots)
        ended = np.zeros(self.num_envs, dtype=bool)
        if self.done is not None:
            ended[:] = self.done(self.simulation, self.robots)
        cut = not goes_on or (self._last > 0 and self.simulation.tick >= self._last)
        return observations, rewards, ended, ~ended & cut, {}

    def close(self):
        if self.simulation is not None:
            self.simulation.finish()


def _box(low, high, shape):
    from .spaces import Box
    low, high = (np.broadcast_to(np.asarray(bound, float), shape).copy() for bound in (low, high))
    return Box(low, high, shape, np.float64)


def _columns(columns, types):
    return [f"{type_}.{column}" for type_ in types for column in columns[type_]]
