-- Drives on at 10 cm/s and tells where it is.
function step()
  robot.wheels.set_velocity(10, 10)
  local at = robot.positioning.position
  log(string.format("at %.6f %.6f", at.x, at.y))
end
