-- Prints what the sensors of a Khepera IV read, in its third step.
steps = 0
function step()
  steps = steps + 1
  robot.wheels.set_velocity(0, 0)
  if steps ~= 3 then return end
  log("lua proximity " .. #robot.proximity .. " " .. robot.proximity[1].value .. " ultrasound " .. robot.ultrasound[3].value
      .. " at " .. robot.ultrasound[3].angle .. " light " .. #robot.light .. " ground " .. robot.ground[1].value .. " "
      .. robot.ground[1].offset.x .. " lidar " .. #robot.lidar .. " " .. robot.lidar[2])
end
