-- Counts its steps where loop functions see them, drives to what is ahead, and grips it.
function init() robot.steps = 0 end

function step()
  robot.steps = robot.steps + 1
  robot.wheels.set_velocity(5, 5)
  if robot.steps > 3000 then robot.gripper.lock_positive() end
end
