"""Measures of plain English, printed and held. Comments of the product's C++ are sentences with a subject, are enough, and each public virtual
method has one. Code and docs have no words of an idiom. Tables of the docs have short cells, and the docs do not grow."""
import re

from tracked import report, tracked

# Tests and users' listings are as they are.
PRODUCT = re.compile(r"^(?!tests/|user/templates/|user/controllers/sample_footbot_controller/).*\.(h|cpp)$")
# Interfaces that others implement or call: the Common Interface, engines, devices, renderers, experiment functions, drivers.
INTERFACES = re.compile(r"^(common/control_interface|engine_worker|controller_host|visualiser|space_server|studies|real_robot|argos3|python)/.*\.h$")

NO_SUBJECT = re.compile(r"(Of|Likewise|As|Whose|Such|Who)\b")
LEAST_SHARE = 0.064  # of the lines of the product
# Words of an idiom that is hard to read, and how many may be among 1,000 words of code and docs.
IDIOM = re.compile(r"\b(nobody|whoever|whom|likewise|anew|one who|those that are)\b", re.IGNORECASE)
READ = re.compile(r"^(?!tests/repository/).*\.(h|cpp|py|js|mjs|md)$")
MOST_IDIOM = 0.05
# Pages that the programs write.
ROWS = "<!-- From here on by tests/validation/run. -->"  # in docs/validation.md
GENERATED = ("docs/argos3_statistics.md", "docs/experiment_reference.md", "docs/plugin_reference.md", "docs/study_reference.md")
FENCED = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
TARGET = re.compile(r"\]\([^)\s]+\)")
CELL = re.compile(r"(?<!\\)\|")
MOST_IN_CELL = 20     # words; longer text stands under its table
MOST_IN_DOCS = 75_900
OWN_LINE = re.compile(r"\s*//+<?\s*(.*)")
TRAILING = re.compile(r"[^\s\"'].*[;,{}()]\s+//+<?\s*(.*)")


def beginnings(lines):
    """The number of each line on which a comment begins, with its text."""
    follows = False
    for number, line in enumerate(lines, 1):
        own = OWN_LINE.match(line)
        trailing = None if own else TRAILING.match(line)
        if own and not follows or trailing:
            yield number, (own or trailing).group(1)
        follows = own is not None


def uncommented_methods(lines):
    """Public virtual methods, other than destructors, without a comment behind them or above them and those directly before them."""
    access = "public"
    for number, line in enumerate(lines, 1):
        code = line.strip()
        if re.match(r"(class|struct)\b[^;]*$", code):
            access = "private" if code.startswith("class") else "public"
        elif label := re.match(r"(public|protected|private):", code):
            access = label.group(1)
        if access != "public" or not re.match(r"virtual\b(?!.*~)", code) or "//" in line:
            continue
        above = number - 2
        while above > 0 and re.match(r"template\b|virtual\b", lines[above].strip()) and "//" not in lines[above]:
            above -= 1
        if not OWN_LINE.match(lines[above]):
            yield number, code


def long_cells(page, text):
    """Mistakes for the cells of tables that have too many words, without the targets of links."""
    lines = FENCED.sub(lambda block: "\n" * block[0].count("\n"), text).splitlines()
    cells = [(number, cell) for number, line in enumerate(lines, 1) if line.startswith("|") for cell in CELL.split(TARGET.sub("]", line))]
    return [f"{page}:{number}: the cell '{' '.join(cell.split()[:6])} …' has {len(cell.split())} words: put the rest under the table"
            for number, cell in cells if len(cell.split()) > MOST_IN_CELL]


def main():
    mistakes, measures = [], []

    def measure(text, value, is_met):
        measures.append(f"{'' if is_met else 'not met: '}{value} {text}")
        if not is_met:
            mistakes.append(measures[-1])

    comments = total = idiom = words = in_docs = without_subject = without_comment = long = 0
    for path in tracked():
        if not READ.match(path):
            continue
        with open(path, encoding="utf-8") as source:
            text = source.read()
        lines = text.splitlines()
        words += len(text.split())
        idiom += len(IDIOM.findall(text))
        if re.match(r"docs/[^/]*\.md$", path):
            in_docs += len(text.split(ROWS)[0].split()) if path not in GENERATED else 0
            found = long_cells(path, text)
            long += len(found)
            mistakes += found
        if PRODUCT.match(path):
            total += len(lines)
            comments += sum(OWN_LINE.match(line) is not None for line in lines)
            found = [f"{path}:{number}: a comment without a subject: {text[:80]}" for number, text in beginnings(lines) if NO_SUBJECT.match(text)]
            without_subject += len(found)
            mistakes += found
        if INTERFACES.match(path):
            found = [f"{path}:{number}: no comment says units, ranges and errors: {code[:80]}" for number, code in uncommented_methods(lines)]
            without_comment += len(found)
            mistakes += found
    measure(f"% of {total} lines of the product are comments (at least {100 * LEAST_SHARE:.1f})", f"{100 * comments / total:.2f}",
            comments >= LEAST_SHARE * total)
    measure("comments begin without a subject (none may)", without_subject, without_subject == 0)
    measure("public virtual methods have no comment (none may)", without_comment, without_comment == 0)
    measure(f"of 1,000 words are nobody, whoever, whom, likewise, anew, one who or those that are (at most {MOST_IDIOM})", f"{1000 * idiom / words:.3f}",
            idiom <= MOST_IDIOM * words / 1000)
    measure(f"words are in the docs, without generated pages and rows (at most {MOST_IN_DOCS})", in_docs, in_docs <= MOST_IN_DOCS)
    measure(f"cells of tables have more than {MOST_IN_CELL} words (none may)", long, long == 0)
    print("\n".join(measures))
    report(mistakes)


main()
