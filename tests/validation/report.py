"""Rows of the page of verification and validation: what was expected, what was measured, whether they agree; and the page itself."""
import dataclasses
import re

SCENES = []
HEAD = "| quantity | "
PUBLISHED = re.compile(r"ARGoS|ITU-R|Byers|Gauci|Förster|MIL-F|Webots|create3|ros-thymio|turtlebot4|Bitcraze")  # sources of published numbers
PROMISED, LINK = re.compile(r"docs/(\w+)(\.md[\w#-]*)"), r"[\1](\1\2)"  # sources that are pages of this documentation
VERIFICATION, PROMISES, VALIDATION = "Verification", "Against this documentation", "Validation"
PREFIX = {"Kinematic engine": "kinematic: ", "2D rigid-body engine": "dynamics2d: ", "3D rigid-body engine": "dynamics3d: "}  # of names, not shown in groups
UNSAID = ("geometry", "rounding", "counts")  # the page says once what an empty source, 1e-13 and 0 mean
ROUNDING = 1e-13  # some hundred roundings of numbers about 1; scenes of larger numbers state more


def scene(group, quick=True):
    """Marks a function of the lab that yields rows of a group; `quick` ones run in every test."""
    def mark(function):
        SCENES.append((group, quick, function))
        return function
    return mark


@dataclasses.dataclass
class Row:
    name: str  # unique: verdicts are compared by it
    form: str  # the closed form or published figure
    source: str
    expected: float
    measured: float
    tolerance: float  # of the difference
    why: str  # where the tolerance comes from, and where the model ends
    unit: str = ""

    def part(self):
        """The part of the page: closed forms and this documentation are verification, published figures are validation."""
        return VALIDATION if PUBLISHED.search(self.source) else PROMISES if PROMISED.search(self.source) else VERIFICATION

    def verdict(self):
        return "passes" if abs(self.measured - self.expected) <= self.tolerance else "**fails**"


def number(value):
    if value == 0 or 1e-3 <= abs(value) < 1e5:
        return f"{value:.5g}"
    return f"{value:.2g}"


def cells(name, form, source, expected, error, tolerance, why, unit, verdict):
    """The line of a table. All arguments are texts."""
    form = re.sub(r" ?([-/+±=]) ", r"\1", form).replace("y, Δx", "y,Δx").replace("z, √", "z,√")  # a formula is one word where it can be
    if source not in UNSAID:
        form += f" ({PROMISED.sub(LINK, source)})"
    if why not in UNSAID:
        tolerance += f": {why}"
    if verdict != "passes":
        error += f" {verdict}"
    return "| " + " | ".join(cell.replace("|", r"\|") for cell in (name, form, f"{expected} {unit}".strip() + f", {error}", tolerance)) + " |"


def line(row):
    return cells(row.name, row.form, row.source, number(row.expected), number(row.measured - row.expected), number(row.tolerance), row.why, row.unit,
                 row.verdict())


def ditto(lines):
    """The lines, with ″ for the form of the line before."""
    before = ""
    for line in lines:
        name, form, rest = re.split(r" (?<!\\)\| ", line, maxsplit=2)
        yield f"{name} | {'″' if form == before else form} | {rest}\n"
        before = form


def table(lines, form):
    return f"\n{HEAD}{form} (source) | expected, error | tolerance: reason |\n|---|---|---|---|\n" + "".join(ditto(lines))


def page(rows, pictures):
    """The part of the page that the run writes. `rows`: part, group, line; `pictures`: part, group, Markdown."""
    def groups(part, form):
        text = ""
        for group in dict.fromkeys(group for found, group, _ in rows if found == part):
            text += f"\n### {group}\n" + table([line.replace(PREFIX.get(group, ""), "", 1) for found, of, line in rows if (found, of) == (part, group)], form)
            text += "".join(f"\n{picture}\n" for found, of, picture in pictures if (found, of) == (part, group))
        return text
    return (f"\n## {VERIFICATION}\n" + groups(VERIFICATION, "closed form")
            + f"\n### {PROMISES}\n" + table([line for part, _, line in rows if part == PROMISES], "promise")
            + "".join(f"\n{picture}\n" for part, _, picture in pictures if part == PROMISES)
            + f"\n## {VALIDATION}\n" + groups(VALIDATION, "published figure"))


def tables(groups):
    """`groups`: the rows and pictures of each group."""
    return page([(row.part(), group, line(row)) for group, (rows, _) in groups.items() for row in rows],
                [(part, group, f"![{caption}](pictures/validation/{name}.svg)") for group, (_, pictures) in groups.items() for name, caption, part in pictures])


def verdicts(page):
    """Verdicts on a page by the names of rows."""
    found, prefix, in_table = {}, "", False
    for text in page.splitlines():
        if text.startswith("### "):
            prefix = PREFIX.get(text[4:], "")
        in_table = text.startswith("|") and (in_table or text.startswith(HEAD))
        if in_table and not text.startswith((HEAD, "|---")):
            name, _, error, _ = re.split(r" (?<!\\)\| ", text.strip("| "))
            found[prefix + name] = "**fails**" if error.endswith("**fails**") else "passes"
    return found
