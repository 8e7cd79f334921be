"""installed_headers.py SOURCE GENERATED PREFIX COMPILER [OPTION...]: exactly the headers that users need are installed.

Users need the Common Interface, the behaviours, the headers that listings, samples, templates and tests of plug-ins include, the
headers that pages for users or public headers name, and all headers that these include. GENERATED is the folder of headers that the
build makes. The compiler then reads all installed headers.
"""
import os
import re
import subprocess
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s+["<]([^">@]+\.h)[">]', re.M)
# A header that a text names with its folder.
NAMED = re.compile(r"(?<![\w./-])[a-z0-9_]+(?:/[a-z0-9_]+)+\.h\b")
# All headers of these folders are public.
INTERFACE = ["common/control_interface", "user/behavior_toolkit"]
INCLUDE_FOLDERS = ["", *INTERFACE, "launcher"]
# Folders with code of users, and code that is written like theirs.
USERS = ["user", "tests/outside/plugins", "tests/package", "tests/seed/behaviors", "tests/seed/chapter4", "tests/seed/listings",
         "tests/cluster/distance_render"]
# These pages describe the simulator's own code. Other pages are for users.
PAGES_OF_DEVELOPERS = {"architecture", "code_tour", "command", "constants", "design_decisions", "determinism", "performance", "recovery", "scaling",
                       "wire"}
# Folders of headers that are installed by other rules.
ARGOS3 = ("argos3/api/", "argos3/refused/")


def files(folder, *endings):
    for base, _, names in os.walk(folder):
        for name in sorted(names):
            if name.endswith(endings):
                yield os.path.join(base, name)


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class Sources:
    def __init__(self, root, generated):
        self.root = root
        self.generated = generated

    def file(self, path):
        """The file of a header that `path` names below the root or the generated headers. None if it does not exist."""
        found = (os.path.join(folder, path) for folder in (self.root, self.generated))
        return next(filter(os.path.isfile, found), None)

    def path(self, name, folder):
        """The path below the root of a header that a file in `folder` includes. None if it is not ours."""
        for place in [folder, *INCLUDE_FOLDERS]:
            path = os.path.normpath(os.path.join(place, name))
            if self.file(path):
                return path
        return None

    def included(self, path):
        names = INCLUDE.findall(text_of(self.file(path)))
        paths = (self.path(name, os.path.dirname(path)) for name in names)
        return [header for header in paths if header]

    def closure(self, headers):
        found, waiting = set(), list(headers)
        while waiting:
            header = waiting.pop()
            if header not in found:
                found.add(header)
                waiting += self.included(header)
        return found


def needs(sources):
    """Public header to one file that needs it."""
    needed = {}
    for folder in INTERFACE:
        for path in files(os.path.join(sources.root, folder), ".h"):
            needed[os.path.relpath(path, sources.root)] = folder
    listings = [path for folder in USERS for path in files(os.path.join(sources.root, folder), ".h", ".cpp", ".in", ".sh", ".md", ".py")]
    pages = [path for path in files(os.path.join(sources.root, "docs"), ".md")]
    for path in [*listings, *pages]:
        path = os.path.relpath(path, sources.root)
        for header in sources.included(path):
            needed[header] = path
    for path in pages:
        if os.path.splitext(os.path.basename(path))[0] not in PAGES_OF_DEVELOPERS:
            for header in NAMED.findall(text_of(path)):
                if os.path.isfile(os.path.join(sources.root, header)):
                    needed[header] = os.path.relpath(path, sources.root)
    own = tuple(folder + "/" for folder in ["user/controllers", "user/entities", "tests"])
    return {header: path for header, path in needed.items() if not header.startswith(own)}


def named_by(sources, headers):
    """Existing headers that the text of these headers names."""
    named = {name for header in headers for name in NAMED.findall(text_of(sources.file(header)))}
    return {name for name in named if os.path.isfile(os.path.join(sources.root, name))}


def main():
    root, generated, prefix, *compiler = sys.argv[1:]
    sources = Sources(root, generated)
    folder = os.path.join(prefix, "include/swarmanoid")
    installed = {os.path.relpath(path, folder) for path in files(folder, ".h")}
    installed = {path for path in installed if not path.startswith(ARGOS3)}
    needed = needs(sources)
    wanted = sources.closure(needed)
    mistakes = [f"{header} is not installed" + (f", but {needed[header]} needs it" if header in needed else ", but a public header needs it")
                for header in sorted(wanted - installed)]
    allowed = sources.closure(wanted | named_by(sources, wanted))
    mistakes += [f"{header} is installed, but users do not need it: see the list in cmake/InstallHeaders.cmake"
                 for header in sorted(installed - allowed)]
    print("\n".join(mistakes))
    print(f"{len(installed)} headers are installed")
    if mistakes:
        sys.exit(1)
    everything = "".join(f'#include "{header}"\n' for header in sorted(installed))
    options = [f"-I{os.path.join(folder, place)}" for place in INCLUDE_FOLDERS]
    sys.exit(subprocess.run([*compiler, *options, "-std=c++20", "-fsyntax-only", "-xc++", "-"], input=everything, text=True).returncode)


main()
