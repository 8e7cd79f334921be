-- A foot-bot drives straight on and turns away from what its proximity sensors see: the rule of the controller
-- footbot_diffusion in C++, with the same results.
local p = parameters{
  velocity = {default = 0.05, unit = "m/s", minimum = 0, maximum = 0.5, description = "Of the robot that drives on."},
  alpha = {default = 7.5, unit = "degrees", minimum = 0, maximum = 89, description = "Half the cone ahead that must be free."},
  delta = {default = 0.1, minimum = 0, description = "Longest sum of the readings that is ignored."},
}

local SENSORS = 24
local WHEEL_RADIUS = 0.029112741 -- m
local tan_alpha = math.tan(math.rad(p.alpha))
local speed = p.velocity / WHEEL_RADIUS

-- What checkpoints and replaced processes restore.
state = {turns = 0}

-- Returns the mean of the readings, each times the direction of its sensor.
local directions = {}
for i = 1, SENSORS do
  local angle = math.rad(7.5 + 15 * (i - 1))
  directions[i] = {x = math.cos(angle), y = math.sin(angle)}
end
local function obstacle(readings)
  local x, y = 0, 0
  for i = 1, SENSORS do
    x = x + readings[i] * directions[i].x
    y = y + readings[i] * directions[i].y
  end
  return x / SENSORS, y / SENSORS
end

function step()
  local x, y = obstacle(robot.footbot_proximity)
  local far_away = x * x + y * y <= p.delta * p.delta
  local beside = y > x * tan_alpha or y < -x * tan_alpha
  if x <= 0 or far_away and beside then
    robot.footbot_wheels.set(speed, speed)
  else
    state.turns = state.turns + 1
    if y > 0 then robot.footbot_wheels.set(speed, 0) else robot.footbot_wheels.set(0, speed) end
  end
end

function destroy() log("turned in ", state.turns, " steps") end
