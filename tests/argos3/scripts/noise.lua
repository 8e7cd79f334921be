-- Stands still and tells what it reads: speed and way of a wheel, range and bearing, distance and angle of the other one.
function init()
  robot.colored_blob_omnidirectional_camera.enable()
  robot.leds.set_single_color(13, "red")
  robot.range_and_bearing.set_data(1, 1)
end

function step()
  local packet, blob = robot.range_and_bearing[1], robot.colored_blob_omnidirectional_camera[1]
  if robot.id == "a" and packet and blob then
    log("reads ", robot.wheels.velocity_left, " ", robot.wheels.distance_left, " ", packet.range, " ",
        packet.horizontal_bearing, " ", blob.distance, " ", blob.angle)
  end
end
