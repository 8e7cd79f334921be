"""CITATION.cff has the keys that version 1.2.0 of the format needs, known ones only, and the version and licence of the project."""
import re

from tracked import report, tracked

NEEDED = {"cff-version", "message", "title", "authors"}
ALLOWED = NEEDED | {"abstract", "commit", "date-released", "doi", "identifiers", "keywords", "license", "license-url", "preferred-citation",
                    "references", "repository", "repository-artifact", "repository-code", "type", "url", "version", "contact"}


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def main():
    path = "CITATION.cff"
    if not tracked(path):
        return report([f"{path} is missing"])
    text = text_of(path)
    values = dict(re.findall(r"^([a-z-]+):[ \t]*(.*)$", text, re.MULTILINE))
    parts = re.findall(r"^#define SWARMANOID_VERSION_\w+ (\d+)$", text_of("common/version/version.h"), re.MULTILINE)
    wanted = {"cff-version": "1.2.0", "version": ".".join(parts), "license": "MIT", "type": "software"}
    mistakes = [f"{path}: it lacks {key}" for key in sorted(NEEDED - set(values))]
    mistakes += [f"{path}: {key} is no key of CFF 1.2.0" for key in sorted(set(values) - ALLOWED)]
    mistakes += [f"{path}: {key} is '{values.get(key, '')}'; it must be '{value}'" for key, value in wanted.items() if values.get(key) != value]
    if not re.search(r"^authors:\n(  - (name|family-names): .+\n)", text, re.MULTILINE):
        mistakes.append(f"{path}: 'authors' needs a list of persons or entities with names")
    report(mistakes)


main()
