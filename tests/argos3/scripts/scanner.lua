-- Turns the distance scanner, then looks ahead, and says what it reads.
local steps = 0

local function say(word, readings)
  for i = 1, #readings do
    log(string.format("%s %.5g %.5g", word, readings[i].angle, readings[i].distance))
  end
end

function step()
  local scanner = robot.distance_scanner
  steps = steps + 1
  if steps == 1 then
    log("off " .. #scanner.short_range .. " " .. #scanner.long_range)
    scanner.enable()
    scanner.set_rpm(30)
  elseif steps == 3 then
    say("turning", scanner.short_range)
    scanner.set_angle(0)
  elseif steps == 5 then
    say("still", scanner.short_range)
    say("still", scanner.long_range)
    scanner.disable()
  end
end
