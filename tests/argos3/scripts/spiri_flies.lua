-- Flies straight on, and turns.
function step()
  robot.quadrotor.set_linear_velocity(0.5, 0, 0)
  robot.range_and_bearing.set_data(1, 9)
  local at = robot.positioning.position
  log(string.format("flies %.3f %.3f %.3f", at.x, at.y, at.z))
end
