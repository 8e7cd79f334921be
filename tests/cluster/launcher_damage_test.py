"""Files of a run with damaged bytes: every command that reads them names the place and what is lost, uses what can be read, and fails."""
import csv
import shutil
import signal
import struct
import subprocess

from harness import CONFIGS, GENEROUS_S, LauncherTest, SWARMANOID

START, TICKS, SNAPSHOT = 1, 2, 3
HEADER_BYTES = 48


class Damage(LauncherTest):
    def blocks(self):
        """Kind, ticks, first tick, offset and bytes of all blocks of the journal."""
        journal = (self.folder / "run/journal/0").read_bytes()
        found, offset = [], 0
        while offset < len(journal):
            self.assertEqual(journal[offset:offset + 7], b"SWARMJB")
            kind, ticks, first, _, stored = struct.unpack_from("<IIQQQ", journal, offset + 8)
            found.append((kind, ticks, first, offset, HEADER_BYTES + stored))
            offset += HEADER_BYTES + stored
        return found

    def damaged(self, file, change):
        """A copy of the run in which `change` has been at the bytes of a file."""
        copy = self.folder / "damaged"
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(self.folder / "run", copy, ignore=shutil.ignore_patterns("latest"))
        (copy / file).write_bytes(change((copy / file).read_bytes()))

    def flip(self, at):
        def change(content):
            return content[:at] + bytes([content[at] ^ 4]) + content[at + 1:]
        return change

    def expect(self, words, code, *says):
        told = self.run_it(*words)
        self.assertEqual(told.process.returncode, code, (words, told.stdout, told.stderr))
        for text in says:
            self.assertIn(text, told.stderr, words)
        return told

    def exported(self, *says):
        table = self.folder / "table.csv"
        table.unlink(missing_ok=True)
        self.expect(("export", "damaged", "--csv", table, "--entities", "fb_0"), 4, *says)
        with table.open(newline="") as file:
            return {int(row["tick"]): row for row in csv.DictReader(file)}

    def test_a_flipped_bit_of_a_journal(self):
        """Paced, so that states are saved on the way."""
        run = self.run_it("run", CONFIGS / "diffusion_10.xml", "--ticks", 400, "--real-time", 15, "--output", "run", "--quiet")
        self.assertEqual(run.process.returncode, 0, run.stderr)
        self.expect(("export", "run", "--csv", "whole.csv", "--entities", "fb_0"), 0)
        with (self.folder / "whole.csv").open(newline="") as file:
            whole = {int(row["tick"]): row for row in csv.DictReader(file)}
        blocks = self.blocks()
        saved = [block for block in blocks if block[0] == SNAPSHOT]
        ticks = [block for block in blocks if block[0] == TICKS]
        self.assertGreater(len(saved), 1)
        # A block with a saved state behind it, and the last one.
        early = next(block for block in ticks if block[2] > 10)
        after = min(block[2] for block in saved if block[2] + 1 >= early[2] + early[1])
        for place, lost in ((early[3] + 2, range(early[2], after)), (early[3] + 14, range(early[2], after)),
                            (early[3] + 34, range(early[2], after)), (early[3] + 45, range(early[2], after)),
                            (early[3] + early[4] - 1, range(early[2], after)), (saved[0][3] + 60, range(0)),
                            (blocks[0][3] + 60, range(0)), (ticks[-1][3] + 60, range(ticks[-1][2], 401))):
            offset = max(block[3] for block in blocks if block[3] <= place)
            self.damaged("journal/0", self.flip(place))
            lost_text = f"{len(lost)} of 401 states are lost: ticks {lost[0]} to {lost[-1]}" if len(lost) > 1 else "state"
            says = (f"damaged/journal/0' is damaged at byte {offset}", lost_text if lost else "no state is lost")
            rest = self.exported(*says)
            self.assertEqual(rest, {tick: row for tick, row in whole.items() if tick not in lost})
            (self.folder / "run.mcap").unlink(missing_ok=True)
            self.expect(("export", "damaged", "--mcap", "run.mcap"), 4, *says)
            self.assertIn(f"equal: {401 - len(lost)} states", self.expect(("diff", "damaged", "run"), 5 if 400 in lost else 4, *says).stdout
                          if 400 not in lost else f"equal: {401 - len(lost)} states")
            self.expect(("replay", "damaged", "text", "file=shown.txt"), 4, *says)
            verified = self.expect(("replay", "damaged", "--verify"), 4, *says)
            self.assertIn(f"equal: {401 - len(lost)} states", verified.stdout)
            # Without its first block the journal does not say which robots the hosts had.
            self.expect(("inspect", "damaged@3", "fb_1"), 4, says[0])
        self.damaged("journal/0", self.flip(early[3] + 60))
        told = self.expect(("inspect", f"damaged@{early[2] + early[1] + 2}", "fb_1"), 4)
        self.assertTrue(f"lacks tick {early[2]}" in told.stderr or f"and not {early[2]}" in told.stderr
                        or after <= early[2] + early[1] + 2, told.stderr)
        told = self.expect(("run", "--branch", f"damaged@{early[2]}", "--output", "branch"), 2, f"lacks tick {early[2]}")
        resumed = self.expect(("resume", "damaged", "--quiet"), 0, "is damaged at byte")
        self.assertEqual(resumed.stdout.split("hash ")[1][:16], run.stdout.split("hash ")[1][:16])
        # Cut between two blocks: nothing but the manifest knows.
        self.damaged("journal/0", lambda content: content[:ticks[-1][3]])
        self.exported(f"{401 - ticks[-1][2]} of 401 states are lost")
        self.damaged("journal/0", lambda content: content[:-3])
        self.expect(("replay", "damaged", "--verify"), 4, "torn end")
        (self.folder / "damaged/manifest.json").unlink()
        self.expect(("replay", "damaged", "--verify"), 0, "torn end", "was killed while it wrote them")
        self.damaged("manifest.json", lambda content: content[:50])
        self.expect(("replay", "damaged", "--verify"), 4, "manifest.json' is damaged")

    def test_a_folder_that_was_deleted_while_the_run_went_on(self):
        for words in ((), ("--single-process",)):
            run = self.start("run", CONFIGS / "diffusion_10.xml", "--ticks", 0, "--real-time", 20, "--output", "gone", *words)
            run.read_until("running")
            shutil.rmtree(self.folder / "gone")
            run.process.send_signal(signal.SIGINT)
            run.wait()
            self.assertNotIn(run.process.returncode, (0,), run.stderr)
            self.assertIn("gone/manifest.json': No such file or directory", run.stderr)

    def test_a_result_that_standard_output_does_not_take(self):
        for words in (("run", CONFIGS / "diffusion_10.xml", "--ticks", 5, "--quiet", "--output", "cluster"),
                      ("run", CONFIGS / "diffusion_10.xml", "--ticks", 5, "--quiet", "--output", "one", "--single-process"),
                      ("check", CONFIGS / "diffusion_10.xml"), ("list", "plugins"), ("diff", "cluster", "cluster"), ("run", "--help")):
            with open("/dev/full", "w") as full:
                done = subprocess.run([SWARMANOID, *map(str, words)], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True,
                                      timeout=GENEROUS_S, check=False)
            self.assertEqual(done.returncode, 4, (words, done.stderr))
            self.assertIn("cannot write the results to standard output", done.stderr, words)
