"""The tree holds finished work only, and names no folder of one developer's machine."""
import re

from tracked import report, tracked

FORBIDDEN = [
    (re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X)\b"), "a note of something left undone"),
    (re.compile(r"not (yet )?imple" r"mented|place" r"holder", re.IGNORECASE), "words for something left undone"),
    (re.compile(r"(?<![\w.$}/-])/(home|root|wo" r"rk|fa" r"rm|tmp/wt)/"), "a path of one machine"),
]


def main():
    mistakes = []
    for path in tracked():
        try:
            with open(path, encoding="utf-8") as source:
                lines = source.read().splitlines()
        except UnicodeDecodeError:
            continue
        for number, line in enumerate(lines, 1):
            for pattern, meaning in FORBIDDEN:
                if pattern.search(line):
                    mistakes.append(f"{path}:{number}: {meaning}: {line.strip()[:100]}")
    report(mistakes)


main()
