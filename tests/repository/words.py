"""The tree holds finished work only, names no folder of one developer's machine, and speaks in the field's words."""
import re

from tracked import report, tracked

FORBIDDEN = [
    (re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X)\b"), "a note of something left undone"),
    (re.compile(r"not (yet )?imple" r"mented|place" r"holder", re.IGNORECASE), "words for something left undone"),
    (re.compile(r"(?<![\w.$}/-])/(home|root|wo" r"rk|fa" r"rm|tmp/wt)/"), "a path of one machine"),
]

# Names that only this project would use, and what the field says instead. Users' listings are as they are.
METAPHORS = {
    r"\w*(Control|Checkpoint)Desk\w*|\bdesk_\w*": "RunControl, CheckpointWriter",
    r"\bAudience\w*|\baudience_|\w*Wish(es)?(?![a-z])\w*|\bwish(es|ed)?_": "ViewPublisher, ViewRequest",
    r"\b(Hello|Bye|SayBye|SayReady|SayState)(Message)?\b|\b(hello|bye)s?_": "Join, Leave, Report",
    r"\w*Suspect\w*|\w*suspects?_\w*|\bCulprits?\b|\bJudge\b": "candidates, attribution",
    r"\bstruct (Ear|Letter|Looked|Raised)\b|\bkLamp\b": "Receiver, Glyph, Viewed, Lifted, Light",
    r"\b(KeepAbsent|StillAbsent|AllMet|MeetOthers|MeetServer)\b": "KeepInactive, StopInactive, AllMatched, WaitFor",
    r"\bStepWatch\b|(ControlClient|StatusChannel)::Tell\b|(ControllerHost|EngineWorker|HostNode|EngineNode)::Step\b":
        "StepTimeout, Send, Publish, Tick",
    r"\w+_kit\.h\b": "a name for what is in it",
}
CODE = re.compile(r"^(?!tests/(seed|repository)/|user/).*\.(h|cpp|idl|py)$")


def metaphors(path, lines):
    if not CODE.match(path):
        return []
    return [f"{path}:{number}: the field says {term}: {line.strip()[:100]}"
            for number, line in enumerate(lines, 1) for word, term in METAPHORS.items() if re.search(word, line)]


def main():
    mistakes = []
    for path in tracked():
        try:
            with open(path, encoding="utf-8") as source:
                lines = source.read().splitlines()
        except UnicodeDecodeError:
            continue
        mistakes += metaphors(path, lines)
        for number, line in enumerate(lines, 1):
            for pattern, meaning in FORBIDDEN:
                if pattern.search(line):
                    mistakes.append(f"{path}:{number}: {meaning}: {line.strip()[:100]}")
    report(mistakes)


main()
