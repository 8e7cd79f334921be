"""ParallelEnvironment against the contract of PettingZoo's parallel interface (https://pettingzoo.farama.org/api/parallel), as
its own parallel_api_test checks it, and against swarmanoid.Environment."""

import numpy as np

import scene
import swarmanoid
from world.case import InFolderCase


class Parallel(InFolderCase):
    def environment(self, ticks=20, **more):
        options = {"sensors": ["footbot_proximity"], "actuators": ["footbot_wheels"],
                   "reward": lambda simulation, robots: simulation.x[simulation.of_kind("footbot")], **more}
        environment = swarmanoid.ParallelEnvironment(scene.write(self.folder, ticks=ticks), **options)
        self.addCleanup(environment.close)
        return environment

    def check_the_contract(self, environment, steps):
        """What parallel_api_test asserts, and warns of; returns how many steps the second episode had."""
        self.assertIs(environment.unwrapped, environment)
        self.assertEqual(environment.max_num_agents, len(environment.possible_agents))
        for _ in range(2):
            observations, infos = environment.reset()
            live, finished = set(environment.agents), set()
            self.assertEqual(live, set(environment.possible_agents))
            self.assertEqual((set(observations), set(infos)), (live, live))
            for step in range(1, steps + 1):
                for agent, seen in observations.items():
                    self.assertIn(seen, environment.observation_space(agent))
                results = environment.step({agent: environment.action_space(agent).sample() for agent in environment.agents})
                for by_agent in results:
                    self.assertIsInstance(by_agent, dict)
                    self.assertEqual(set(by_agent), live)
                observations, _, terminations, truncations, _ = results
                self.assertFalse(set(environment.agents) & finished, "agents cannot be revived once dead")
                over = {agent for agent in live if terminations[agent] or truncations[agent]}
                live -= over
                finished |= over
                self.assertEqual(set(environment.agents), live)
                self.assertEqual(environment.num_agents, len(live))
                for agent in environment.possible_agents:
                    self.assertIs(environment.observation_space(agent), environment.observation_space(agent))
                    self.assertIs(environment.action_space(agent), environment.action_space(agent))
                if not live:
                    break
            self.assertEqual(finished, set(environment.possible_agents))
        return step

    def test_the_contract_of_parallel_environments(self):
        self.assertEqual(self.check_the_contract(self.environment(action_low=-10, action_high=10), 50), 20)
        self.assertEqual(self.check_the_contract(self.environment(sensors=None, actuators=None, frame_skip=4), 50), 5)

    def test_agents_end_one_by_one(self):
        environment = self.environment(done=lambda simulation, robots: [simulation.tick >= 3, simulation.tick >= 6])
        self.assertEqual(self.check_the_contract(environment, 50), 6)
        environment.reset()
        for tick in range(1, 7):
            _, _, terminations, truncations, _ = environment.step({agent: np.zeros(2) for agent in environment.agents})
            self.assertEqual(terminations, {"a": tick >= 3, "b": tick >= 6} if tick <= 3 else {"b": tick >= 6})
            self.assertFalse(any(truncations.values()))
        with self.assertRaisesRegex(RuntimeError, "call reset"):
            environment.step({})

    def test_agents_are_cut_at_the_last_tick_unless_they_are_done(self):
        environment = self.environment(ticks=4, done=lambda simulation, robots: [False, simulation.tick >= 4])
        environment.reset()
        for tick in range(1, 5):
            _, _, terminations, truncations, _ = environment.step({agent: np.zeros(2) for agent in environment.agents})
            self.assertEqual(terminations, {"a": False, "b": tick == 4})
            self.assertEqual(truncations, {"a": tick == 4, "b": False})
        self.assertEqual(environment.agents, [])

    def test_the_bits_of_the_vector_form(self):
        parallel = self.environment(ticks=60)
        vector = swarmanoid.Environment(scene.write(self.folder, ticks=60), sensors=["footbot_proximity"], actuators=["footbot_wheels"])
        seen, _ = parallel.reset(seed=5)
        rows, _ = vector.reset(seed=5)
        for step in range(60):
            np.testing.assert_array_equal(rows, [seen["a"], seen["b"]])
            np.testing.assert_array_equal(parallel.state(), rows.ravel())
            actions = np.array([[8.0 + step % 3, 8.5], [-3, 9]])
            seen, rewards, _, _, _ = parallel.step({"b": actions[1], "a": actions[0]})
            rows = vector.step(actions)[0]
            self.assertEqual(rewards["a"], parallel.simulation.x[parallel.simulation.index("a")])
        self.assertGreater(rows.max(), 0)  # the wall was seen
        self.assertEqual(parallel.simulation.hash(), vector.simulation.hash())

    def test_spaces_have_bounds_and_names(self):
        environment = self.environment(action_low=[-1, 0], action_high=[1, 5])
        self.assertEqual(environment.action_columns, ["footbot_wheels.left [rad/s]", "footbot_wheels.right [rad/s]"])
        self.assertEqual(len(environment.observation_columns), 24)
        space = environment.action_space("a")
        self.assertIsNot(space, environment.action_space("b"))
        space.seed(7)
        drawn = np.array([space.sample() for _ in range(200)])
        self.assertTrue((np.abs(drawn[:, 0]) <= 1).all() and (drawn[:, 1] >= 0).all() and (drawn[:, 1] <= 5).all())
        self.assertGreater(np.ptp(drawn[:, 1]), 4)
        space.seed(7)
        np.testing.assert_array_equal(space.sample(), drawn[0])
        self.assertFalse(space.contains(np.array([0.0, 6.0])))
        self.assertFalse(space.contains(np.zeros(3)))

    def test_actions_of_the_wrong_agents_are_refused(self):
        environment = self.environment()
        with self.assertRaisesRegex(RuntimeError, "call reset"):
            environment.step({})
        environment.reset()
        with self.assertRaisesRegex(KeyError, "no action of b"):
            environment.step({"a": np.zeros(2)})
        with self.assertRaisesRegex(KeyError, "actions of wall"):
            environment.step({"a": np.zeros(2), "b": np.zeros(2), "wall": np.zeros(2)})
        with self.assertRaisesRegex(ValueError, r"'b': an action of the shape \(3,\); it takes \(2,\)"):
            environment.step({"a": np.zeros(2), "b": np.zeros(3)})
