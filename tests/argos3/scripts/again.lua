local steps = 0

function init() log("init ", steps) end

function step()
  steps = steps + 1
  robot.wheels.set_velocity(5, 5)
end

function reset()
  log("reset after ", steps)
  steps = 0
end
