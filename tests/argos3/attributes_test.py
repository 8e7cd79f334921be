"""Each attribute that ARGoS3 reads acts here, or a message names it with its place."""
import copy
import xml.etree.ElementTree as xml

from running import HERE, RunningTest

BODY = '<body position="{}" orientation="0,0,0"/>'
LEDS = '<leds medium="leds"><led color="red"/></leds>'
FILE = f"""<argos-configuration>
<framework><system/><experiment length="1" ticks_per_second="10" random_seed="1"/></framework>
<controllers>
 <lua_controller id="foot"><actuators><differential_steering/><leds medium="leds"/><range_and_bearing/></actuators>
  <sensors><differential_steering/><footbot_proximity/><footbot_light/><footbot_motor_ground/><footbot_base_ground/>
   <footbot_distance_scanner/><proximity/><light/><positioning/><battery/><range_and_bearing medium="rab"/>
   <colored_blob_omnidirectional_camera medium="leds"/><colored_blob_perspective_camera medium="leds"/></sensors><params script="s.lua"/>
 </lua_controller>
 <lua_controller id="eye"><actuators/><sensors><eyebot_proximity/><eyebot_light/><battery/><range_and_bearing medium="rab"/>
  <colored_blob_perspective_camera medium="leds"/></sensors><params script="s.lua"/></lua_controller>
 <lua_controller id="puck"><actuators><differential_steering/></actuators><sensors><ground/><epuck_proximity/><battery/>
  <range_and_bearing medium="rab"/></sensors><params script="s.lua"/></lua_controller>
 <lua_controller id="spir"><actuators/><sensors><battery/><range_and_bearing medium="rab"/><colored_blob_perspective_camera medium="leds"/></sensors>
  <params script="s.lua"/></lua_controller>
</controllers>
<arena size="8,8,2" center="0,0,1">
 <floor id="f" source="image" path="f.png"/>
 <foot-bot id="a">{BODY.format("0,0,0")}<controller config="foot"/><battery discharge_model="motion"/></foot-bot>
 <eye-bot id="e">{BODY.format("1,0,1")}<controller config="eye"/><battery/></eye-bot>
 <spiri id="s">{BODY.format("1,2,1")}<controller config="spir"/><battery/></spiri>
 <e-puck id="p">{BODY.format("2,0,0")}<controller config="puck"/><battery/></e-puck>
 <box id="w" size="1,1,1" movable="true" mass="1">{BODY.format("3,3,0")}{LEDS}</box>
 <cylinder id="c" radius="0.1" height="0.1" movable="true" mass="1">{BODY.format("-3,3,0")}{LEDS}</cylinder>
 <light id="l" position="1,1,1" intensity="1" medium="leds"/>
 <distribute><position method="uniform" min="-1,-1,0" max="1,1,0"/><orientation method="uniform" min="0,0,0" max="20,0,0"/>
  <entity quantity="1" max_trials="10"><foot-bot id="fb"><controller config="foot"/></foot-bot></entity></distribute>
</arena>
<physics_engines><dynamics2d id="d"/></physics_engines>
<media><led id="leds"/><range_and_bearing id="rab"/></media>
</argos-configuration>"""
# These attributes are required, and the file lacks them.
NEEDED = {"code": {"id": "code"}, "pointmass3d": {"id": "p"}, "dynamics3d": {"id": "p"}, "loop_functions": {"label": "x"},
          "user_functions": {"label": "x"}, "profiling": {"file": "x"}}
METHODS = {"uniform": {"min": "0,0,0", "max": "20,0,0"}, "gaussian": {"mean": "0,0,0", "std_dev": "1,1,0"}, "constant": {"values": "0,0,0"},
           "grid": {"center": "0,0,0", "distances": "1,0,0", "layout": "2,1,1"}}
# The parts of a battery's model, by the attributes that only one model has.
MODELS = {"delta": "time", "time_factor": "time_motion", "pos_factor": "time_motion", "orient_factor": "time_motion"}


class Attributes(RunningTest):
    def setUp(self):
        super().setUp()
        for script in "st":
            (self.folder / f"{script}.lua").write_text("function step() end\n")

    @staticmethod
    def child(parent, tag):
        """Returns the child of that tag, with the elements before it. It is made if it does not exist."""
        found = parent.find(tag)
        if found is None:
            found = xml.SubElement(parent, tag, NEEDED.get(tag, {"id": tag} if parent.tag in ("arena", "media") else {}))
        return found

    def place(self, root, path):
        """Returns the elements from the root to the one that the path names."""
        first, *rest = path.split("/")
        if first in ("foot", "eye", "puck"):
            chain = [root, root.find("controllers"), root.find(f"controllers/*[@id='{first}']")]
        else:
            chain, rest = [root], [first, *rest]
        for tag in rest:
            tag, _, method = tag.partition(".")
            if chain[-1].tag == "controllers" and tag in ("foot", "eye", "puck"):
                chain.append(chain[-1].find(f"*[@id='{tag}']"))
                continue
            chain.append(self.child(chain[-1], tag))
            if method:
                chain[-1].attrib = {"method": method, **METHODS[method]}
        if path.endswith("vertex"):
            for point in ("4,4", "-4,4", "-4,-4"):
                xml.SubElement(chain[-2], "vertex", {"point": point})
        return chain

    def written(self, root):
        """Writes the file, an element in each line, and returns the line of each element."""
        lines, line_of = [], {}

        def write(element):
            lines.append("<" + element.tag + "".join(f' {name}="{value}"' for name, value in element.attrib.items()) + ">")
            line_of[element] = len(lines)
            for child in element:
                write(child)
            lines.append(f"</{element.tag}>")
        write(root)
        (self.folder / "x.argos").write_text("\n".join(lines))
        return lines, line_of

    def converted(self, path, attribute, value):
        """Returns how the attribute with this value stands, and the converted file with all messages."""
        root = copy.deepcopy(self.base)
        chain = self.place(root, path)
        element = chain[-1]
        element.set(attribute, value)
        if element.tag == "battery" and attribute in MODELS:
            element.set("discharge_model", MODELS[attribute])
        if attribute == "method" and element.tag in ("position", "orientation"):
            element.attrib = {"method": value, **METHODS[value]}
        lines, line_of = self.written(root)
        result = self.swarmanoid("convert", "x.argos", code=None)
        self.assertIn(result.returncode, (0, 3), result.stderr)
        column = lines[line_of[element] - 1].index(f' {attribute}="') + 2
        named = [line for line in result.stderr.splitlines()
                 if line.startswith(f"x.argos:{line_of[element]}:{column}: ") and attribute in line]
        for outer in chain[1:]:
            named += [line for line in result.stderr.splitlines()
                      if line.startswith(f"x.argos:{line_of[outer]}:1: ") and f"<{outer.tag}>" in line]
        state = "acts" if not named else "named" if result.returncode == 0 else "refused"
        return state, (result.stdout, result.stderr)

    def test_every_attribute_acts_or_is_named(self):
        self.base = xml.fromstring(FILE)
        rows = [line.split() for line in (HERE / "attributes.txt").read_text().splitlines() if not line.startswith("#")]
        self.assertGreater(len(rows), 300)
        found = []
        for path, attribute, first, second, _ in rows:
            state, after = self.converted(path, attribute, second)
            if state == "acts" and self.converted(path, attribute, first)[1] == after:
                state = "silent"
            found.append([path, attribute, first, second, state])
        self.maxDiff = None
        self.assertEqual(found, rows)

    def test_an_unknown_attribute_is_named(self):
        """The same for a name that ARGoS3 does not read, in each element of the file."""
        root = xml.fromstring(FILE)
        for element in root.iter():
            if element.tag != "params":
                element.set("colur", "1")
        lines, line_of = self.written(root)
        stderr = self.swarmanoid("convert", "x.argos").stderr
        for element in root.iter():
            if element.tag != "params":
                self.assertRegex(stderr, rf"'colur' of <{element.tag}> has no effect here")
        self.assertRegex(stderr, r"'colur' of <body> has no effect here \(also at (\d+:\d+, ){4}\d+:\d+\)")
