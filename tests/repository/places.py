"""A new device of the simulator is a description and code, a new sub-command a file, and a new option of a run a row: no other product file
knows one by its name. control_verbs.py has requests to a run, generated_messages.py messages."""
import collections
import re

from tracked import report, tracked

DESCRIPTIONS = "common/plugin_descriptions/"
OPTIONS = "common/run/run_options.cpp"
IMPLEMENTATION = re.compile(r'\.implementation = "(\w+)"')
SUB_COMMAND = re.compile(r'RegisterSubCommand \w+\(\d+, "[a-z]+", (\w+)\)')
# Names of one word have other meanings, too.
OPTION = re.compile(r'(?:Whole|Text|Path|Number|Flag)\(\s*"([a-z]+-[a-z-]+)"')
# These use devices as users do; a check of experiments is about one device; some sub-commands take options of a run.
OTHERS = ("tests/", "argos3/", "user/", "launcher/editor/", "launcher/command/", "common/plugin_descriptions/led_cones.cpp")


def main():
    sources = {}
    for path in tracked("*.cpp", "*.h"):
        with open(path, encoding="utf-8") as source:
            sources[path] = source.read()
    descriptions = "".join(text for path, text in sources.items() if path.startswith(DESCRIPTIONS))
    commands = [name for path, text in sources.items() for name in SUB_COMMAND.findall(text)]
    # A sensor and an actuator of one name have one description file and two of code.
    most = {f'"{device}"': 1 + count for device, count in collections.Counter(IMPLEMENTATION.findall(descriptions)).items()}
    most |= {command: 1 for command in commands}
    most |= {f'"{option}"': 1 for option in OPTION.findall(sources[OPTIONS])}
    mistakes = [] if len(most) > 70 else [f"only {len(most)} devices, sub-commands and options are found: they are written in another way"]
    for name, limit in most.items():
        places = [path for path, text in sources.items() if name in text and (name in commands or not path.startswith(OTHERS))]
        if len(places) > limit:
            mistakes.append(f"{name} stands in {len(places)} files, {limit} must do: {', '.join(places)}")
    report(mistakes)


main()
