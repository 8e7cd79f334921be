"""links_test.py SITE: each link, picture and anchor of the built site leads to a file or heading in it, and each page of docs/ is in the site."""
import html.parser
import os
import pathlib
import sys
import urllib.parse

SITE = pathlib.Path(sys.argv[1]).resolve()


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.links.append(value)
            elif name in ("id", "name") and value:
                self.anchors.add(value)


def mistakes_of(path, pages):
    for link in pages[path].links:
        parts = urllib.parse.urlsplit(link)
        if parts.scheme or parts.netloc:
            continue
        # The page of missing pages is shown at any address, so its links start at the root.
        folder = SITE if parts.path.startswith("/") else path.parent
        target = pathlib.Path(os.path.normpath(folder / urllib.parse.unquote(parts.path).lstrip("/"))) if parts.path else path
        if target.is_dir():
            target /= "index.html"
        if not target.is_file():
            yield f"{path.relative_to(SITE)}: nothing is at {link}"
        elif parts.fragment and target in pages and urllib.parse.unquote(parts.fragment) not in pages[target].anchors | {"__codelineno"}:
            yield f"{path.relative_to(SITE)}: {target.relative_to(SITE)} has no heading {parts.fragment}"


def main():
    # Doxygen's pages have scripts for their menus. Only their existence counts here.
    own = [path for path in SITE.rglob("*.html") if path.relative_to(SITE).parts[0] != "api"]
    pages = {path: Page(path) for path in own}
    docs = pathlib.Path(__file__).resolve().parents[2] / "docs"
    mistakes = [f"the site lacks docs/{page.name}" for page in docs.glob("*.md") if not (SITE / "docs" / f"{page.stem}.html").is_file()]
    for path in own:
        mistakes += mistakes_of(path, pages)
    print("\n".join(sorted(set(mistakes))) or f"{len(own)} pages, {sum(len(page.links) for page in pages.values())} links")
    sys.exit(1 if mistakes else 0)


main()
