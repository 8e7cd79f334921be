"""No two product files have one name, so that a name leads to one place. Every program may have its main.cpp, and the headers
of ARGoS3's interface have ARGoS3's names."""
import collections
import os

from tracked import report, tracked

OTHERS = ("tests/", "docs/", "user/", "argos3/api/")

folders = collections.defaultdict(list)
for path in tracked("*.h", "*.cpp", "*.js", "*.py"):
    if not path.startswith(OTHERS) and os.path.basename(path) not in ("main.cpp", "__init__.py"):
        folders[os.path.basename(path)].append(os.path.dirname(path))
report([f"{name} stands in {' and in '.join(found)}; say in one of the names what it has" for name, found in folders.items() if len(found) > 1])
