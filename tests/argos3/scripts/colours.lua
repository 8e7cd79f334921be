-- Drives ahead and says which colours it sees.
function init() robot.colored_blob_omnidirectional_camera.enable() end

function step()
  robot.wheels.set_velocity(10, 10)
  local seen = {}
  for i = 1, #robot.colored_blob_omnidirectional_camera do
    local colour = robot.colored_blob_omnidirectional_camera[i].color
    seen[i] = string.format("%d,%d,%d", colour.red, colour.green, colour.blue)
  end
  table.sort(seen)
  log("saw ", table.concat(seen, " "))
end
