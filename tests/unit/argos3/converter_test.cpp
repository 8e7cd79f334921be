// Experiments of ARGoS3 become ours: what TinyXML reads, frames, sizes and defaults, and the devices of each robot.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "argos3/converter/convert.h"
#include "argos3/converter/our_ids.h"
#include "argos3/converter/robot_rows.h"
#include "argos3/converter/tiny_xml.h"
#include "common/configuration/xml_writer.h"
#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"
#include "common/plugins/plugin_library.h"
#include "test_folders.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid::argos3
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Returns the content that TinyXML reads from a text, as well-formed XML, or "refused".
std::string TinyXmlOf(const std::string& text, std::vector<Diagnostic>* notes = nullptr)
{
  std::vector<Diagnostic> found;
  const auto root = ReadTinyXml(text, "x.argos", found);
  if (notes != nullptr) *notes = found;
  return root == nullptr ? "refused" : WriteXml(*root);
}

TEST(TinyXml, ReadsWhatTheOriginalReads)
{
  const std::string plain = TinyXmlOf("<a b='1'><c/></a>");
  EXPECT_THAT(plain, HasSubstr("<a b=\"1\">"));
  for (const char* same :
       {"<a b=1><c/></a>", "<a b = '1'><c/></a>", "<a\tb=\"1\"\n><c/>\n</a>", "<?xml version='1.0'?><a b='1'><c/></a>",
        "\n<?xml version='1.0'?><a b='1'><c/></a>", "<!-- x --><a b='1'><!-- y -- z --><c/></a>",
        "\xef\xbb\xbf<a b='1'><c/></a>", "<a b='1'><!DOCTYPE x><c/></a>", "<a b='1'><?x y?><c/></a>",
        "<a b='&#49;'><c/></a>", "<a b='&#x31;'><c/></a>", "<a b='1'><c/></a><later/>", "<a b='1'><c></c></a>"})
    EXPECT_EQ(TinyXmlOf(same), plain) << same;
  for (const char* text : {"", "text", "<a>", "<a b='1' b='2'/>", "<a></b>", "<a b/>", "<a b=>", "<a b='1/>",
                           "<a b=1\"/>", "<a><!-- x</a>", "<a><![CDATA[x</a>", "<a>&#0;</a>", "<a>&#xd800;</a>",
                           "<a>&#12</a>", "<a>&#;</a>", "<a>&#x110000;</a>", "<a b='\x01'/>", "<1/>", "<a"})
    EXPECT_EQ(TinyXmlOf(text), "refused") << text;
}

TEST(TinyXml, DecodesTextsAndAttributes)
{
  const auto text = [](const std::string& inside)
  {
    std::vector<Diagnostic> notes;
    const auto root = ReadTinyXml("<a>" + inside + "</a>", "x", notes);
    return root == nullptr ? "refused" : root->text;
  };
  EXPECT_EQ(text(" two \n words "), "two   words");
  EXPECT_EQ(text("&amp;&lt;&gt;&quot;&apos;"), "&<>\"'");
  EXPECT_EQ(text("a&b"), "ab");
  EXPECT_EQ(text("<![CDATA[a &lt; b]]>"), "a &lt; b");
  EXPECT_EQ(text("one<b/>two"), "onetwo");
  EXPECT_EQ(text("&#xe9;&#233;"), "\u00e9\u00e9");
  EXPECT_EQ(text("&#x7f;&#x80;&#x7ff;&#x800;"), "\u007f\u0080\u07ff\u0800");
  EXPECT_EQ(text("&#xffff;&#x10000;&#x10ffff;"), "\uffff\U00010000\U0010ffff");
  EXPECT_EQ(text("&#xd7ff;&#xe000;"), "\ud7ff\ue000");
  EXPECT_EQ(text("caf\xe9"), "caf\u00e9") << "a byte that is no UTF-8 is Latin-1";
  EXPECT_EQ(text("caf\u00e9"), "caf\u00e9");
  EXPECT_EQ(text("&#31;"), "refused");
  EXPECT_EQ(text("&#9;x"), "x");
}

TEST(TinyXml, WhatItForgivesIsNoted)
{
  struct Forgiven
  {
    const char *text, *place, *what;
  };
  for (const Forgiven& row :
       std::vector<Forgiven>{{"<a><!!-- x --!></a>", "x.argos:1:4", "what starts with '<!' here ends at the next '>'"},
                             {"\n<?xml?><a/>", "x.argos:2:1", "the XML declaration is not at the start of the file"},
                             {"<a><!-- -- --></a>", "x.argos:1:4", "the comment contains '--'"},
                             {"<a><!-- ---></a>", "x.argos:1:4", "the comment contains '--'"},
                             {"<a b='1'c='2'/>", "x.argos:1:9", "there is no blank before 'c' of <a>"},
                             {"<a b=1/>", "x.argos:1:4", "the value of 'b' of <a> has no quotes"},
                             {"<a b='x&y'/>", "x.argos:1:8", "the '&' starts no character, and is left out"},
                             {"<a b='\xe9'/>", "x.argos:1:7", "a byte is not UTF-8 text"}})
  {
    std::vector<Diagnostic> notes;
    TinyXmlOf(row.text, &notes);
    ASSERT_EQ(notes.size(), 1U) << row.text;
    EXPECT_EQ(notes[0].location.Text(), row.place) << row.text;
    EXPECT_THAT(notes[0].message, HasSubstr(row.what));
  }
  for (const char* fine : {"<?xml version='1.0'?><a b='1' c='2'><!-- x - y --><?x?></a>", "<a b='&amp;'/>"})
  {
    std::vector<Diagnostic> notes;
    TinyXmlOf(fine, &notes);
    EXPECT_THAT(notes, IsEmpty()) << fine;
  }
  EXPECT_TRUE(KeepsRealTime("<a><framework><experiment real_time='true'/></framework></a>"));
  EXPECT_FALSE(KeepsRealTime("<a><framework><experiment real_time='false'/></framework></a>"));
  EXPECT_FALSE(KeepsRealTime("<a><framework><experiment/></framework></a>"));
  EXPECT_FALSE(KeepsRealTime("<a><framework/></a>"));
}

TEST(OurIds, HaveTheCharactersThatOursMayHave)
{
  EXPECT_EQ(OurCharacters("fb_0.a:b-c"), "fb_0.a:b-c");
  EXPECT_EQ(OurCharacters("robot one/2"), "robot_one_2");
  EXPECT_EQ(OurCharacters("\u00e9t\u00e9"), "_t_") << "one for each character";
  EXPECT_EQ(OurCharacters(".x"), "_x");
  EXPECT_EQ(OurCharacters("7x"), "7x");
  EXPECT_EQ(OurCharacters(""), "_");
  EXPECT_EQ(OurCharacters(std::string(70, 'x')), std::string(64, 'x'));
}

// The sections of a file of ARGoS3.
struct Argos
{
  std::string arena{};
  std::string controllers{};
  std::string experiment = "length=\"10\" ticks_per_second=\"10\" random_seed=\"3\"";
  std::string arena_attributes = "size=\"8,6,2\" center=\"1,0,1\"";
  std::string engines = "<dynamics2d id=\"d\"/>";
  std::string media{};
  std::string more{};
};

struct Ours
{
  std::string xml, mistakes, notes;
};

Ours OursOf(const Argos& theirs)
{
  const std::string text = "<argos-configuration><framework><experiment " + theirs.experiment +
                           "/></framework><controllers>" + theirs.controllers + "</controllers><arena " +
                           theirs.arena_attributes + ">" + theirs.arena + "</arena><physics_engines>" + theirs.engines +
                           "</physics_engines><media>" + theirs.media + "</media>" + theirs.more +
                           "</argos-configuration>";
  std::vector<Diagnostic> notes;
  const auto root = ReadTinyXml(text, "x.argos", notes);
  EXPECT_TRUE(root) << text;
  if (root == nullptr) return {};
  const test::TemporaryFolder folder;
  const ConvertedExperiment converted = ConvertArgos3(*root, folder.Path());
  Ours ours;
  if (converted.root) ours.xml = WriteXml(*converted.root);
  for (const Diagnostic& mistake : converted.mistakes) ours.mistakes += mistake.message + "\n";
  for (const Diagnostic& note : converted.notes) ours.notes += note.message + "\n";
  return ours;
}

std::string Body(const std::string& position, const std::string& orientation = "0,0,0")
{
  return "<body position=\"" + position + "\" orientation=\"" + orientation + "\"/>";
}

TEST(Argos3Framework, HasTheTicksOfTheFile)
{
  const auto framework = [](const std::string& experiment) { return OursOf({.experiment = experiment}); };
  const std::string rest = " ticks_per_second=\"10\" random_seed=\"3\"";
  EXPECT_THAT(framework("length=\"10\"" + rest).xml,
              HasSubstr("<framework clocktick=\"100\" maxclock=\"101\" seed=\"3\"/>"));
  EXPECT_THAT(framework("length=\"0\"" + rest).xml, HasSubstr("<framework clocktick=\"100\" seed=\"3\"/>"));
  EXPECT_THAT(framework("length=\"0.25\" ticks_per_second=\"1000\" random_seed=\"3\"").xml,
              HasSubstr("<framework clocktick=\"1\" maxclock=\"251\" seed=\"3\"/>"));
  EXPECT_THAT(framework("ticks_per_second=\"30\" random_seed=\"3\"").xml,
              HasSubstr("<framework ticks_per_second=\"30\" seed=\"3\"/>"));
  const Ours unseeded = framework("ticks_per_second=\"1\"");
  EXPECT_THAT(unseeded.xml, HasSubstr("<framework clocktick=\"1000\" seed=\"1\"/>"));
  EXPECT_THAT(unseeded.notes, HasSubstr("without a random_seed ARGoS3 takes the time; here it is 1"));
  EXPECT_EQ(framework("length=\"10\"" + rest).notes, "");
  for (const char* ticks : {"0", "1001", "-1"})
    EXPECT_THAT(framework(std::string("ticks_per_second=\"") + ticks + "\"").mistakes,
                HasSubstr("it must be from 1 to 1000"));
  for (const char* length : {"-1", "1e14"})
    EXPECT_THAT(framework(std::string("length=\"") + length + "\"" + rest).mistakes,
                HasSubstr("'length' of <experiment> is"));
  EXPECT_EQ(framework("length=\"9.9e13\"" + rest).mistakes, "");
  EXPECT_THAT(framework("length=\"1\"").mistakes, HasSubstr("<experiment> has no 'ticks_per_second'; add it"));
}

TEST(Argos3Arena, LiesInThePositiveQuadrantAndHoldsAllEntities)
{
  const auto box = [](const std::string& position)
  { return "<box id=\"w\" size=\"1,0.5,0.4\" movable=\"false\">" + Body(position) + "</box>"; };
  // The arena is from -3 to 5 and from -3 to 3.
  const Ours inside = OursOf({.arena = box("3,2,0")});
  EXPECT_EQ(inside.mistakes + inside.notes, "");
  EXPECT_THAT(inside.xml, HasSubstr("<arena size=\"8, 6, 2\" optimization=\"2D\">"));
  EXPECT_THAT(inside.xml, HasSubstr("<block size=\"1, 0.5, 0.4\" movable=\"false\" id=\"w\" position=\"6, 5, 0.2\" "
                                    "orientation=\"0, 0, 0\"/>"));
  const Ours west = OursOf({.arena = box("-4,7,0.5")});
  EXPECT_THAT(west.xml, HasSubstr("<arena size=\"9, 10, 2\""));
  EXPECT_THAT(west.xml, HasSubstr("position=\"0, 10, 0.7\""));
  EXPECT_THAT(OursOf({.arena = box("0,0,2.5")}).xml, HasSubstr("<arena size=\"8, 6, 2.9\""))
      << "a box needs its height";
  EXPECT_THAT(OursOf({.arena = box("0,0,-1")}).xml, HasSubstr("<arena size=\"8, 6, 3\""));
  EXPECT_THAT(OursOf({.arena_attributes = "size=\"4,4,0\" center=\"0,0,0\""}).xml,
              HasSubstr("<arena size=\"4, 4, 1\""));
  EXPECT_THAT(OursOf({.arena_attributes = "size=\"4,4,3\""}).xml, HasSubstr("<arena size=\"4, 4, 1.5\""));
  for (const char* size : {"0,4,1", "4,-1,1", "4,4,-1"})
    EXPECT_THAT(OursOf({.arena_attributes = std::string("size=\"") + size + "\""}).mistakes,
                HasSubstr("it must be above 0 m along x and y, and from 0 m on along z"));
  EXPECT_THAT(OursOf({.arena_attributes = ""}).mistakes, HasSubstr("<arena> has no 'size'; add it"));
}

TEST(Argos3Bodies, HaveTheirMassFrictionAndColour)
{
  const auto box = [](const std::string& attributes, const std::string& leds = "")
  { return "<box id=\"w\" size=\"1,1,0.4\" " + attributes + ">" + Body("0,0,0", "30,0,0") + leds + "</box>"; };
  const Ours movable = OursOf({.arena = box("movable=\"true\" mass=\"3\"")});
  const std::string friction = fmt::format("{}", 1.49 / (3 * 9.81));
  EXPECT_THAT(movable.xml,
              HasSubstr("movable=\"true\" mass=\"3\" ground_friction=\"" + friction +
                        "\" ground_torque=\"1.49\" id=\"w\" position=\"3, 3, 0.2\" orientation=\"0, 0, 30\""));
  EXPECT_THAT(OursOf({.arena = box("movable=\"true\"")}).xml, HasSubstr("mass=\"1\""));
  EXPECT_THAT(OursOf({.arena = box("movable=\"true\" mass=\"1e-4\"")}).xml, HasSubstr("ground_friction=\"100\""));
  const Ours heavy = OursOf({.arena = box("movable=\"true\" mass=\"2e9\"")});
  EXPECT_THAT(heavy.xml, HasSubstr("mass=\"1000000000\""));
  EXPECT_THAT(heavy.notes, HasSubstr("kg here"));
  EXPECT_THAT(OursOf({.arena = box("")}).mistakes, HasSubstr("<box> has no 'movable'; add it"));
  const std::string own =
      "<friction box_linear_friction=\"2\" box_angular_friction=\"3\" cylinder_linear_friction=\"4\" "
      "cylinder_angular_friction=\"5\"/>";
  const std::string cylinder =
      "<cylinder id=\"c\" radius=\"0.1\" height=\"0.2\" movable=\"true\" mass=\"2\">" + Body("1,1,0") + "</cylinder>";
  const Ours rubbed = OursOf({.arena = box("movable=\"true\" mass=\"1\"") + cylinder,
                              .engines = "<dynamics2d id=\"d\">" + own + "</dynamics2d>"});
  EXPECT_THAT(rubbed.xml, HasSubstr(fmt::format("ground_friction=\"{}\" ground_torque=\"3\"", 2 / 9.81)));
  EXPECT_THAT(rubbed.xml, HasSubstr("<cylindric_prey radius=\"0.1\" height=\"0.2\" colour=\"black\" movable=\"true\" "
                                    "mass=\"2\" " +
                                    fmt::format("ground_friction=\"{}\" ground_torque=\"5\"", 4 / (2 * 9.81))));
  EXPECT_THAT(OursOf({.engines = "<dynamics2d id=\"d\"><friction box_linear_friction=\"-1\"/></dynamics2d>"}).mistakes,
              HasSubstr("'box_linear_friction' of <friction> must not be negative"));

  const std::string leds = "<leds medium=\"m\"><led color=\"{}\"/><led color=\"blue\"/></leds>";
  for (const auto& [theirs, ours] : std::map<std::string, std::string>{{"red", "red"},
                                                                       {"gray10", "#1a1a1a"},
                                                                       {"gray50", "#7f7f7f"},
                                                                       {"gray90", "#e5e5e5"},
                                                                       {"1,20,300", "#0114ff"},
                                                                       {"orange", "orange"},
                                                                       {"purple", "purple"}})
  {
    const Ours lit = OursOf(
        {.arena = box("movable=\"false\"", fmt::format(fmt::runtime(leds), theirs)), .media = "<led id=\"m\"/>"});
    EXPECT_THAT(lit.xml, HasSubstr("<argos3_box colour=\"" + ours + "\" size=\"1, 1, 0.4\"")) << theirs;
    EXPECT_THAT(lit.notes, HasSubstr("all LEDs of one object have the colour of the first one here"));
    EXPECT_THAT(lit.xml, HasSubstr("<argos3_box library=\"argos3_box\"/>"));
  }
  for (const char* wrong : {"pink", "1,2", "gray55", "gray00"})
    EXPECT_THAT(OursOf({.arena = box("movable=\"false\"", fmt::format(fmt::runtime(leds), wrong))}).mistakes,
                HasSubstr("is no colour"))
        << wrong;
  const Ours light = OursOf({.arena = "<light id=\"l\" position=\"1,1,1\"/>"});
  EXPECT_THAT(light.xml, HasSubstr("<light_bulb intensity=\"1\" colour=\"yellow\" id=\"l\" position=\"4, 4, 1\"/>"));
}

TEST(Argos3Arena, AnglesAreAboutTheFixedAxes)
{
  const std::string box = "<box id=\"w\" size=\"1,1,2\" movable=\"false\">" + Body("0,0,0", "90,90,0") + "</box>";
  const Ours flat = OursOf({.arena = box});
  EXPECT_THAT(flat.xml, HasSubstr("position=\"3, 3, 1\" orientation=\"0, 0, 90\""));
  EXPECT_THAT(flat.notes, HasSubstr("the tilt has no effect, as in ARGoS3"));
  // About z and then about y: the box lies along x, and so its middle is a metre from its base.
  const Ours leaning = OursOf({.arena = box, .engines = "<dynamics3d id=\"d\"/>"});
  EXPECT_EQ(leaning.notes, "");
  double x = 0, y = 0, z = 0;
  const std::size_t at = leaning.xml.find("position=\"");
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(std::sscanf(leaning.xml.c_str() + at, "position=\"%lf, %lf, %lf\"", &x, &y, &z), 3);
  EXPECT_NEAR(x, 4, 1e-9);
  EXPECT_NEAR(y, 3, 1e-9);
  EXPECT_NEAR(z, 0, 1e-9);
}

TEST(Argos3Distribute, KeepsMethodsAndNumbers)
{
  const auto distributed =
      [](const std::string& position, const std::string& orientation, const std::string& entity,
         const std::string& what = "<cylinder id=\"c\" radius=\"1\" height=\"1\" movable=\"false\"/>")
  {
    return OursOf({.arena = "<distribute><position " + position + "/><orientation " + orientation + "/><entity " +
                            entity + ">" + what + "</entity></distribute>"});
  };
  const std::string uniform = "method=\"uniform\" min=\"0,0,0\" max=\"360,0,0\"",
                    few = "quantity=\"3\" max_trials=\"9\"";
  const Ours plain = distributed("method=\"uniform\" min=\"-1,-1,0\" max=\"1,2,0\"", uniform, few);
  EXPECT_EQ(plain.mistakes + plain.notes, "");
  EXPECT_THAT(plain.xml, HasSubstr("<distribute quantity=\"3\" max_trials=\"9\">"));
  EXPECT_THAT(plain.xml, HasSubstr("<position method=\"uniform\" min=\"2, 2, 0\" max=\"4, 5, 0\"/>"));
  EXPECT_THAT(plain.xml, HasSubstr("<orientation method=\"uniform\" min=\"0, 0, 0\" max=\"0, 0, 360\"/>"));
  const Ours grid = distributed("method=\"grid\" center=\"1,0,0\" distances=\"0.5,0.25,0\" layout=\"2,3,1\"",
                                "method=\"constant\" values=\"45,0,0\"", few);
  EXPECT_THAT(grid.xml, HasSubstr("<position method=\"grid\" centre=\"4, 3, 0\" spacing=\"-0.5, -0.25, -0\" "
                                  "layout=\"2, 3, 1\"/>"));
  EXPECT_THAT(grid.xml, HasSubstr("<orientation method=\"constant\" value=\"0, 0, 45\"/>"));
  const Ours gaussian = distributed("method=\"gaussian\" mean=\"0,0,0\" std_dev=\"1,2,0\"",
                                    "method=\"gaussian\" mean=\"10,0,0\" std_dev=\"20,0,0\"", few);
  EXPECT_THAT(gaussian.xml, HasSubstr("<position method=\"gaussian\" mean=\"3, 3, 0\" deviation=\"1, 2, 0\"/>"));
  EXPECT_THAT(gaussian.xml, HasSubstr("<orientation method=\"gaussian\" mean=\"0, 0, 10\" deviation=\"0, 0, 20\"/>"));
  const Ours constant = distributed("method=\"constant\" values=\"1,1,0\"",
                                    "method=\"grid\" center=\"0,0,0\" distances=\"30,0,0\" layout=\"3,1,1\"", few,
                                    "<box id=\"b\" size=\"1,1,2\" movable=\"false\"/>");
  EXPECT_THAT(constant.xml, HasSubstr("<position method=\"uniform\" min=\"4, 4, 1\" max=\"4, 4, 1\"/>"))
      << "a box is lifted";
  EXPECT_THAT(constant.xml,
              HasSubstr("<orientation method=\"grid\" centre=\"0, 0, 0\" spacing=\"0, 0, -30\" layout=\"1, 1, "
                        "3\"/>"));
  EXPECT_THAT(distributed("method=\"ring\"", uniform, few).mistakes, HasSubstr("'ring' is no method"));
  EXPECT_THAT(distributed("method=\"constant\" values=\"1,1,0\"", "method=\"ring\"", few).mistakes,
              HasSubstr("is no method"));
  EXPECT_THAT(distributed("method=\"constant\" values=\"1,1,0\"", uniform, few + " base_num=\"-1\"").mistakes,
              HasSubstr("entities are numbered from 0 on"));
  EXPECT_THAT(distributed("method=\"constant\" values=\"1,1,0\"", uniform, "quantity=\"0\" max_trials=\"1\"").xml,
              Not(HasSubstr("<distribute")));
}

TEST(Argos3Engines, HaveTheirPlanesAndVolumes)
{
  const auto engines = [](const std::string& theirs) { return OursOf({.engines = theirs}); };
  EXPECT_THAT(engines("<dynamics2d id=\"d\" elevation=\"0.5\"/>").xml,
              HasSubstr("<dynamics2d id=\"d\" distance=\"0.5\" wheel_friction=\"1\" gripper=\"rod\"/>"));
  EXPECT_THAT(engines("<kinematics2d id=\"k\"/>").xml, HasSubstr("<kinematics2d id=\"k\" distance=\"0\"/>"));
  EXPECT_THAT(engines("<dynamics3d id=\"k\"/>").xml, HasSubstr("<dynamics3d id=\"k\"/>"));
  const Ours points = engines("<pointmass3d id=\"p\"/>");
  EXPECT_THAT(points.xml, HasSubstr("<dynamics3d id=\"p\"/>"));
  EXPECT_THAT(points.notes, HasSubstr("<pointmass3d> is dynamics3d here: bodies that meet collide"));
  EXPECT_THAT(engines("<bullet id=\"b\"/>").mistakes, HasSubstr("the engine <bullet> has no counterpart"));
  EXPECT_THAT(engines("<dynamics2d id=\"a\"/><dynamics2d id=\"b\"/>").notes,
              HasSubstr("<dynamics2d> of id 'b' and the one before are one engine here"));
  const auto volume = [](const std::string& id, const std::string& x)
  {
    return "<dynamics2d id=\"" + id + "\"><boundaries><sides><vertex point=\"" + x + ",-1\"/><vertex point=\"" + x +
           ",1\"/><vertex point=\"0,0\"/></sides><top height=\"1\"/></boundaries></dynamics2d>";
  };
  const Ours two = engines(volume("a", "2") + volume("b", "-2"));
  EXPECT_EQ(two.mistakes, "");
  EXPECT_THAT(two.xml, HasSubstr("<engine id=\"a\" volume=\"5, 2, 5, 4, 3, 3\" heights=\"-1000000, 1\"/>"));
  EXPECT_THAT(two.xml, HasSubstr("<engine id=\"b\" volume=\"1, 2, 1, 4, 3, 3\" heights=\"-1000000, 1\"/>"));
  EXPECT_THAT(engines("<dynamics2d id=\"a\"><boundaries><bottom height=\"0.5\"/></boundaries></dynamics2d>").xml,
              HasSubstr("heights=\"0.5, 1000000\""));
  EXPECT_THAT(engines("<dynamics2d id=\"a\"><boundaries><sides><vertex point=\"1,1\"/><vertex point=\"1,2\"/></sides>"
                      "</boundaries></dynamics2d>")
                  .mistakes,
              HasSubstr("need at least three <vertex>"));
}

// Returns what a robot with a controller in C++ of these devices becomes.
Ours WithDevices(const std::string& robot, const std::string& sensors, const std::string& actuators,
                 const std::string& attributes = "", const std::string& inside = "")
{
  static const test::TemporaryFolder folder;
  const std::string script = folder.Write("s.lua", "function step() end\n");
  return OursOf({.arena = "<" + robot + " id=\"r\" " + attributes + ">" + Body("0,0,0") + "<controller config=\"c\"/>" +
                          inside + "</" + robot + ">",
                 .controllers = "<lua_controller id=\"c\"><actuators>" + actuators + "</actuators><sensors>" + sensors +
                                "</sensors><params script=\"" + script + "\"/></lua_controller>",
                 .media = "<led id=\"leds\"/><range_and_bearing id=\"rab\"/><range_and_bearing id=\"through\" "
                          "check_occlusions=\"false\"/>"});
}

TEST(Argos3Devices, AreOursWithTheirNumbers)
{
  struct Row
  {
    const char *robot, *sensors, *actuators, *ours;
  };
  for (const Row& row : std::vector<Row>{
           {"foot-bot", "<footbot_proximity noise_level=\"0.1\"/>", "",
            "<footbot_proximity implementation=\"generic_footbot_proximity\" noise_kind=\"uniform\" noise_mean=\"0\" "
            "noise_range=\"0.1\"/>"},
           {"foot-bot", "<footbot_proximity/>", "",
            "<footbot_proximity implementation=\"generic_footbot_proximity\"/>"},
           {"foot-bot", "<footbot_light/>", "", "<footbot_light implementation=\"argos3_footbot_light\"/>"},
           {"foot-bot", "<footbot_motor_ground/>", "",
            "<footbot_motor_ground implementation=\"generic_footbot_motor_ground\"/>"},
           {"foot-bot", "<footbot_base_ground/>", "",
            "<footbot_base_ground implementation=\"generic_footbot_base_ground\"/>"},
           {"foot-bot", "<light/>", "",
            "<light implementation=\"generic_light\" sensors=\"24\" first_angle=\"7.5\" radius=\"0.085036758\" "
            "height=\"0.06\"/>"},
           {"e-puck", "<light/>", "",
            "<light implementation=\"generic_light\" sensors=\"8\" first_angle=\"22.5\" radius=\"0.035\" "
            "height=\"0.06\"/>"},
           {"kheperaiv", "<light/>", "",
            "<light implementation=\"generic_light\" sensors=\"8\" first_angle=\"0\" radius=\"0.0704\" "
            "height=\"0.0145\"/>"},
           {"foot-bot", "<differential_steering/>", "",
            "<footbot_encoders implementation=\"engine_footbot_encoders\"/>"},
           {"foot-bot", "<positioning pos_noise_range=\"-0.1:0.2\" angle_noise_range=\"0:180\"/>", "",
            "position_noise_kind=\"uniform\" position_noise_mean=\"0.05\" position_noise_range=\"0.15000000000000002\" "
            "heading_noise_kind=\"uniform\" heading_noise_mean=\"1.5707963267948966\" "
            "heading_noise_range=\"1.5707963267948966\"/>"},
           {"foot-bot", "<footbot_distance_scanner noise_range=\"-2:4\"/>", "",
            "<footbot_distance_scanner implementation=\"argos3_footbot_distance_scanner\" noise_kind=\"uniform\" "
            "noise_mean=\"0.01\" noise_range=\"0.03\"/>"},
           {"foot-bot", "", "<footbot_distance_scanner/>",
            "<footbot_distance_scanner implementation=\"argos3_footbot_distance_scanner\"/>"},
           {"foot-bot", "<footbot_turret_encoder/>", "",
            "<footbot_turret_encoder implementation=\"generic_footbot_turret_encoder\"/>"},
           {"foot-bot", "", "<footbot_turret/>", "<footbot_turret implementation=\"dummy_footbot_turret\"/>"},
           {"foot-bot", "", "<footbot_turret/>", "<footbot_turret_encoder implementation="},
           {"foot-bot", "", "<footbot_gripper/>", "<footbot_gripper implementation=\"dummy_footbot_gripper\"/>"},
           {"foot-bot", "", "<leds medium=\"leds\"/>",
            "<footbot_leds implementation=\"generic_footbot_leds\" separate=\"true\"/>"},
           {"foot-bot", "", "<leds/>", "<footbot_beacon implementation=\"generic_footbot_beacon\"/>"},
           {"eye-bot", "", "<leds/>", "<eyebot_leds implementation=\"generic_eyebot_leds\" separate=\"true\"/>"},
           {"e-puck", "", "<leds/>", "<led_ring implementation=\"generic_led_ring\" separate=\"true\"/>"},
           {"foot-bot", "", "<differential_steering noise_std_dev=\"0.1\" bias_avg=\"0.2\" bias_avg_left=\"0.3\"/>",
            "bias_avg_left=\"0.3\" bias_avg_right=\"0.2\""},
           {"e-puck", "", "<differential_steering/>", "<wheels implementation=\"generic_wheels\"/>"},
           {"kilobot", "", "<differential_steering/>", "<wheels implementation=\"generic_wheels\" max_speed=\"10\"/>"},
           {"eye-bot", "", "<quadrotor_position/>",
            "<eyebot_propellers implementation=\"position_eyebot_propellers\"/>"},
           {"eye-bot", "", "<quadrotor_speed/>", "<positioning implementation=\"generic_positioning\"/>"},
           {"eye-bot", "<eyebot_light/>", "", "<eyebot_light implementation=\"argos3_eyebot_light\"/>"},
           {"eye-bot", "<eyebot_proximity/>", "", "<proximity implementation=\"generic_proximity\"/>"},
           {"eye-bot", "<colored_blob_perspective_camera medium=\"leds\"/>", "",
            "<eyebot_pan_tilt_camera implementation=\"generic_eyebot_pan_tilt_camera\" aperture=\"30\" range=\"2\"/>"},
           {"spiri", "<colored_blob_perspective_camera medium=\"leds\"/>", "",
            "aperture=\"30\" range=\"10\" position=\"0.332340187, 0, 0\"/>"},
           {"foot-bot", "<colored_blob_perspective_camera medium=\"leds\"/>", "",
            "<footbot_perspective_camera implementation=\"generic_footbot_perspective_camera\" aperture=\"30\" "
            "range=\"2\"/>"},
           {"foot-bot", "<range_and_bearing medium=\"rab\" packet_drop_prob=\"0.2\"/>", "",
            "<range_and_bearing implementation=\"generic_range_and_bearing\" range=\"3\" loss_probability=\"0.2\"/>"},
           {"foot-bot", "<range_and_bearing medium=\"through\"/>", "", "range=\"3\" line_of_sight=\"false\"/>"},
           {"e-puck", "<range_and_bearing medium=\"rab\"/>", "", "range=\"0.8\" antenna=\"0.0849"},
           {"spiri", "<range_and_bearing medium=\"rab\"/>", "", "range=\"3\" antenna=\"0.045\""},
           {"kheperaiv", "<range_and_bearing medium=\"rab\"/>", "", "range=\"3\" antenna=\"0.0567"},
           {"kheperaiv", "<kheperaiv_lidar/>", "",
            "<range_scanner implementation=\"generic_range_scanner\" beams=\"682\" field_of_view=\"210\" position=\"0, "
            "0, "
            "0.1417\""},
           {"kheperaiv", "<kheperaiv_lidar num_readings=\"2\"/>", "", "beams=\"2\""},
           {"kheperaiv", "<kheperaiv_ultrasound/>", "",
            "<proximity implementation=\"generic_proximity\" range=\"2.25\"/>"},
           {"kheperaiv", "<kheperaiv_light/>", "", "<light implementation=\"argos3_light\" index_step=\"15\"/>"},
           {"kheperaiv", "<kheperaiv_ground noise_level=\"0.3\"/>", "",
            "<ground implementation=\"generic_ground\" noise_kind=\"uniform\" noise_mean=\"0\" noise_range=\"0.3\"/>"},
           {"kilobot", "<kilobot_light/>", "",
            "<light implementation=\"argos3_light\" directions=\"100\" half_angle=\"180\" position=\"0.00668"},
           {"kilobot", "<kilobot_communication/>", "", "range=\"0.1\" line_of_sight=\"false\"/>"},
           {"e-puck", "<epuck_ground/>", "", "<ground implementation=\"generic_ground\"/>"},
           {"e-puck", "<epuck_light/>", "", "directions=\"16.99"},
           {"e-puck", "<epuck_omnidirectional_camera/>", "", "height=\"0.122\" aperture=\"89.9\" range=\"0.33"},
           {"e-puck", "", "<epuck_wheels/>", "<wheels implementation=\"generic_wheels\"/>"},
           {"e-puck", "", "<epuck_rgb_leds/>", "<led_ring implementation=\"generic_led_ring\" separate=\"true\"/>"},
           {"pipuck", "<pipuck_rangefinders/>", "", "<proximity implementation=\"generic_proximity\"/>"},
           {"pipuck", "<pipuck_ground/>", "", "<ground implementation=\"generic_ground\"/>"},
           {"pipuck", "", "<pipuck_differential_drive/>", "<wheels implementation=\"generic_wheels\"/>"},
           {"pipuck", "", "<pipuck_leds/>",
            "<directional_leds implementation=\"generic_directional_leds\" observable_angle=\"0\" elevation=\"90\"/>"}})
  {
    const Ours ours = WithDevices(row.robot, row.sensors, row.actuators);
    EXPECT_EQ(ours.mistakes, "") << row.robot << row.sensors << row.actuators;
    EXPECT_THAT(ours.xml, HasSubstr(row.ours)) << row.robot << row.sensors << row.actuators;
  }
}

TEST(Argos3Devices, BatteriesLastAThousandTimesAsLong)
{
  const auto battery = [](const std::string& attributes)
  { return WithDevices("foot-bot", "<battery/>", "", "", "<battery " + attributes + "/>").xml; };
  EXPECT_THAT(
      WithDevices("foot-bot", "<battery/>", "").xml,
      HasSubstr("<battery implementation=\"generic_battery\" per_second=\"0\" per_metre=\"0\" per_radian=\"0\"/>"));
  // Ten ticks a second, each of the default 1e-5.
  EXPECT_THAT(battery("full_charge=\"2\""), HasSubstr(fmt::format("per_second=\"{}\" per_metre=\"0\" per_radian=\"0\"",
                                                                  1e-5 * 10 * (1 / (2 * 1000.0)))));
  EXPECT_THAT(battery("discharge_model=\"time\" delta=\"0.1\""),
              HasSubstr(fmt::format("per_second=\"{}\" per_metre=\"0\"", 0.1 * 10 * (1 / 1000.0))));
  EXPECT_THAT(battery("discharge_model=\"motion\" pos_delta=\"0.5\""),
              HasSubstr("per_second=\"0\" per_metre=\"0.0005\" per_radian=\"1e-06\""));
  EXPECT_THAT(
      battery("discharge_model=\"time_motion\" time_factor=\"0.1\" orient_factor=\"0.25\""),
      HasSubstr(fmt::format("per_second=\"{}\" per_metre=\"1e-06\" per_radian=\"0.00025\"", 0.1 * 10 * (1 / 1000.0))));
  const auto mistake = [](const std::string& attributes)
  { return WithDevices("foot-bot", "<battery/>", "", "", "<battery " + attributes + "/>").mistakes; };
  EXPECT_THAT(mistake("discharge_model=\"x\""), HasSubstr("'x' is no discharge_model"));
  EXPECT_THAT(mistake("full_charge=\"0\""), HasSubstr("'full_charge' of <battery> is more than 0"));
}

TEST(Argos3Devices, RadiosAndCamerasHaveTheNumbersOfTheirRobot)
{
  const std::string rab = "<range_and_bearing medium=\"rab\"/>", send = "<range_and_bearing/>";
  const Ours small = WithDevices("foot-bot", rab, send, "rab_range=\"2\" rab_data_size=\"4\"");
  EXPECT_EQ(small.mistakes, "");
  EXPECT_THAT(small.xml, HasSubstr("range=\"2\"/>"));
  EXPECT_THAT(small.xml, HasSubstr("rab_data_size=\"4\""));
  EXPECT_THAT(WithDevices("foot-bot", rab, send, "rab_data_size=\"20\"").xml, HasSubstr("bytes=\"2"));
  EXPECT_THAT(WithDevices("foot-bot", rab, send, "rab_data_size=\"0\"").mistakes,
              HasSubstr("have 1 to 10000 bytes here"));
  EXPECT_THAT(WithDevices("foot-bot", rab, send, "rab_data_size=\"10001\"").mistakes,
              HasSubstr("have 1 to 10000 bytes"));
  EXPECT_THAT(WithDevices("foot-bot", rab, send, "rab_range=\"0\"").mistakes,
              HasSubstr("'rab_range' of <foot-bot> is 0; it must be above 0"));
  EXPECT_THAT(WithDevices("foot-bot", "", send).notes, HasSubstr("the robots are in no medium"));
  const std::string camera = "<colored_blob_omnidirectional_camera medium=\"leds\"/>";
  EXPECT_THAT(WithDevices("foot-bot", camera, "", "omnidirectional_camera_aperture=\"45\"").xml,
              HasSubstr("aperture=\"45\" range=\"1.2999999999999998\""));
  EXPECT_THAT(WithDevices("foot-bot", camera, "", "perspective_camera_front=\"false\"").mistakes,
              HasSubstr("a perspective camera that looks up has no counterpart"));
  EXPECT_THAT(WithDevices("foot-bot", "<colored_blob_omnidirectional_camera medium=\"no\"/>", "").notes,
              HasSubstr("'no'"));
}

TEST(Argos3Devices, OfOtherRobotsAreRefused)
{
  struct Row
  {
    const char *robot, *sensors, *actuators, *mistake;
  };
  for (const Row& row : std::vector<Row>{
           {"spiri", "<ground/>", "", "<ground> is no device of <spiri>, also in ARGoS3; leave it out"},
           {"kilobot", "<battery/>", "", "<battery> is no device of <kilobot>"},
           {"foot-bot", "<ground/>", "", "take footbot_motor_ground or footbot_base_ground"},
           {"eye-bot", "<light/>", "", "take eyebot_light"},
           {"e-puck", "<colored_blob_perspective_camera/>", "", "is no sensor of <e-puck>; leave it out"},
           {"foot-bot", "<kheperaiv_lidar/>", "", "<kheperaiv_lidar> is a device of <kheperaiv>, and other robots"},
           {"kheperaiv", "<kheperaiv_lidar num_readings=\"1\"/>", "", "it must be from 2 to 8192"},
           {"kheperaiv", "<kheperaiv_lidar num_readings=\"8193\"/>", "", "it must be from 2 to 8192"},
           {"kheperaiv", "<kheperaiv_lidar num_readings=\"2.5\"/>", "", "it must be from 2 to 8192"},
           {"kheperaiv", "<kheperaiv_encoder/>", "", "take differential_steering"},
           {"kheperaiv", "<kheperaiv_light/><light/>", "", "a controller has one sensor for light here"},
           {"e-puck", "<epuck_camera/>", "",
            "<epuck_camera> has no counterpart here; take epuck_omnidirectional_camera"},
           {"pipuck", "<pipuck_imu/>", "", "<pipuck_imu> has no counterpart here"},
           {"foot-bot", "<footbot_proximty/>", "", "did you mean 'footbot_proximity'?"},
           {"foot-bot", "", "<footbot_griper/>", "did you mean 'footbot_gripper'?"},
           {"foot-bot", "<footbot_light implementation=\"default\"/>", "",
            "<footbot_light> has no implementation 'default'; it has 'rot_z_only'"},
           {"foot-bot", "<range_and_bearing implementation=\"default\"/>", "", "it has 'medium'"},
           {"foot-bot", "<footbot_proximity noise_level=\"x\"/>", "", "'noise_level' is 'x', no number"},
           {"foot-bot", "<positioning pos_noise_range=\"2:1\"/>", "", "'pos_noise_range' is '2:1'; write min:max"},
           {"foot-bot", "<positioning pos_noise_range=\"1\"/>", "", "write min:max"}})
    EXPECT_THAT(WithDevices(row.robot, row.sensors, row.actuators).mistakes, HasSubstr(row.mistake))
        << row.robot << row.sensors << row.actuators;
  EXPECT_THAT(OursOf({.arena = "<drone id=\"d\"/>"}).mistakes, HasSubstr("<drone> has no counterpart"));
  EXPECT_THAT(OursOf({.more = "<extra/>"}).mistakes, HasSubstr("<extra> has no counterpart; leave it out"));
}

// The sizes are those of the sources of ARGoS3 and its plug-ins.
TEST(Argos3Kinds, HaveTheSizesOfARGoS3)
{
  struct Kind
  {
    const char* tag;
    double radius, height, mass, axle, wheel;
    std::size_t leds, proximity;
    double led_height, proximity_height, proximity_range, first_angle;
  };
  for (const Kind& expected :
       std::vector<Kind>{{"argos3_epuck", 0.035, 0.086, 0.4, 0.053, 0.0205, 8, 8, 0.086, 0.06, 0.1, 17},
                         {"argos3_demiurge_epuck", 0.035, 0.076, 0.4, 0.053, 0.0205, 11, 8, 0.0765, 0.032, 0.05, 11.25},
                         {"argos3_kheperaiv", 0.0704, 0.0577, 0.4, 0.1054, 0.021, 3, 8, 0.0577, 0.0145, 0.12, 0},
                         {"argos3_pipuck", 0.0362, 0.08, 0.4, 0.0565, 0.02125, 10, 8, 0.025, 0.0333, 0.1, -12.5914}})
  {
    const std::vector<std::string> folders = {SWARMANOID_BUILD_FOLDER "/lib/swarmanoid"};
    EXPECT_EQ(LoadPluginLibrary(expected.tag, folders).error, "");
    const auto kind = KindOfTag(expected.tag);
    ASSERT_TRUE(kind) << expected.tag;
    const EntityKindDescription& row = DescriptionOf(*kind);
    EXPECT_EQ(row.form, BodyForm::kCylinder);
    EXPECT_NEAR(row.size.x(), expected.radius, 1e-12) << expected.tag;
    EXPECT_NEAR(row.size.z(), expected.height, 1e-12) << expected.tag;
    EXPECT_EQ(row.mass_kg, expected.mass);
    EXPECT_EQ(row.wheels->axle_m, expected.axle);
    EXPECT_EQ(row.wheels->radius_m, expected.wheel);
    EXPECT_EQ(row.wheels->max_speed_m_s, 10) << "ARGoS3 does not limit the commands";
    EXPECT_EQ(row.leds->places.size(), expected.leds);
    EXPECT_NEAR(row.leds->height_m, expected.led_height, 1e-12);
    ASSERT_EQ(row.proximity->sensors.size(), expected.proximity);
    EXPECT_EQ(row.proximity->height_m, expected.proximity_height);
    EXPECT_EQ(row.proximity->range_m, expected.proximity_range);
    EXPECT_NEAR(row.proximity->sensors[0].direction, DegreesToRadians(expected.first_angle), 1e-5) << expected.tag;
    // The sensors are symmetric about the axis ahead, and look away from the middle.
    double across = 0, turn = 0;
    for (const auto& sensor : row.proximity->sensors)
    {
      across += sensor.place.y();
      turn += std::sin(sensor.direction);
      EXPECT_GT(sensor.place.dot(Vector2(std::cos(sensor.direction), std::sin(sensor.direction))), 0.02)
          << expected.tag;
    }
    EXPECT_NEAR(across, 0, 1e-12);
    EXPECT_NEAR(turn, 0, 1e-12);
  }
  const std::vector<std::string> folders = {SWARMANOID_BUILD_FOLDER "/lib/swarmanoid"};
  EXPECT_EQ(LoadPluginLibrary("argos3_spiri", folders).error, "");
  const Propellers& spiri = *DescriptionOf(*KindOfTag("argos3_spiri")).propellers;
  EXPECT_NEAR(spiri.max_thrust_n, 2.2 * 9.81, 1e-12);
  EXPECT_NEAR(spiri.inertia_kg_m2.z(), 0.332340187 * 0.332340187 / 2, 1e-12);
  EXPECT_NEAR(spiri.inertia_kg_m2.x(), (3 * 0.332340187 * 0.332340187 + 0.09 * 0.09) / 12, 1e-12);
  EXPECT_NEAR(spiri.centre_of_mass_m, 0.045, 1e-12);
}

}  // namespace
}  // namespace swarmanoid::argos3
