#!/usr/bin/env python3
"""run_page.py PAGE PREFIX: runs the ```sh blocks of a page, as one shell would, in an empty folder that is its home, where
`swarmanoid` is the installed package. A ```text block after one is the output, in which … stands for anything; more may be
printed before, between and after its lines. Any other block shows a part of a file beside the page:

    <!-- shown in FILE -->
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^(?:<!-- shown in (\S+) -->\n)?```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
MARK = "---- block "


def expected_lines(text):
    return [re.compile(".*".join(re.escape(part) for part in line.split("…"))) for line in text.splitlines()]


def first_missing(expected, output):
    """The first expected line that the output does not have in its place."""
    lines = iter(output.splitlines())
    for pattern in expected:
        if not any(pattern.fullmatch(line) for line in lines):
            return pattern.pattern
    return None


def main():
    page, prefix = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    blocks = []  # (commands, expected output)
    for file, language, text in BLOCK.findall(page.read_text()):
        if file:
            if text not in (page.parent / file).read_text():
                sys.exit(f"{file} does not have what {page.name} shows of it:\n{text}")
        elif language == "sh":
            blocks.append([text, ""])
        elif language == "text":
            blocks[-1][1] = text
        else:
            sys.exit(f"{page.name}: which file has this?\n{text}")
    script = "set -euo pipefail\n"
    for number, (commands, _) in enumerate(blocks):
        script += f"echo '{MARK}{number}'\n{commands}\n"

    with tempfile.TemporaryDirectory() as home:
        (pathlib.Path(home) / "swarmanoid").symlink_to(prefix)
        # Runs of others on this machine are none of ours.
        environment = {**os.environ, "HOME": home, "SWARMANOID_SHARED_FOLDER": f"/dev/shm/swarmanoid-test-{os.getpid()}"}
        run = subprocess.run(["bash", "-c", script], cwd=home, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             text=True, timeout=500)
        shutil.rmtree(environment["SWARMANOID_SHARED_FOLDER"], ignore_errors=True)
    print(run.stdout)
    outputs = run.stdout.split(MARK)[1:]
    failures = []
    for number, output in enumerate(outputs):
        missing = first_missing(expected_lines(blocks[number][1]), output.split("\n", 1)[1])
        if missing is not None:
            failures.append(f"block {number} of {page.name} prints no line: {missing}")
    if run.returncode != 0:
        failures.append(f"block {len(outputs) - 1} of {page.name} ends with exit code {run.returncode}")
    print("\n".join(failures))
    sys.exit(1 if failures else 0)


main()
