-- What a script may use of Lua's libraries. `trusted.lua` beside it says whether the user trusts the experiment.
local trusted = dofile("trusted.lua")
local read = require("modules.readings")

local function refused(what, call)
  local fine, message = pcall(call)
  assert(not fine and tostring(message):find("--trust", 1, true), what .. ": " .. tostring(message))
end

function init()
  assert(type(read) ~= "nil" and os.time() == 0 and os.clock() == 0 and os.date() and os.getenv("PATH"))
  local file = assert(io.open("trusted.lua"))
  assert(file:read("a"):find("return"))
  file:close()
  for line in io.lines("trusted.lua") do assert(line:find("return")) end
  assert(load("return 1 + 1")() == 2 and loadstring("return 3")() == 3 and loadfile("trusted.lua")() == trusted)
  assert(debug.traceback():find("limits.lua"))
  io.write("written to standard output\n")
  if trusted then
    assert(os.execute("true") and io.popen("true"):close() and package.loadlib)
    io.open("made_by_the_script", "w"):close()
    return
  end
  refused("os.execute", function() os.execute("touch made_by_the_script") end)
  refused("os.remove", function() os.remove("trusted.lua") end)
  refused("os.rename", function() os.rename("trusted.lua", "other") end)
  refused("os.exit", function() os.exit(0) end)
  refused("io.popen", function() io.popen("touch made_by_the_script") end)
  refused("io.output", function() io.output("made_by_the_script") end)
  refused("io.open to write", function() io.open("made_by_the_script", "w") end)
  refused("io.open to change", function() io.open("trusted.lua", "r+") end)
  refused("io.open elsewhere", function() io.open("/etc/passwd") end)
  refused("io.open above", function() io.open("../x") end)
  refused("io.open of a link", function() io.open("link_to_passwd") end)
  refused("io.lines elsewhere", function() io.lines("/etc/passwd") end)
  refused("loadfile elsewhere", function() loadfile("/etc/passwd") end)
  assert(not pcall(dofile) and not pcall(loadfile), "standard input is not read")
  refused("package.loadlib", function() package.loadlib("libc.so.6", "system") end)
  refused("debug.getregistry", function() debug.getregistry() end)
  refused("debug.getupvalue", function() debug.getupvalue(io.open, 1) end)
  assert(package.cpath == nil)
  -- Bytecode is no text.
  assert(not load(string.dump(function() return 1 end)) and not load(string.dump(function() return 1 end), "b", "b"))
  package.path = package.path .. ";/etc/?"
  local fine, message = pcall(require, "passwd")
  assert(not fine and message:find("not below the folder of the script"), message)
end

function step() end
