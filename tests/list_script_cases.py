#!/usr/bin/env python3
"""list_script_cases.py FILE.py|FILE.mjs ...: the test cases of scripts, a line each: SCRIPT|NAME OF THE TEST|ARGUMENT THAT RUNS IT ALONE

Of Python, the methods test_* of classes that derive from unittest.TestCase, or from a class of another file. Of JavaScript, the methods of
the object `tests`. ctest asks when it lists the tests (ScriptTests.cmake)."""
import ast
import pathlib
import re
import sys


def cases_of_python(text):
    classes = {node.name: node for node in ast.parse(text).body if isinstance(node, ast.ClassDef)}

    def bases(node):
        return [base.attr if isinstance(base, ast.Attribute) else base.id for base in node.bases]

    def is_test(node):
        return any(is_test(classes[base]) if base in classes else base != "object" for base in bases(node))

    def methods(node):
        for base in bases(node):
            if base in classes:
                yield from methods(classes[base])
        yield from (item.name for item in node.body if isinstance(item, ast.FunctionDef) and item.name.startswith("test"))

    for node in classes.values():
        if is_test(node):
            for name in dict.fromkeys(methods(node)):
                yield f"{node.name}.{name}", f"{node.name}.{name}"


def cases_of_javascript(text):
    for name in re.findall(r'^  async "([^"]+)"\(\)', text, re.MULTILINE):
        yield re.sub(r"\W+", "_", name), name


def main():
    for script in map(pathlib.Path, sys.argv[1:]):
        found = list((cases_of_python if script.suffix == ".py" else cases_of_javascript)(script.read_text()))
        if not found:
            sys.exit(f"{script}: no test case was found")
        for name, argument in found:
            print(f"{script}|{name}|{argument}")


main()
