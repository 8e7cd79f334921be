"""one_definition.py LIBRARY...: no two libraries define the same function or variable, and no two headers the same type.

All libraries meet in one process: of two definitions of one name the loader takes the first, for both, without a word.
"""
import collections
import re
import subprocess
import sys

from tracked import report, tracked

# A type at the left margin is one of namespace swarmanoid, or of one inside it that the same header names.
TYPE = re.compile(r"^(?:struct|class|enum class|enum)\s+(?:alignas\(\w+\)\s+)?(\w+)(?:\s+final)?\s*(?::[^:][^;]*)?(?:\{.*)?$")
NAMESPACE = re.compile(r"^namespace(?:\s+([\w:]+))?")


def defined_symbols(library):
    listing = subprocess.run(["nm", "--demangle", "--defined-only", "--extern-only", library],
                             capture_output=True, text=True, check=True)
    symbols = set()
    for line in listing.stdout.splitlines():
        found = re.match(r"[0-9a-f]+ [TBDR] (swarmanoid::.*)", line)
        if found:
            symbols.add(found.group(1))
    return symbols


def defined_types(header):
    namespaces = []
    with open(header, encoding="utf-8") as source:
        for line in source:
            namespace = NAMESPACE.match(line)
            if namespace:
                namespaces.append(namespace.group(1) or header)
            elif line.startswith("}  // namespace") and namespaces:
                namespaces.pop()
            found = TYPE.match(line.rstrip())
            if found:
                yield "::".join(namespaces + [found.group(1)])


def main():
    mistakes = []
    for what, files, names_of in (("symbol", sys.argv[1:], defined_symbols),
                                  ("type", tracked("*.h"), defined_types)):
        places = collections.defaultdict(set)
        for file in files:
            for name in names_of(file):
                places[name].add(file)
        mistakes += [f"two definitions of the {what} {name}: {', '.join(sorted(where))}; rename one"
                     for name, where in sorted(places.items()) if len(where) > 1]
    report(mistakes)


main()
