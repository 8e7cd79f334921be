"""Parameters of a stranger's controllers and experiment functions: what is misspelt or wrong is a mistake of the file, found
before anything starts where they are declared, and after Init where they are not, with the same words in all ways."""
from outside import BUILT, PREFIX, WAYS, OutsideTest

WHEELS = "<footbot_wheels><implementation>dummy_footbot_wheels</implementation></footbot_wheels>"
KNOWN = "it has: velocity, backwards, target_distance"
CURE = "; a controller that asks for it after Init overrides ReadsParametersLater"


class Parameters(OutsideTest):
    def walker(self, parameters="", controller="outside_walker", **more):
        return self.experiment(controller=controller, parameters=parameters, actuators=WHEELS, **more)

    def place(self, file, text):
        """file:line:col of the first occurrence of a text."""
        before = file.read_text().split(text)[0]
        return f"{file}:{before.count(chr(10)) + 1}:{len(before.rpartition(chr(10))[2]) + 1}"

    def refused(self, file, words, *settings):
        """By check and by run, in both ways, with the same words, before anything was started."""
        options = [word for setting in settings for word in ("--set", setting)]
        for done in [self.command("swarmanoid", "check", file, *options),
                     *(self.run_experiment(file, *way, *options) for way in WAYS.values())]:
            self.assertEqual((done.returncode, done.stdout), (3, ""), done.stderr)
            self.assertEqual(done.stderr.splitlines()[0], words)
        self.assertFalse((self.folder / "runs").exists())

    def test_a_declared_parameter_that_is_misspelt(self):
        file = self.walker("<velocty>0.2</velocty>")
        self.refused(file, f"{self.place(file, '<velocty>')}: the controller <outside_walker> has no parameter 'velocty'; "
                     f"{KNOWN}; did you mean 'velocity'?")
        file = self.walker()
        self.refused(file, "--set controllers.c.parameters.target_distnce: the controller <outside_walker> has no parameter "
                     f"'target_distnce'; {KNOWN}; did you mean 'target_distance'?",
                     "controllers.c.parameters.target_distnce=0.5")

    def test_declared_parameters_with_bad_values(self):
        for value, said in [("fast", "'fast'; it must be a number in m/s, from 0 to 0.3 m/s"),
                            ("20 cm/s", "'20 cm/s'; it must be a number in m/s, from 0 to 0.3 m/s"),
                            ("0.5", "0.5 m/s; it must be from 0 to 0.3 m/s")]:
            file = self.walker(f"<velocity>{value}</velocity>")
            with self.subTest(value):
                done = self.command("swarmanoid", "check", file)
                self.assertEqual(done.returncode, 3)
                self.assertEqual(done.stderr.splitlines()[0],
                                 f"{self.place(file, '<velocity>')}: 'velocity' of the controller <outside_walker> is {said}")
        self.refused(file, f"--set controllers.c.parameters.velocity: 'velocity' of the controller <outside_walker> is 0.4 m/s; "
                     "it must be from 0 to 0.3 m/s", "controllers.c.parameters.velocity=0.4")

    def test_defaults_are_those_that_were_declared(self):
        hashes = {}
        for way, options in WAYS.items():
            hashes[way] = [self.hash_of(self.run_experiment(self.walker(), *options, *more))
                           for more in ([], ["--set", "controllers.c.parameters.velocity=0.1"],
                                        ["--set", "controllers.c.parameters.velocity=0.2"])]
            self.assertEqual(hashes[way][0], hashes[way][1])
            self.assertNotEqual(hashes[way][0], hashes[way][2])
        self.assertEqual(hashes["one process"], hashes["cluster"])

    def test_what_a_controller_never_reads(self):
        file = self.walker("<velocty>0.2</velocty>\n<gains forwrd='2'/>", controller="outside_asker")
        said = [f"{self.place(file, '<velocty>')}: the controller 'c' (outside_asker) never reads the parameter 'velocty'; "
                "it reads: gains, velocity; did you mean 'velocity'?",
                f"{self.place(file, 'forwrd')}: the controller 'c' (outside_asker) never reads the parameter 'forwrd' of "
                f"<gains>; it reads: forward; did you mean 'forward'?{CURE}"]
        for way, options in WAYS.items():
            with self.subTest(way):
                done = self.run_experiment(file, *options)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertEqual(done.stderr.splitlines()[:2], said)

    def test_a_bad_value_that_a_controller_reads_is_a_mistake_of_the_file(self):
        file = self.walker("<velocity>fast</velocity>", controller="outside_asker")
        for way, options in WAYS.items():
            with self.subTest(way):
                done = self.run_experiment(file, *options)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertEqual(done.stderr.splitlines()[0],
                                 f"{self.place(file, '<velocity>')}: 'velocity' is 'fast'; it must be a number")

    def test_controllers_may_read_later_and_ignore_nothing(self):
        later = self.walker("<velocity>0.2</velocity>", controller="outside_asker")
        text = later.read_text()
        first = self.hash_of(self.run_experiment(later, "--single-process"))
        later.write_text(text.replace("<outside_asker ", "<outside_later ").replace("</outside_asker>", "</outside_later>"))
        self.assertEqual(self.hash_of(self.run_experiment(later, "--single-process")), first)

    def test_experiment_functions(self):
        functions = '<outside_span id="span" library="outside_span"><aftr>3</aftr></outside_span>'
        file = self.walker(functions=functions)
        self.refused(file, f"{self.place(file, '<aftr>')}: <outside_span> has no element <aftr>; allowed: id, library, after; "
                     "did you mean 'after'?")
        file = self.walker(functions=functions.replace("<aftr>3</aftr>", ""))
        for options in WAYS.values():
            self.assertIn("finished: 7 ticks", self.run_experiment(file, *options).stdout)
        done = self.run_experiment(file, "--single-process", "--set", "experiment_functions.span.after=3")
        self.assertIn("finished: 3 ticks", done.stdout)

    def test_they_are_listed(self):
        library = BUILT / "controllers" / "liboutside_walker.so"
        shown = self.command("swarmanoid", "list", "plugins", library, "outside_walker").stdout
        self.assertRegex(shown, r"controller outside_walker\n  drives straight on\n")
        self.assertRegex(shown, r"\n    velocity +number +m/s +0.1 +from 0 to 0.3 m/s +Of both wheels.\n")
        rows = self.command("swarmanoid", "list", "plugins", "--rows", library).stdout.splitlines()
        self.assertIn("controller\toutside_walker\t\tvelocity\tnumber\tm/s\t0.1\t0\t0.3\t\tOf both wheels.", rows)
        settings = self.command("swarmanoid", "list", "settings", self.walker()).stdout.splitlines()
        self.assertIn("controllers.c.parameters.target_distance=1\ta number in m, at least 0 m\tWhere it would stop.", settings)

    def test_the_schema_knows_them(self):
        schema = self.folder / "experiment.xsd"
        schema.write_text(self.command("swarmanoid", "list", "schema", BUILT / "controllers" / "liboutside_walker.so").stdout)
        self.assertIn('<xs:element name="outside_walker">', schema.read_text())
        for parameters, right in [("<velocity>0.2</velocity>", True), ("<velocty>0.2</velocty>", False),
                                  ("<velocity>0.5</velocity>", False)]:
            done = self.command("/usr/bin/xmllint", "--noout", "--schema", schema, self.walker(parameters))
            self.assertEqual(done.returncode == 0, right, done.stderr)

    def test_the_installed_schema_is_the_printed_one_and_samples_fit_it(self):
        shared = PREFIX / "share" / "swarmanoid"
        installed = shared / "experiment.xsd"
        self.assertEqual(installed.read_text(), self.command("swarmanoid", "list", "schema").stdout)
        # The others have kinds of robots of their own.
        samples = [file for file in (shared / "configs").glob("*.xml") if file.stem not in ("hexapods", "meshes", "stones", "urdf_rover")]
        self.assertGreater(len(samples), 20)
        done = self.command("/usr/bin/xmllint", "--noout", "--schema", installed, *samples)
        self.assertEqual(done.returncode, 0, done.stderr)


class Robot(OutsideTest):
    def test_the_program_of_the_robot_reads_them_too(self):
        robot = PREFIX / "bin" / "swarmanoid_robot"
        file = self.experiment(controller="outside_walker", parameters="<velocty>0.2</velocty>")
        done = self.command(robot, file, "--robot", "robot_one", "--check")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn(f"the controller <outside_walker> has no parameter 'velocty'; {KNOWN}; did you mean 'velocity'?",
                      done.stderr)
        file = self.experiment(controller="outside_still", parameters="<speed>1</speed>")
        done = self.command(robot, file, "--robot", "robot_one", "--steps", "1")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("the controller 'c' (outside_still) never reads the parameter 'speed'; it reads: none", done.stderr)
