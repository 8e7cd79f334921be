"""How numbers and tables of studies are written: for people, in HTML, Markdown and LaTeX."""
import html
import math
import re

LEAST, MOST = 1e-4, 1e6  # beyond these, numbers have a power of ten
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power(exponent):
    return f" × 10{str(exponent).translate(RAISED)}"


def exponent_of(value):
    """The power of ten of the first digit."""
    return math.floor(math.log10(abs(value)))


def fixed(value, decimals):
    """Rounded to so many decimals; tens and hundreds if they are below 0."""
    rounded = round(value, decimals) + 0.0  # 0 for -0
    return f"{rounded:.{max(decimals, 0)}f}"


def number(value, digits=4):
    """A number with so many significant digits, as people write it: 1010, 0.00049, 1.2 × 10⁻⁷."""
    if not math.isfinite(value) or value == 0:
        return f"{value:g}"
    exponent = exponent_of(float(f"{value:.{digits - 1}e}"))
    if not LEAST <= 10.0**exponent < MOST:
        return number(value / 10.0**exponent, digits) + power(exponent)
    text = fixed(value, digits - 1 - exponent)
    return text.rstrip("0").rstrip(".") if "." in text else text


def with_error(mean, half):
    """A number with its uncertainty, both to the second digit of the uncertainty: 310 ± 160, 0.046 ± 0.025."""
    if not (math.isfinite(mean) and math.isfinite(half)) or half <= 0:
        return f"{number(mean)} ± {number(half)}"
    size = max(abs(mean), half)
    if not LEAST <= size < MOST:
        exponent = exponent_of(size)
        return f"({with_error(mean / 10.0**exponent, half / 10.0**exponent)}){power(exponent)}"
    decimals = 1 - exponent_of(float(f"{half:.1e}"))
    return f"{fixed(mean, decimals)} ± {fixed(half, decimals)}"


def probability(p):
    return "p < 0.0001" if p < 1e-4 else f"p = {number(p, 2)}"


def as_html(head, rows):
    def row(cells, tag):
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    return f'<div class="wide" tabindex="0" role="region" aria-label="Table"><table><thead>{row(head, "th")}</thead><tbody>{"".join(row(cells, "td") for cells in rows)}</tbody></table></div>'


def as_markdown(head, rows):
    def row(cells):
        return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n"

    return row(head) + "|" + "---|" * len(head) + "\n" + "".join(map(row, rows))


LATEX = {"&": r"\&", "%": r"\%", "$": r"\$", "#": r"\#", "_": r"\_", "{": r"\{", "}": r"\}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
         "\\": r"\textbackslash{}", "±": r"$\pm$", "×": r"$\times$", "<": "$<$", ">": "$>$", "°": r"$^\circ$"}
PLAIN = {raised: chr(digit) for digit, raised in RAISED.items()}


def latex_text(cell):
    plain = "".join(LATEX.get(character, character) for character in cell)
    return re.sub("[" + "".join(map(chr, PLAIN)) + "]+", lambda found: f"$^{{{found[0].translate(PLAIN)}}}$", plain)


def as_latex(head, rows):
    """A tabular of the package booktabs."""
    def row(cells):
        return " & ".join(map(latex_text, cells)) + r" \\" + "\n"

    return (f"% \\usepackage{{booktabs}}\n\\begin{{tabular}}{{{'r' * len(head)}}}\n\\toprule\n{row(head)}\\midrule\n{''.join(map(row, rows))}"
            "\\bottomrule\n\\end{tabular}\n")
