// Tests ARGoS3's utilities other than mathematics: colours, bytes, options, statistics, sockets.
#include <argos3/core/utility/configuration/command_line_arg_parser.h>
#include <argos3/core/utility/configuration/memento.h>
#include <argos3/core/utility/datatypes/any.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/core/utility/datatypes/set.h>
#include <argos3/core/utility/networking/tcp_socket.h>
#include <argos3/core/utility/plugins/dynamic_loading.h>
#include <argos3/core/utility/profiler/profiler.h>
#include <argos3/core/utility/rate.h>
#include <argos3/core/utility/signal_processing.h>
#include <gmock/gmock.h>
#include <sys/socket.h>

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

}  // namespace
