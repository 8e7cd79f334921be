-- Says what the devices of a foot-bot read, once.
local function text_of(value)
  if type(value) == "userdata" then return "{" .. tostring(value) .. "}" end
  if type(value) ~= "table" then return type(value) == "number" and string.format("%.6g", value) or tostring(value) end
  local parts = {}
  for key, part in pairs(value) do
    if type(part) ~= "function" then parts[#parts + 1] = key .. "=" .. text_of(part) end
  end
  return "{" .. table.concat(parts, " ") .. "}"
end

local ticks = 0

function init()
  robot.colored_blob_omnidirectional_camera.enable()
  robot.turret.set_position_control_mode()
  robot.turret.set_rotation(0.5)
  robot.range_and_bearing.set_data({1, 2, 3, 4, 5, 6, 7, 8, 9, 300})
  robot.leds.set_all_colors("green")
end

function step()
  robot.wheels.set_velocity(10, 10)
  ticks = ticks + 1
  if ticks ~= 10 then return end
  for _, name in ipairs({"wheels", "proximity", "light", "motor_ground", "base_ground", "positioning", "battery", "turret", "range_and_bearing",
                         "colored_blob_omnidirectional_camera"}) do
    log(robot.id, " ", name, " ", text_of(robot[name]))
  end
  robot.gripper.lock_positive()
  robot.range_and_bearing.clear_data()
end

function destroy() log(robot.id, " ends after ", ticks, " steps ", ticks > 0) end
