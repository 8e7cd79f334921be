"""A message that a file or folder cannot be written, read or opened also says why: the statement that makes it has the reason."""
import re

from tracked import report, tracked

MESSAGE = re.compile(r"\"[^\"\n]*\bcannot (?:write|open|read|make|create)[^\"\n]*'")
REASON = re.compile(r"strerror|reason|error|message|what|why|cause|_to_string|trouble|another program")


def main():
    mistakes = []
    for path in tracked("*.cpp", "*.h"):
        if path.startswith("tests/"):
            continue
        with open(path, encoding="utf-8") as source:
            text = source.read()
        for found in MESSAGE.finditer(text):
            statement = text[found.end():text.find(";\n", found.end())]
            if not REASON.search(statement):
                number = text.count("\n", 0, found.start()) + 1
                mistakes.append(f"{path}:{number}: it does not say why: {found.group(0)}")
    report(mistakes)


main()
