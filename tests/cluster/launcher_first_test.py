"""What somebody meets first: version, doctor, samples that are played, the first run on a terminal; and answers for programs."""
import json
import os
import pathlib
import pty
import re
import signal
import subprocess
import unittest
import urllib.request

import harness

BUILD = pathlib.Path(os.environ["SWARMANOID_BUILD"])
DRAWS = (BUILD / "lib" / "swarmanoid" / "libswarmanoid_image_render.so").exists()
SERVES = (BUILD / "lib" / "swarmanoid" / "libswarmanoid_web_render.so").exists()


def on_terminal(folder, *arguments, **environment):
    """What a command says on a terminal, and its exit code."""
    kept = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER", "NO_COLOR")}
    pid, terminal = pty.fork()
    if pid == 0:
        os.chdir(folder)
        os.execve(harness.SWARMANOID, [harness.SWARMANOID, *map(str, arguments)], {**kept, "TERM": "xterm", **environment})
    said = b""
    while True:
        try:
            part = os.read(terminal, 4096)
        except OSError:
            break
        if not part:
            break
        said += part
    os.close(terminal)
    return said.decode(errors="replace"), os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])


class First(harness.LauncherTest):
    def command(self, *words, **environment):
        return subprocess.run([harness.SWARMANOID, *map(str, words)], cwd=self.folder, env={**os.environ, **environment},
                              capture_output=True, text=True, timeout=harness.GENEROUS_S, check=False)

    def json_of(self, *words):
        done = self.command(*words, "--json")
        return json.loads(done.stdout), done.returncode

    def test_each_program_tells_version_and_commit(self):
        for program in ("swarmanoid", "swarmanoid_robot", "space_server", "engine_worker", "controller_host", "visualiser"):
            said = subprocess.run([BUILD / "bin" / program, "--version"], capture_output=True, text=True, check=True).stdout
            self.assertRegex(said, rf"^{program} \d+\.\d+\.\d+( \([0-9a-f]+(-dirty)?\))?\n$")

    def test_what_controllers_log_stands_in_the_log_of_their_host(self):
        said = {}
        for name, words in (("one", ["--single-process"]), ("cluster", ["--controller-hosts", "2"])):
            done = self.command("run", harness.CONFIGS / "sound_seekers.xml", *words, "--output", name)
            self.assertEqual(done.returncode, 0, done.stderr)
            logs = "".join(log.read_text() for log in (self.folder / name).glob("*.log"))
            said[name] = sorted(re.findall(r"info: (robot '\w+' at tick \d+: reads the tag speaker)$", logs, re.MULTILINE))
        self.assertTrue(said["one"])
        self.assertEqual(said["one"], said["cluster"])

    def test_doctor_finds_what_is_well(self):
        findings, exit_code = self.json_of("doctor")
        verdicts = {finding["subject"]: finding["verdict"] for finding in findings}
        self.assertEqual(exit_code, 0, findings)
        self.assertEqual((verdicts["run"], verdicts["DDS"]), ("good", "good"))
        self.assertEqual(verdicts["pictures"], "good" if DRAWS else "limited")
        for finding in findings:
            self.assertEqual(bool(finding["cure"]), finding["verdict"] != "good", finding)

    def test_doctor_finds_what_is_wrong_with_shared_memory(self):
        done = self.command("doctor", "--json", SWARMANOID_SHARED_FOLDER="/proc/swarmanoid")
        bad = {finding["subject"]: finding for finding in json.loads(done.stdout) if finding["verdict"] == "bad"}
        self.assertEqual(done.returncode, 4)
        self.assertEqual(set(bad), {"DDS", "shared memory"})
        self.assertIn("/proc", bad["DDS"]["what"])
        self.assertIn("SWARMANOID_SHARED_FOLDER", bad["shared memory"]["cure"])

    def test_demo_lists_each_sample_with_a_line(self):
        said = self.command("demo", "--list").stdout.splitlines()
        self.assertTrue(any(line.endswith("(Gauci et al. 2014)") for line in said), "a whole sentence")
        names = [line.split()[0] for line in said]
        self.assertEqual(sorted(names), sorted(path.stem for path in harness.CONFIGS.glob("*.xml")))
        self.assertEqual(names[:2], ["prey_retrieval", "aggregation"], "what shows most comes first")
        for line in said:
            self.assertGreater(len(line.split()), 3, line)
            self.assertLessEqual(len(line), 100, "a line of a terminal")
        wrong = self.command("demo", "prey_retreival")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("did you mean 'prey_retrieval'?", wrong.stderr)

    @unittest.skipUnless(DRAWS, "image_render is not part of this build")
    def test_demo_draws_a_picture_and_a_film(self):
        done = self.command("demo", "sample_footbot", "--film", "--output", "shown")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({path.name for path in (self.folder / "shown").iterdir()}, {"picture.png", "film.mp4"})
        for path in (self.folder / "shown").iterdir():
            self.assertIn(f"shown/{path.name}", done.stderr)
            self.assertGreater(path.stat().st_size, 1000)

    @unittest.skipUnless(SERVES, "web_render is not part of this build")
    def test_demo_serves_a_page(self):
        run = self.start("demo", "diffusion_10", "--page")
        said = run.read_until("Ctrl-C")
        url = re.search(r"Watch it: (http://127\.0\.0\.1:\S+)", said).group(1)
        with urllib.request.urlopen(url, timeout=harness.GENEROUS_S) as page:
            self.assertIn(b"<html", page.read())
        os.killpg(run.process.pid, signal.SIGINT)
        self.assertEqual(run.wait(), 0)
        self.assert_nothing_left(run)
        self.assertEqual(list((self.folder / "runs").iterdir()), [])

    @unittest.skipUnless(SERVES, "web_render is not part of this build")
    def test_demo_opens_the_page_on_a_desktop(self):
        browser = self.folder / "bin" / "xdg-open"
        browser.parent.mkdir()
        browser.write_text(f'#!/bin/sh\necho "$1" >{self.folder}/opened\n')
        browser.chmod(0o755)
        run = self.start("demo", "diffusion_10", environment={"DISPLAY": ":1", "PATH": f"{browser.parent}:{os.environ['PATH']}"})
        said = run.read_until("Ctrl-C")
        self.wait_until("the browser", lambda: (self.folder / "opened").exists() and (self.folder / "opened").read_text(), run)
        self.assertIn((self.folder / "opened").read_text().strip(), said)
        os.killpg(run.process.pid, signal.SIGINT)
        self.assertEqual(run.wait(), 0)

    @unittest.skipUnless(DRAWS, "image_render is not part of this build")
    def test_the_first_run_on_a_terminal_is_shown(self):
        sample = harness.CONFIGS / "sample_footbot.xml"
        said, exit_code = on_terminal(self.folder, "run", sample, "--ticks", "8", "--single-process")
        self.assertEqual(exit_code, 0, said)
        latest = self.folder / "runs" / "latest"
        self.assertTrue(latest.is_symlink())
        runs = [path for path in latest.parent.iterdir() if path != latest]
        self.assertEqual(runs, [latest.parent / os.readlink(latest)])
        self.assertTrue((runs[0] / "film.mp4").exists())
        self.assertIn(f"runs/{runs[0].name}/picture.png", said)
        self.assertLess(said.index("finished:"), said.index("Picture:"))
        self.assertIn("swarmanoid demo --list", said)
        self.assertFalse((runs[0] / "shown").exists() or (runs[0] / "shown.xml").exists())

        again, exit_code = on_terminal(self.folder, "run", sample, "--ticks", "8", "--single-process")
        self.assertEqual((exit_code, "Picture:" in again), (0, False))

    def test_scripts_are_not_shown_anything(self):
        sample = harness.CONFIGS / "sample_footbot.xml"
        done = self.command("run", sample, "--ticks", "10", "--single-process")
        self.assertEqual((done.returncode, "Picture:" in done.stderr, "Next:" in done.stderr), (0, False, False))
        said, exit_code = on_terminal(self.folder, "run", sample, "--ticks", "10", "--single-process", "--quiet")
        self.assertEqual((exit_code, "Picture:" in said), (0, False))

    def test_colours_are_for_terminals(self):
        sample = harness.CONFIGS / "sample_footbot.xml"
        self.assertIn("\033[32mvalid\033[0m", on_terminal(self.folder, "check", sample)[0])
        self.assertNotIn("\033[", on_terminal(self.folder, "check", sample, NO_COLOR="1")[0])
        self.assertNotIn("\033[", self.command("check", sample).stdout)

    def test_complaints_are_red_on_terminals(self):
        self.assertIn("\033[31mswarmanoid\033[0m: there is no sample", on_terminal(self.folder, "demo", "nothing")[0])

    def completed_by_bash(self, *words):
        script = pathlib.Path(__file__).parents[2] / "launcher" / "completion" / "swarmanoid.bash"
        shell = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _swarmanoid 2>/dev/null; printf "%s\\n" "${COMPREPLY[@]}"'
        done = subprocess.run(["bash", "-c", shell, "bash", script, harness.SWARMANOID, *words], cwd=harness.CONFIGS, capture_output=True,
                              text=True, check=True)
        return done.stdout.splitlines()

    def test_bash_completes_commands_options_files_and_values(self):
        self.assertEqual(self.completed_by_bash("atta"), ["attach"])
        self.assertEqual(self.completed_by_bash("run", "diffusion_10.xml", "--single-"), ["--single-process"])
        self.assertEqual(self.completed_by_bash("run", "pil"), ["pile.xml"])
        self.assertEqual(self.completed_by_bash("run", "terr"), ["terrain/"])
        self.assertEqual(self.completed_by_bash("run", "pile.xml", "--set", "framework.max"), ["framework.maxclock="])
        self.assertEqual(self.completed_by_bash("demo", "prey_r"), ["prey_retrieval"])

    def test_check_answers_programs(self):
        sample = harness.CONFIGS / "diffusion_10.xml"
        good, exit_code = self.json_of("check", sample)
        self.assertEqual((exit_code, good["valid"], good["errors"], good["entities"]["footbot"]), (0, True, [], 10))
        wrong = self.folder / "wrong.xml"
        wrong.write_text(sample.read_text().replace("<clocktick>100</clocktick>", "<clocktick>none</clocktick>"))
        bad, exit_code = self.json_of("check", wrong)
        line = next(number for number, text in enumerate(wrong.read_text().splitlines(), 1) if "none" in text)
        self.assertEqual((exit_code, bad["valid"]), (3, False))
        self.assertEqual((bad["errors"][0]["line"], pathlib.Path(bad["errors"][0]["file"]).name), (line, "wrong.xml"))

    def test_lists_answer_programs_as_people(self):
        plugins, _ = self.json_of("list", "plugins")
        rows = [row.split("\t") for row in self.command("list", "plugins", "--rows").stdout.splitlines()]
        self.assertEqual({(each["label"], each["implementation"]) for each in plugins}, {(row[1], row[2]) for row in rows})
        self.assertEqual(sum(len(each["parameters"]) for each in plugins), sum(row[3] != "" for row in rows))
        sample = harness.CONFIGS / "diffusion_10.xml"
        settings, _ = self.json_of("list", "settings", sample)
        rows = self.command("list", "settings", sample).stdout.splitlines()
        self.assertEqual([f"{each['path']}={each['value']}\t{each['allowed']}\t{each['description']}" for each in settings], rows)

    def test_control_answers_programs(self):
        run = self.start("run", harness.CONFIGS / "diffusion_10.xml", "--ticks", "0", "--paused", "--no-visualisers")
        run.find("space_server")
        while not self.json_of("list", "experiments")[0]:
            pass
        answer, exit_code = self.json_of("control", "step", "3")
        self.assertEqual((exit_code, answer["experiment"], answer["ok"], answer["tick"]), (0, "diffusion_10", True, 3))
        refused, exit_code = self.json_of("control", "remove", "missing")
        self.assertEqual((exit_code, refused["ok"]), (2, False))
        self.json_of("control", "stop")
        self.assertEqual(run.wait(), 0)

    def test_the_manifest_tells_machine_and_builds(self):
        self.command("run", harness.CONFIGS / "diffusion_10.xml", "--ticks", "5", "--single-process", "--quiet", "--output", "one")
        manifest = json.loads((self.folder / "one" / "manifest.json").read_text())
        self.assertEqual(manifest["host"], os.uname().nodename)
        self.assertIn(manifest["processor"], pathlib.Path("/proc/cpuinfo").read_text())
        library = BUILD / "lib" / "swarmanoid" / "libfootbot_diffusion.so"
        notes = subprocess.run(["readelf", "-n", library], capture_output=True, text=True, check=True).stdout
        self.assertEqual(manifest["libraries"]["libfootbot_diffusion.so"], re.search(r"Build ID: ([0-9a-f]+)", notes).group(1))
        self.assertRegex(manifest["libraries"]["Swarmanoid"], r"^([0-9a-f]{16}\.)+$")
