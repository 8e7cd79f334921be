#!/usr/bin/env python3
"""run_cases.py SCRIPT [-v] [CLASS[.CASE] ...]: runs the test cases of a Python script, or some of them. The script can import its
neighbours, and the modules of tests, tests/world and tests/cluster. If a case was skipped and none failed, the exit code is 77, so
that ctest does not count it as passed."""
import importlib
import pathlib
import sys
import unittest

script = pathlib.Path(sys.argv[1]).resolve()
tests = pathlib.Path(__file__).resolve().parents[1]
sys.path[0:1] = map(str, (script.parent, tests, tests / "cluster"))
result = unittest.main(module=importlib.import_module(script.stem), argv=sys.argv[1:], exit=False).result
for test, reason in result.skipped:
    print(f"skipped: {test}: {reason}")
sys.exit(1 if not result.wasSuccessful() else 77 if result.skipped else 0)
