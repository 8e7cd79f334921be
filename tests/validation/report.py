"""Rows of the page of verification and validation: what was expected, what was measured, whether they agree; and the page itself."""
import dataclasses
import re

SCENES = []
PUBLISHED = re.compile(r"ARGoS|ITU-R")  # sources of published numbers
PARTS = (("Verification", "closed form (source)", False), ("Validation", "published figure (source)", True))


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

    def is_published(self):
        """Whether the source is a published one: validation. All other rows are verification."""
        return PUBLISHED.search(self.source) is not None

    def verdict(self):
        return "passes" if abs(self.measured - self.expected) <= self.tolerance else "**fails**"


def number(value):
    if value == 0 or 1e-3 <= abs(value) < 1e5:
        return f"{value:.5g}"
    return f"{value:.2g}"


def line(row):
    cells = (row.name, f"{row.form} ({row.source})", number(row.expected), number(row.measured), number(row.measured - row.expected),
             number(row.tolerance) + ": " + row.why, row.unit or "1", row.verdict())
    return "| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |"


def table(rows, form):
    head = f"| quantity | {form} | expected | measured | error | tolerance: reason | unit | verdict |\n|---|---|---|---|---|---|---|---|\n"
    return head + "".join(line(row) + "\n" for row in rows)


def tables(groups):
    """The part of the page that the run writes: verification and validation, each with its rows and pictures by group."""
    text = ""
    for part, form, published in PARTS:
        text += f"\n## {part}\n"
        for group, (rows, pictures) in groups.items():
            chosen = [row for row in rows if row.is_published() == published]
            if chosen:
                text += f"\n### {group}\n\n{table(chosen, form)}"
                text += "".join(f"\n![{caption}](pictures/validation/{name}.svg)\n" for name, caption, shown in pictures if shown == published)
    return text


def verdicts(page):
    """Verdicts on a page by the names of rows."""
    found = {}
    for text in page.splitlines():
        cells = [cell.strip() for cell in text.strip("| ").split(" | ")]
        if len(cells) == 8 and re.fullmatch(r"passes|\*\*fails\*\*", cells[7]):
            found[cells[0]] = cells[7]
    return found
