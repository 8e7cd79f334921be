"""Users who are no members of a run: watchers look, operators steer, and neither can do more, or for longer, than was granted."""
import concurrent.futures
import json
import os
import subprocess
import time
import unittest

from harness import DIFFUSION, GENEROUS_S, SWARMANOID, LauncherTest

TICKS = 60


class Share(LauncherTest):
    def start_paused(self, *options):
        return super().start_paused("--ticks", TICKS, "--output", "out", *options)

    def share(self, *words):
        made = self.run_it("share", *words, "--json")
        self.assertEqual(made.process.returncode, 0, made.stderr)
        return json.loads(made.stdout)

    def elsewhere(self, ticket):
        """The environment of somebody who finds no run of his own, and has the line."""
        return {"SWARMANOID_SHARED_FOLDER": f"{self.shared}-elsewhere", "SWARMANOID_SHARE": ticket}

    def control(self, ticket, *words):
        return self.run_it("control", *words, environment=self.elsewhere(ticket))

    def end(self, run):
        resumed = self.run_it("control", "resume")
        self.assertEqual(resumed.process.returncode, 0, resumed.stderr)
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)
        one = self.run_it("run", DIFFUSION, "--ticks", TICKS, "--quiet", "--single-process", "--no-visualisers", "--hash-log", "one")
        self.assertEqual(self.assert_finished(run, TICKS), self.assert_finished(one, TICKS))
        self.assertEqual((self.folder / "hashes").read_text(), (self.folder / "one").read_text())

    def events(self):
        return (self.folder / "out" / "events.csv").read_text()

    def test_a_watcher_looks_and_an_operator_steers(self):
        run = self.start_paused()
        watcher, operator = self.share("--watch"), self.share("--operate", "--for", "2h")
        self.assertEqual((watcher["role"], watcher["ends"], operator["role"]), ("watcher", 0, "operator"))
        self.assertAlmostEqual(operator["ends"], time.time() + 7200, delta=GENEROUS_S)
        looking = self.start("attach", "text", "--file", "table", "--output", self.folder, environment=self.elsewhere(watcher["ticket"]))
        refused = self.control(watcher["ticket"], "resume")
        self.assertEqual(refused.process.returncode, 2, refused.stderr)
        self.assertIn(f"watcher grant {watcher['id']} may only look", refused.stderr)
        stepped = self.control(operator["ticket"], "step", "10")
        self.assertEqual((stepped.process.returncode, stepped.stdout), (0, "diffusion_10: paused at tick 10\n"), stepped.stderr)
        # Shares end with the run that is reset.
        refused = self.control(operator["ticket"], "reset")
        self.assertEqual(refused.process.returncode, 2, refused.stderr)
        self.assertIn("may not ask for 'reset'; members of the run may", refused.stderr)
        self.wait_until("a table", lambda: self.has_table("table"), looking)
        self.end(run)
        self.assertEqual(looking.wait(GENEROUS_S), 0, looking.stderr)
        self.assertRegex(self.events(), rf"(?m)^0,share,{watcher['id']},watch 0,")
        self.assertRegex(self.events(), rf"(?m)^0,refused,ControlRequest,,[^,]* by watcher grant {watcher['id']},")
        self.assertRegex(self.events(), rf"(?m)^0,step,,10,[^,]* by operator grant {operator['id']},")
        for file in (self.folder / "out").rglob("*"):
            if file.is_file():
                for ticket in watcher["ticket"], operator["ticket"]:
                    self.assertNotIn(ticket.split(",")[6].encode(), file.read_bytes(), file)
        self.assert_nothing_left(run)

    def test_an_open_view_is_told_listed_and_revoked(self):
        run = self.start_paused()
        opened = self.run_it("share", "--open", "--for", "1h")
        self.assertRegex(opened.stdout, r"^DDS domain \d+, partition diffusion_10, topics View/open RunStatus/open World/open Leave/open\n$")
        self.assertRegex(opened.stderr, r"^open view [0-9a-f]{8}: .*reach 127\.0\.0\.1 may look at the run with any DDS, until .*Nothing of it is encrypted")
        twice = self.run_it("share", "--open")
        self.assertEqual(twice.process.returncode, 2, twice.stderr)
        self.assertIn("the run has an open view already", twice.stderr)
        share = opened.stderr.split()[2].rstrip(":")
        self.assertRegex(self.run_it("share", "--list").stdout, rf"^{share}  open view  ends \S+, 0 looking; made by ")
        self.assertRegex(self.run_it("share", "--revoke", share).stdout, rf"^open view {share} was revoked by ")
        again = self.share("--open")
        self.assertEqual((again["role"], again["partition"]), ("open view", "diffusion_10"))
        self.assertIn("View/open", again["topics"])
        self.end(run)
        self.assertRegex(self.events(), rf"(?m)^0,share,{share},open ")

    def test_what_is_revoked_is_over_at_once(self):
        run = self.start_paused()
        share = self.share("--operate")
        looking = self.start("attach", "text", "--file", "table", "--output", self.folder, environment=self.elsewhere(share["ticket"]))
        self.wait_until("somebody looking", lambda: "1 looking" in self.run_it("share", "--list").stdout, looking)
        revoked = self.run_it("share", "--revoke", share["id"])
        self.assertRegex(revoked.stdout, rf"^operator grant {share['id']} was revoked by \S+@\S+\n$")
        self.assertNotEqual(looking.wait(GENEROUS_S), 0)
        self.assertIn(f"operator grant {share['id']} was revoked by", looking.stderr)
        refused = self.control(share["ticket"], "resume")
        self.assertEqual(refused.process.returncode, 2, refused.stderr)
        self.assertIn("was revoked by", refused.stderr)
        late = self.run_it("attach", "text", "--file", "late", "--output", self.folder, environment=self.elsewhere(share["ticket"]))
        self.assertNotEqual(late.process.returncode, 0)
        self.assertIn(f"operator grant {share['id']} was revoked by", late.stderr)
        self.assertFalse((self.folder / "late").exists())
        self.assertIn("was revoked by", self.run_it("share", "--list").stdout)
        again = self.run_it("share", "--revoke", share["id"])
        self.assertEqual(again.process.returncode, 2)
        self.end(run)

    def test_what_has_ended_is_over(self):
        run = self.start_paused()
        share = self.share("--operate", "--for", "3s")
        looking = self.start("attach", "text", "--file", "table", "--output", self.folder, environment=self.elsewhere(share["ticket"]))
        self.assertNotEqual(looking.wait(GENEROUS_S), 0)
        self.assertIn(f"operator grant {share['id']} ", looking.stderr)
        self.assertIn("ended", looking.stderr)
        refused = self.control(share["ticket"], "resume")
        self.assertNotEqual(refused.process.returncode, 0)
        self.assertIn("ended at", refused.stderr)
        # A holder who writes a later end into the line makes its key invalid.
        words = share["ticket"].split(",")
        words[3] = "0"
        longer = self.control(",".join(words), "resume", "--patience", "1")
        self.assertNotEqual(longer.process.returncode, 0)
        self.end(run)

    def test_a_watcher_cannot_become_an_operator(self):
        """A watcher who writes another role into his line, and an operator who asks for what members ask."""
        run = self.start_paused()
        watcher, operator = self.share("--watch"), self.share("--operate")
        raised = self.control(watcher["ticket"].replace("watch", "operate"), "resume")
        self.assertEqual(raised.process.returncode, 2, raised.stderr)
        self.assertIn("may only look", raised.stderr)
        other = self.control(watcher["ticket"].replace(watcher["id"], operator["id"]), "resume", "--patience", "1")
        self.assertNotEqual(other.process.returncode, 0)
        # As a key of the run it is worth nothing.
        key = self.folder / "key"
        key.write_text(operator["ticket"].split(",")[6] + "\n")
        key.chmod(0o600)
        domain = operator["ticket"].split(",")[4]
        made = self.run_it("share", "diffusion_10", "--operate", "--domain", domain, "--key", key,
                           environment={"SWARMANOID_SHARED_FOLDER": f"{self.shared}-elsewhere"})
        self.assertNotEqual(made.process.returncode, 0)
        self.end(run)

    def test_sixteen_shares_are_open_at_most_and_ended_ones_do_not_count(self):
        run = self.start_paused()
        shares = [self.share("--watch") for _ in range(16)]
        for _ in range(2):
            refused = self.run_it("share", "--watch")
            self.assertEqual(refused.process.returncode, 2, refused.stderr)
            self.assertIn("16 access grants of this run are open; revoke one of them first", refused.stderr)
            self.assertEqual(self.run_it("share", "--revoke", shares.pop()["id"]).process.returncode, 0)
            self.share("--watch")
        # A share that has ended cannot be revoked again, which would make room for another one.
        once_more = shares.pop()["id"]
        self.assertEqual([self.run_it("share", "--revoke", once_more).process.returncode for _ in range(2)], [0, 2])
        self.share("--watch")
        self.assertEqual(self.run_it("share", "--watch").process.returncode, 2)
        self.end(run)

    def test_grants_are_made_and_revoked_while_others_join(self):
        """The more endpoints the run has, the longer a process that joins is told about them, and may leave meanwhile."""
        run = self.start_paused()
        for _ in range(8):
            self.share("--watch")

        def make_and_revoke(_):
            return self.run_it("share", "--revoke", self.share("--watch")["id"]).process.returncode

        with concurrent.futures.ThreadPoolExecutor(3) as people:
            self.assertEqual(set(people.map(make_and_revoke, range(45))), {0})
        self.end(run)

    def test_shares_outlive_the_space_server(self):
        run = self.start("run", DIFFUSION, "--quiet", "--paused", "--no-visualisers", "--ticks", TICKS, "--output", "out")
        self.wait_for_experiment("diffusion_10")
        kept, revoked = self.share("--operate"), self.share("--operate")
        self.assertEqual(self.run_it("share", "--revoke", revoked["id"]).process.returncode, 0)
        os.kill(run.find("space_server"), 9)
        self.wait_until("the share at another server",
                        lambda: "an earlier space server" in self.run_it("share", "--list").stdout, run)
        listed = self.run_it("share", "--list").stdout
        self.assertIn(kept["id"], listed)
        self.assertNotIn(revoked["id"], listed)
        resumed = self.control(kept["ticket"], "resume")
        self.assertEqual(resumed.process.returncode, 0, resumed.stderr)
        self.assertEqual(run.wait(GENEROUS_S), 0, run.stderr)

    @unittest.skipUnless(os.geteuid() == 0, "only root can be another user")
    def test_another_user_uses_a_share(self):
        other_user = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]
        if subprocess.run([*other_user, "test", "-x", SWARMANOID], check=False).returncode != 0:
            self.skipTest("other users cannot start the command that is tested")
        run = self.start_paused()
        share = self.share("--operate")
        environment = {**os.environ, **self.elsewhere(share["ticket"]), "XDG_RUNTIME_DIR": ""}
        answer = subprocess.run([*other_user, SWARMANOID, "control", "step"], check=False, capture_output=True, text=True, cwd="/",
                                timeout=GENEROUS_S, env=environment)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        self.end(run)

    def test_mistakes_are_told(self):
        for words, said in (([], "give one of --watch"), (["--watch", "--operate"], "give one of --watch"),
                            (["--watch", "--for", "soon"], "such as 90s, 30m"), (["--list", "--for", "2h"], "--for is the time of")):
            answer = self.run_it("share", *words)
            self.assertEqual(answer.process.returncode, 2, words)
            self.assertIn(said, answer.stderr)
        domain_and_key = f"77,127.0.0.1,{'0' * 64}"
        open_share = self.run_it("control", "stop", "--insecure",
                                 environment={"SWARMANOID_SHARE": f"1,1a2b3c4d,watch,0,{domain_and_key},diffusion_10"})
        self.assertNotEqual(open_share.process.returncode, 0)
        self.assertIn("has a key; leave out --insecure", open_share.stderr)
        broken = self.run_it("control", "stop", environment={"SWARMANOID_SHARE": "1,2,3"})
        self.assertNotEqual(broken.process.returncode, 0)
        self.assertIn("paste the whole line", broken.stderr)
