-- Prints what the sensors of a Pi-Puck read, in its third step, and drives a curve.
steps = 0
function step()
  steps = steps + 1
  robot.differential_drive.set_linear_velocity(0, 0.05)
  robot.leds.set_ring_leds(true)
  robot.leds.set_ring_led_index(4, false)
  robot.leds.set_front_led(true)
  robot.leds.set_body_led(false)
  if steps ~= 3 then return end
  local seen = ""
  for _, one in ipairs(robot.rangefinders) do seen = seen .. " " .. one.proximity end
  log("lua ranges" .. seen)
  local ray, ground = robot.rangefinders[3].transform, robot.ground_sensors[1]
  local direction = vector3(0, 0, 1)
  direction:rotate(ray.orientation)
  log("lua place " .. ray.position.y .. " looks " .. direction.y .. " from " .. ray.anchor .. " ground " .. #robot.ground_sensors
      .. " " .. ground.reflected .. " " .. ground.transform.position.y .. " speeds " .. robot.differential_drive.encoders.left .. " "
      .. robot.differential_drive.encoders.right .. " time " .. robot.system.time .. " " .. robot.system.temperature)
end
