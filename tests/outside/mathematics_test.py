"""What a controller computes with <cmath> and <complex> has the same bits however the experiment is started, on any processor."""
import ctypes
import os
import shutil
import subprocess
import sys

from outside import BUILT, PREFIX, WAYS, OutsideTest

import free_domain as domains

LIBRARY = BUILT / "controllers" / "liboutside_mathematics.so"
# What changes the choice among the variants of libm, and when its functions are looked up.
ENVIRONMENTS = {
    "as it is": {},
    "no FMA, no AVX2": {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA_Usable,-FMA4,-AVX2,-AVX2_Usable"},
    "no choice": {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4,-SSE4_1,-AVX512F"},
    "an empty choice": {"GLIBC_TUNABLES": "glibc.cpu.hwcaps="},
    "bound at once": {"LD_BIND_NOW": "1"},
}
TICKS = 3
SENSED_TICKS = 8


def free_domain():
    return domains.free_domain(range(100, 160))


class Mathematics(OutsideTest):
    def setUp(self):
        super().setUp()
        self.digests = self.folder / "digests.txt"
        self.file = self.experiment(
            name=f"mathematics_{os.getpid()}", controller="outside_mathematics", parameters=f"<digests>{self.digests}</digests>",
            actuators="<footbot_leds><implementation>generic_footbot_leds</implementation></footbot_leds>", ticks=TICKS)
        self.seen = {}

    def compare(self, what, hash_of_run):
        """All runs gave the same digests; those with a state gave the same hash."""
        digests = self.digests.read_text()
        self.digests.unlink()
        self.assertEqual(len(digests.splitlines()), TICKS, what)
        self.assertEqual(self.seen.setdefault("digests", (what, digests))[1], digests, f"{self.seen['digests'][0]} and {what}")
        if hash_of_run is not None:
            self.assertEqual(self.seen.setdefault("hash", (what, hash_of_run))[1], hash_of_run,
                             f"{self.seen['hash'][0]} and {what}")

    def robot(self, file, environment, steps=TICKS):
        return self.command("swarmanoid_robot", file, "--robot", "robot_one", "--steps", steps,
                            environment={**environment, "ROS_LOCALHOST_ONLY": "1", "ROS_DOMAIN_ID": str(free_domain())})

    def by_hand(self, of_host, of_server, of_engine):
        """The three processes of a cluster, each with its own environment."""
        domain = str(free_domain())
        commands = [
            (["space_server", str(self.file), "--no-visualisers", "--domain", domain], of_server),
            (["engine_worker", "--engine", "ground", "--experiment", self.file.stem, "--domain", domain], of_engine),
            (["controller_host", "--experiment", self.file.stem, "--domain", domain], of_host),
        ]
        processes = [subprocess.Popen([str(PREFIX / "bin" / words[0]), *words[1:]], cwd=self.folder, stdout=subprocess.PIPE,
                                      stderr=subprocess.STDOUT, text=True, env=self.environment(own))
                     for words, own in commands]
        try:
            outputs = [process.communicate(timeout=60)[0] for process in processes]
        finally:
            for process in processes:
                if process.poll() is None:
                    process.kill()
                    process.communicate()
        self.assertEqual([process.returncode for process in processes], [0, 0, 0], outputs)
        return subprocess.CompletedProcess(commands[0][0], 0, outputs[0], "")

    def test_the_same_bits_however_started(self):
        simulation = BUILT / "simulation"
        environments = list(ENVIRONMENTS.values())
        for turn, (name, environment) in enumerate(ENVIRONMENTS.items()):
            for way, options in WAYS.items():
                done = self.run_experiment(self.file, *options, environment=environment)
                self.compare(f"run, {way}, {name}", self.hash_of(done))
                done = self.command(simulation, self.file, "--quiet", *options, environment=environment)
                self.compare(f"a user's simulator, {way}, {name}", self.hash_of(done))
            others = [environments[(turn + k) % len(environments)] for k in (1, 2)]
            self.compare(f"by hand, the host with {name}", self.hash_of(self.by_hand(environment, *others)))
            done = self.robot(self.file, environment)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.compare(f"the robot, {name}", None)

    def test_the_robot_commands_what_the_simulated_one_does_by_the_same_readings(self):
        noise = "<noise_kind>gaussian</noise_kind><noise_deviation>0.01</noise_deviation>"
        devices = {"footbot_proximity": noise, "footbot_encoders": "", "footbot_omnidirectional_camera": ""}
        sensors = "".join(f"<{name}><implementation>{find}{name}</implementation>{more}</{name}>"
                          for (name, more), find in zip(devices.items(), ["generic_", "engine_", "generic_"]))
        commands = {"footbot_wheels": "dummy_", "footbot_leds": "generic_"}
        actuators = "".join(f"<{name}><implementation>{kind}{name}</implementation></{name}>" for name, kind in commands.items())
        second = '<footbot id="robot_two"><position>1.25,1,0</position><orientation>0,0,100</orientation><controller>c</controller></footbot>'

        def experiment(name):
            folder = self.folder / name
            folder.mkdir()
            file = self.experiment(f"senses_{name}_{os.getpid()}", controller="outside_senses", ticks=SENSED_TICKS, sensors=sensors,
                                   actuators=actuators, arena=second, entities="robot_two",
                                   parameters=f"<record>{folder}</record>")
            file.write_text(file.read_text().replace("<clocktick>100<", "<clocktick>20<"))
            return file, folder

        def recorded(folder, ending=""):
            return {name: (folder / f"robot_one.{name}{ending}.txt").read_text() for name in [*devices, *commands]
                    if not ending or name in commands}

        simulated, known = experiment("simulated")
        expected_hash = self.hash_of(self.run_experiment(simulated, *WAYS["one process"]))
        expected = recorded(known)
        for name, lines in expected.items():
            self.assertGreater(len(set(lines.splitlines())), SENSED_TICKS // 2, f"{name} varies")
        again, folder = experiment("cluster")
        self.assertEqual(self.hash_of(self.run_experiment(again, environment=ENVIRONMENTS["no FMA, no AVX2"])), expected_hash)
        self.assertEqual(recorded(folder), expected)

        for turn, (name, environment) in enumerate(ENVIRONMENTS.items()):
            file, folder = experiment(f"robot_{turn}")
            robot = self.folder / f"robot_{turn}.xml"
            robot.write_text(f'''<ahss-robot id="robot_one" kind="footbot">
  <experiment file="{file}" controller="c"/>
  <drivers library="recorded_drivers" path="{BUILT}/drivers" prefer="recorded">
    <sensors>{"".join(f"<{d}><file>{known}/robot_one.{d}.txt</file></{d}>" for d in devices)}</sensors>
    <actuators>{"".join(f"<{d}><file>{folder}/robot_one.{d}.driver.txt</file></{d}>" for d in commands)}</actuators>
  </drivers>
</ahss-robot>
''')
            done = self.robot(robot, environment, SENSED_TICKS)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(recorded(folder), expected, name)
            self.assertEqual(recorded(folder, ".driver"), {d: expected[d] for d in commands}, name)

    def test_a_program_that_has_libm_of_its_own_loads_a_controller(self):
        """Python: its functions are libm's, those of the controller are ours all the same."""
        done = self.run_experiment(self.file, *WAYS["one process"])
        self.hash_of(done)
        script = ("import ctypes; ctypes.CDLL('libm.so.6', ctypes.RTLD_GLOBAL); digest = ctypes.CDLL("
                  f"{str(LIBRARY)!r}).outside_mathematics_digest; digest.restype = ctypes.c_uint64; "
                  f"print('\\n'.join(format(digest(ctypes.c_uint64(t)), '016x') for t in range({TICKS})))")
        for name, environment in ENVIRONMENTS.items():
            answer = self.command(sys.executable, "-c", script, environment=environment)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            self.assertEqual(answer.stdout, self.digests.read_text(), name)

    def test_a_program_that_names_libm_first_and_drops_what_it_does_not_need(self):
        """Ours comes before libm all the same, and stays, for the plug-ins that the program will load."""
        (self.folder / "CMakeLists.txt").write_text("""cmake_minimum_required(VERSION 3.25)
project(linked LANGUAGES CXX)
find_package(Swarmanoid REQUIRED)
add_executable(linked linked.cpp)
target_link_libraries(linked PRIVATE m ${CMAKE_DL_LIBS} Swarmanoid::control_interface)
target_link_options(linked PRIVATE -Wl,--as-needed)
""")
        (self.folder / "linked.cpp").write_text("""#include <cmath>
#include <cstdio>
#include <dlfcn.h>
#include <initializer_list>
int main(int count, char**)
{
  for (const char* version : {"GLIBC_2.2.5", "GLIBC_2.17", "SWARMANOID_1"})
  {
    Dl_info place{};
    if (void* found = dlvsym(RTLD_DEFAULT, "sin", version)) dladdr(found, &place);
    if (place.dli_fname != nullptr) std::puts(place.dli_fname);
  }
  return std::fmod(count, 7.0) > 6;
}
""")
        for arguments in [["-S", ".", "-B", "build", f"-DCMAKE_PREFIX_PATH={PREFIX}"], ["--build", "build"]]:
            done = self.command(shutil.which("cmake"), *arguments, timeout=120)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        found = self.command(self.folder / "build" / "linked").stdout.splitlines()
        self.assertGreaterEqual(len(found), 2)
        for path in found:
            self.assertIn("libswarmanoid_reproducible_math.so", path, found)

    def test_a_simulator_that_finds_libm_first_is_refused(self):
        """Box2D and ODE would take their functions from it."""
        libm = ctypes.CDLL("libm.so.6")._name
        done = self.command(BUILT / "simulation", self.file, environment={"LD_PRELOAD": libm})
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("libm.so.6", done.stderr)
        self.assertIn("Swarmanoid::simulation", done.stderr)
        self.assertIn("LD_PRELOAD=" + str(PREFIX), done.stderr)
        ours = next(PREFIX.glob("lib*/**/libswarmanoid_reproducible_math.so"))
        cured = self.command(BUILT / "simulation", self.file, environment={"LD_PRELOAD": f"{ours} {libm}"})
        self.hash_of(cured)
