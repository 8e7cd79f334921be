"""outcomes.py RESULTS [AGAIN]: prints each skipped test of a JUnit file of ctest with its reason, then how many tests passed, failed and
were skipped. AGAIN is the file of the failed tests run once more: those that passed then are printed too, and count as passed. The exit
code is 1 if a test failed."""
import re
import sys
import xml.etree.ElementTree as xml


def cases_of(file):
    return list(xml.parse(file).getroot().iter("testcase"))


def reason_of(output):
    """What GoogleTest or unittest gives as the reason, or the last line of the output."""
    for pattern in (r": Skipped\n(.+)", r"skipped ['\"](.+)['\"]"):
        found = re.search(pattern, output)
        if found:
            return found.group(1)
    return (output.strip().splitlines() or ["no reason given"])[-1]


def outcomes(results, again=None):
    """The lines to print, and the number of failed tests."""
    lines = []
    cases = cases_of(results)
    failed = {case.get("name") for case in cases if case.find("failure") is not None}
    skipped = [case for case in cases if case.find("skipped") is not None]
    for case in skipped:
        lines.append(f"skipped: {case.get('name')}: {reason_of(case.findtext('system-out') or '')}")
    for case in cases_of(again) if again else ():
        if case.get("name") in failed and case.get("status") == "run":
            failed.remove(case.get("name"))
            lines.append(f"unsteady: {case.get('name')}: it failed beside other tests, and passed alone; its first output is above")
    closing = f"{len(cases) - len(failed) - len(skipped)} passed, {len(failed)} failed"
    lines.append(closing + (f", {len(skipped)} skipped" if skipped else ""))
    return lines, len(failed)


if __name__ == "__main__":
    text, failures = outcomes(*sys.argv[1:3])
    print("\n".join(text))
    sys.exit(failures > 0)
