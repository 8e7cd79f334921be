"""Each page of docs/ stands in the list of the site (docs/site/mkdocs.yml) and in README.md; each link to a file leads to one."""
import os
import re

from tracked import report, tracked

SITE = "docs/site/mkdocs.yml"
CODE = re.compile(r"^```.*?^```$|`[^`\n]*`", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s#]+)(?:#[^)\s]*)?\)")


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def main():
    mistakes = []
    pages = tracked("docs/*.md")
    for place in (SITE, "README.md"):
        listing = text_of(place)
        mistakes += [f"{place} lacks {page}" for page in pages if page not in listing]
    mistakes += [f"{SITE}: there is no {page}" for page in re.findall(r": (\S+\.md)$", text_of(SITE), re.MULTILINE)
                 if not os.path.isfile(page)]
    for page in [*tracked("*.md"), *pages]:
        if page.startswith("tests/"):
            continue
        text = text_of(page)
        for link in LINK.findall(CODE.sub("", text)):
            if "://" not in link and not link.startswith("mailto:") and not os.path.isfile(os.path.join(os.path.dirname(page), link)):
                mistakes.append(f"{page}: there is no file {link}")
    report(sorted(set(mistakes)))


main()
