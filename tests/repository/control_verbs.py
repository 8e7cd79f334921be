"""A verb of control requests is known in two places: its row in the table, and its action at the space server."""
import re

from tracked import report, tracked

TABLE = "common/messages/control_verbs.cpp"
ACTIONS = ("space_server/run_control.cpp", "space_server/cluster/access_grants.cpp")
ROW = re.compile(r'\{"([a-z-]+)",\s*\{')
# The interface of renderers has functions for some verbs, buttons of the page ask for some, the event log is read for the pace and the
# grants of a run that goes on, and `share` is a sub-command of its own.
OTHERS = {"visualiser/experiment_control.cpp", "visualiser/web/page/src/function_keys.js", "space_server/event_log.cpp", "launcher/command/command_share.cpp"}
# These words have other meanings, too.
COMMON = {"add", "hosts", "machines", "move", "pause", "press", "release", "remove", "reset", "resume", "select", "share", "speed", "step", "stop", "failed", "refused", "fault"}


def text_of(path):
    with open(path, encoding="utf-8") as source:
        return source.read()


def main():
    sources = {path: text_of(path) for path in tracked("*.cpp", "*.h", "*.py", "*.js") if not path.startswith("tests/")}
    verbs = ROW.findall(sources[TABLE])
    mistakes = [] if len(verbs) > 20 else [f"{TABLE}: the rows are written in another way"]
    for verb in verbs:
        actions = [path for path in ACTIONS if f'{{"{verb}", &' in sources[path]]
        if len(actions) != 1 and verb not in ("failed", "refused", "fault"):
            mistakes.append(f"{TABLE}: '{verb}' has {len(actions)} actions")
        if verb in COMMON:
            continue
        places = {path for path, text in sources.items() if f'"{verb}"' in text} - OTHERS
        mistakes += [f"{path}: it knows the verb '{verb}'" for path in sorted(places - {TABLE, *ACTIONS})]
    report(mistakes)


main()
