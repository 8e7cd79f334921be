"""contraction.py LIBRARY...: no library holds a fused multiply-add, which rounds once where other processors round twice."""
import re
import subprocess
import sys

from tracked import report

FUSED = re.compile(r"\tvfn?m(?:add|sub|addsub|subadd)\d{3}[ps][ds]\b")
FUNCTION = re.compile(r"^[0-9a-f]+ <(.*)>:$")


def functions_with_fused(library):
    listing = subprocess.run(["objdump", "--disassemble", "--demangle", "--no-show-raw-insn", library],
                             capture_output=True, text=True, check=True)
    found = []
    function = "?"
    for line in listing.stdout.splitlines():
        head = FUNCTION.match(line)
        if head:
            function = head.group(1)
        elif FUSED.search(line) and function not in found:
            found.append(function)
    return found


def main():
    report([f"{library}: a fused multiply-add in {function}; build with -mno-fma"
            for library in sys.argv[1:] for function in functions_with_fused(library)])


main()
