"""No two files have one name, so that a name leads to one place; a header and its source stand in one folder. Unit tests are named within
their folder. Every program may have its main.cpp, and the headers of ARGoS3's interface have ARGoS3's names."""
import collections
import os

from tracked import report, tracked

OTHERS = ("tests/unit/", "docs/", "user/", "argos3/api/")
ALLOWED = ("main.cpp", "__init__.py")

folders = collections.defaultdict(set)
for path in tracked("*.h", "*.cpp", "*.js", "*.py"):
    folder, name = os.path.split(path)
    if not path.startswith(OTHERS) and name not in ALLOWED:
        folders[name.replace(".h", ".cpp")].add(folder)
report([f"{name} stands in {' and in '.join(sorted(found))}; say in one of the names what it has" for name, found in folders.items() if len(found) > 1])
