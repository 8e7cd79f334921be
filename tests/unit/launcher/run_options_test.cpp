// The table of run settings: the allowed command lines, and the command lines of processes that are written from it.
#include "common/run/run_options.h"
#include "common/run/access/addresses.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "common/program/usage_error.h"
#include "common/run/access/cluster_options.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

void Parse(const std::vector<OptionSpec>& options, std::vector<std::string> words)
{
  CLI::App app("", "test");
  AddOptions(app, options);
  std::reverse(words.begin(), words.end());
  app.parse(words);
}

std::string ErrorOf(const std::vector<std::string>& words)
{
  RunSettings settings;
  return test::MessageOf<UsageError>([&] { Parse(RunOptionTable(settings), words); }, "no error");
}

// A text that the option takes, and that is not its default.
std::string Taken(const OptionSpec& option)
{
  if (option.value.type == ParameterType::kPath) return "/proc/self/status";
  if (!option.value.choices.empty()) return option.value.choices.back();
  return option.example;
}

// All options of a table at once, given and read again; the texts of every target must be the same.
template <class Settings>
void ExpectRoundTrip(std::vector<OptionSpec> (*table)(Settings&))
{
  Settings first, second, untouched;
  std::vector<std::string> words;
  std::size_t given = 0;
  for (const OptionSpec& option : table(untouched))
  {
    const bool positional = std::isupper(static_cast<unsigned char>(option.value.name[0])) != 0;
    ++given;
    if (!positional) words.push_back("--" + option.value.name);
    if (!std::holds_alternative<bool*>(option.target)) words.push_back(Taken(option));
  }
  Parse(table(first), words);
  const std::vector<std::string> written = WordsOf(table(first), table(untouched));
  Parse(table(second), written);
  EXPECT_EQ(WordsOf(table(second), table(untouched)), written);
  EXPECT_EQ(written, words) << "each of the " << given << " options is written as it was given";
}

TEST(RunSettings, EverySettingIsReadAndWrittenAlike)
{
  ExpectRoundTrip(RunOptionTable);
  ExpectRoundTrip(ServerOptionTable);
  ExpectRoundTrip(EngineOptionTable);
  ExpectRoundTrip(HostOptionTable);
  ExpectRoundTrip(VisualiserOptionTable);
  ExpectRoundTrip(BusOptionTable);
}

TEST(RunSettings, TheServerGetsWhatTheLauncherGot)
{
  RunSettings given;
  Parse(RunOptionTable(given), {"relative.xml",
                                "--seed",
                                "9",
                                "--ticks",
                                "0",
                                "--set",
                                "a.b=c d",
                                "--set",
                                "x=--y",
                                "--real-time",
                                "0.1",
                                "--paused",
                                "--no-visualisers",
                                "--hash-log",
                                "log.txt",
                                "--checkpoint-every",
                                "300",
                                "--controller-hosts",
                                "3",
                                "--quiet"});
  RunSettings server;
  Parse(ServerOptionTable(server), ServerWords(given));
  EXPECT_EQ(server.file, std::filesystem::absolute("relative.xml"));
  EXPECT_EQ(server.seed, 9U);
  EXPECT_EQ(server.ticks, 0U);
  EXPECT_THAT(server.settings, ElementsAre("a.b=c d", "x=--y"));
  EXPECT_EQ(server.real_time_factor, 0.1);
  EXPECT_TRUE(server.paused);
  EXPECT_FALSE(server.visualisations);
  EXPECT_EQ(server.hash_log, std::filesystem::absolute("log.txt"));
  EXPECT_EQ(server.checkpoint_every, 300U);
  EXPECT_EQ(server.controller_hosts, 3U);
}

// Ids of an experiment become values of options of its processes.
TEST(RunSettings, AnIdThatLooksLikeAnOptionStaysTheValueOfItsOption)
{
  for (const char* id : {"--insecure", "-h", "--engine"})
  {
    WorkerSettings read;
    Parse(EngineOptionTable(read), WorkerWords(EngineOptionTable, {.engine = id}));
    EXPECT_EQ(read.engine, id);
  }
}

TEST(RunSettings, WordsSayOnlyWhatDiffers)
{
  RunSettings settings;
  settings.file = "/a.xml";
  EXPECT_THAT(ServerWords(settings), ElementsAre("/a.xml"));
  EXPECT_THAT(WorkerWords(EngineOptionTable, {.experiment = "e", .engine = "ground"}),
              ElementsAre("--engine", "ground", "--experiment", "e"));
  BusOptions bus;
  bus.peers = {"alpha", "beta"};
  EXPECT_THAT(BusWords(bus), ElementsAre("--peers", "alpha,beta"));
}

TEST(RunSettings, NumbersOutsideTheirRangeAreRefusedWithTheCure)
{
  EXPECT_THAT(ErrorOf({"a.xml", "--real-time", "nan"}),
              AllOf(HasSubstr("--real-time is 'nan'"), HasSubstr("a number, from 0 to"), HasSubstr("for example")));
  EXPECT_THAT(ErrorOf({"a.xml", "--real-time", "inf"}), HasSubstr("'inf'"));
  EXPECT_THAT(ErrorOf({"a.xml", "--real-time", "-1"}), HasSubstr("--real-time is -1; it must be from 0"));
  EXPECT_THAT(ErrorOf({"a.xml", "--ticks", "-1"}), HasSubstr("--ticks is -1; it must be from 0"));
  EXPECT_THAT(ErrorOf({"a.xml", "--ticks", "1.5"}), HasSubstr("a whole number"));
  EXPECT_THAT(ErrorOf({"a.xml", "--ticks", "99999999999999999999"}), HasSubstr("a whole number"));
  EXPECT_THAT(ErrorOf({"a.xml", "--seed", "-1"}), HasSubstr("--seed is -1"));
  EXPECT_THAT(ErrorOf({"a.xml", "--seed", "0x7"}), HasSubstr("'0x7'"));
  EXPECT_THAT(ErrorOf({"a.xml", "--domain", "233"}), HasSubstr("from 0 to 232"));
  EXPECT_THAT(ErrorOf({"a.xml", "--controller-hosts", "0"}), HasSubstr("from 1 to 1000"));
  EXPECT_THAT(ErrorOf({"a.xml", "--checkpoint-every", "-5"}), HasSubstr("--checkpoint-every is -5"));
  EXPECT_THAT(ErrorOf({"a.xml", "--placement", "spraed"}), HasSubstr("did you mean 'spread'?"));
  EXPECT_THAT(ErrorOf({"a.xml", "--set", "x"}), HasSubstr("PATH=VALUE"));
  EXPECT_THAT(ErrorOf({"a.xml", "--expect-hash", "xyz"}), HasSubstr("16 hexadecimal digits"));
  EXPECT_THAT(ErrorOf({"a.xml", "--restore", "/dev/zero"}), HasSubstr("a device"));
  EXPECT_THAT(ErrorOf({"a.xml", "--restore", "/nowhere"}), HasSubstr("no such file"));
}

// A process must accept each value that the launcher accepts. Only 0 may stand for a default.
TEST(RunSettings, NumbersThatTheLauncherTakesAreTakenByItsProcesses)
{
  RunSettings run;
  BusOptions bus;
  WorkerSettings worker;
  std::vector<OptionSpec> others;
  for (const auto& table : {ServerOptionTable(run), BusOptionTable(bus), HostOptionTable(worker),
                            EngineOptionTable(worker), VisualiserOptionTable(worker)})
    others.insert(others.end(), table.begin(), table.end());
  std::size_t compared = 0;
  for (const OptionSpec& option : RunOptionTable(run))
  {
    if (option.value.type != ParameterType::kInteger && option.value.type != ParameterType::kNumber) continue;
    for (const OptionSpec& other : others)
      if (other.value.name == option.value.name)
        for (const char* text : {"1e-300", "1e-9", "0.001", "0.19", "0.2", "1", "2", "65", "232", "233", "1000", "1001",
                                 "3600", "3601", "1000000", "1e15", "1e300"})
        {
          if (MistakeIn(option, text).empty())
          {
            EXPECT_EQ(MistakeIn(other, text), "") << text;
          }
          ++compared;
        }
  }
  EXPECT_GT(compared, 17U * 5) << "seed, ticks, lease, domain, threads … have the same names there";
}

TEST(RunSettings, NumbersTooSmallForAnyProcessAreRefusedWithTheLimit)
{
  EXPECT_THAT(ErrorOf({"a.xml", "--lease", "1e-9"}), HasSubstr("it must be 0, or from 0.2 to 3600 s"));
  EXPECT_EQ(ErrorOf({"a.xml", "--lease", "0"}), "no error");
  EXPECT_THAT(ErrorOf({"a.xml", "--step-timeout", "1e-9"}), HasSubstr("it must be 0, or from 0.001 to 1e+06 s"));
  EXPECT_THAT(ErrorOf({"a.xml", "--memory-limit", "1"}), HasSubstr("does not start with less than 64MiB"));
}

TEST(RunSettings, ASettingThatAnOptionGivesTooIsRefused)
{
  ExperimentChoice choice;
  choice.settings = {"framework.maxclock=5", "arena.size=1,1,1"};
  choice.seed = 3;
  EXPECT_EQ(ChangesOf(choice).settings.size(), 3U);
  choice.ticks = 7;
  EXPECT_EQ(test::MessageOf<UsageError>([&] { ChangesOf(choice); }),
            "--ticks 7 and --set framework.maxclock=5 set the same value; leave one of the two out");
}

TEST(RunSettings, MemoryIsReadInItsUnit)
{
  const auto bytes_of = [](const std::string& text)
  {
    RunSettings settings;
    settings.memory_limit = text;
    return LimitsOf(settings).memory_bytes;
  };
  EXPECT_EQ(bytes_of("4096"), 4096U);
  EXPECT_EQ(bytes_of("4096B"), 4096U);
  EXPECT_EQ(bytes_of("1.5K"), 1536U);
  EXPECT_EQ(bytes_of("500M"), 500U << 20U);
  EXPECT_EQ(bytes_of("2GiB"), std::uint64_t{2} << 30U);
  EXPECT_EQ(bytes_of("1TB"), std::uint64_t{1} << 40U);
  for (const char* text : {"", "0", "2G5", "GiB", "2 GiB", "-1", "2000T"})
    EXPECT_THAT(ErrorOf({"a.xml", "--memory-limit", text}), HasSubstr("--memory-limit")) << text;
}

TEST(BusOptions, AddressesAreReadWhole)
{
  EXPECT_EQ(ParseServerAddress("127.0.0.1:11811"), std::pair(std::string("127.0.0.1"), 11811U));
  EXPECT_EQ(ParseServerAddress("alpha:1")->first, "alpha");
  for (const char* text : {"127.0.0.1:11811junk", "127.0.0.1:", ":11811", "127.0.0.1", "", "a:0", "a:65536", "a:-1",
                           "a:+1", "a: 1", "a:99999999999999999999"})
    EXPECT_FALSE(ParseServerAddress(text)) << text;
}

// Every number has limits, so that each is refused if it cannot mean anything.
TEST(RunSettings, EveryNumberHasARange)
{
  RunSettings run;
  WorkerSettings worker;
  BusOptions bus;
  for (const auto& table : {RunOptionTable(run), EngineOptionTable(worker), HostOptionTable(worker),
                            VisualiserOptionTable(worker), BusOptionTable(bus)})
    for (const OptionSpec& option : table)
    {
      const bool number = option.value.type == ParameterType::kInteger || option.value.type == ParameterType::kNumber;
      EXPECT_TRUE(!number || !RangeText(option.value).empty()) << option.value.name;
      EXPECT_NE(option.value.description, "") << option.value.name;
      const bool self_evident =
          option.value.type == ParameterType::kBoolean || option.value.type == ParameterType::kChoice;
      EXPECT_TRUE(self_evident || !option.example.empty()) << option.value.name;
    }
}

}  // namespace
}  // namespace swarmanoid
