-- What Lua leaves open, and would be another one in each process; what a script tells by its wheels reaches the hash.
local sum

local function hash_of(text)
  for i = 1, #text do sum = (sum * 31 + text:byte(i)) % 1000003 end
end

local function refused(call)
  local fine, message = pcall(call)
  assert(not fine)
  return message
end

function init()
  sum = 7
  local words = {}
  for i = 1, 40 do words["word" .. i] = i end
  words[3.5], words[1], words[true] = "c", "a", "d"
  for key, value in pairs(words) do hash_of(tostring(key) .. tostring(value)) end
  local count = 0
  for key in next, words do
    words[key] = nil
    count = count + 1
  end
  assert(count == 43 and next(words) == nil)
  for i = 1, 5 do words[i] = i end
  for key in pairs(words) do
    if key == 1 then words[2] = nil end
    assert(key ~= 2, "a key that went is not visited")
  end
  assert(refused(function() for _ in pairs({[words] = 1}) do end end):find("has no order that is the same in every run"))
  local meta = setmetatable({}, {__pairs = function() return function(_, key) return not key and "one" or nil end, nil, nil end})
  for key in pairs(meta) do assert(key == "one") end
  hash_of(tostring(math.random(1, 1000000)))
  math.randomseed(os.time())
  hash_of(tostring(math.random(1, 1000000)))
  math.randomseed()
  assert(os.time() == 0 and os.clock() == 0)
  assert(math.atan2(1, -1) == math.atan(1, -1) and unpack({5}) == 5)
  print("sum", sum)
end

function step()
  assert(math.abs(os.clock() - math.floor(os.clock() * 10 + 0.5) / 10) < 1e-9)
  robot.wheels.set_velocity(sum % 10 + math.random(), sum // 10 % 10)
end
