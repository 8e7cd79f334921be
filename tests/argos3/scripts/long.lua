-- Sends twelve bytes and tells what it hears and how many light sensors it has.
function step()
  robot.range_and_bearing.set_data({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})
  local heard = {}
  for _, packet in ipairs(robot.range_and_bearing) do heard[#heard + 1] = table.concat(packet.data, ",") end
  log("script hears ", table.concat(heard, ";"), " sees ", #robot.light, " ", robot.light[6])
end
