-- Says where in its image it sees something, from step 3 on.
function init() steps = 0 end

function step()
  steps = steps + 1
  if steps == 2 then robot.colored_blob_perspective_camera.enable() end
  for i = 1, #robot.colored_blob_perspective_camera do
    local blob = robot.colored_blob_perspective_camera[i]
    log("sees ", blob.color.red, ",", blob.color.green, ",", blob.color.blue, " at ", blob.x, ",", blob.y)
  end
end
