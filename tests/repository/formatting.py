"""Every C++ file is as clang-format and .clang-format make it."""
import re
import subprocess

from tracked import report, tracked


def main():
    paths = tracked("*.h", "*.hpp", "*.cpp")
    places = {}
    for start in range(0, len(paths), 100):
        check = subprocess.run(["clang-format", "--dry-run", "--Werror", *paths[start:start + 100]],
                               capture_output=True, text=True)
        for path, line in re.findall(r"^(\S+):(\d+):\d+: error:", check.stderr, re.MULTILINE):
            places.setdefault(path, line)
    report([f"{path}:{line}: is the first place to format; cure: clang-format -i {path}"
            for path, line in places.items()])


main()
