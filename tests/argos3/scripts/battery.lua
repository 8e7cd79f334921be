-- Drives straight on, if it has wheels, and tells what its battery has.
function step()
  if robot.wheels then robot.wheels.set_velocity(10, 10) end
  log("has ", robot.battery.available_charge, " for ", robot.battery.time_left)
end
