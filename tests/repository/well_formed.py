"""Every XML text of the tree is XML for another parser too (libxml2): files, templates with their names filled in, and what the pages print."""
import re
import subprocess

from tracked import report, tracked

PRINTED = re.compile(r"^```xml\n(.*?)^```$", re.MULTILINE | re.DOTALL)
# What the first users printed has no language at its fences.
SEED = re.compile(r"^```\n(.*?)^```$", re.MULTILINE | re.DOTALL)
SEED_PAGE = "tests/seed/listings/definition_of_an_experiment.md"


def texts(path, text):
    """The XML in a file, as (first line, text)."""
    if path.endswith((".xml", ".svg")):
        return [(1, text)]
    if path.endswith((".xml.in", ".argos.in")):
        return [(1, re.sub(r"@\w+@", "name", text))]
    blocks = (SEED if path == SEED_PAGE else PRINTED).finditer(text)
    return [(text.count("\n", 0, block.start(1)) + 1, block[1]) for block in blocks]


def fragment(text):
    """A part of a file as a document of its own: parts of the skeleton open what a later one closes."""
    return text if text.startswith("<?xml") else f"<part>{text}</part>"


def main():
    mistakes = []
    count = 0
    for path in tracked("*.xml", "*.svg", "*.xml.in", "*.argos.in", "*.md"):
        with open(path, encoding="utf-8") as source:
            found = texts(path, source.read())
        if path == SEED_PAGE:
            # The skeleton is printed in two parts.
            found = [(found[0][0], found[0][1] + found[1][1]), *found[2:]]
        for line, text in found:
            count += 1
            parsed = subprocess.run(["xmllint", "--noout", "--nonet", "-"], input=fragment(text), capture_output=True, text=True)
            if parsed.returncode != 0:
                mistakes.append(f"{path}:{line}: {parsed.stderr}")
    if count < 40:
        mistakes.append(f"only {count} texts are found")
    report(mistakes)


main()
