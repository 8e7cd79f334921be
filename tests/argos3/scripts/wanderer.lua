-- libraries/argos3_wanderer.cpp in Lua: the same rule, the same random numbers, so the same bits.
local readings = require("modules.readings")

local VELOCITY = 5
local turn = 0

function step()
  local x, y = readings.away(robot.proximity)
  if math.sqrt(x * x + y * y) > 0.1 then
    turn = math.atan2(y, x)
  elseif robot.random.bernoulli(0.05) == 1 then
    turn = robot.random.uniform(math.rad(-50), math.rad(50))
  end
  local side = turn > 0.1 and 1 or turn < -0.1 and -1 or 0
  robot.wheels.set_velocity(VELOCITY * (1 - side), VELOCITY * (1 + side))
  turn = turn * 0.7
  if #robot.range_and_bearing == 0 then
    robot.leds.set_single_color(13, "black")
  else
    robot.leds.set_single_color(13, 0, 0, 255)
  end
  robot.leds.set_single_color(1, "red")
  robot.range_and_bearing.set_data(1, robot.random.uniform_int(1, 200))
  for _, packet in ipairs(robot.range_and_bearing) do
    if packet.range < 30 then turn = turn + (packet.data[1] > 100 and 0.3 or -0.3) end
  end
end
