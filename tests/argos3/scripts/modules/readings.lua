local readings = {}

-- Minus the sum of all readings as vectors.
function readings.away(ring)
  local x, y = 0, 0
  for _, reading in pairs(ring) do
    x = x - reading.value * math.cos(reading.angle)
    y = y - reading.value * math.sin(reading.angle)
  end
  return x, y
end

return readings
