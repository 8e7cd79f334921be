#!/usr/bin/env python3
"""extract_listings.py OUTPUT FILE...: the listings of the pages, as files that the tests compile and run.

Each heading `## name` becomes OUTPUT/name.inc: its fenced parts, joined, with every `Slip:` put right. Where there are `Fill:` lines,
OUTPUT/name_filled.inc has these comments replaced too. The parts of definition_of_an_experiment.md become OUTPUT/chapter4.xml."""
import pathlib
import re
import sys

FENCE = re.compile(r"^```\n(.*?)^```$", re.MULTILINE | re.DOTALL)
CHANGE = re.compile(r"^(Slip|Fill): `(.*)` -> `(.*)`$", re.MULTILINE)


def replaced(text, old, new):
    old, new = (part.replace("\\n", "\n") for part in (old, new))
    if text.count(old) != 1:
        sys.exit(f"the listing has {text.count(old)} times: {old}")
    return text.replace(old, new)


def listings(page):
    """name -> (text, text with the comments filled in or None)"""
    found = {}
    for section in re.split(r"^## ", page, flags=re.MULTILINE)[1:]:
        name = section.split("\n", 1)[0]
        text = "".join(FENCE.findall(section))
        changes = CHANGE.findall(FENCE.sub("", section))
        for kind, old, new in changes:
            if kind == "Slip":
                text = replaced(text, old, new)
        filled = text
        for kind, old, new in changes:
            if kind == "Fill":
                filled = replaced(filled, old, new)
        found[name] = text, filled if filled != text else None
    return found


# What the listings leave to the reader: the eyebot's controller, which the arena names.
EYEBOT_CONTROLLER = """<eyebot_sample_controller id="ec" library="eyebot_sample_controller">
    <actuators/>
    <sensors/>
    <parameters/>
  </eyebot_sample_controller>
"""


def experiment(parts):
    """The skeleton with all its parts."""
    text = parts["skeleton"].strip() + "\n"
    for name, part in parts.items():
        if name == "skeleton":
            continue
        part = part.strip()
        part = part.replace("  ...\n", EYEBOT_CONTROLLER if name == "controllers" else "")
        text, count = re.subn(rf"<{name}[^>]*>\s*\.\.\.\s*</{name}>", lambda _: part, text)
        if count != 1:
            sys.exit(f"the skeleton has no <{name}>")
    return text


def main():
    output = pathlib.Path(sys.argv[1])
    output.mkdir(parents=True, exist_ok=True)
    for path in map(pathlib.Path, sys.argv[2:]):
        found = listings(path.read_text())
        if path.stem == "definition_of_an_experiment":
            (output / "chapter4.xml").write_text(experiment({name: text for name, (text, _) in found.items()}))
            continue
        for name, (text, filled) in found.items():
            (output / f"{name}.inc").write_text(text)
            if filled is not None:
                (output / f"{name}_filled.inc").write_text(filled)


main()
