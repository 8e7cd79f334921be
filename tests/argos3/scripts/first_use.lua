-- Sensors are read from their first use on: what the script has not asked for is not in the table yet.
local steps = 0
local kept

function step()
  steps = steps + 1
  assert(rawget(robot, "battery") == nil, "a sensor that nobody used")
  if steps < 4 then
    assert(rawget(robot, "proximity") == nil and rawget(robot, "positioning") == nil)
    robot.wheels.set_velocity(5, 5)
    return
  end
  assert(#robot.proximity == 24 and robot.proximity[1].value >= 0 and rawget(robot, "proximity") == robot.proximity)
  -- Angles are written once. A table that the script replaces is new.
  if steps == 4 then robot.proximity[3].angle = "changed" end
  if steps == 5 then assert(robot.proximity[3].angle == "changed") robot.proximity = {} end
  if steps == 6 then assert(math.abs(robot.proximity[3].angle - math.rad(37.5)) < 1e-9 and robot.proximity[24].value) end
  -- A table that the script keeps is written again.
  local x = robot.positioning.position.x
  kept = kept or robot.positioning
  assert(kept == robot.positioning)
  if steps > 4 then assert(x > last, "the robot drives along x") end
  last = x
  if steps == 8 then log("x ", x, " steps ", steps) end
  assert(robot.nothing == nil)
  robot.own = steps
  assert(robot.own == steps)
end

function reset() end

function destroy()
  local fields = {}
  for name in pairs(robot) do fields[#fields + 1] = name end
  table.sort(fields)
  log("fields ", table.concat(fields, " "))
end
