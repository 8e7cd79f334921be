// Controllers in Lua: what scripts see, what they may do, the same order in every process, and state that is saved.
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "common/logging/log.h"
#include "common/math/elementary.h"
#include "common/math/random.h"
#include "tests/unit/scripts/scripted_robots.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

// Runs statements in the step of tick 0 and returns the text of their result `r`.
std::string ResultOf(const std::string& statements, const std::map<std::string, std::string>& files = {})
{
  Scripted scripted(
      {.script = "function step()\n local r\n " + statements + "\n status = tostring(r)\nend", .files = files});
  EXPECT_EQ(scripted.Mistakes(), "") << statements;
  if (scripted.host == nullptr) return "";
  const std::string failure = test::MessageOf<std::runtime_error>([&] { scripted.Tick(0); });
  return failure.empty() ? scripted.Status() : failure;
}

struct Row
{
  const char* statements;
  const char* result;
};

void ExpectResults(const std::vector<Row>& rows, const std::map<std::string, std::string>& files = {})
{
  for (const Row& row : rows) EXPECT_THAT(ResultOf(row.statements, files), HasSubstr(row.result)) << row.statements;
}

// Expects the whole text of each result.
void ExpectTexts(const std::vector<Row>& rows, const std::map<std::string, std::string>& files = {})
{
  for (const Row& row : rows) EXPECT_EQ(ResultOf(row.statements, files), row.result) << row.statements;
}

TEST(LuaOrder, PairsAndNextVisitBooleansNumbersAndTextsInAscendingOrder)
{
  const std::string all =
      "local t = {} t.b = 'B' t.a = 'A' t[3] = 3 t[-1] = -1 t[2.5] = 2.5 t[true] = 'yes' t[false] = 'no' r = '' ";
  const std::string order = "false=no true=yes -1=-1 2.5=2.5 3=3 a=A b=B ";
  EXPECT_EQ(ResultOf(all + "for k, v in pairs(t) do r = r .. tostring(k) .. '=' .. v .. ' ' end"), order);
  EXPECT_EQ(ResultOf(all + "local k, v = next(t) while k ~= nil do r = r .. tostring(k) .. '=' .. v .. ' ' "
                           "k, v = next(t, k) end"),
            order);
}

TEST(LuaOrder, TablesMayLoseElementsWhileTheyAreVisited)
{
  ExpectTexts({
      {"r = '' local t = {a = 1, b = 2, c = 3} for k in pairs(t) do r = r .. k t.b = nil end", "ac"},
      {"r = '' local t = {5, 6, 7} for k, v in pairs(t) do r = r .. k .. v .. ' ' t[2] = nil end", "15 37 "},
      {"r = '' for k, v in pairs{5, 6, 7} do r = r .. k .. v .. ' ' end", "15 26 37 "},
      {"r = '' for k in pairs({1, 2, nil, 4}) do r = r .. k end", "124"},
      {"r = '' for k in pairs({}) do r = r .. 'x' end", ""},
      {"r = next({})", "nil"},
      {"r = next({a = 1}, 'a')", "nil"},
      {"r = select('#', next({7}))", "2"},
      {"r = '' for k in pairs(setmetatable({1, 2}, {__pairs = function(t) return next, {x = 1}, nil end})) do r = r .. "
       "k end",
       "x"},
      {"r = '' for k in pairs(setmetatable({b = 1, a = 2}, {})) do r = r .. k end", "ab"},
      {"r = pcall(function() for k in pairs(3) do end end)", "false"},
  });
}

TEST(LuaOrder, KeysWithoutAnOrderAreRefused)
{
  ExpectResults({{"for k in pairs({[{}] = 1}) do r = k end",
                  "walk.lua:3: a table whose keys are of type table has no order that is the same in every run"},
                 {"next({[print] = 1})", "walk.lua:3: a table whose keys are of type function has no order"}});
}

TEST(LuaOrder, LongListsAreSortedWithEqualElementsInTheirOrder)
{
  // 100 elements are sorted by Lua itself; more by a stable sort.
  for (const char* count : {"0", "1", "2", "99", "100", "101", "112", "113", "257", "1000"})
  {
    const std::string list = std::string("local n = ") + count + " local t = {} for i = 1, n do t[i] = ";
    EXPECT_EQ(ResultOf(list + "i * 7919 % 1009 end table.sort(t) r = #t == n for i = 2, n do r = r and t[i - 1] < t[i] "
                              "end"),
              "true")
        << count;
    EXPECT_EQ(
        ResultOf(list + "i * 7919 % 1009 end table.sort(t, function(a, b) return a > b end) r = true for i = 2, n "
                        "do r = r and t[i - 1] > t[i] end"),
        "true")
        << count;
  }
  EXPECT_EQ(ResultOf("local t = {} for i = 1, 500 do t[i] = {key = i * 31 % 7, place = i} end "
                     "table.sort(t, function(a, b) return a.key < b.key end) r = true for i = 2, 500 do local a, b = "
                     "t[i - 1], t[i] r = r and (a.key < b.key or a.key == b.key and a.place < b.place) end"),
            "true");
  EXPECT_THAT(ResultOf("table.sort(3)"), HasSubstr("table expected"));
}

TEST(LuaFunctions, OfOlderVersionsAreThere)
{
  ExpectTexts({{"r = math.atan2(1, 0) == math.pi / 2", "true"},
               {"r = math.pow(2, 10)", "1024.0"},
               {"r = table.concat({unpack({1, 2, 3}, 2)}, ' ')", "2 3"},
               {"r = loadstring('return 3 + 4')()", "7"},
               {"r = load(function() return nil end) ~= nil", "true"}});
}

TEST(LuaFunctions, TellTheTimeOfTheSimulation)
{
  Scripted scripted(
      {.script = "function step() status = os.time() .. ' ' .. os.clock() .. ' ' .. os.date('!%H:%M:%S') .. "
                 "' ' .. os.date('!%Y', 0) .. ' ' .. os.time{year = 1970, month = 1, day = 3} // 86400 .. ' ' .. "
                 "#os.date() end"});
  scripted.Tick(0);
  EXPECT_THAT(scripted.Status(), testing::MatchesRegex("0 0\\.0 00:00:00 1970 [123] 2[0-9]"));
  scripted.Tick(617);
  EXPECT_THAT(scripted.Status(), testing::MatchesRegex("61 61\\.7 00:01:01 1970 [123] 2[0-9]"));
}

TEST(LuaFunctions, WriteIntoTheLog)
{
  const test::TemporaryFolder folder;
  OpenLog({.process = "host", .folder = folder.Path()});
  {
    Scripted scripted({.script = "log('file ', 1)\nfunction init() print('init', robot.tick, nil) end\nfunction step() "
                                 "log(robot.tick, ' ', 2.5, true) log() end\nfunction destroy() print('end') end"});
    scripted.StatusAfter(3);
    scripted.host->Destroy();
  }
  OpenLog({.process = "test"});  // closes the file
  const std::string text = folder.Read("host.log");
  for (const char* line : {"robot 'a' at tick 0: file 1\n", "robot 'a' at tick 0: init\t0\tnil\n",
                           "robot 'a' at tick 2: 2 2.5true\n", "robot 'b' at tick 2: \n", "robot 'b' at tick 2: end\n"})
    EXPECT_THAT(text, HasSubstr(line));
}

TEST(LuaLimits, AllowReadingBesideTheScriptAlone)
{
  const std::map<std::string, std::string> files = {{"s/part.lua", "return 5"},
                                                    {"s/sub/init.lua", "return {name = ...}"},
                                                    {"s/data.txt", "one\ntwo\n"},
                                                    {"outside.txt", "x"},
                                                    {"outside.lua", "return 6"}};
  ExpectTexts(
      {
          {"r = dofile('part.lua')", "5"},
          {"r = loadfile('part.lua')()", "5"},
          {"r = require('part')", "5"},
          {"r = require('sub').name", "sub"},
          {"r = io.open('data.txt'):read('a')", "one\ntwo\n"},
          {"r = io.open('data.txt', 'r'):read('l')", "one"},
          {"r = io.open('data.txt', 'rb'):read('l')", "one"},
          {"r = '' for line in io.lines('data.txt') do r = r .. line .. ';' end", "one;two;"},
          {"r = io.open('none.txt')", "nil"},
          {"r = load('return 1', 'x', 'b')()", "1"},
          {"r = load('return y', 'x', 't', {y = 3})()", "3"},
          {"r = load(string.dump(function() end))", "nil"},
          {"r = os.difftime(3, 1)", "2.0"},
          {"r = type(os.getenv('PATH'))", "string"},
          {"r = type(debug.traceback()) .. type(debug.getinfo(1)) .. io.type(io.stdout)", "stringtablefile"},
      },
      files);
  ExpectResults(
      {
          {"os.execute('true')",
           "walk.lua:3: os.execute is not for scripts unless the user trusts the experiment: --trust"},
          {"os.exit(0)", "os.exit is not for scripts"},
          {"os.remove('data.txt')", "os.remove is not for scripts"},
          {"os.rename('a', 'b')", "os.rename is not for scripts"},
          {"os.tmpname()", "os.tmpname is not for scripts"},
          {"os.setlocale('C')", "os.setlocale is not for scripts"},
          {"io.popen('true')", "io.popen is not for scripts"},
          {"io.output('x')", "io.output is not for scripts"},
          {"io.input('x')", "io.input is not for scripts"},
          {"io.tmpfile()", "io.tmpfile is not for scripts"},
          {"io.read()", "io.read is not for scripts"},
          {"debug.sethook()", "debug.sethook is not for scripts"},
          {"debug.getregistry()", "debug.getregistry is not for scripts"},
          {"debug.setmetatable(1, {})", "debug.setmetatable is not for scripts"},
          {"package.loadlib('x', 'y')", "package.loadlib is not for scripts"},
          {"package.searchpath('x', 'y')", "package.searchpath is not for scripts"},
          {"r = package.cpath", "nil"},
          {"r = io.stdin", "nil"},
          {"r = #package.searchers", "2"},
          {"io.open('data.txt', 'w')", "walk.lua:3: 'data.txt' can only be read"},
          {"io.open('data.txt', 'r+')", "'data.txt' can only be read"},
          {"io.open('../outside.txt')", "walk.lua:3: '../outside.txt' is not below the folder of the script"},
          {"io.open('/etc/passwd')", "'/etc/passwd' is not below the folder of the script"},
          {"io.open()", "walk.lua:3: the name of a file must be given"},
          {"io.lines('../outside.txt')", "is not below the folder of the script"},
          {"dofile('../outside.lua')", "is not below the folder of the script"},
          {"loadfile('../outside.lua')", "is not below the folder of the script"},
          {"package.path = '"
           "./?.lua;../?.lua' r = require('../outside')",
           "module '../outside' not found"},
          {"require('nowhere')", "module 'nowhere' not found"},
      },
      files);
  EXPECT_THAT(ResultOf("require('part')", {{"s/part.lua", "x ="}}), HasSubstr("error loading module 'part' from file"));
  EXPECT_THAT(ResultOf("dofile('part.lua')", {{"s/part.lua", "x ="}}), HasSubstr("unexpected symbol"));
}

TEST(LuaRandom, NumbersAreThoseOfTheRobotAndItsStep)
{
  Scripted scripted({.script = R"(function step()
  local u, d, i, g, h, v, b = math.random(), math.random(6), math.random(-3, 3), robot.random.gaussian(),
    robot.random.gaussian(5, 2), robot.random.uniform(2, 4), robot.random.bernoulli(0.5)
  status = string.format("%.17g %d %d %.17g %.17g %.17g %s", u, d, i, g, h, v, b)
end)"});
  for (std::uint64_t tick = 0; tick < 20; ++tick)
  {
    scripted.Tick(tick);
    RandomStream random(7, StreamName("a"), kControlStepStream, tick);
    const double u = random.Uniform();
    const std::uint32_t d = 1 + random.Below(6);
    const int i = static_cast<int>(random.Below(7)) - 3;
    const double g = random.Gaussian(0, 1), h = random.Gaussian(5, 2), v = random.Uniform(2, 4);
    const bool b = random.Uniform() < 0.5;
    char text[200];
    std::snprintf(text, sizeof text, "%.17g %u %d %.17g %.17g %.17g %s", u, d, i, g, h, v, b ? "true" : "false");
    EXPECT_EQ(scripted.Status(), text);
  }
}

TEST(LuaRandom, IntervalsAreChecked)
{
  ExpectResults({{"r = math.random(2, 2)", "2"},
                 {"r = math.random(1)", "1"},
                 {"math.random(3, 2)", "walk.lua:3: the interval of math.random is empty"},
                 {"math.random(0)", "the interval of math.random is empty"},
                 {"math.random(1, 2, 3)", "math.random has no, one or two values"},
                 {"r = math.random(0, 4294967294) >= 0", "true"},
                 {"math.random(0, 4294967295)", "the interval of math.random has more than 2^32 - 1 integers"},
                 {"math.random(math.mininteger, math.maxinteger)", "more than 2^32 - 1 integers"},
                 {"math.random(1.5)", "number has no integer representation"},
                 {"math.randomseed(3)", "random numbers are those of the robot and cannot be seeded"},
                 {"robot.random.uniform(1)", "walk.lua:3: 1 values are given, and 2 are needed"},
                 {"robot.random.uniform(1, 2, 3)", "3 values are given, and 2 are needed"},
                 {"robot.random.bernoulli('x')", "number expected"},
                 {"r = robot.random.bernoulli(1)", "true"},
                 {"r = robot.random.bernoulli(0)", "false"}});
}

TEST(LuaRobot, HasIdKindTimeAndDevices)
{
  Scripted scripted({.script =
                         "local p = robot.footbot_proximity\nfunction step()\n status = table.concat({robot.id, "
                         "robot.kind, robot.tick, robot.time, robot.tick_seconds, #p, tostring(p == "
                         "robot.footbot_proximity), tostring(p.rows), tostring(robot.nothing), tostring(robot[1])}, "
                         "' ')\nend"});
  scripted.Tick(0);
  EXPECT_EQ(scripted.Status(0), "a footbot 0 0.0 0.1 24 true nil nil nil");
  scripted.Tick(25);
  EXPECT_EQ(scripted.Status(1), "b footbot 25 2.5 0.1 24 true nil nil nil");
}

TEST(LuaRobot, TablesThatAScriptKeepsAreReadBeforeEachStep)
{
  Scripted scripted({.script =
                         "local p = robot.footbot_proximity\nfunction step()\n local sum = 0 for i = 1, 24 do sum = "
                         "sum + p[i] end status = sum > 0 and 'near' or 'far'\nend"});
  scripted.Tick(0);
  EXPECT_EQ(scripted.Status(), "far");
  scripted.space->SetPose(1, {{1.2, 1, 0}, Quaternion::Identity()});
  scripted.Tick(1);
  EXPECT_EQ(scripted.Status(), "near");
  scripted.space->SetPose(1, {{5, 1, 0}, Quaternion::Identity()});
  scripted.Tick(2);
  EXPECT_EQ(scripted.Status(), "far");
}

// The robot "a" hears "b" while that sends.
TEST(LuaRobot, RowsOfASensorAreAListAsLongAsTheReadings)
{
  Scripted scripted({.script = R"(local radio = robot.range_and_bearing
local rows = radio.rows
function step()
  local sends = robot.id == "b" and robot.tick < 2 and 1 or 0
  radio.set{sends, 3, robot.tick, 0, 0, 0, 0, 0, 0, 0, 9}
  status = #radio.rows .. ""
  for _, row in ipairs(radio.rows) do
    status = status .. string.format(" %g %g %g %g %g", row.range, row.bearing, row.byte_0, row.byte_1, row.byte_9)
  end
  status = status .. tostring(rows == radio.rows)
end)",
                     .actuators = {"generic_range_and_bearing"},
                     .sensors = {"generic_range_and_bearing"}});
  std::vector<std::string> heard;
  for (std::uint64_t tick = 0; tick < 5; ++tick)
  {
    scripted.Tick(tick);
    heard.push_back(scripted.Status());
  }
  EXPECT_THAT(heard, ElementsAre("0true", "1 0.5 0 3 0 9true", "1 0.5 0 3 1 9true", "0true", "0true"));
}

TEST(LuaRobot, ActuatorsTakeNumbersOrAList)
{
  const auto wheels = [](const std::string& call)
  {
    Scripted scripted(
        {.script = "function step() if robot.id == 'a' then robot.footbot_wheels.set" + call + " end end"});
    return scripted.Tick(0).values;
  };
  EXPECT_THAT(wheels("(5, -2.5)"), ElementsAre(5, -2.5, 0, 0));
  EXPECT_THAT(wheels("{1, 2}"), ElementsAre(1, 2, 0, 0));
  EXPECT_THAT(wheels("('3', 4)"), ElementsAre(3, 4, 0, 0));
  ExpectResults({{"robot.footbot_wheels.set(5)", "walk.lua:3: 1 values are given, and 2 are needed"},
                 {"robot.footbot_wheels.set()", "0 values are given, and 2 are needed"},
                 {"robot.footbot_wheels.set{1, 2, 3}", "3 values are given, and 2 are needed"},
                 {"robot.footbot_wheels.set({1}, 2)", "value 1 is a table; it must be a number"},
                 {"robot.footbot_wheels.set(5, 0 / 0)", "walk.lua:3: value 2 is not finite"},
                 {"robot.footbot_wheels.set(math.huge, 5)", "value 1 is not finite"},
                 {"robot.footbot_wheels.set{5, 'fast'}", "value 2 is a string; it must be a number"},
                 {"robot.footbot_wheels.set(nil, 5)", "value 1 is a nil; it must be a number"},
                 {"r = robot.footbot_proximity.set", "nil"},
                 {"robot.k = 1", "walk.lua:3: the table `robot` takes no new field 'k'; keep it in the table `state`"},
                 {"robot.wheels.set(5, 5)", "attempt to index a nil value (field 'wheels')"}});
}

TEST(LuaScript, BeginsOnceAndMayReplaceItsTables)
{
  Scripted scripted({.script =
                         "#!/usr/bin/lua\nlocal k = 0\nfunction init() k = k + 10 end\nrobot = 7\nfunction step() k "
                         "= k + 1 status = tostring(k) end"});
  EXPECT_EQ(scripted.StatusAfter(3), "13");
  EXPECT_EQ(Scripted({.script = "\xef\xbb\xbf#!lua\nfunction step() status = 3 end"}).StatusAfter(1), "")
      << "a status is a text";
  EXPECT_EQ(Scripted({.script = "function step() end"}).StatusAfter(1), "");
  // A script may guard its globals.
  EXPECT_EQ(
      Scripted({.script = "state = {} status = 'x'\nsetmetatable(_G, {__index = error, __newindex = error})\n"
                          "rawset(_G, 'step', function() rawset(_G, 'status', tostring(pcall(function() return no "
                          "end))) end)"})
          .StatusAfter(1),
      "false");
}

TEST(LuaScript, MistakesHaveFileAndLine)
{
  struct Mistake
  {
    const char *script, *parameters, *text;
  };
  for (const Mistake& mistake : std::vector<Mistake>{
           {"x =", "", "walk.lua:1: unexpected symbol near <eof>"},
           {"x = 1", "", "walk.lua: the script has no function step()"},
           {"step = 3", "", "walk.lua: the script has no function step()"},
           {"function step() error({}) end", "", "walk.lua: an error that is no text"},
           {"function step() error('why', 0) end", "", "ControlStep at tick 0 failed: why"},
           {"state = 3 function step() end", "", "walk.lua: the global `state` is a number; it must be a table"},
           {"state = 'x' function step() end", "", "the global `state` is a string"},
           {"parameters{a = {defalt = 3}}", "",
            "the parameter 'a' has no field 'defalt'; the fields are: default, unit, "},
           {"parameters{a = {default = 3, maximum = 2}}", "", "walk.lua:1: "},
           {"parameters{a = {default = 3, maximum = 'x'}}", "",
            "the parameter 'a' has the maximum 'x', which is no number"},
           {"parameters{a = {default = 3, minimum = 'y'}}", "",
            "the parameter 'a' has the minimum 'y', which is no number"},
           {"parameters{a = {default = {1, 2}}}", "", "the parameter 'a' has no single value as its default"},
           {"parameters{a = {default = {}}}", "", "the parameter 'a' has no single value as its default"},
           {"parameters{a = {type = 'nubmer'}}", "",
            "the parameter 'a' has no type 'nubmer'; the types are: number, integer, boolean, text, choice, colour, "
            "path; did you mean 'number'?"},
           {"parameters{a = print}", "", "the parameter 'a' has a function, where a number, text or boolean must be"},
           {"parameters{a = {3}}", "", "the parameter 'a' has a field without a name"},
           {"parameters{3}", "", "parameters{…} has a declaration without a name"},
           {"parameters(3)", "", "parameters{…} takes a table with a declaration for each name"},
           {"parameters{script = 3}", "", "the parameter 'script' is the script itself; choose another name"},
           {"parameters{a = {unit = 'm'}} function step() end", "", "lacks the parameter 'a'"},
           {"parameters{speed = {default = 5, maximum = 20, unit = 'rad/s'}} function step() end", "<speed>30</speed>",
            "'speed' of the controller <lua_controller> is 30 rad/s; it must be at most 20 rad/s"},
           {"parameters{speed = {default = 5, minimum = 2}} function step() end", "<speed>1</speed>",
            "it must be at least 2"},
           {"parameters{speed = 5} function step() end", "<sped>1</sped>", "did you mean 'speed'?"}})
    EXPECT_THAT(FailureOf({.script = mistake.script, .parameters = mistake.parameters}), HasSubstr(mistake.text))
        << mistake.script;
  EXPECT_THAT(FailureOf({.script = "function step() end", .parameters = "<script>none.lua</script>"}),
              HasSubstr("script"));
}

TEST(LuaParameters, HaveTheTypesOfTheirDeclarations)
{
  const std::string script = R"(local p = parameters{
  whole = 5, half = {default = 0.5, unit = "m", description = "half"}, name = "x y", fast = false, slow = true,
  count = {default = 3, type = "integer"}, kind = {default = "b", choices = {"a", "b"}},
  red = {default = "red", type = "colour"}, file = {default = "", type = "path"}, tiny = 1e-7}
function step()
  local names = {}
  for name, value in pairs(p) do names[#names + 1] = name .. "=" .. tostring(value) .. ":" .. (math.type(value) or type(value)) end
  status = table.concat(names, " ")
end)";
  EXPECT_EQ(Scripted({.script = script}).StatusAfter(1),
            "count=3:integer fast=false:boolean file=:string half=0.5:float kind=b:string name=x y:string "
            "red=16711680:integer "
            "slow=true:boolean tiny=1e-07:float whole=5.0:float");
  Scripted other({.script = script,
                  .parameters = "<count>-4</count><fast>true</fast><slow>false</slow><half>1.5</half><kind>a</kind>"
                                "<name>z</name><red>blue</red><whole>6</whole><file>s/walk.lua</file>"});
  EXPECT_EQ(other.Mistakes(), "");
  EXPECT_EQ(other.StatusAfter(1), "count=-4:integer fast=true:boolean file=" + other.Folder() +
                                      "/s/walk.lua:string half=1.5:float kind=a:string name=z:string "
                                      "red=255:integer slow=false:boolean tiny=1e-07:float whole=6.0:float");
}

TEST(LuaParameters, AreDeclaredWithoutDevices)
{
  // The declaration ends the run of a script whose parameters are read.
  EXPECT_EQ(
      Scripted({.script = "log('x') local p = parameters{a = 3}\nlocal w = robot.footbot_wheels.set\nfunction step() "
                          "status = tostring(p.a) end"})
          .StatusAfter(1),
      "3.0");
  // A script that declares nothing may use devices at once.
  EXPECT_EQ(Scripted({.script = "robot.footbot_wheels.set(1, 2) function step() status = 'ran' end"}).StatusAfter(1),
            "ran");
}

constexpr const char* kCounting =
    R"(state = {count = 0, half = 0.5, name = "x", yes = true, no = false, [1] = "one", [-2.5] = 3, list = {}}
local list = state.list
function step()
  state.count = state.count + 1
  list[#list + 1] = {robot.tick, at = robot.time}
  if state.count == 3 then state.name = nil state.late = {deep = {deeper = math.huge}} end
  local names = {}
  for name, value in pairs(state) do names[#names + 1] = tostring(name) .. "=" .. (type(value) == "table" and "{}" or tostring(value)) end
  status = #list .. (list[1] and list[1].at or "") .. (state.late and state.late.deep.deeper or "") .. " " .. table.concat(names, " ")
    .. math.type(state.count) .. math.type(state.half) .. tostring(list == state.list)
end)";

TEST(LuaState, ContinuesInAnotherProcess)
{
  for (const std::uint64_t end : {1U, 2U, 3U, 4U})
  {
    Scripted whole({.script = kCounting});
    whole.StatusAfter(end);
    Scripted other({.script = kCounting});
    other.Load(whole.Saved());
    EXPECT_EQ(other.Saved(), whole.Saved());
    for (std::uint64_t tick = end; tick < end + 3; ++tick)
    {
      whole.Tick(tick);
      other.Tick(tick);
      EXPECT_EQ(other.Status(), whole.Status());
      EXPECT_EQ(other.Saved(), whole.Saved());
    }
  }
  EXPECT_EQ(Scripted({.script = kCounting}).StatusAfter(4),
            "40.0inf -2.5=3 1=one count=4 half=0.5 late={} list={} no=false yes=trueintegerfloattrue");
}

TEST(LuaState, ReplacesWhatTheOtherProcessHad)
{
  Scripted early({.script = kCounting}), late({.script = kCounting});
  early.StatusAfter(1);
  const auto saved = early.Saved();
  late.StatusAfter(5);
  late.Load(saved);
  EXPECT_EQ(late.Saved(), saved) << "elements that came later are gone";
  early.Tick(1);
  late.Tick(1);
  EXPECT_EQ(late.Status(), early.Status());
}

TEST(LuaState, DamagedOnesAreRefused)
{
  Scripted scripted({.script = "state = {a = 1} function step() end"});
  const std::vector<char> saved = scripted.Saved();
  Scripted other({.script = "state = {a = 1} function step() end"});
  for (std::size_t length = 0; length < saved.size(); ++length)
    EXPECT_THROW(other.Load({saved.begin(), saved.begin() + static_cast<std::ptrdiff_t>(length)}), std::runtime_error)
        << length;
  Scripted stateless({.script = "function step() end"});
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { stateless.Load(saved); }),
              HasSubstr("saved state: the script has no `state`"));
}

TEST(LuaState, WhatWouldBeLostIsTold)
{
  const auto failure = [](const std::string& script)
  {
    return test::MessageOf<std::runtime_error>(
        [&]
        {
          Scripted scripted({.script = script});
          scripted.StatusAfter(2);
          scripted.Saved();
        });
  };
  for (const Row& row : std::vector<Row>{
           {"function step() end", "its controller cannot be saved"},
           {"k = 0 state = {} function step() k = k + 1 end",
            "walk.lua: the global variable 'k' has changed since the start of the script and would not be restored"},
           {"state = {} function step() k = 1 end", "the global variable 'k' has changed"},
           {"state = {} t = {a = {1}} function step() t.a[1] = 2 end", "the global variable 't' has changed"},
           {"state = {} t = {a = {1}} function step() t.a = {b = 1} end", "the global variable 't' has changed"},
           {"state = {} local list = {}\nfunction step() list[#list + 1] = 1 end",
            "walk.lua:2 has changed since the start"},
           {"state = {} local k = 1\nlocal function f() k = k + 1 end\nfunction step() f() end",
            "the local variable 'k' of the function in "},
           {"state = {} local c = coroutine.create(print) function step() c = c end", "keeps a coroutine"},
           {"state = {} function step() state.f = step end",
            "state.f is a function; only numbers, texts, booleans and tables of them can be saved"},
           {"state = {} function step() state[2] = {print} end", "state[2][1] is a function"},
           {"state = {} function step() state.a = {} state.b = {state.a} end", "is the same table as state."},
           {"state = {} function step() state.a = setmetatable({}, {}) end",
            "state.a has a metatable, which is not saved"},
           {"state = {} function step() state.a = state end", "state.a is the same table as state"},
           {"state = {} function step() state[step] = 1 end", "state has a function as a key"},
           {"state = {} function step() state = 3 end", "the global `state` is no table any more"},
           {"state = {} function step() local t = state for i = 1, 101 do t.a = {} t = t.a end end",
            "is a table within more than 100 tables"},
           {"state = {} function step() local t = state for i = 1, 100 do t.a = {} t = t.a end end", ""},
           {"k = 0 state = {} function step() k = 0 status = 'x' end", ""},
           {"state = {a = {}} local a, t = state.a, {x = state} function step() a.k = 1 t.x.m = 1 end", ""},
           {"state = {} local function f() return 1 end function step() local x = f() end", ""},
           {"state = {} t = {print, step, {}} function step() t[1] = print end", ""},
       })
  {
    const std::string said = failure(row.statements);
    EXPECT_EQ(said.empty(), *row.result == 0) << row.statements;
    EXPECT_THAT(said, HasSubstr(row.result)) << row.statements;
  }
}

}  // namespace
}  // namespace swarmanoid
