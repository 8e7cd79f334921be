-- Goes to a place and tells where it is, what it hears and what it sees.
local ticks = 0

function init()
  robot.colored_blob_perspective_camera.enable()
end

function step()
  ticks = ticks + 1
  robot.quadrotor.set_absolute_position(1, 0, 2)
  robot.range_and_bearing.set_data(1, 7)
  local at = robot.positioning.position
  log(string.format("at %.3f %.3f %.3f", at.x, at.y, at.z))
  for _, packet in ipairs(robot.range_and_bearing) do
    log(string.format("hears %d %.1f", packet.data[1], packet.range))
  end
  for _, blob in ipairs(robot.colored_blob_perspective_camera) do
    log(string.format("sees %d %d %d", blob.x, blob.y, blob.color.red))
  end
  log(string.format("charge %.4f", robot.battery.available_charge))
end
