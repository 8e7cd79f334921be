"""build_framework compiles for what the processor has, whatever parts of it a virtual machine hides."""
import pathlib
import re
import subprocess
import tempfile

from tracked import report

ALL = "sse2 avx avx2 fma bmi1 bmi2 f16c movbe abm"
EXPECTED = {
    ALL: "x86-64-v3",
    "fpu sse2 avx": "x86-64",
    ALL.replace(" avx2", ""): "x86-64",
    ALL.replace(" abm", ""): "x86-64-v3 -mno-lzcnt",
    ALL.replace(" bmi1 bmi2", ""): "x86-64-v3 -mno-bmi -mno-bmi2",
    "avx2": "x86-64-v3 -mno-fma -mno-bmi -mno-bmi2 -mno-f16c -mno-movbe -mno-lzcnt",
    # Not a word of its own.
    ALL.replace("abm", "abmx"): "x86-64-v3 -mno-lzcnt",
}


def main():
    function = re.search(r"^Cpu\(\)\n\{.*?^\}", pathlib.Path("build_framework").read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    mistakes = []
    with tempfile.TemporaryDirectory() as folder:
        cpuinfo = pathlib.Path(folder) / "cpuinfo"
        for flags, expected in EXPECTED.items():
            cpuinfo.write_text(f"processor\t: 0\nflags\t\t: {flags}\nbugs\t\t: none\n" * 2)
            told = subprocess.run(["bash", "-euo", "pipefail", "-c", f'{function.group(0)}\nunset SWARMANOID_CPU\nCpu "$1"', "bash", cpuinfo],
                                  capture_output=True, text=True, check=True).stdout.strip()
            if told != expected:
                mistakes.append(f"build_framework: with '{flags}' it compiles for '{told}', not '{expected}'")
            # The compiler knows these words.
            subprocess.run(["g++", *f"-march={expected}".split(), "-x", "c++", "-E", "-o", "/dev/null", "/dev/null"], check=True)
    report(mistakes)


main()
