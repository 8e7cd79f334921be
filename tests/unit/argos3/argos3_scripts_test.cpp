// Scripts of ARGoS3 in Lua: what the table `robot`, vectors and random numbers do. The scripts check it themselves.
#include <argos3/core/utility/logging/argos_log.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <gmock/gmock.h>

#include <sstream>
#include <string>

#include "tests/unit/argos3/argos3_run.h"
#include "tests/world/message_of.h"

namespace
{

using namespace argos;
using swarmanoid::test::Argos3Run;
using swarmanoid::test::Argos3Text;
using swarmanoid::test::Placed;
using testing::HasSubstr;

// The scripts of these tests call these functions.
const char* const kChecks = R"(
function near(value, expected, limit)
  if not (math.abs(value - expected) <= (limit or 1e-6)) then error(value .. " is not " .. expected, 2) end
end
function refused(words, call, ...)
  local ok, message = pcall(call, ...)
  if ok then error("it was not refused: " .. words, 2) end
  if not tostring(message):find(words, 1, true) then error(tostring(message) .. " has not the words " .. words, 2) end
end
ticks = 0
)";

// A controller with a script.
std::string Scripted(const std::string& id, const std::string& actuators, const std::string& sensors)
{
  return "<lua_controller id='" + id + "'><actuators>" + actuators + "</actuators><sensors>" + sensors +
         "</sensors><params script='" + id + ".lua' speed='5 cm'/></lua_controller>";
}

// Catches the lines that scripts log while it lives.
class Logged
{
public:
  Logged() : before_(LOG.GetStream().rdbuf(text_.rdbuf())) {}
  ~Logged() { LOG.GetStream().rdbuf(before_); }
  Logged(const Logged&) = delete;
  Logged& operator=(const Logged&) = delete;
  std::string Text() const { return text_.str(); }

private:
  std::ostringstream text_;
  std::streambuf* before_;
};

TEST(Argos3Scripts, VectorsAndQuaternionsHaveTheirOperators)
{
  const Logged logged;
  Argos3Run run({.controllers = Scripted("v", "", ""),
                 .arena = Placed("foot-bot", "a", "0,0,0", "v"),
                 .files = {{"v.lua", std::string(kChecks) + R"(
function init()
  local a, b = vector2(3, 4), vector2(1, 2)
  local sum, difference = a + b, a - b
  near(sum.x, 4) near(sum.y, 6) near(difference.x, 2) near(difference.y, 2)
  near((a * 2).y, 8) near((2 * a).x, 6) near((-a).x, -3) near((-a).y, -4)
  near(a:length(), 5) near(a:dot(b), 11) near(a:cross(b), 2)
  assert(a == vector2(3, 4) and a ~= vector2(3, 5) and a ~= vector2(4, 4))
  local copy = vector2(a)
  a:normalize()
  near(a.x, 0.6) near(a.y, 0.8) near(copy.x, 3)
  copy.x = 7
  copy.y = 8
  assert(tostring(copy) == "7,8", tostring(copy))
  local turned = vector2(1, 0):rotate(math.pi / 2)
  near(turned.x, 0) near(turned.y, 1)
  assert(vector2() == vector2(0, 0))

  local u, v = vector3(1, 2, 3), vector3(4, 5, 6)
  local total, rest = u + v, u - v
  near(total.x, 5) near(total.y, 7) near(total.z, 9) near(rest.x, -3) near(rest.z, -3)
  near((u * 3).z, 9) near((3 * u).y, 6) near((-u).z, -3) near(u:dot(v), 32) near(vector3(2, 3, 6):length(), 7)
  assert(u == vector3(1, 2, 3) and u ~= vector3(1, 2, 4))
  local same = vector3(u)
  same:cross(v)
  near(same.x, -3) near(same.y, 6) near(same.z, -3) near(u.x, 1)
  same.x, same.y, same.z = 1, 2, 2
  same:normalize()
  near(same.x, 1 / 3) near(same.z, 2 / 3)

  local quarter = quaternion(math.pi / 2, vector3(0, 0, 1))
  near(quarter.w, math.sqrt(0.5)) near(quarter.z, math.sqrt(0.5)) near(quarter.x, 0) near(quarter.y, 0)
  local ahead = vector3(1, 0, 0):rotate(quarter)
  near(ahead.x, 0) near(ahead.y, 1)
  local half = quarter * quarter
  local angle, axis = half:toangleaxis()
  near(angle, math.pi) near(axis.z, 1)
  near(half.angle, math.pi) near(half.axis.z, 1)
  local z, y, x = quaternion(math.pi / 4, vector3(0, 0, 1)):toeulerangles()
  near(z, math.pi / 4) near(y, 0) near(x, 0)
  near((quarter * quarter:inverse()).w, 1)
  assert(quaternion() == quaternion(1, 0, 0, 0) and quaternion() ~= quaternion(1, 0, 0, 1))
  local q = quaternion(1, 2, 3, 4)
  near(q.w, 1) near(q.x, 2) near(q.y, 3) near(q.z, 4)
  q.w, q.x, q.y, q.z = 0, 0, 3, 4
  q:normalize()
  near(q.y, 0.6) near(q.z, 0.8)
  near(quaternion(q).z, 0.8)

  refused("2 values are given, and 3 are needed", vector3, 1, 2)
  refused("3 values are given, and 2 are needed", vector2, 1, 2, 3)
  refused("3 values are given, and 4 are needed", quaternion, 1, 2, 3)
  refused("vector3", function() return u + a end)
  refused("a vector3 has no element 'q'; its elements are xyz", function() return u.q end)
  refused("a vector2 has no element 'z'; its elements are xy", function() return a.z end)
  refused("a vector2 has no element 'length'; its elements are xy", function() a.length = 1 end)
  log("vectors are right")
end
function step() end
)"}}});
  EXPECT_EQ(logged.Text(), "vectors are right\n");
}

TEST(Argos3Scripts, RandomNumbersAreInTheirRanges)
{
  const Logged logged;
  Argos3Run run({.controllers = Scripted("r", "", ""),
                 .arena = Placed("foot-bot", "a", "0,0,0", "r"),
                 .files = {{"r.lua", std::string(kChecks) + R"(
function init()
  local random = robot.random
  local counts, sum, heads, waits, events, bells, most = {}, 0, 0, 0, 0, 0, 0
  for i = 1, 4000 do
    local x = random.uniform()
    assert(x >= 0 and x < 1)
    sum = sum + x
    x = random.uniform(5)
    assert(x >= 0 and x < 5)
    most = math.max(most, x)
    x = random.uniform(-3, -2)
    assert(x >= -3 and x < -2)
    local whole = random.uniform_int(3)
    counts[whole] = (counts[whole] or 0) + 1
    whole = random.uniform_int(-2, 0)
    assert(whole == -2 or whole == -1)
    heads = heads + random.bernoulli()
    assert(random.bernoulli(1) == 1 and random.bernoulli(0) == 0)
    waits = waits + random.exponential(2)
    events = events + random.poisson(3)
    bells = bells + random.gaussian(0.5) + random.gaussian(0.5, 7)
  end
  near(sum / 4000, 0.5, 0.02)
  assert(most > 4.9)
  for i = 0, 2 do near(counts[i], 1333, 150) end
  assert(counts[3] == nil)
  near(heads, 2000, 150)
  near(waits / 4000, 2, 0.15)
  near(events / 4000, 3, 0.12)
  near(bells / 4000, 7, 0.05)
  assert(math.type(random.uniform_int(3)) == "integer")
  near(random.uniform_int(4.7, 5.2), 4)
  near(random.uniform_int(1e9, 1e9), 1e9)
  refused("random.uniform has no, one or two values", random.uniform, 1, 2, 3)
  refused("0 values are given, and 2 are needed", random.uniform_int)
  refused("3 values are given, and 2 are needed", random.uniform_int, 1, 2, 3)
  refused("a limit is beyond a thousand million", random.uniform_int, 2e9)
  refused("a limit is beyond a thousand million", random.uniform_int, -2e9, 1)
  refused("number expected", random.gaussian)
  assert(robot.id == "a" and robot.params.speed == "5 cm" and robot.params.none == nil)
  log("numbers ", 1.5, " ", true, " ", nil, " ", {}, " are right")
end
function step() end
function reset() log("again") end
function destroy() log("ends") end
)"}}});
  EXPECT_EQ(logged.Text(), "numbers 1.5 true nil table are right\n");
  run.Simulator().Reset();
  EXPECT_THAT(logged.Text(), HasSubstr("right\nagain\n"));
}

TEST(Argos3Scripts, ActuatorsOfAFootBotHaveLimits)
{
  const Logged logged;
  Argos3Run run({.controllers = Scripted("f",
                                         "<differential_steering/><leds medium='leds'/><range_and_bearing/>"
                                         "<footbot_turret/><footbot_gripper/><footbot_distance_scanner/>",
                                         "<differential_steering/><footbot_turret_encoder/>"
                                         "<footbot_distance_scanner/><range_and_bearing medium='rab'/>"),
                 .arena = Placed("foot-bot", "a", "0,0,0", "f") + Placed("foot-bot", "b", "0.5,0,0", "f"),
                 .files = {{"f.lua", std::string(kChecks) + R"(
function init()
  local leds = robot.leds
  refused("there is no LED 0; they are 1 to 13", leds.set_single_color, 0, "red")
  refused("there is no LED 14; they are 1 to 13", leds.set_single_color, 14, "red")
  refused("a colour is 0 to 255", leds.set_single_color, 1, 256, 0, 0)
  refused("a colour is 0 to 255", leds.set_single_color, 1, 0, -1, 0)
  refused("no colour 'redd'", leds.set_all_colors, "redd")
  refused("2 values are given, and 3 are needed", leds.set_all_colors, 1, 2)
  refused("3 values are given, and 4 are needed", leds.set_single_color, 1, 2, 3)
  leds.set_all_colors(10, 20, 255)
  leds.set_single_color(1, "red")
  leds.set_single_color(13, 1, 2, 3)
  local radio = robot.range_and_bearing
  refused("there is no byte 0; they are 1 to 10", radio.set_data, 0, 1)
  refused("there is no byte 11; they are 1 to 10", radio.set_data, 11, 1)
  refused("9 bytes are given, and a message has 10", radio.set_data, {1, 2, 3, 4, 5, 6, 7, 8, 9})
  refused("11 bytes are given, and a message has 10", radio.set_data, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11})
  refused("table expected", radio.set_data, 5)
  refused("1 values are given, and 2 are needed", robot.wheels.set_velocity, 1)
  refused("that is no speed of a turret", robot.turret.set_rotation_speed, 2e6)
  refused("that is no speed of a turret", robot.turret.set_rotation_speed, -1e7)
  robot.turret.set_rotation_speed(1e6)
  refused("1 values are given, and 0 are needed", robot.gripper.unlock, 1)
  refused("0 values are given, and 1 are needed", robot.distance_scanner.set_rpm)
  refused("0 values are given, and 1 are needed", robot.distance_scanner.set_angle)
  refused("0 values are given, and 1 are needed", robot.turret.set_rotation)
end
function step()
  ticks = ticks + 1
  if ticks == 1 then
    robot.wheels.set_velocity(3, 4)
    robot.turret.set_speed_control_mode()
    robot.turret.set_rotation_speed(6)
    robot.range_and_bearing.set_data({1, 2, 3, 4, 5, 6, 7, 8, 9, 300})
    robot.range_and_bearing.set_data(1, -1)
    robot.distance_scanner.enable()
  elseif ticks == 2 then
    near(robot.wheels.velocity_left, 3) near(robot.wheels.velocity_right, 4)
    near(robot.wheels.distance_left, 0.3) near(robot.wheels.distance_right, 0.4)
    near(robot.wheels.axis_length, 14)
    near(robot.turret.rotation, 0.1 * 6 * 2 * math.pi / 60, 1e-5)
    assert(#robot.range_and_bearing == 1)
    local packet = robot.range_and_bearing[1]
    assert(#packet.data == 10 and packet.data[1] == 255 and packet.data[2] == 2 and packet.data[10] == 44)
    near(packet.range, 50, 1)
    near(math.abs(packet.horizontal_bearing), robot.id == "a" and 0 or math.pi, 0.01)
    near(packet.vertical_bearing, 0)
    robot.turret.set_passive_mode()
    robot.range_and_bearing.clear_data()
  elseif ticks == 4 then
    near(robot.range_and_bearing[1].data[2], 0)
    local scanner = robot.distance_scanner
    assert(#scanner.short_range == 2 and #scanner.long_range == 2)
    near(scanner.long_range[2].angle, math.pi / 2)
    near(scanner.long_range[2].distance, -2)
    scanner.disable()
    robot.turret.set_position_control_mode()
    robot.turret.set_rotation(robot.turret.rotation + 1)
  elseif ticks == 6 then
    assert(#robot.distance_scanner.short_range == 0)
    robot.distance_scanner.set_rpm(60)
    robot.gripper.lock_positive()
    robot.gripper.lock_negative()
    log(robot.id, " is right")
  end
end
)"}}});
  auto& leds = run.Get("a").GetLEDEquippedEntity();
  run.Step();
  EXPECT_EQ(leds.GetLED(0).GetColor(), CColor::RED);
  EXPECT_EQ(leds.GetLED(1).GetColor(), CColor(10, 20, 255));
  EXPECT_EQ(leds.GetLED(11).GetColor(), CColor(10, 20, 255));
  EXPECT_EQ(leds.GetLED(12).GetColor(), CColor(1, 2, 3));
  EXPECT_EQ(ToString(run.Get("a").GetRABEquippedEntity().GetData()), "255 2 3 4 5 6 7 8 9 44");
  run.Step(6);
  EXPECT_THAT(logged.Text(), HasSubstr("a is right"));
  EXPECT_THAT(logged.Text(), HasSubstr("b is right"));
}

TEST(Argos3Scripts, SensorsOfAFootBotAreLists)
{
  const Logged logged;
  Argos3Run run(
      {.controllers = Scripted("s", "<leds medium='leds'/>",
                               "<footbot_proximity/><footbot_light/><footbot_motor_ground/>"
                               "<footbot_base_ground/><positioning/><battery/>"
                               "<colored_blob_omnidirectional_camera medium='leds'/>"
                               "<colored_blob_perspective_camera medium='leds'/>"),
       .arena = "<floor id='floor' source='loop_functions' pixels_per_meter='10'/>" +
                Placed("foot-bot", "a", "1,2,0", "s", "90,0,0") +
                Placed("box", "wall", "1,2.19,0", "", "0,0,0", "size='1,0.1,0.5' movable='false'") +
                "<light id='lamp' position='3,2,0.2' orientation='0,0,0' color='red' intensity='1' medium='leds'/>",
       .files = {{"s.lua", std::string(kChecks) + R"(
function init() robot.colored_blob_omnidirectional_camera.enable() end
function step()
  ticks = ticks + 1
  if ticks < 3 then return end
  assert(#robot.proximity == 24 and #robot.light == 24 and #robot.motor_ground == 4 and #robot.base_ground == 8)
  near(robot.proximity[1].angle, math.rad(7.5))
  near(robot.proximity[13].angle, math.rad(-172.5))
  assert(robot.proximity[1].value > 0 and robot.proximity[24].value > 0 and robot.proximity[12].value == 0)
  near(robot.light[24].angle, math.rad(-7.5))
  assert(robot.light[18].value > 0 and robot.light[6].value == 0)
  near(robot.motor_ground[2].offset.x, -6.3) near(robot.motor_ground[2].offset.y, 1.16)
  near(robot.motor_ground[1].value, 0) near(robot.motor_ground[4].value, 1)
  near(robot.base_ground[2].offset.x, 4.2) near(robot.base_ground[2].offset.y, 6.5)
  near(robot.base_ground[3].value, 0) near(robot.base_ground[7].value, 1)
  near(robot.positioning.position.x, 1) near(robot.positioning.position.y, 2) near(robot.positioning.position.z, 0)
  near((robot.positioning.orientation:toeulerangles()), math.pi / 2)
  near(robot.battery.available_charge, 1)
  assert(robot.battery.time_left == math.huge)
  assert(#robot.colored_blob_perspective_camera == 0)
  assert(robot.none == nil and robot.wheels == nil)
  local fields = {}
  for field in pairs(robot) do fields[#fields + 1] = field end
  assert(table.concat(fields, " ") == "base_ground battery colored_blob_omnidirectional_camera " ..
         "colored_blob_perspective_camera id leds light motor_ground params positioning proximity random",
         table.concat(fields, " "))
  if ticks == 4 then robot.colored_blob_omnidirectional_camera.disable() end
  if ticks == 6 then
    assert(#robot.colored_blob_omnidirectional_camera == 0)
    log("sensors are right")
  end
end
)"}}},
      {.floor = [](const CVector2& place) { return place.GetX() < 1 ? CColor::BLACK : CColor::WHITE; }});
  run.Step(6);
  EXPECT_EQ(logged.Text(), "sensors are right\n");
}

TEST(Argos3Scripts, QuadrotorsAreToldDegrees)
{
  const Logged logged;
  const std::string flies = std::string(kChecks) + R"(
function init()
  refused("2 values are given, and 3 are needed", robot.quadrotor.set_absolute_position, 1, 2)
  refused("0 values are given, and 1 are needed", robot.quadrotor.set_absolute_yaw)
end
function step()
  ticks = ticks + 1
  if ticks == 1 then
    robot.quadrotor.set_absolute_position(0.3, 0, 1.2)
    robot.quadrotor.set_absolute_yaw(90)
  elseif ticks == 80 then
    near(robot.positioning.position.x, 0.3, 0.02) near(robot.positioning.position.z, 1.2, 0.02)
    near((robot.positioning.orientation:toeulerangles()), math.pi / 2, 0.05)
    robot.quadrotor.set_relative_position(0.2, 0.1, 0)
    robot.quadrotor.set_relative_yaw(-90)
  elseif ticks == 160 then
    near(robot.positioning.position.x, 0.2, 0.02) near(robot.positioning.position.y, 0.2, 0.02)
    near((robot.positioning.orientation:toeulerangles()), 0, 0.05)
    log("places are right")
  end
end
)";
  const std::string goes = std::string(kChecks) + R"(
function init()
  refused("1 values are given, and 3 are needed", robot.quadrotor.set_linear_velocity, 1)
  refused("4 values are given, and 3 are needed", robot.quadrotor.set_linear_velocity, 1, 2, 3, 4)
  refused("0 values are given, and 1 are needed", robot.quadrotor.set_rotational_speed)
end
function step()
  ticks = ticks + 1
  if ticks < 60 then robot.quadrotor.set_linear_velocity(0.1, 0.05, 0.02)
  elseif ticks < 120 then robot.quadrotor.set_linear_velocity(0, 0.1)
  else robot.quadrotor.set_linear_velocity(0, 0, 0) robot.quadrotor.set_rotational_speed(0.3) end
  local at, heading = robot.positioning.position, robot.positioning.orientation:toeulerangles()
  if ticks == 40 or ticks == 100 or ticks == 150 then from, turned = vector3(at), heading end
  if ticks == 50 then
    local way = at - from
    near(way.x, 0.1, 0.01) near(way.y, 0.05, 0.01) near(way.z, 0.02, 0.01)
  elseif ticks == 110 then
    local way = at - from
    near(way.x, 0, 0.01) near(way.y, 0.1, 0.01) near(way.z, 0, 0.01)
  elseif ticks == 160 then
    near(heading - turned, 0.3, 0.03)
    log("speeds are right")
  end
end
)";
  Argos3Run run({.controllers = Scripted("p", "<quadrotor_position/>", "<positioning/>") +
                                Scripted("q", "<quadrotor_speed/>", "<positioning/>"),
                 .arena = Placed("eye-bot", "a", "0,0,1", "p") + Placed("eye-bot", "b", "-2,-2,1", "q"),
                 .engines = "<pointmass3d id='p'/>",
                 .files = {{"p.lua", flies}, {"q.lua", goes}}});
  run.Step(162);
  EXPECT_THAT(logged.Text(), HasSubstr("places are right\n"));
  EXPECT_THAT(logged.Text(), HasSubstr("speeds are right\n"));
}

TEST(Argos3Scripts, EPucksHaveNumbersAlone)
{
  const Logged logged;
  Argos3Run run({.controllers = Scripted("e", "<differential_steering/>", "<proximity/><light/><ground/>"),
                 .arena = "<floor id='floor' source='loop_functions' pixels_per_meter='10'/>" +
                          Placed("e-puck", "e", "0,0,0", "e") +
                          Placed("box", "wall", "0.115,0,0", "", "0,0,0", "size='0.1,1,0.5' movable='false'"),
                 .files = {{"e.lua", std::string(kChecks) + R"(
function step()
  assert(#robot.proximity == 8 and #robot.light == 8 and #robot.ground == 3)
  local distance = (0.065 - 0.035 * math.cos(math.rad(17))) / math.cos(math.rad(17))
  near(robot.proximity[1], math.exp(-distance), 1e-5) near(robot.proximity[8], robot.proximity[1], 1e-5)
  near(robot.proximity[4], 0)
  near(robot.light[1], 0)
  near(robot.ground[1], 1) near(robot.ground[3], 0)
  log("numbers are right")
end
)"}}},
                {.floor = [](const CVector2& place) { return place.GetY() > 0 ? CColor::BLACK : CColor::WHITE; }});
  run.Step();
  EXPECT_EQ(logged.Text(), "numbers are right\n");
}

TEST(Argos3Scripts, RobotsOfPlugInsHaveTheirTables)
{
  const Logged logged;
  const std::string khepera = std::string(kChecks) + R"(
function step()
  ticks = ticks + 1
  if ticks < 2 then return end
  assert(#robot.proximity == 8 and #robot.ultrasound == 5 and #robot.light == 8)
  assert(#robot.ground == 4 and #robot.lidar == 15)
  near(robot.proximity[1].value, 4.14 * math.exp(-33 * 0.06) - 0.085, 1e-5)
  near(robot.proximity[8].angle, math.rad(-45))
  near(robot.ultrasound[3].angle, math.rad(90))
  near(robot.light[4].angle, math.rad(135))
  near(robot.ground[1].offset.x, 0.0614) near(robot.ground[4].offset.y, -0.01)
  near(robot.ground[1].value, 0) near(robot.ground[4].value, 1)
  near(robot.lidar[2], 148)
  log("khepera is right")
end
)";
  const std::string pipuck = std::string(kChecks) + R"(
function init()
  refused("1 values are given, and 2 are needed", robot.differential_drive.set_linear_velocity, 1)
  refused("there is no LED 0; they are 1 to 8", robot.leds.set_ring_led_index, 0, true)
  refused("there is no LED 9; they are 1 to 8", robot.leds.set_ring_led_index, 9, true)
  refused("boolean expected", robot.leds.set_ring_led_index, 1, 1)
  refused("boolean expected", robot.leds.set_body_led, "on")
  refused("0 values are given, and 1 are needed", robot.leds.set_ring_leds)
end
function step()
  ticks = ticks + 1
  if ticks == 1 then
    robot.differential_drive.set_linear_velocity(0.01, 0.02)
    robot.leds.set_ring_leds(true)
    robot.leds.set_ring_led_index(4, false)
    robot.leds.set_front_led(true)
    robot.leds.set_body_led(false)
  elseif ticks == 2 then
    near(robot.differential_drive.encoders.left, 0.01) near(robot.differential_drive.encoders.right, 0.02)
    near(robot.system.time, 0.2) near(robot.system.temperature, 0)
    assert(#robot.rangefinders == 8 and #robot.ground_sensors == 3)
    local third, ground = robot.rangefinders[3], robot.ground_sensors[1]
    near(third.proximity, 0.06, 1e-3) near(third.illuminance, 0)
    near(third.transform.position.y, -0.035) near(third.transform.position.z, 0.0333)
    assert(third.transform.anchor == "origin")
    local direction = vector3(0, 0, 1):rotate(third.transform.orientation)
    near(direction.y, -1) near(direction.z, 0)
    near(ground.reflected, 0) near(ground.background, 0) near(robot.ground_sensors[3].reflected, 1)
    near(ground.transform.position.x, 0.03) near(ground.transform.position.y, 0.01)
    log("pipuck is right")
  end
end
)";
  const auto floor = [](const CVector2& place) { return place.GetY() > 0.005 ? CColor::BLACK : CColor::WHITE; };
  const std::string painted = "<floor id='floor' source='loop_functions' pixels_per_meter='10'/>";
  {
    Argos3Run run({.controllers = Scripted("k", "<differential_steering/>",
                                           "<kheperaiv_proximity/><kheperaiv_ultrasound/><kheperaiv_light/>"
                                           "<kheperaiv_ground/><kheperaiv_lidar num_readings='15'/>"),
                   .arena = painted + Placed("kheperaiv", "k", "0,0,0", "k") +
                            Placed("box", "ahead", "0.2304,0,0", "", "0,0,0", "size='0.2,0.6,0.12' movable='false'") +
                            Placed("box", "right", "0,-1.6754,0", "", "0,0,0", "size='0.6,0.2,0.5' movable='false'"),
                   .files = {{"k.lua", khepera}}},
                  {.floor = floor});
    run.Step(2);
    EXPECT_EQ(logged.Text(), "khepera is right\n");
  }
  Argos3Run run(
      {.controllers = Scripted("p", "<pipuck_differential_drive/><pipuck_leds/>",
                               "<pipuck_differential_drive/><pipuck_rangefinders/><pipuck_ground/><pipuck_system/>"),
       .arena = painted + Placed("pipuck", "p", "0,0,0", "p") +
                Placed("box", "right", "0,-0.195,0", "", "0,0,0", "size='0.2,0.2,0.04' movable='false'"),
       .media = "<led id='leds'/>",
       .files = {{"p.lua", pipuck}}},
      {.floor = floor});
  run.Step();
  std::string lit;
  for (UInt32 led = 0; led < 10; ++led)
    lit += run.Get("p").GetLEDEquippedEntity().GetLED(led).GetColor() == CColor::WHITE ? '1' : '0';
  EXPECT_EQ(lit, "1110111110");
  run.Step();
  EXPECT_EQ(logged.Text(), "khepera is right\npipuck is right\n");
}

TEST(Argos3Scripts, EPucksOfThePlugInHaveItsNames)
{
  const Logged logged;
  Argos3Run run(
      {.controllers = Scripted("e",
                               "<epuck_wheels/><epuck_rgb_leds medium='leds'/><epuck_base_leds medium='leds'/>"
                               "<epuck_range_and_bearing range='0.7'/>",
                               "<epuck_range_and_bearing medium='rab' data_size='4'/><epuck_proximity/><epuck_light/>"
                               "<epuck_ground/><epuck_omnidirectional_camera medium='leds'/>"),
       .arena = "<floor id='floor' source='loop_functions' pixels_per_meter='10'/>" +
                Placed("e-puck", "a", "0,0,0", "e") + Placed("e-puck", "b", "0.28,0,0", "e"),
       .size = "4,4,1",
       .files = {{"e.lua", std::string(kChecks) + R"(
function init()
  refused("1 values are given, and 2 are needed", robot.wheels.set_velocity, 1)
  refused("there is no LED 0; they are 1 to 3", robot.overo_leds.set_single_color, 0, "red")
  refused("there is no LED 4; they are 1 to 3", robot.overo_leds.set_single_color, 4, "red")
  refused("there is no LED 0; they are 1 to 8", robot.base_leds.switch_led, 0, true)
  refused("there is no LED 9; they are 1 to 8", robot.base_leds.switch_led, 9, true)
  refused("boolean expected", robot.base_leds.switch_led, 1, 1)
  refused("boolean expected", robot.base_leds.switch_leds, 1)
  refused("3 bytes are given, and a message has 4", robot.range_and_bearing.set_data, {1, 2, 3})
  refused("5 bytes are given, and a message has 4", robot.range_and_bearing.set_data, {1, 2, 3, 4, 5})
  robot.colored_blob_omnidirectional_camera.enable()
end
function step()
  ticks = ticks + 1
  if ticks == 1 then
    robot.wheels.set_velocity(0, 0)
    robot.overo_leds.set_all_colors("black")
    robot.overo_leds.set_single_color(2, 0, 255, 0)
    robot.base_leds.switch_leds(true)
    robot.base_leds.switch_led(1, false)
    robot.range_and_bearing.set_data({5, 6, 7, 300})
  elseif ticks == 3 then
    assert(#robot.proximity == 8 and #robot.light == 8 and #robot.range_and_bearing == 1)
    near(robot.proximity[3].angle, math.pi / 2)
    near(robot.light[8].angle, math.pi / 0.5247)
    near(robot.ground.left, 0) near(robot.ground.center, 1) near(robot.ground.right, 1)
    local packet = robot.range_and_bearing[1]
    assert(#packet.data == 4 and packet.data[1] == 5 and packet.data[4] == 44)
    near(packet.range, 21, 1e-4)
    near(math.abs(packet.bearing), robot.id == "a" and 0 or math.pi, 1e-6)
    local blobs = robot.colored_blob_omnidirectional_camera
    local green = 0
    for _, blob in ipairs(blobs) do
      if blob.color.green == 255 and blob.color.red == 0 then green = green + 1 end
    end
    assert(green == 1, green)
    robot.colored_blob_omnidirectional_camera.disable()
  elseif ticks == 4 then
    assert(#robot.colored_blob_omnidirectional_camera == 0)
    log(robot.id, " is right")
  end
end
)"}}},
      {.floor = [](const CVector2& place) { return place.GetY() > 0 ? CColor::BLACK : CColor::WHITE; }});
  run.Step();
  auto& leds = run.Get("a").GetLEDEquippedEntity();
  EXPECT_EQ(leds.GetLED(7).GetColor(), CColor::BLACK) << "the first one clockwise";
  EXPECT_EQ(leds.GetLED(0).GetColor(), CColor::RED);
  EXPECT_EQ(leds.GetLED(8).GetColor(), CColor::BLACK);
  EXPECT_EQ(leds.GetLED(9).GetColor(), CColor::GREEN);
  run.Step(3);
  EXPECT_THAT(logged.Text(), HasSubstr("a is right"));
  EXPECT_THAT(logged.Text(), HasSubstr("b is right"));
}

TEST(Argos3Scripts, MistakesNameTheLine)
{
  const auto mistake = [](const std::string& script)
  {
    return swarmanoid::test::MessageOf<CARGoSException>(
        [&]
        {
          Argos3Run run({.controllers = Scripted("m", "<differential_steering/>", ""),
                         .arena = Placed("foot-bot", "a", "0,0,0", "m"),
                         .files = {{"m.lua", script}}});
          run.Step();
        });
  };
  EXPECT_THAT(mistake("function step()\n  error('late')\nend"), HasSubstr("m.lua:2: late"));
  EXPECT_THAT(mistake("function step() end\nfunction init()\n  error('early')\nend"), HasSubstr("m.lua:3: early"));
  EXPECT_THAT(mistake("function init() end"), HasSubstr("m.lua: the script has no function step()"));
  EXPECT_THAT(mistake("function step()\n  robot.wheels.set_velocity('x', 1)\nend"), HasSubstr("m.lua:2: bad argument"));
  EXPECT_EQ(mistake("function step() robot = 5 end"), "") << "a script may replace the table";
}

}  // namespace
