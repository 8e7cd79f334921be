"""What a controller computes with <cmath> and <complex> has the same bits however the experiment is started, on any processor."""
import ctypes
import os
import pathlib
import shutil
import subprocess
import sys

from outside import BUILT, PREFIX, WAYS, OutsideTest, main

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import free_domain as domains  # noqa: E402

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

    def by_hand(self, environment):
        """The three processes of a cluster, each with its own environment."""
        domain = str(free_domain())
        commands = [
            (["space_server", str(self.file), "--no-visualisers", "--domain", domain], environment),
            (["engine_worker", "--engine", "ground", "--experiment", self.file.stem, "--domain", domain], {}),
            (["controller_host", "--experiment", self.file.stem, "--domain", domain], environment),
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
        for name, environment in ENVIRONMENTS.items():
            way, options = "one process", WAYS["one process"]
            done = self.run_experiment(self.file, *options, environment=environment)
            self.compare(f"run, {way}, {name}", self.hash_of(done))
            done = self.command(simulation, self.file, environment=environment)
            self.compare(f"a user's simulator, {name}", self.hash_of(done))
            done = self.command("swarmanoid_robot", self.file, "--robot", "robot_one", "--steps", TICKS,
                                environment={**environment, "ROS_LOCALHOST_ONLY": "1", "ROS_DOMAIN_ID": str(free_domain())})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.compare(f"the robot, {name}", None)
        for name in ["as it is", "no FMA, no AVX2"]:
            done = self.run_experiment(self.file, *WAYS["cluster"], environment=ENVIRONMENTS[name])
            self.compare(f"run, cluster, {name}", self.hash_of(done))
            self.compare(f"by hand, {name}", self.hash_of(self.by_hand(ENVIRONMENTS[name])))

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
            self.assertTrue(path.endswith("libswarmanoid_reproducible_math.so"), found)

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


if __name__ == "__main__":
    main()
