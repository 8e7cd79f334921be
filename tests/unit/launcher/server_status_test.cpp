#include "launcher/processes/server_status.h"

#include <gtest/gtest.h>

#include <vector>

#include "launcher/processes/line_splitter.h"

namespace swarmanoid
{
namespace
{

TEST(ServerStatus, ReadsEachKindOfLine)
{
  EXPECT_EQ(std::get<ServerState>(*ParseServerStatus("state waiting engine ground, visualiser main")).waiting_for,
            "engine ground, visualiser main");
  EXPECT_EQ(std::get<ServerState>(*ParseServerStatus("state paused")).phase, ServerState::kPaused);
  const auto tick = std::get<ServerTick>(*ParseServerStatus("tick 12 500 3.5"));
  EXPECT_EQ(tick.tick, 12U);
  EXPECT_EQ(tick.max, 500U);
  EXPECT_EQ(tick.real_time_factor, 3.5);
  const auto stall = std::get<ServerStall>(*ParseServerStatus("stalled controller_host 0 2.5"));
  EXPECT_EQ(stall.name, "controller_host 0");
  EXPECT_EQ(stall.seconds, 2.5);
  EXPECT_EQ(std::get<ServerError>(*ParseServerStatus("error all is lost")).text, "all is lost");
  const auto finished = std::get<ServerFinished>(*ParseServerStatus("finished 500 10 0123456789abcdef 1.25 40"));
  EXPECT_EQ(finished.ticks, 500U);
  EXPECT_EQ(finished.entities, 10U);
  EXPECT_EQ(finished.hash, 0x0123456789abcdefU);
  EXPECT_EQ(finished.wall_s, 1.25);
  EXPECT_EQ(finished.real_time_factor, 40);
}

TEST(ServerStatus, LeavesOtherLinesAlone)
{
  for (const char* line : {"", "hello", "tick", "tick 1", "tick one two three", "tick 1 2 3 4", "state",
                           "state of the art", "finished 1 2 xyz 3 4", "stalled", "stalled host"})
    EXPECT_FALSE(ParseServerStatus(line)) << line;
}

TEST(LineSplitter, JoinsPiecesAndDropsCarriageReturns)
{
  LineSplitter splitter;
  std::vector<std::string> lines;
  const auto take = [&](std::string_view line) { lines.emplace_back(line); };
  splitter.Add("on", take);
  splitter.Add("e\r\ntwo\n\nthr", take);
  splitter.Finish(take);
  EXPECT_EQ(lines, (std::vector<std::string>{"one", "two", "", "thr"}));
}

}  // namespace
}  // namespace swarmanoid
