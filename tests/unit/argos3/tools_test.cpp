// Tests ARGoS3's utilities other than mathematics: colours, bytes, options, statistics, sockets.
#include <argos3/core/utility/configuration/argos_configuration.h>
#include <argos3/core/utility/configuration/command_line_arg_parser.h>
#include <argos3/core/utility/configuration/memento.h>
#include <argos3/core/utility/datatypes/any.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/core/utility/datatypes/set.h>
#include <argos3/core/utility/logging/argos_log.h>
#include <argos3/core/utility/math/rng.h>
#include <argos3/core/utility/networking/tcp_socket.h>
#include <argos3/core/utility/plugins/dynamic_loading.h>
#include <argos3/core/utility/profiler/profiler.h>
#include <argos3/core/utility/rate.h>
#include <argos3/core/utility/signal_processing.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <functional>
#include <numbers>
#include <thread>

#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace
{

using namespace argos;

TEST(Argos3Tools, ColoursAreToldByNameIfTheyHaveOne)
{
  EXPECT_EQ(ToString(CColor::GRAY50), "gray50");
  EXPECT_EQ(ToString(CColor(1, 2, 3)), "1,2,3,255");
  CColor colour;
  colour.Set("10,20,30,40");
  EXPECT_EQ(colour, CColor(10, 20, 30, 40));
  EXPECT_EQ(static_cast<UInt32>(colour), 0x281e140aU);
  EXPECT_THROW(colour.Set("mauve"), CARGoSException);
  EXPECT_THROW(colour.Set("1,2,300"), CARGoSException);
  EXPECT_EQ(CColor(200, 100, 0, 51).Blend(CColor(0, 100, 50)), CColor(40, 100, 40)) << "a fifth of the colour";
  EXPECT_NEAR(CColor(255, 0, 0).ToGrayScale(), 76.245, 1e-9) << "not a whole number";
}

TEST(Argos3Tools, ByteArraysGiveTypedValues)
{
  CByteArray bytes;
  bytes << UInt32{7} << 2.5 << std::string("text");
  EXPECT_EQ(bytes.PopFront<UInt32>(), 7U);
  EXPECT_EQ(bytes.PopFront<double>(), 2.5);
  CByteArray other;
  bytes.Swap(other);
  EXPECT_TRUE(bytes.Empty());
  EXPECT_TRUE(bytes != other);
  EXPECT_EQ(other.PopFront<std::string>(), "text");
}

TEST(Argos3Tools, SetsAndAnysGiveWhatIsInThem)
{
  CSet<int> set;
  for (const int i : {3, 1, 2}) set.insert(i);
  EXPECT_EQ(set.first() * 10 + set.last(), 13);
  EXPECT_TRUE(set.exists(2));
  EXPECT_FALSE(set.exists(4));
  CAny any(5), none;
  any.swap(none);
  EXPECT_TRUE(any.IsEmpty());
  EXPECT_EQ(*any_cast<int>(&none), 5);
  EXPECT_EQ(any_cast<double>(&none), nullptr);
}

struct Remembered : public CMemento
{
  void SaveState(CByteArray& bytes) override { bytes << value; }
  void LoadState(CByteArray& bytes) override { bytes >> value; }
  SInt32 value = 0;
};

TEST(Argos3Tools, MementosAreRestored)
{
  Remembered one, other;
  one.value = -9;
  CByteArray bytes;
  one.SaveState(bytes);
  other.LoadState(bytes);
  EXPECT_EQ(other.value, -9);
}

TEST(Argos3Tools, OptionsOfProgramsAreParsed)
{
  bool flag = true, other_flag = false;
  UInt32 number = 0;
  std::string text;
  CCommandLineArgParser parser;
  parser.AddFlag('f', "flag", "a flag", flag);
  parser.AddFlag('g', "other", "another", other_flag);
  parser.AddArgument('n', "number", "a number", number);
  parser.AddArgument('t', "text", "a text", text);
  EXPECT_FALSE(flag);
  const auto parse = [&](std::vector<std::string> words)
  {
    std::vector<char*> pointers{nullptr};
    for (std::string& word : words) pointers.push_back(word.data());
    parser.Parse(static_cast<SInt32>(pointers.size()), pointers.data());
  };
  parse({"--number", "12", "-fgt", "two words"});
  EXPECT_TRUE(flag && other_flag);
  EXPECT_EQ(number, 12U);
  EXPECT_EQ(text, "two words");
  EXPECT_THROW(parse({"--nummer", "1"}), CARGoSException);
  EXPECT_THROW(parse({"--number"}), CARGoSException);
  EXPECT_THROW(parse({"-nf", "1"}), CARGoSException);
  EXPECT_THROW(parse({"word"}), CARGoSException);
}

TEST(Argos3Tools, SignalsHaveMeanAndVarianceAndAreSmoothed)
{
  CStats stats;
  for (const Real value : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) stats.Append(value);
  EXPECT_DOUBLE_EQ(stats.GetMean(), 5);
  EXPECT_DOUBLE_EQ(stats.GetVariance(), 32.0 / 7);
  CRCLowPassFilter filter(0.75);
  EXPECT_EQ(filter.Filter(8), 8);
  EXPECT_EQ(filter.Filter(0), 6);
  filter.Reset();
  EXPECT_EQ(filter.Filter(1), 1);
}

TEST(Argos3Tools, RatesKeepTheirPeriod)
{
  CRate rate(50);
  const auto start = std::chrono::steady_clock::now();
  rate.Sleep();
  rate.Sleep();
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(40));
  EXPECT_EQ(rate.GetRate(), 50);
  EXPECT_THROW(rate.SetRate(0), CARGoSException);
}

TEST(Argos3Tools, ProfilesAreWritten)
{
  const swarmanoid::test::TemporaryFolder folder;
  const std::string file = folder / "profile.txt";
  {
    CProfiler profiler(file);
    profiler.Start();
    profiler.Stop();
    profiler.Flush(true);
  }
  EXPECT_THAT(folder.Read("profile.txt"), testing::StartsWith("wall clock, s: "));
  EXPECT_THROW(CProfiler("/nowhere/profile"), CARGoSException);
}

TEST(Argos3Tools, LibrariesThatAreNotThereAreNamed)
{
  EXPECT_THAT(swarmanoid::test::MessageOf<CARGoSException>([&] { CDynamicLoading::LoadLibrary("no_such_library"); }),
              testing::HasSubstr("./no_such_library.so"));
}

TEST(Argos3Tools, SocketsCarryByteArrays)
{
  int ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  CTCPSocket one(ends[0]), other(ends[1]);
  CByteArray sent;
  sent << std::string("hello") << UInt16{3};
  one.SendByteArray(sent);
  CByteArray received;
  EXPECT_TRUE(other.ReceiveByteArray(received));
  EXPECT_EQ(received, sent);
  one.Disconnect();
  EXPECT_FALSE(one.IsConnected());
  EXPECT_FALSE(other.ReceiveByteArray(received));
  EXPECT_THROW(other.SendByteArray(sent), CARGoSException);
  EXPECT_THROW(CTCPSocket().Connect("localhost", 1), CARGoSException);
}

TEST(Argos3Tools, GraysAreTenthsOfWhite)
{
  const CColor grays[] = {CColor::GRAY10, CColor::GRAY20, CColor::GRAY30, CColor::GRAY40, CColor::GRAY50,
                          CColor::GRAY60, CColor::GRAY70, CColor::GRAY80, CColor::GRAY90};
  for (int tenths = 1; tenths <= 9; ++tenths)
  {
    const CColor& gray = grays[tenths - 1];
    EXPECT_NEAR(gray.GetRed(), 25.5 * tenths, 0.6) << tenths;
    EXPECT_EQ(gray.GetGreen(), gray.GetRed()) << tenths;
    EXPECT_EQ(gray.GetBlue(), gray.GetRed()) << tenths;
    EXPECT_EQ(gray.GetAlpha(), 255) << tenths;
  }
}

TEST(Argos3Tools, ARateTellsMicrosecondsAndSeconds)
{
  const CRate rate(10);
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const UInt64 before = rate.ElapsedUS();
  const Real seconds = rate.ElapsedS();
  const UInt64 after = rate.ElapsedUS();
  EXPECT_GE(before, 2'000U);
  EXPECT_GE(seconds, 1e-6 * static_cast<Real>(before) * (1 - 1e-9));
  EXPECT_LE(seconds, 1e-6 * static_cast<Real>(after) * (1 + 1e-9));
}

TEST(Argos3Tools, ColoursHaveTheNamesOfFiles)
{
  const std::tuple<std::string, CColor, CColor> colours[] = {
      {"black", CColor::BLACK, CColor(0, 0, 0)},         {"white", CColor::WHITE, CColor(255, 255, 255)},
      {"red", CColor::RED, CColor(255, 0, 0)},           {"green", CColor::GREEN, CColor(0, 255, 0)},
      {"blue", CColor::BLUE, CColor(0, 0, 255)},         {"magenta", CColor::MAGENTA, CColor(255, 0, 255)},
      {"cyan", CColor::CYAN, CColor(0, 255, 255)},       {"yellow", CColor::YELLOW, CColor(255, 255, 0)},
      {"orange", CColor::ORANGE, CColor(255, 140, 0)},   {"brown", CColor::BROWN, CColor(165, 42, 42)},
      {"purple", CColor::PURPLE, CColor(160, 32, 240)},  {"gray10", CColor::GRAY10, CColor(26, 26, 26)},
      {"gray20", CColor::GRAY20, CColor(51, 51, 51)},    {"gray30", CColor::GRAY30, CColor(77, 77, 77)},
      {"gray40", CColor::GRAY40, CColor(102, 102, 102)}, {"gray50", CColor::GRAY50, CColor(127, 127, 127)},
      {"gray60", CColor::GRAY60, CColor(153, 153, 153)}, {"gray70", CColor::GRAY70, CColor(179, 179, 179)},
      {"gray80", CColor::GRAY80, CColor(204, 204, 204)}, {"gray90", CColor::GRAY90, CColor(229, 229, 229)}};
  for (const auto& [name, constant, channels] : colours)
  {
    EXPECT_EQ(constant, channels) << name;
    EXPECT_EQ(ToString(constant), name);
    CColor read;
    read.Set(name);
    EXPECT_EQ(read, channels) << name;
  }
}

TEST(Argos3Tools, ColoursHaveFourChannels)
{
  EXPECT_EQ(CColor(), CColor(0, 0, 0, 255));
  EXPECT_EQ(CColor(0x80102030U), CColor(16, 32, 48, 128));
  CColor colour(1, 2, 3, 4);
  for (const CColor& other : {CColor(0, 2, 3, 4), CColor(1, 0, 3, 4), CColor(1, 2, 0, 4), CColor(1, 2, 3, 0)})
    EXPECT_TRUE(colour != other && !(colour == other)) << other;
  colour.SetRed(9);
  colour.SetGreen(8);
  colour.SetBlue(7);
  colour.SetAlpha(6);
  EXPECT_EQ(ToString(colour), "9,8,7,6");
  colour.Set(5, 4, 3);
  EXPECT_EQ(colour, CColor(5, 4, 3, 255));
  colour.Set(5, 4, 3, 2);
  EXPECT_EQ(colour.GetAlpha(), 2);
  colour.Set("0,128,255");
  EXPECT_EQ(colour, CColor(0, 128, 255, 255));
  EXPECT_EQ(colour.GetRed(), 0);
  EXPECT_EQ(colour.GetGreen(), 128);
  EXPECT_EQ(colour.GetBlue(), 255);
  for (const char* wrong : {"256,0,0", "0,-1,0", "0,0,256", "0,0,0,256", "1,2", ""})
    EXPECT_THROW(colour.Set(wrong), CARGoSException) << wrong;
  std::istringstream stream("1,2,3,4");
  stream >> colour;
  EXPECT_EQ(colour, CColor(1, 2, 3, 4));
  EXPECT_FALSE(stream.fail());
  EXPECT_NEAR(CColor(0, 255, 0).ToGrayScale(), 149.685, 1e-9);
  EXPECT_NEAR(CColor(0, 0, 255).ToGrayScale(), 29.07, 1e-9);
  EXPECT_NEAR(CColor::WHITE.ToGrayScale(), 255, 1e-9);
  EXPECT_EQ(CColor(1, 2, 3, 255).Blend(CColor(9, 9, 9, 0)), CColor(1, 2, 3)) << "opaque";
  EXPECT_EQ(CColor(1, 2, 3, 0).Blend(CColor(9, 8, 7, 0)), CColor(9, 8, 7)) << "clear";
}

TEST(Argos3Tools, ByteArraysGrowAndShrink)
{
  const UInt8 four[]{1, 2, 3, 4};
  CByteArray bytes(four, 4);
  EXPECT_EQ(ToString(bytes), "1 2 3 4");
  UInt8 fetched[3]{};
  bytes.FetchBuffer(fetched, 3);
  EXPECT_EQ(fetched[0] * 100 + fetched[1] * 10 + fetched[2], 123);
  EXPECT_EQ(ToString(bytes), "4");
  EXPECT_THROW(bytes.FetchBuffer(fetched, 2), CARGoSException);
  bytes.AddBuffer(four, 2).AddBuffer(four, 1);
  EXPECT_EQ(ToString(bytes), "4 1 2 1");
  bytes.PopFront(1);
  EXPECT_EQ(ToString(bytes), "1 2 1");
  bytes.Resize(5, 9);
  EXPECT_EQ(ToString(bytes), "1 2 1 9 9");
  bytes.Resize(6);
  EXPECT_EQ(bytes[5], 0);
  EXPECT_EQ(bytes.ToCArray()[3], 9);
  bytes[0] = 200;
  EXPECT_EQ(std::as_const(bytes)[0], 200);
  EXPECT_THROW(static_cast<void>(std::as_const(bytes)[6]), CARGoSException);
  bytes.Zero();
  EXPECT_EQ(bytes, CByteArray(6));
  EXPECT_EQ(CByteArray(2, 7)[1], 7);
  bytes.PopFront(99);
  EXPECT_TRUE(bytes.Empty());
  EXPECT_EQ(bytes.ToCArray(), nullptr);
  EXPECT_EQ(std::as_const(bytes).ToCArray(), nullptr);
  bytes << UInt16{5};
  EXPECT_FALSE(bytes.Empty());
  bytes.Clear();
  EXPECT_EQ(bytes.Size(), 0U);
  EXPECT_EQ(ToString(bytes), "");
  bytes.AddBuffer(four, 2);
  std::string text;
  EXPECT_THROW(bytes >> text, CARGoSException) << "no zero ends it";
  bytes << UInt8{0} << std::string() << float{0.5F} << SInt64{-3};
  bytes >> text;
  EXPECT_EQ(text, "\x01\x02");
  EXPECT_EQ(bytes.PopFront<std::string>(), "");
  EXPECT_EQ(bytes.PopFront<float>(), 0.5F);
  EXPECT_EQ(bytes.PopFront<SInt64>(), -3);
}

TEST(Argos3Tools, AnysAndSetsAreCopied)
{
  const CAny number(5);
  const CAny copy = number;
  EXPECT_EQ(any_cast<int>(copy), 5);
  EXPECT_FALSE(copy.IsEmpty());
  EXPECT_THROW(any_cast<double>(copy), std::bad_cast);
  EXPECT_THROW(any_cast<int>(CAny()), std::bad_cast);
  EXPECT_EQ(any_cast<int>(static_cast<const CAny*>(nullptr)), nullptr);
  const CSet<int> set{3, 1, 2};
  const CSet<int, std::greater<int>> turned = set;
  EXPECT_EQ(turned.first() * 10 + turned.last(), 31);
  EXPECT_TRUE(turned.exists(3));
}

TEST(Argos3Tools, TextsOfValues)
{
  EXPECT_EQ(ToString(true), "true");
  EXPECT_EQ(FromString<bool>("true"), true);
  EXPECT_EQ(FromString<int>("12"), 12);
  EXPECT_EQ(FromString<int>("none"), 0);
  EXPECT_EQ(StringToUpperCase("Abc-1"), "ABC-1");
  EXPECT_EQ(StringToLowerCase("AbC-1"), "abc-1");
  std::string text = "aaa";
  Replace(text, "", "b");
  EXPECT_EQ(text, "aaa");
  Replace(text, "a", "aa");
  EXPECT_EQ(text, "aaaaaa");
  std::vector<std::string> words{"before"};
  Tokenize("one two", words);
  EXPECT_EQ(words, (std::vector<std::string>{"before", "one", "two"}));
  Tokenize("  ", words);
  EXPECT_EQ(words.size(), 3U);
  EXPECT_TRUE(MatchPattern("robot_7", "t_7")) << "a part is enough";
  text = "$$HOME_OF_THIS_TEST_IS_UNSET $";
  EXPECT_EQ(ExpandEnvVariables(text), "$$HOME_OF_THIS_TEST_IS_UNSET $");
  setenv("ARGOS3_TEST_WORD_1", "w", 1);
  text = "a$ARGOS3_TEST_WORD_1-$ARGOS3_TEST_WORD_1";
  EXPECT_EQ(ExpandEnvVariables(text), "aw-w");
  int numbers[3] = {7, 7, 7};
  ParseValues<int>("1,,3", 3, numbers, ',');
  EXPECT_EQ(numbers[0] * 100 + numbers[1] * 10 + numbers[2], 173) << "an empty field changes nothing";
  EXPECT_EQ(swarmanoid::test::MessageOf<CARGoSException>([&] { ParseValues<int>("1,2", 3, numbers, ','); }),
            "expected 3 values, found 2");
  ParseValues<int>("4\n5", 2, numbers);
  EXPECT_EQ(numbers[0] * 10 + numbers[1], 45) << "lines, unless a delimiter is given";
}

TEST(Argos3Tools, ExceptionsTellTheirCause)
{
  const auto message = swarmanoid::test::MessageOf<CARGoSException>(
      []
      {
        try
        {
          THROW_ARGOSEXCEPTION("no value " << 5);
        }
        catch (CARGoSException& cause)
        {
          THROW_ARGOSEXCEPTION_NESTED("robot " << 1, cause);
        }
      });
  EXPECT_EQ(message, "robot 1: no value 5");
}

TEST(Argos3Tools, ElementsHaveTexts)
{
  ticpp::Document document;
  document.Parse("<a><b>12</b><b x='1' y='2'/><c>true</c></a>");
  TConfigurationNode& a = *document.FirstChildElement();
  int number = 0;
  GetNodeText(GetNode(a, "b"), number);
  EXPECT_EQ(number, 12);
  TConfigurationNode& second = *GetNode(a, "b").NextSiblingElement();
  EXPECT_EQ(second.Value(), "b");
  GetNodeTextOrDefault(second, number, 5);
  EXPECT_EQ(number, 5);
  GetNodeTextOrDefault(GetNode(a, "b"), number, 5);
  EXPECT_EQ(number, 12);
  EXPECT_THROW(GetNodeText(second, number), CARGoSException);
  bool flag = false;
  GetNodeText(GetNode(a, "c"), flag);
  EXPECT_TRUE(flag);
  EXPECT_THROW(GetNodeText(GetNode(a, "b"), flag), CARGoSException) << "12 is neither true nor false";
  GetNode(a, "b").GetTextOrDefault(&number, 3);
  EXPECT_EQ(number, 12);
  second.GetTextOrDefault(&number, 3);
  EXPECT_EQ(number, 3);
  second.SetText("7");
  second.GetText(&number);
  EXPECT_EQ(number, 7);
  EXPECT_EQ(second.GetText(), "7");
  EXPECT_TRUE(second.NoChildren());
  EXPECT_FALSE(a.NoChildren());
  std::string name;
  second.GetValue(&name);
  EXPECT_EQ(name, "b");
}

TEST(Argos3Tools, AttributesAreSetReadAndRemoved)
{
  TConfigurationNode node("node");
  SetNodeAttribute(node, "flag", false);
  SetNodeAttribute(node, "small", -5);
  SetNodeAttribute(node, "small", -6);
  EXPECT_EQ(ToString(node), "<node flag=\"false\" small=\"-6\"/>") << "a second value replaces the first one";
  SInt8 small = 0;
  GetNodeAttribute(node, "small", small);
  EXPECT_EQ(small, -6);
  bool flag = true;
  GetNodeAttributeOrDefault(node, "flag", flag, true);
  EXPECT_FALSE(flag);
  EXPECT_THROW(GetNodeAttribute(node, "small", flag), CARGoSException);
  int number = 3;
  node.GetAttribute("none", &number, false);
  EXPECT_EQ(number, 3);
  node.GetAttributeOrDefault("none", &number, 8);
  EXPECT_EQ(number, 8);
  node.GetAttributeOrDefault("small", &number, 8);
  EXPECT_EQ(number, -6);
  EXPECT_THROW(node.GetAttribute("none", &number), ticpp::Exception);
  EXPECT_EQ(node.GetAttribute("none"), "");
  EXPECT_EQ(swarmanoid::test::MessageOf<CARGoSException>([&] { GetNodeAttribute(node, "none", number); }),
            "<node> has no attribute 'none'");
  std::string names;
  TConfigurationAttributeIterator it;
  for (it = it.begin(&node); it != it.end(); ++it) names += it->Name() + "=" + (*it).Value() + " ";
  EXPECT_EQ(names, "flag=false small=-6 ");
  node.RemoveAttribute("flag");
  EXPECT_FALSE(NodeAttributeExists(node, "flag"));
  EXPECT_TRUE(NodeAttributeExists(node, "small"));
  node.RemoveAttribute("small");
  EXPECT_TRUE(it.begin(&node) == it.end());
  ticpp::Attribute attribute("name", "2.5");
  double value = 0;
  attribute.GetValue(&value);
  attribute.GetName(&names);
  EXPECT_EQ(value, 2.5);
  EXPECT_EQ(names, "name");
  attribute.SetValue("3");
  EXPECT_EQ(attribute.Value(), "3");
}

TEST(Argos3Tools, ElementsAreWrittenWithTheirChildrenIndented)
{
  TConfigurationNode top("top"), child("child"), leaf("leaf");
  leaf.SetText("<&>\"");
  AddChildNode(child, leaf);
  AddChildNode(top, child);
  AddChildNode(top, leaf);
  EXPECT_EQ(
      ToString(top),
      "<top>\n  <child>\n    <leaf>&lt;&amp;&gt;&quot;</leaf>\n  </child>\n  <leaf>&lt;&amp;&gt;&quot;</leaf>\n</top>");
  EXPECT_TRUE(NodeExists(top, "leaf"));
  EXPECT_FALSE(NodeExists(top, "top"));
  TConfigurationNode& first = GetNode(top, "child");
  EXPECT_EQ(first.NextSiblingElement("leaf")->Value(), "leaf");
  EXPECT_THROW(first.NextSiblingElement("child"), ticpp::Exception);
  EXPECT_THROW(first.FirstChildElement("none"), ticpp::Exception);
  EXPECT_EQ(first.FirstChildElement("none", false), nullptr);
  EXPECT_THROW(top.RemoveChild(&top), ticpp::Exception);
  TConfigurationNode kept = first;
  top.RemoveChild(&first);
  EXPECT_EQ(top.FirstChildElement()->Value(), "leaf");
  EXPECT_EQ(kept.NextSiblingElement(false), nullptr) << "it has no siblings any more";
  // The elements behind a removed element follow each other.
  for (const char* name : {"x", "y", "z"}) top.InsertEndChild(TConfigurationNode(name));
  top.RemoveChild(top.FirstChildElement("x"));
  EXPECT_EQ(top.FirstChildElement("leaf")->NextSiblingElement()->Value(), "y");
  EXPECT_EQ(top.FirstChildElement("y")->NextSiblingElement()->Value(), "z");
  EXPECT_EQ(top.FirstChildElement("z")->NextSiblingElement(false), nullptr);
  TConfigurationNodeIterator it;
  it = it.begin(&top);
  TConfigurationNodeIterator before = it++;
  EXPECT_EQ(before->Value() + it->Value(), "leafy");
  EXPECT_TRUE(it == top.FirstChildElement("y"));
  EXPECT_TRUE(it != top.FirstChildElement("z"));
  EXPECT_EQ(it.Get(), top.FirstChildElement("y"));
}

TEST(Argos3Tools, DocumentsHoldTheirLastText)
{
  ticpp::Document document("file.argos");
  EXPECT_EQ(document.Value(), "file.argos");
  document.Parse("<a/>");
  document.Parse("<b/>");
  EXPECT_EQ(document.FirstChildElement()->Value(), "b");
  EXPECT_EQ(document.FirstChildElement()->NextSiblingElement(false), nullptr);
  document.Parse("<c x=1/>");
  EXPECT_EQ(document.FirstChildElement()->GetAttribute("x"), "1") << "as TinyXML reads it";
  EXPECT_EQ(document.FirstChildElement()->Place(), "file.argos:1:1");
  EXPECT_THROW(document.SaveFile("/nowhere/x.argos"), ticpp::Exception);
  const swarmanoid::test::TemporaryFolder folder;
  document.SetValue(folder / "y.argos");
  document.SaveFile();
  EXPECT_EQ(folder.Read("y.argos"), "<c x=\"1\"/>\n");
}

TEST(Argos3Tools, LogsAreLinesWithoutColoursInAFile)
{
  const swarmanoid::test::TemporaryFolder folder;
  CARGoSLog log("error: ");
  EXPECT_FALSE(log.IsColoredOutput());
  log.RedirectToFile(folder / "log.txt");
  log << "one " << 1.5 << red << " red" << reset << " " << true;
  EXPECT_EQ(folder.Read("log.txt"), "") << "a line is written when it ends";
  log << std::endl << "two\nthree";
  EXPECT_EQ(folder.Read("log.txt"), "error: one 1.5 red true\nerror: two\n");
  log << std::endl;
  EXPECT_EQ(folder.Read("log.txt"), "error: one 1.5 red true\nerror: two\nerror: three\n");
  EXPECT_THROW(log.RedirectToFile("/nowhere/log"), CARGoSException);
  std::ostringstream other;
  log.GetStream().rdbuf(other.rdbuf());
  log << "four" << std::endl;
  EXPECT_EQ(other.str(), "error: four\n");
}

TEST(Argos3Tools, ColoursOfTerminalsAreThoseOfAnsi)
{
  const std::tuple<std::ostream& (*)(std::ostream&), const char*> manipulators[] = {
      {red, "\033[1;31m"},     {green, "\033[1;32m"}, {yellow, "\033[1;33m"}, {blue, "\033[1;34m"},
      {magenta, "\033[1;35m"}, {cyan, "\033[1;36m"},  {white, "\033[1;37m"},  {reset, "\033[0m"}};
  for (const auto& [manipulator, code] : manipulators)
  {
    std::ostringstream text;
    text << manipulator;
    EXPECT_EQ(text.str(), code);
  }
  EXPECT_EQ(ToString(SLogColor()), "\033[0;37m");
  const std::pair<EARGoSLogAttributes, int> attributes[] = {{ARGOS_LOG_ATTRIBUTE_DIM, 2},
                                                            {ARGOS_LOG_ATTRIBUTE_UNDERSCORE, 3},
                                                            {ARGOS_LOG_ATTRIBUTE_BLINK, 5},
                                                            {ARGOS_LOG_ATTRIBUTE_REVERSE, 7},
                                                            {ARGOS_LOG_ATTRIBUTE_HIDDEN, 8}};
  for (const auto& [attribute, code] : attributes)
    EXPECT_EQ(ToString(SLogColor(attribute, ARGOS_LOG_COLOR_BLACK)), "\033[" + std::to_string(code) + ";30m");
}

TEST(Argos3Tools, UsageListsTheOptions)
{
  bool flag = false;
  int number = 4;
  CCommandLineArgParser parser;
  parser.AddFlag('f', "flag", "a flag", flag);
  parser.AddArgument('n', "number", "a number", number);
  std::ostringstream text;
  CARGoSLog log("");
  log.GetStream().rdbuf(text.rdbuf());
  parser.PrintUsage(log);
  EXPECT_EQ(text.str(), "-f|--flag\ta flag\n-n|--number <value>\ta number\n");
  EXPECT_EQ(number, 4) << "a value stays until the option is found";
  std::string program = "program", option = "--flag", value = "-";
  char* words[] = {program.data(), option.data(), value.data()};
  EXPECT_THROW(parser.Parse(3, words), CARGoSException) << "a hyphen alone is no option";
  flag = false;
  parser.Parse(2, words);
  EXPECT_TRUE(flag);
  std::string last = "-n", five = "5";
  char* behind[] = {program.data(), last.data(), five.data()};
  EXPECT_THROW(parser.Parse(2, behind), CARGoSException);
  parser.Parse(3, behind);
  EXPECT_EQ(number, 5);
}

TEST(Argos3Tools, ProfilesAreNumbersInALine)
{
  const swarmanoid::test::TemporaryFolder folder;
  const std::string file = folder / "profile.txt";
  const auto measure = [&](bool truncates, bool human_readable)
  {
    CProfiler profiler(file, truncates);
    profiler.Start();
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    profiler.Stop();
    profiler.Flush(human_readable);
    return folder.Read("profile.txt");
  };
  const std::string one = measure(true, false);
  EXPECT_EQ(std::count(one.begin(), one.end(), '\t'), 3);
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 1);
  EXPECT_EQ(one.back(), '\n');
  double wall = 0, user = 0, system = 0, memory = 0;
  std::istringstream(one) >> wall >> user >> system >> memory;
  EXPECT_GE(wall, 0.003);
  EXPECT_GE(user, 0);
  EXPECT_GE(system, 0);
  EXPECT_LE(user + system, 10 * wall + 1);
  EXPECT_GT(memory, 1000) << "KiB of this process";
  const std::string both = measure(false, true);
  EXPECT_THAT(both, testing::StartsWith(one + "wall clock, s: ")) << "the first line is kept";
  EXPECT_EQ(std::count(both.begin(), both.end(), '\n'), 5);
  EXPECT_THAT(measure(true, true), testing::StartsWith("wall clock, s: "));
}

TEST(Argos3Tools, ARateTellsThatItsPeriodIsOver)
{
  std::ostringstream text;
  std::streambuf* const before = LOGERR.GetStream().rdbuf(text.rdbuf());
  CRate rate(1000);
  EXPECT_EQ(rate.GetRate(), 1000);
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  rate.Sleep();
  EXPECT_THAT(text.str(), testing::StartsWith("error: a period of 0.001 s was over after 0.0"));
  rate.SetRate(20);
  EXPECT_LT(rate.ElapsedS(), 5) << "it starts now";
  text.str("");
  rate.Sleep();
  LOGERR.GetStream().rdbuf(before);
  EXPECT_EQ(text.str(), "");
  EXPECT_THROW(rate.SetRate(-1), CARGoSException);
  EXPECT_EQ(rate.GetRate(), 20);
}

// Returns a port at which no program listens.
SInt32 FreePort()
{
  const int stream = ::socket(AF_INET, SOCK_STREAM, 0);
  ::sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ::socklen_t length = sizeof address;
  EXPECT_EQ(::bind(stream, reinterpret_cast<::sockaddr*>(&address), length), 0);
  EXPECT_EQ(::getsockname(stream, reinterpret_cast<::sockaddr*>(&address), &length), 0);
  ::close(stream);
  return ntohs(address.sin_port);
}

TEST(Argos3Tools, SocketsConnectToEachOther)
{
  const SInt32 port = FreePort();
  CTCPSocket server, accepted, client;
  EXPECT_FALSE(server.IsConnected());
  EXPECT_EQ(server.GetStream(), -1);
  std::thread listening([&] { server.Accept(accepted, port); });
  while (!client.IsConnected())
  {
    try
    {
      client.Connect("localhost", port);
    }
    catch (const CARGoSException&)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  listening.join();
  EXPECT_TRUE(accepted.IsConnected() && server.IsConnected());
  // The parts of a buffer may come one after the other.
  const UInt8 sent[]{1, 2, 3, 4, 5};
  std::thread sending(
      [&]
      {
        client.SendBuffer(sent, 2);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        client.SendBuffer(sent + 2, 3);
      });
  UInt8 received[5]{};
  EXPECT_TRUE(accepted.ReceiveBuffer(received, 5));
  sending.join();
  EXPECT_TRUE(std::equal(sent, sent + 5, received));
  accepted.SendByteArray(CByteArray());
  CByteArray bytes(3);
  EXPECT_TRUE(client.ReceiveByteArray(bytes));
  EXPECT_TRUE(bytes.Empty());
  // A stream that ends within a buffer gives none.
  client.SendBuffer(sent, 4);
  client.Disconnect();
  EXPECT_FALSE(accepted.ReceiveBuffer(received, 5));
  EXPECT_EQ(client.GetStream(), -1);
  CTCPSocket other;
  EXPECT_THROW(other.Accept(accepted, -5), CARGoSException);
}

TEST(Argos3Tools, RandomGeneratorsDrawFromTheirRanges)
{
  CRandom::CRNG random(11);
  EXPECT_EQ(random.GetSeed(), 11U);
  EXPECT_EQ(random.GetType(), "philox4x32");
  constexpr int kMany = 20000;
  int heads = 0, rare = 0;
  double angles = 0, logarithms = 0;
  for (int i = 0; i < kMany; ++i)
  {
    heads += random.Bernoulli() ? 1 : 0;
    rare += random.Bernoulli(0.1) ? 1 : 0;
    const CRadians angle = random.Uniform(CRange<CRadians>(CRadians(1), CRadians(3)));
    ASSERT_TRUE(angle >= CRadians(1) && angle < CRadians(3));
    angles += angle.GetValue();
    const UInt32 whole = random.Uniform(CRange<UInt32>(5, 8));
    ASSERT_TRUE(whole >= 5 && whole < 8);
    logarithms += std::log(random.Lognormal(0.5, 2));
  }
  // The limits are four standard errors.
  EXPECT_NEAR(heads, kMany * 0.5, 4 * std::sqrt(kMany * 0.25));
  EXPECT_NEAR(rare, kMany * 0.1, 4 * std::sqrt(kMany * 0.09));
  EXPECT_NEAR(angles / kMany, 2, 4 * 2 / std::sqrt(12.0 * kMany));
  EXPECT_NEAR(logarithms / kMany, 2, 4 * 0.5 / std::sqrt(kMany));
  EXPECT_FALSE(random.Bernoulli(0));
  EXPECT_TRUE(random.Bernoulli(1));
  EXPECT_EQ(random.Uniform(CRange<UInt32>(5, 5)), 5U) << "an empty range gives its lower limit";
  EXPECT_EQ(random.Uniform(CRange<SInt32>(-5, -5)), -5);
  EXPECT_EQ(random.Uniform(CRange<SInt32>(-5, -4)), -5);
  EXPECT_THROW(random.Poisson(701), CARGoSException);
  EXPECT_GT(random.Poisson(700), 500U);

  // A new seed counts from the next reset on, and a copy begins at the start.
  const Real next = CRandom::CRNG(random).Gaussian(1);
  EXPECT_EQ(next, CRandom::CRNG(11).Gaussian(1));
  random.Reset();
  random.SetSeed(12);
  EXPECT_EQ(random.Gaussian(1), next);
  random.Reset();
  EXPECT_EQ(random.Gaussian(1), CRandom::CRNG(12).Gaussian(1));
  EXPECT_NE(CRandom::CRNG(12).Gaussian(1), next);
}

TEST(Argos3Tools, CategoriesOfRandomNumbersHaveSeeds)
{
  EXPECT_TRUE(CRandom::ExistsCategory("argos"));
  EXPECT_TRUE(CRandom::CreateCategory("seeds", 3));
  EXPECT_FALSE(CRandom::CreateCategory("seeds", 4)) << "it exists";
  EXPECT_EQ(CRandom::GetSeedOf("seeds"), 3U);
  CRandom::CCategory& category = CRandom::GetCategory("seeds");
  EXPECT_EQ(category.GetId(), "seeds");
  CRandom::CRNG* const first = CRandom::CreateRNG("seeds");
  CRandom::CRNG* const second = category.CreateRNG();
  const Real one = first->Gaussian(1), other = second->Gaussian(1);
  EXPECT_NE(one, other);
  EXPECT_NE(first->Gaussian(1), one);
  category.ResetRNGs();
  EXPECT_EQ(first->Gaussian(1), one);
  EXPECT_EQ(second->Gaussian(1), other);
  // Generators get a new seed, which counts from their next reset on.
  CRandom::SetSeedOf("seeds", 9);
  EXPECT_EQ(category.GetSeed(), 9U);
  category.ResetRNGs();
  const Real changed = first->Gaussian(1);
  EXPECT_NE(changed, one);
  EXPECT_NE(changed, second->Gaussian(1));
  category.SetSeed(9);
  category.ResetRNGs();
  EXPECT_EQ(first->Gaussian(1), changed) << "the same seed gives the same numbers";
  // A variation changes the numbers, and 0 brings them back.
  category.Vary(5);
  category.ResetRNGs();
  const Real varied = first->Gaussian(1);
  EXPECT_NE(varied, changed);
  category.Vary(6);
  category.ResetRNGs();
  EXPECT_NE(first->Gaussian(1), varied);
  category.Vary(5);
  category.ResetRNGs();
  EXPECT_EQ(first->Gaussian(1), varied);
  category.Vary(0);
  category.ResetRNGs();
  EXPECT_EQ(first->Gaussian(1), changed);
  category.SetId("renamed");
  EXPECT_EQ(category.GetId(), "renamed");
  EXPECT_THROW(CRandom::GetCategory("none"), CARGoSException);
  EXPECT_THROW(CRandom::RemoveCategory("none"), CARGoSException);
  CRandom::Reset();
  EXPECT_FALSE(CRandom::ExistsCategory("seeds"));
  EXPECT_TRUE(CRandom::ExistsCategory("argos"));
}

TEST(Argos3Tools, StatisticsOfFewNumbers)
{
  CStats stats;
  EXPECT_EQ(stats.GetMean(), 0);
  EXPECT_EQ(stats.GetVariance(), 0);
  stats.Append(5);
  EXPECT_EQ(stats.GetMean(), 5);
  EXPECT_EQ(stats.GetVariance(), 0) << "one number has no variance";
  stats.Append(8);
  EXPECT_DOUBLE_EQ(stats.GetVariance(), 4.5);
  EXPECT_DOUBLE_EQ(stats.GetStdDev(), std::sqrt(4.5));
  CRCLowPassFilter follows(0), stays(1);
  for (const Real input : {3.0, 9.0})
  {
    EXPECT_EQ(follows.Filter(input), input);
    EXPECT_EQ(stays.Filter(input), 3);
  }
}

}  // namespace
