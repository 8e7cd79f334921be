#!/usr/bin/env python3
"""index_api.py XML SITE: adds the pages of Doxygen to the search index of the site.

XML is the folder of Doxygen's XML output. Each class, structure and header becomes one entry with its name as the title, its description, and the
names and descriptions of its members. Reads XML/index.xml, and writes SITE/search/search_index.json again. Headings that are names, such as
footbot_wheels, are also found by their parts.
"""
import json
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

KINDS = {"class": "class", "struct": "structure", "file": "header"}


def text_of(element):
    return " ".join("".join(element.itertext()).split()) if element is not None else ""


def entry(file):
    """The entry of one class, structure or header; None for other files."""
    compound = ElementTree.parse(file).find("compounddef")
    kind = KINDS.get(compound.get("kind"))
    if kind is None:
        return None
    names = compound.findtext("compoundname").split("::")
    text = [kind, "::".join(names), text_of(compound.find("includes"))]
    text += [text_of(compound.find(part)) for part in ("briefdescription", "detaileddescription")]
    for member in compound.iter("memberdef"):
        text += [member.findtext("name"), text_of(member.find("briefdescription")), text_of(member.find("detaileddescription"))]
    # Searches match the start of words. The folder of a header, and the namespace of a name such as EngineSetup, keep them behind the pages about
    # that word.
    if kind == "header":
        title = compound.find("location").get("file")
    else:
        title = names[-1] if re.match(r"C[A-Z]", names[-1]) else "::".join(names)
    return {"location": f"api/{compound.get('id')}.html", "title": f"{title} ({kind}, C++)", "text": " ".join(filter(None, text))}


def main():
    xml, site = map(pathlib.Path, sys.argv[1:3])
    path = site / "search" / "search_index.json"
    index = json.loads(path.read_text())
    compounds = ElementTree.parse(xml / "index.xml").getroot().findall("compound")
    entries = [entry(xml / f"{compound.get('refid')}.xml") for compound in compounds if compound.get("kind") in KINDS]
    index["docs"] += [found for found in entries if found and (site / found["location"]).is_file()]
    for page in index["docs"]:
        page["text"] += "".join(" " + name.replace("_", " ") for name in re.findall(r"\b[a-z]+(?:_[a-z]+)+\b", page["title"]))
    path.write_text(json.dumps(index, ensure_ascii=False, separators=(",", ":")))


main()
