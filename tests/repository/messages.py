"""What docs/troubleshooting.md says that programs say, they do say: each part of a message between two … stands in a source."""
import re

from tracked import report, tracked

PAGE = "docs/troubleshooting.md"
# What compilers, CMake and the loader say.
OF_OTHERS = ("c++: fatal error", "Could not find a package", "undefined symbol", "cannot open shared object file")
SHORTEST = 8


def source_text():
    text = ""
    for path in tracked("*.cpp", "*.h", "*.in", "*/CMakeLists.txt", "build_framework"):
        with open(path, encoding="utf-8") as source:
            text += source.read()
    # Literals that go on in the next line, and quotes within them.
    return re.sub(r'"\s*\n?\s*"', "", text).replace('\\"', '"')


def pieces(message):
    # What is put in is in braces in the source.
    for part in re.split(r"…|'…'|\b\d+\b", message):
        part = part.strip(" .:;'()")
        if len(part) >= SHORTEST:
            yield part


def main():
    text = source_text()
    mistakes = []
    with open(PAGE, encoding="utf-8") as page:
        for number, line in enumerate(page, 1):
            row = re.match(r"\| `([^`]+)` \|", line)
            if not row or any(other in row.group(1) for other in OF_OTHERS):
                continue
            mistakes += [f"{PAGE}:{number}: no program says '{piece}'" for piece in pieces(row.group(1)) if piece not in text]
    report(mistakes)


main()
