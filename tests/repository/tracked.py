"""The files of the repository, for the rules beside this file."""
import os
import subprocess
import sys


def tracked(*patterns):
    """Paths of the tracked files, relative to the root. Ends the test as skipped outside a git checkout."""
    listing = subprocess.run(["git", "ls-files", "-z", *patterns], capture_output=True, text=True)
    if listing.returncode != 0:
        print("skipped:", listing.stderr.strip())
        sys.exit(77)
    return [path for path in listing.stdout.split("\0") if path and os.path.isfile(path)]


def report(mistakes):
    """Prints one mistake a line and ends the test."""
    for mistake in mistakes:
        print(mistake)
    sys.exit(1 if mistakes else 0)
