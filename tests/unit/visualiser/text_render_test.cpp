// Tests text_render: programs can read its tables, whatever controllers call their states.
#include "visualiser/text/text_render.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/configuration/xml_reader.h"
#include "common/program/csv.h"
#include "tests/unit/visualiser/small_world.h"
#include "tests/world/fake_run.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;

// In one process the state of a controller reaches the table without a check.
constexpr const char* kState = "turn, \"left\"\\\n\tä \xff";

// Columns of a user.
class OddRender : public CTextRender
{
protected:
  std::vector<Column> Columns() const override
  {
    std::vector<Column> columns = CTextRender::Columns();
    const auto add = [&](const char* title, double value)
    {
      columns.push_back({title, true, [this, value](const CSwarmanoidSpaceEntity&, std::string& line) {
                           AppendNumber(value, line);
                         }});
    };
    add("a \"wide\" title", 1e300);
    add("infinite", -HUGE_VAL);
    add("none", std::nan(""));
    columns.push_back({"empty", true, [](const CSwarmanoidSpaceEntity&, std::string&) {}});
    return columns;
  }
};

class TextRender : public ::testing::Test
{
protected:
  TextRender() : world_({4, 4, 1})
  {
    world_.Add(EntityKind::kFootbot, "fb", {1.25, 2, 0}, 90);
    assignment_.owner = {0};
    assignment_.host = {0};
    world_.GetExperiment().engines.resize(1);
    world_.GetExperiment().engines[0].id = "ground";
    monitor_.inside.state = kState;
  }

  std::string Written(CTextRender&& render, const std::string& attributes)
  {
    const TConfigurationTree tree(ReadXml("<text_render file='table' " + attributes + "/>", "text.xml"));
    world_.Space().SetTick(7);
    render.Init({.parameters = Parameters(tree, CTextRender::Description().parameters),
                 .space = world_.Space(),
                 .assignment = assignment_,
                 .output_folder = folder_.Path(),
                 .monitor = &monitor_});
    render.Draw();
    render.Finish();
    return folder_.Read("table");
  }

  SmallWorld world_;
  Assignment assignment_;
  test::FakeMonitor monitor_;
  test::TemporaryFolder folder_;
};

TEST_F(TextRender, WritesTheTableOfTheSeed)
{
  EXPECT_EQ(Written(CTextRender(), ""),
            "#\tclock\tEntity type\tEntity id\tX\tY\tZ\tAlpha\tBeta\tGamma\n7\t\tFootbot\tfb\t1.25\t2\t0\t0\t0\t90\n");
  EXPECT_EQ(Written(CTextRender(), "columns='Entity id, State'"),
            "#\tEntity id\tState\nfb\t\tturn, \"left\"\\  ä \xff\n");
}

TEST_F(TextRender, WritesJsonThatParsersRead)
{
  EXPECT_EQ(
      Written(CTextRender(), "format='json'"),
      "{\"clock\":7,\"Entity type\":\"Footbot\",\"Entity id\":\"fb\",\"X\":1.25,\"Y\":2,\"Z\":0,\"Alpha\":0,\"Beta\":0,"
      "\"Gamma\":90}\n");
  EXPECT_EQ(Written(CTextRender(), "format='json' columns='Engine, Host, State'"),
            "{\"Engine\":\"ground\",\"Host\":\"0\",\"State\":\"turn, \\\"left\\\"\\\\\\n\\tä \xef\xbf\xbd\"}\n");

  const nlohmann::json odd = nlohmann::json::parse(Written(OddRender(), "format='json'"));
  EXPECT_EQ(odd["a \"wide\" title"], 1e300);
  EXPECT_TRUE(odd["infinite"].is_null());
  EXPECT_TRUE(odd["none"].is_null());
  EXPECT_TRUE(odd["empty"].is_null());
}

// The table of the last tick was drawn before the run was known to be paused.
TEST_F(TextRender, TellsThatARunIsPausedAfterItsLatestTable)
{
  const TConfigurationTree tree(ReadXml("<text_render file='table' status='true' columns='clock'/>", "text.xml"));
  CTextRender render;
  monitor_.status.phase = RunStatus::Phase::kRunning;
  render.Init({.parameters = Parameters(tree, CTextRender::Description().parameters),
               .space = world_.Space(),
               .assignment = assignment_,
               .output_folder = folder_.Path(),
               .monitor = &monitor_});
  render.Idle();
  render.Draw();
  monitor_.status.tick = 1;
  render.Idle();
  monitor_.status.phase = RunStatus::Phase::kPaused;
  render.Idle();
  render.Idle();
  render.Finish();
  EXPECT_EQ(folder_.Read("table"), "#\tclock\n# tick 0, running, 0.0x real time, 0 ticks/s\n0\n# tick 1, paused\n");
}

TEST_F(TextRender, WritesTheStatusAsJson)
{
  monitor_.status.phase = RunStatus::Phase::kRunning;
  monitor_.status.tick = 9;
  monitor_.status.real_time_factor = 12.5;
  monitor_.status.processes = {{"space server", "a:1", 9, 0, ""}, {"engine \"x\"", "a:2", 8, 2.5, ""}};
  const std::string text = Written(CTextRender(), "format='json' status='true' columns='clock'");
  EXPECT_EQ(text,
            "{\"tick\":9,\"phase\":\"running\",\"real_time_factor\":12.5,\"late\":[\"engine \\\"x\\\"\"]}\n"
            "{\"clock\":7}\n");
  monitor_.status.real_time_factor = HUGE_VAL;
  EXPECT_EQ(Written(CTextRender(), "format='json' status='true' columns='clock'").substr(0, 52),
            "{\"tick\":9,\"phase\":\"running\",\"real_time_factor\":null,");
}

TEST_F(TextRender, WritesCsvThatParsersRead)
{
  const std::string text = Written(OddRender(), "format='csv' columns='Entity id, State, a \"wide\" title'");
  EXPECT_TRUE(text.starts_with("Entity id,State,\"a \"\"wide\"\" title\"\nfb,\"turn, \"\"left\"\""));
  const std::size_t row = text.find('\n') + 1;
  EXPECT_THAT(CsvFields(std::string_view(text).substr(row, text.size() - row - 1)),
              ElementsAre("fb", kState, testing::StartsWith("1000000000000000052504760255204420248704468581108159")));
}

}  // namespace
}  // namespace swarmanoid
