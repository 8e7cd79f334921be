"""skipped_tests.py RESULTS: prints each skipped test of a JUnit file of ctest, with its reason."""
import re
import sys
import xml.etree.ElementTree as xml


def reason_of(output):
    """What GoogleTest or unittest gives as the reason, or the last line of the output."""
    for pattern in (r": Skipped\n(.+)", r"skipped ['\"](.+)['\"]"):
        found = re.search(pattern, output)
        if found:
            return found.group(1)
    return (output.strip().splitlines() or ["no reason given"])[-1]


for case in xml.parse(sys.argv[1]).getroot().iter("testcase"):
    if case.find("skipped") is not None:
        print(f"skipped: {case.get('name')}: {reason_of(case.findtext('system-out') or '')}")
