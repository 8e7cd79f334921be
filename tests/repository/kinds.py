"""Code asks the row of a kind of entity for a property (common/experiment/entity_kind.h); it does not ask which kind it is. A
new kind is one row then, also in a user's library."""
import re

from tracked import report, tracked

# The table itself, the classes of entities that users hold, and the value of an entity that is not read yet.
ALLOWED = ["common/experiment/entity_kinds.cpp", "common/space/make_entity.cpp", "common/experiment/experiment.h"]
# Users' own code is about the robots that it is made for.
OTHERS = ("user/", "tests/")
NAMED = re.compile(r"\bEntityKind::k[A-Z]\w*|\busing enum (swarmanoid::)?EntityKind\b")


def main():
    mistakes = []
    for path in tracked("*.h", "*.cpp"):
        if path in ALLOWED or path.startswith(OTHERS):
            continue
        with open(path, encoding="utf-8") as source:
            for number, line in enumerate(source, 1):
                for name in NAMED.finditer(line):
                    mistakes.append(f"{path}:{number}: {name.group()}: ask the row of the kind instead: DescriptionOf(kind)")
    report(mistakes)


main()
