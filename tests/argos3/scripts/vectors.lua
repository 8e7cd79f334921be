-- Says what vectors and quaternions do, and how a robot is turned.
local function say(...)
  local words = {}
  for _, word in ipairs({...}) do
    words[#words + 1] = type(word) == "number" and string.format("%.4g", word) or tostring(word)
  end
  log(table.concat(words, " "))
end

function init()
  local a, b = vector2(3, 4), vector2(1, 2)
  say("plane", a + b, a - b, a * 2, 2 * a, -a, a:length(), a:dot(b), a:cross(b), a == vector2(3, 4), a.x)
  local same = vector2(a)
  a:normalize()
  same.y = 8
  say("itself", a, same, vector2(1, 0):rotate(math.pi).x, vector2())
  local u, v = vector3(1, 0, 0), vector3(0, 1, 0)
  local quarter = quaternion(math.pi / 2, vector3(0, 0, 1))
  local turned = vector3(u):rotate(quarter)
  say("space", u + v, v * 3, vector3(u):cross(v), u.x, turned.x, turned.y, vector3(2, 3, 6):length())
  local half = quarter * quarter
  local angle, axis = half:toangleaxis()
  local z, y, x = quarter:toeulerangles()
  say("turned", angle, axis, z, y, x, half.w, half.z, (quarter * quarter:inverse()).w, quaternion(), quaternion(2, 0, 0, 0):normalize().w)
  say("wrong", select(2, pcall(function() return a + u end)), select(2, pcall(function() return u.q end)),
      select(2, pcall(function() a.length = 1 end)), select(2, pcall(vector3, 1, 2)))
end

function step()
  local at = robot.positioning
  say("axis", at.orientation.x / math.sin(math.pi / 4), at.orientation.w, at.position.x)
  say("old", at.orientation.angle, at.orientation.axis.z)
end
