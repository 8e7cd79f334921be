#!/usr/bin/env python3
"""generate.py IDL FOLDER: writes the C++ headers of the messages in IDL to FOLDER/idl, when CMake configures the build.

A header for each struct has the plain C++ struct. `messages.h` includes all of them, `constants.h` has the constants, and
`topics.h` the quality of service of each topic. `message_fields.h` has the function `Fields` of each struct. It visits the fields
in the order of the IDL with an archive (common/bus/topics/cdr.h), which counts, writes, or reads and checks them.

Fields have the same name and order in C++. `unsigned short` is std::uint32_t with 16 bits on the wire. A typedef of a string or
double has an archive function of its own name. These lines concern the next line:

    //@topic NAME [hot] [kept] W R  the struct is the type of a topic, and NAME in C++. Topics of a tick are hot. DDS keeps messages
                                    for processes that join later. Histories of the writer and the reader have W and R messages
    //@cpp NAME                     another name in C++
    //@class NAME HEADER            C++ uses the class NAME of the handwritten HEADER, which is derived from the struct
    //@plain NAME HEADER            C++ uses the handwritten struct NAME
    //@extends NAME                 is derived from the struct NAME in C++, and declares only further fields
    //@checked                      a handwritten function CheckFields looks at the struct after its fields
    //@equal                        has a comparison
    //@enum NAME                    the typedef is an enumeration of the constants that begin with its name. 0 is never sent
    //@header [tick [SENDER]]       in C++ the header is a value of its own. The struct repeats its tick, and its source as SENDER
    //@base                         a base class, not a member
    //@flags BIT...                 each bit is a bool of the header, or otherwise of the struct
    //@columns                      poses, of which the flags in the next field tell the uniform columns
    //@version                      the protocol version: of another one the rest is not read
    //@constant NUMBER              always this number, and not in C++
    //@default VALUE                the value of a new struct
    //@local CODE                   (alone) a member that is not sent
"""
import pathlib
import re
import sys

# IDL type to C++ type and function of the archive.
BASIC = {"unsigned long": ("std::uint32_t", "Integer"), "unsigned long long": ("std::uint64_t", "Integer"),
         "unsigned short": ("std::uint32_t", "Short"), "long long": ("std::int64_t", "Signed"), "boolean": ("bool", "Bool"),
         "double": ("double", "Number"), "float": ("float", None), "octet": ("char", None), "string": ("std::string", "Exact")}
ANNOTATIONS = set(re.findall(r"//@(\w+)", __doc__))
# Header of the standard library to the text that needs it.
LIBRARY = {"cstdint": "_t", "string": "std::string", "variant": "std::variant", "vector": "std::vector"}
MOTTO = "// Made by idl/generate.py from idl/swarmanoid.idl. Do not edit.\n#pragma once\n\n"


def snake(name):
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def constant(name):
    return "k" + "".join(word.capitalize() for word in name.split("_"))


def namespace(code):
    return f"\nnamespace swarmanoid\n{{\n\n{code}\n}}  // namespace swarmanoid\n"


class Item:
    """A declaration: its annotations (word to arguments), the comment above it, and the comment behind it."""

    def __init__(self, kind, name, marks, above, behind, **more):
        self.kind, self.name, self.marks, self.above, self.behind = kind, name, marks, above, behind
        self.__dict__.update(more)

    def mark(self, word):
        return self.marks.get(word)

    @property
    def cpp(self):
        for word in ("topic", "cpp", "class", "plain", "enum"):
            if word in self.marks:
                return self.marks[word][0]
        return self.name

    def comment(self, indent=""):
        return "".join(f"{indent}{line}\n" for line in self.above)

    def tail(self):
        return f"  // {self.behind}" if self.behind else ""


def parse(text):
    """All declarations of the module, in their order. Structs and unions have `fields`."""
    items, fields, marks, above = [], None, {}, []
    for number, line in enumerate(text.splitlines(), 1):
        line = line.strip()
        if (annotation := re.fullmatch(r"//@(\w+) ?(.*)", line)) and annotation[1] in ANNOTATIONS:
            if annotation[1] == "local":
                fields.append(Item("local", annotation[2], {}, above, ""))
                above = []
            else:
                marks[annotation[1]] = annotation[2].split()
            continue
        if line.startswith("//") and not line.startswith("//@"):
            above.append(line)
            continue
        if line in ("", "{", "@final") or line.startswith("module "):
            above = above if line else []
            continue
        code, _, behind = (part.strip() for part in line.partition("//"))
        more = (marks, above, behind)
        if code == "};":
            fields = None
        elif found := re.fullmatch(r"(struct|union) (\w+)(?: switch \(unsigned long\))?", code):
            fields = []
            items.append(Item(*found.groups(), *more, fields=fields))
        elif found := re.fullmatch(r"const ([\w ]+) (\w+) = (.+);", code):
            items.append(Item("const", found[2], *more, type=found[1], value=found[3]))
        elif found := re.fullmatch(r"typedef ([\w ]+) (\w+);", code):
            items.append(Item("typedef", found[2], *more, type=found[1]))
        elif found := re.fullmatch(r"(@key |case \d+: )?([\w<> ]+) (\w+);", code):
            fields.append(Item("field", found[3], *more, type=found[2], key=found[1] == "@key "))
        else:
            sys.exit(f"swarmanoid.idl:{number}: generate.py does not know this: {line}")
        marks, above = {}, []
    return items


class Generator:
    def __init__(self, items):
        self.items = {item.name: item for item in items}
        self.constants = [item for item in items if item.kind == "const"]
        self.structs = [item for item in items if item.kind in ("struct", "union")]
        self.topics = [item for item in self.structs if "topic" in item.marks]
        self.header_bits = {field.name.split()[1] for field in self.items["MessageHeader"].fields if field.kind == "local"}

    # ---- types ----

    def element(self, kind):
        found = re.fullmatch(r"sequence<(.+)>", kind)
        return found[1] if found else None

    def enumerators(self, enum):
        prefix = snake(enum.name).upper() + "_"
        return [(constant(one.name[len(prefix):]), one) for one in self.constants if one.name.startswith(prefix)]

    def is_text_or_number(self, kind):
        """Whether the type is a typedef of a string or double."""
        return self.items[kind].kind == "typedef" and "enum" not in self.items[kind].marks

    def cpp_type(self, kind):
        if inner := self.element(kind):
            return f"std::vector<{self.cpp_type(inner)}>"
        if kind in BASIC:
            return BASIC[kind][0]
        return self.cpp_type(self.items[kind].type) if self.is_text_or_number(kind) else self.items[kind].cpp

    def default(self, field):
        if value := field.mark("default"):
            return f" = {constant(value[0]) if value[0] in self.items else value[0]}"
        if "version" in field.marks:
            return " = kProtocolVersion"
        item = self.items.get(field.type)
        if item and "enum" in item.marks:
            return f" = {item.cpp}::{self.enumerators(item)[0][0]}"
        kind = self.cpp_type(field.type)
        return " = false" if kind == "bool" else " = 0" if kind.endswith("_t") or kind == "double" else "{}"

    def header_of(self, item):
        """The header of a struct or enumeration."""
        if "class" in item.marks or "plain" in item.marks:
            return (item.mark("class") or item.mark("plain"))[1]
        return f"idl/{snake(item.cpp.split('::')[0])}.h"

    def own_flags(self, field):
        return [bit for bit in field.mark("flags") if bit.lower() not in self.header_bits]

    def needs_header(self, item):
        return any("header" in field.marks or "flags" in field.marks and len(self.own_flags(field)) < len(field.mark("flags"))
                   or "base" in field.marks and self.needs_header(self.items[field.type]) for field in item.fields)

    # ---- structs ----

    def members(self, item):
        inherited = [field.name for field in self.items[item.mark("extends")[0]].fields] if "extends" in item.marks else []
        for field in item.fields:
            if field.kind == "local":
                yield f"  {field.name}\n"
            elif field.name in inherited or "constant" in field.marks or "base" in field.marks:
                continue
            elif "header" in field.marks:
                for name, kind in zip(field.mark("header"), ("std::uint64_t", "std::uint32_t")):
                    yield f"  {kind} {name} = 0;\n"
            elif "flags" in field.marks:
                for bit in self.own_flags(field):
                    yield f"  bool {bit.lower()} = false;{self.items['FLAG_' + bit].tail()}\n"
            else:
                yield f"{field.comment('  ')}  {self.cpp_type(field.type)} {field.name}{self.default(field)};{field.tail()}\n"

    def enumeration(self, enum, indent=""):
        values = "".join(f"{indent}  {name} = {one.value},{one.tail()}\n" for name, one in self.enumerators(enum))
        return f"{indent}enum class {enum.cpp.split('::')[-1]} : std::uint32_t\n{indent}{{\n{values}{indent}}};\n"

    def struct(self, item):
        """The content of the header with the C++ struct."""
        name = item.name if "class" in item.marks else item.cpp
        fields = [field for field in item.fields if field.kind == "field" and "header" not in field.marks]
        types = [self.element(field.type) or field.type for field in fields] + item.marks.get("extends", [])
        used = [self.items[kind] for kind in types if kind in self.items and not self.is_text_or_number(kind)]
        inner = [one for one in used if one.cpp.startswith(item.cpp + "::")]
        headers = {self.header_of(one) for one in used if one not in inner}
        if any("version" in field.marks or field.marks.get("default", [""])[0] in self.items for field in fields):
            headers.add("idl/constants.h")
        own = "".join(f'#include "{header}"\n' for header in sorted(headers))
        code = item.comment()
        if item.kind == "union":
            kinds = ", ".join(self.cpp_type(field.type) for field in item.fields)
            code += f"// The index of the alternative is the discriminator on the wire.\nusing {name} = std::variant<{kinds}>;\n"
        else:
            bases = [self.items[field.type].cpp for field in item.fields if "base" in field.marks] + item.marks.get("extends", [])
            code += f"struct {name}{' : ' + ', '.join(bases) if bases else ''}\n{{\n"
            code += "".join(self.enumeration(enum, "  ") + "\n" for enum in inner) + "".join(self.members(item))
            code += f"\n  bool operator==(const {name}&) const = default;\n" if "equal" in item.marks else ""
            code += "};\n"
        library = "".join(f"#include <{name}>\n" for name, kind in LIBRARY.items() if kind in code)
        return library + "\n" * bool(library and own) + own + namespace(code)

    # ---- fields ----

    def flags(self, field):
        bits = (f"{{kFlag{bit.capitalize()}, &{'header' if bit.lower() in self.header_bits else 'message'}.{bit.lower()}}}"
                for bit in field.mark("flags"))
        return "{" + ", ".join(bits) + "}"

    def visit(self, item, index):
        """The statements that visit a field."""
        field = item.fields[index]
        if field.kind == "local" or index > 0 and "columns" in item.fields[index - 1].marks:
            return ""  # the flags of columns are visited with them
        place = f'"{field.name}", message.{field.name}'
        kind = self.items.get(field.type)
        inner = self.element(field.type)
        if "header" in field.marks:
            return "".join(f"if constexpr (Archive::kReads) message.{name} = header.{of};\n"
                           for name, of in zip(field.mark("header"), ("tick", "source")))
        if "base" in field.marks:
            header = "header, " if self.needs_header(kind) else ""
            return f"Fields(archive, {header}static_cast<{kind.cpp}&>(message));\n"
        if "columns" in field.marks:
            return f"PoseFields(archive, message.{field.name}, {self.flags(item.fields[index + 1])});\n"
        if "flags" in field.marks:
            return f'archive.Flags("{field.name}", {self.flags(field)});\n'
        if "constant" in field.marks:
            return f'archive.Constant("{field.name}", {field.mark("constant")[0]});\n'
        if "version" in field.marks:
            return f"archive.Version({place});\n"
        if inner:
            is_array = inner in BASIC or "enum" in self.items[inner].marks
            return f"archive.{'Array' if is_array else inner + 'List' if self.is_text_or_number(inner) else 'List'}({place});\n"
        if kind is None:
            return f"archive.{BASIC[field.type][1]}({place});\n"
        if "enum" in kind.marks:
            return f"archive.Choice({place}, {kind.cpp}::{self.enumerators(kind)[-1][0]});\n"
        return f"archive.{kind.name if kind.kind == 'typedef' else 'Struct'}({place});\n"

    def fields(self, item):
        header = "MessageHeader& header, " if self.needs_header(item) else ""
        code = f"\ntemplate <class Archive>\nvoid Fields(Archive& archive, {header}{item.cpp}& message)\n{{\n"
        if item.kind == "union":
            code += '  archive.Alternative("kind", message);\n'
            for index, field in enumerate(item.fields):
                method = "Array" if self.element(field.type) else (BASIC.get(field.type) or (0, field.type))[1]
                code += f"  if (auto* value = std::get_if<{index}>(&message)) archive.{method}(\"value\", *value);\n"
            return code + "}\n"
        for index in range(len(item.fields)):
            code += "".join(f"  {line}\n" for line in self.visit(item, index).splitlines())
        return code + ("  CheckFields(message);\n" if "checked" in item.marks else "") + "}\n"

    # ---- files ----

    def files(self):
        """Name of each header to its content."""
        made = {snake(item.name if "class" in item.marks else item.cpp) + ".h": self.struct(item)
                for item in self.structs if "plain" not in item.marks}
        enums = [item for item in self.items.values() if "enum" in item.marks]
        for enum in enums:
            if "::" not in enum.cpp:
                made[snake(enum.cpp) + ".h"] = "#include <cstdint>\n" + namespace(enum.comment() + self.enumeration(enum))
        enumerators = [one for enum in enums for _, one in self.enumerators(enum)]
        made["constants.h"] = "#include <cstdint>\n" + namespace("".join(
            f"{one.comment()}inline constexpr {BASIC[one.type][0]} {constant(one.name)} = {one.value};{one.tail()}\n"
            for one in self.constants if one not in enumerators))
        headers = sorted({f"idl/{name}" for name in made} | {self.header_of(item) for item in self.structs})
        made["messages.h"] = "// All messages.\n" + "".join(f'#include "{header}"\n' for header in headers)
        made["topics.h"] = self.topic_table()
        made["message_fields.h"] = self.message_fields()
        return {name: MOTTO + content for name, content in made.items()}

    def topic_table(self):
        rows = ""
        for topic in self.topics:
            _, *words, writer, reader = topic.mark("topic")
            flags = ("hot" in words, "kept" in words, any(field.key for field in topic.fields if field.kind == "field"))
            rows += f'    {{"{topic.name}", {", ".join(str(flag).lower() for flag in flags)}, {writer}, {reader}}},\n'
        rows = f"    // topic, hot, kept, keyed, history of the writer, and of the reader\n{rows}"
        return '#include "common/bus/topics/qos.h"\n' + namespace(f"inline constexpr TopicQos kTopics[] = {{\n{rows}}};\n")

    def message_fields(self):
        code = "// A message is sent on the topic of this name, as the type swarmanoid::wire::<name>.\n"
        code += "template <class Message>\ninline constexpr const char* kTopicOf = nullptr;\n"
        code += "".join(f'template <>\ninline constexpr const char* kTopicOf<{topic.cpp}> = "{topic.name}";\n'
                        for topic in self.topics)
        code += "\n// Returns the key of a topic with instances, nullptr for others.\n"
        code += "template <class Message>\nconst std::string* KeyOf(const Message&)\n{\n  return nullptr;\n}\n"
        for topic in self.topics:
            for field in topic.fields:
                if field.kind == "field" and field.key:
                    code += f"inline const std::string* KeyOf(const {topic.cpp}& message) {{ return &message.{field.name}; }}\n"
        code += "\n// MACRO(Message, Topic) for each message of a tick, and for each other message.\n"
        for name, hot in (("HOT", True), ("COLD", False)):
            code += f"#define SWARMANOID_{name}_MESSAGES(MACRO)" + "".join(
                f" \\\n  MACRO({topic.cpp}, {topic.name})" for topic in self.topics if ("hot" in topic.mark("topic")) == hot) + "\n"
        code += "\n// common/bus/topics/message_fields.h has these functions.\n"
        code += "".join(f"inline void CheckFields(const {item.cpp}& message);\n"
                        for item in self.structs if "checked" in item.marks)
        return '#include "idl/messages.h"\n' + namespace(code + "".join(self.fields(item) for item in self.structs))


def main():
    source, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]) / "idl"
    folder.mkdir(parents=True, exist_ok=True)
    made = Generator(parse(source.read_text(encoding="utf-8"))).files()
    for old in folder.iterdir():
        if old.name not in made:
            old.unlink()
    for name, content in made.items():
        path = folder / name
        # Headers that stay the same keep their times, so that nothing is compiled again.
        if not path.exists() or path.read_text(encoding="utf-8") != content:
            path.write_text(content, encoding="utf-8")


main()
