-- Uses the devices of e-pucks of argos3-epuck by their names in Lua.
steps = 0
function init() robot.colored_blob_omnidirectional_camera.enable() end
function step()
  steps = steps + 1
  robot.wheels.set_velocity(0, 0)
  robot.overo_leds.set_all_colors("black")
  robot.overo_leds.set_single_color(2, 0, 255, 0)
  robot.overo_leds.set_single_color(3, "black")
  assert(not pcall(robot.overo_leds.set_single_color, 4, "red"), "there are three LEDs")
  robot.base_leds.switch_led(1, false)
  robot.base_leds.switch_leds(false)
  robot.range_and_bearing.set_data({5, 6, 7, 8})
  if steps ~= 3 then return end
  local packet = robot.range_and_bearing[1]
  if packet == nil then return end
  log("lua " .. #robot.proximity .. " " .. #robot.light .. " ground " .. robot.ground.left .. " " .. robot.ground.right
      .. " heard " .. packet.data[4] .. " from " .. packet.range .. " sees " .. #robot.colored_blob_omnidirectional_camera)
end
