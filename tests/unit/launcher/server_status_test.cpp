#include "common/run/server_status.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "launcher/supervision/line_splitter.h"

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
  const auto stall = std::get<ServerStall>(*ParseServerStatus("stalled 2.5 controller_host 0"));
  EXPECT_EQ(stall.name, "controller_host 0");
  EXPECT_EQ(stall.seconds, 2.5);
  EXPECT_EQ(std::get<ServerError>(*ParseServerStatus("error all is lost")).text, "all is lost");
  const ServerMove move{"alpha", "engine 'a to b'"};
  EXPECT_EQ(std::get<ServerMove>(*ParseServerStatus(ServerStatusLine(move))), move);
  EXPECT_FALSE(ParseServerStatus("move alpha"));
  const ServerHosts hosts{"here beta here"};
  EXPECT_EQ(std::get<ServerHosts>(*ParseServerStatus(ServerStatusLine(hosts))), hosts);
  EXPECT_FALSE(ParseServerStatus("hosts"));
  EXPECT_FALSE(ParseServerStatus("move"));
  const ServerReset reset{9007199254740993, true, 0.5};
  EXPECT_EQ(std::get<ServerReset>(*ParseServerStatus(ServerStatusLine(reset))), reset);
  EXPECT_FALSE(ParseServerStatus("reset 7 yes 0.5"));
  EXPECT_FALSE(ParseServerStatus("reset 7 1"));
  const auto finished = std::get<ServerFinished>(*ParseServerStatus("finished 500 10 0123456789abcdef 1.25 40"));
  EXPECT_EQ(finished.ticks, 500U);
  EXPECT_EQ(finished.entities, 10U);
  EXPECT_EQ(finished.hash, 0x0123456789abcdefU);
  EXPECT_EQ(finished.wall_s, 1.25);
  EXPECT_EQ(finished.real_time_factor, 40);
}

TEST(ServerStatus, WhatIsWrittenIsRead)
{
  const std::vector<ServerStatus> all{
      ServerState{ServerState::kLoading, ""},
      ServerState{ServerState::kWaiting, "engine 'ground', controller host 0"},
      ServerState{ServerState::kRunning, ""},
      ServerState{ServerState::kPaused, ""},
      ServerTick{412, 0, 0.1},
      ServerTick{~0ULL, ~0ULL, 1e-7},
      ServerStall{2, "controller host 0 (runs the controller of fb 3)"},
      ServerWarning{"engine 'ground' at tick 5: the footbot 'fb' left the world at 1, 1, -300"},
      ServerError{"controller 'x' of robot 'y' failed: 5 of 6"},
      ServerLeft{"engine 'the ground'"},
      ServerFinished{500, 10, 0xffULL, 0.0541234567, 1.0 / 3},
      ServerFinished{500, 10, 0xffULL, 1, 2, "experiment functions 'goal' say: 3 of 10 preys"},
  };
  for (const ServerStatus& status : all)
  {
    const std::string line = ServerStatusLine(status);
    const auto read = ParseServerStatus(line);
    ASSERT_TRUE(read) << line;
    EXPECT_TRUE(*read == status) << line;
  }
}

TEST(ServerStatus, TextsStayOnTheirLine)
{
  EXPECT_EQ(ServerStatusLine(ServerError{"first\nfinished 1 1 00 1 1\r\x1b[2J"}),
            "error first finished 1 1 00 1 1  [2J");
  EXPECT_EQ(std::get<ServerError>(*ParseServerStatus("error \x1b[2Jgone")).text, " [2Jgone");
}

TEST(ServerStatus, LeavesOtherLinesAlone)
{
  for (const char* line : {"",
                           "join",
                           "tick",
                           "tick 1",
                           "tick one two three",
                           "tick 1 2 3 4",
                           "state",
                           "state of the art",
                           "finished 1 2 xyz 3 4",
                           "stalled",
                           "stalled host",
                           "stalled 2.5",
                           "stalled -1 host",
                           "stalled nan host",
                           "state running away",
                           "tick -1 2 3",
                           "tick 1 2 inf",
                           "tick 99999999999999999999 2 3",
                           "tick 1 2 3x",
                           "tick  1 2 3",
                           "TICK 1 2 3",
                           "finished 1 2 0x12 3 4",
                           "finished 1 2 00000000000000001 3 4",
                           "finished 1 2 -1 3 4",
                           "finished 1 2 12 3 1e999"})
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
