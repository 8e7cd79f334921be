"""A message stands only in idl/swarmanoid.idl: idl/generate.py makes its struct, fields, checks, topic and all lists of messages. The
table of topics in docs/wire.md says the same as the IDL.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

from tracked import report

TOP = pathlib.Path(__file__).resolve().parents[2]
MESSAGE = """
// The charge of a battery.
//@topic BatteryMessage kept 3 5
@final
struct Battery
{
  unsigned long long run;
  @key Line robot;   // its id
  //@flags LAST
  unsigned long flags;
  //@default 12.5
  double volts;
  FaultKind kind;
  sequence<DeviceStatus> cells;
};
"""
STRUCT = """// The charge of a battery.
struct BatteryMessage
{
  std::uint64_t run = 0;
  std::string robot{};  // its id
  bool last = false;  // no tick follows
  double volts = 12.5;
  FaultKind kind = FaultKind::kThrew;
  std::vector<DeviceStatus> cells{};
};
"""
FIELDS = """
void Fields(Archive& archive, BatteryMessage& message)
{
  archive.Integer("run", message.run);
  archive.Line("robot", message.robot);
  archive.Flags("flags", {{kFlagLast, &message.last}});
  archive.Number("volts", message.volts);
  archive.Choice("kind", message.kind, FaultKind::kTooSlow);
  archive.List("cells", message.cells);
}
"""
WANTED = {"battery_message.h": [STRUCT], "topics.h": ['{"Battery", false, true, true, 3, 5},'], "messages.h": ["idl/battery_message.h"],
          "message_fields.h": [FIELDS, 'kTopicOf<BatteryMessage> = "Battery"', "KeyOf(const BatteryMessage& message) { return &message.robot; }",
                               "MACRO(BatteryMessage, Battery)"]}


def made(idl, folder):
    path = pathlib.Path(folder, "swarmanoid.idl")
    path.write_text(idl, encoding="utf-8")
    return subprocess.run([sys.executable, TOP / "idl/generate.py", path, folder], capture_output=True, text=True, check=False)


def differences_of_page(idl):
    text = (TOP / "docs/wire.md").read_text(encoding="utf-8")
    page = {}
    for names, durability, writer, reader in re.findall(r"^\| (`[A-Z].*?) \| .* \| .* \| (.*?) \| (.*?) / (.*?) \| .*? \|$", text, re.M):
        for index, name in enumerate(names := re.findall(r"`(\w+)`", re.sub(r"\(.*\)", "", names))):
            depths = [re.findall(r"\d+", depth) for depth in (writer, reader)]
            page[name] = (durability, *(depth[index if len(depth) == len(names) else 0] for depth in depths))
    topics = re.findall(r"//@topic \w+ (.*?)(\d+) (\d+)\n.*?struct (\w+)", idl, re.S)
    for words, writer, reader, name in topics:
        wanted = ("transient local" if "kept" in words else "volatile", writer, reader)
        if page.pop(name, None) != wanted:
            yield f"docs/wire.md: the row of {name} must have {' | '.join(wanted)}"
    yield from (f"docs/wire.md: there is no topic {name}" for name in page)


def main():
    idl = (TOP / "idl/swarmanoid.idl").read_text(encoding="utf-8")
    mistakes = list(differences_of_page(idl))
    with tempfile.TemporaryDirectory() as folder:
        made(idl.replace("\n};\n};\n", MESSAGE + "\n};\n};\n"), folder)
        headers = {name: pathlib.Path(folder, "idl", name) for name in WANTED}
        mistakes += [f"a new message: {name} has not: {text}" for name, texts in WANTED.items() for text in texts
                     if not headers[name].exists() or text not in headers[name].read_text(encoding="utf-8")]
        before = headers["topics.h"].stat().st_mtime_ns
        made(idl, folder)
        if headers["battery_message.h"].exists() or pathlib.Path(folder, "idl/join_message.h").stat().st_mtime_ns > before:
            mistakes.append("a removed message keeps its header, or other headers are written again")
        for unknown in ("  map<long, long> state;", "  //@rage 1\n  sequence<octet> state;"):
            refused = made(idl.replace("  sequence<octet> state;", unknown), folder)
            if refused.returncode == 0 or "does not know" not in refused.stderr:
                mistakes.append(f"the generator does not refuse this: {unknown.strip()}")
    report(mistakes)


main()
