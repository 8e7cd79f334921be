# TryUserDirectory DIRECTORY SCRIPTS: makes a user directory and in it all that `swarmanoid new` and the user scripts make,
# builds it once, and runs every experiment. `swarmanoid` is on the PATH. Sourced by the tests of user directories.

Expect()
{
  if ! grep -qF "$2" <<<"$1"; then
    printf 'expected: %s\nin: %s\n' "$2" "$1" >&2
    exit 1
  fi
}

Hash() { grep -oE 'hash [0-9a-f]{16}' <<<"$1" | tail -n 1; }

# Runs of others on this machine are none of ours.
export SWARMANOID_SHARED_FOLDER=/dev/shm/swarmanoid-test-$$

TryUserDirectory()
{
  local directory=$1 scripts=$2 answer said runs
  runs=$(mktemp -d)
  cd "$directory/controllers"

  echo "== a behaviour controller of a footbot, asked for"
  said=$(printf 'wall_follower\nfootbot\n\nbt_along_the_wall\nCBTAlongTheWall\nyes\n' | "$scripts/create_behavior_controller.sh")
  Expect "$said" "wall_follower/bt_along_the_wall.h"
  grep -q 'class CWallFollower : public CCI_BehaviorController<CCI_FootBotState>' wall_follower/wall_follower.h
  grep -q 'class CBTAlongTheWall : public CCI_Behavior<CCI_FootBotState>' wall_follower/bt_along_the_wall.h

  echo "== those of the other robots, by options"
  "$scripts/create_behavior_controller.sh" --name sky_watch --robot eyebot --yes
  "$scripts/create_behavior_controller.sh" --name climber --robot handbot --class CMyClimber --behavior up --behavior-class CUp --experiment
  grep -q 'class CMyClimber : public CCI_BehaviorController<CCI_HandBotState>' climber/climber.h

  echo "== a behaviour for each, in the folder of its controller"
  (cd wall_follower && printf 'bt_footbot_stop\n\n' | "$scripts/create_behavior.sh")
  (cd sky_watch && "$scripts/create_behavior.sh" --name bt_rise --yes)
  swarmanoid new behavior bt_hold --controller climber
  grep -q 'class CBTFootbotStop : public CCI_Behavior<CCI_FootBotState>' wall_follower/bt_footbot_stop.h
  grep -q 'class CBTRise : public CCI_Behavior<CCI_EyeBotState>' sky_watch/bt_rise.h
  # Used as its maker says: a member of the root behaviour, called by its Step.
  sed -i -e 's|#include "footbot/bt_footbot_random_walk.h"|&\n#include "bt_footbot_stop.h"|' \
    -e 's|CBTFootbotRandomWalk random_walk_;|&\n  CBTFootbotStop stop_;|' wall_follower/bt_along_the_wall.h
  sed -i 's|obstacle_avoidance_.Step(cRobotState);|&\n  stop_.Step(cRobotState);|' wall_follower/bt_along_the_wall.cpp
  grep -q 'stop_.Step' wall_follower/bt_along_the_wall.cpp

  echo "== a controller in one class, one in Lua, a sensor, a kind of robot, experiment functions, a physics engine, and a visualisation"
  swarmanoid new controller plain
  swarmanoid new lua avoid
  swarmanoid new device compass
  swarmanoid new entity rover
  swarmanoid new functions spreading
  swarmanoid new engine gliding
  swarmanoid new renderer plan
  swarmanoid new experiment first_try
  # They move a robot and light another one's beacon before the controllers of tick 10.
  sed -i 's|void PreStep(SpaceEditor&) override {}|void PreStep(SpaceEditor\& space) override\n  {\n    if (space.GetSpace().GetTick() != 10) return;\n    space.MoveEntity("fb_0", {Vector3(2, 2, 0), Quaternion::Identity()});\n    space.SetAttribute("fb_1", "beacon", 0xff0000);\n  }|' \
    ../functions/spreading/spreading.cpp
  grep -q MoveEntity ../functions/spreading/spreading.cpp

  echo "== what is wrong is told with the cure"
  answer=$("$scripts/create_behavior_controller.sh" --name again --robot hndbot --yes 2>&1) && exit 1
  Expect "$answer" "footbot, handbot or eyebot"
  answer=$("$scripts/create_behavior_controller.sh" </dev/null 2>&1) && exit 1
  Expect "$answer" "(or give --name)"
  # On a terminal a wrong answer is asked for again, before the next question; elsewhere it ends the script.
  answer=$(printf 'Late-Riser\nlate_riser\nhndbot\nhandbot\n\n\n\nno\n' | script -qec "$(printf %q "$scripts/create_behavior_controller.sh")" /dev/null)
  Expect "$answer" "'Late-Riser' cannot be taken: it must be small letters"
  Expect "$answer" "'hndbot' cannot be taken"
  Expect "$answer" "late_riser/bt_handbot_late_riser.h"
  rm -r late_riser
  answer=$(printf 'Late-Riser\nlate_riser\n' | "$scripts/create_behavior_controller.sh" 2>&1) && exit 1
  Expect "$answer" "'Late-Riser' cannot be taken"
  answer=$(cd / && "$scripts/create_behavior_controller.sh" --yes 2>&1 </dev/null) && exit 1
  Expect "$answer" "this is no user directory"
  answer=$("$scripts/create_behavior.sh" --name bt_stop --yes 2>&1) && exit 1
  Expect "$answer" "there is no behaviour controller in this folder"
  answer=$(swarmanoid new behavior-controller again --robot hndbot 2>&1) && exit 1
  Expect "$answer" "did you mean 'handbot'?"
  answer=$(swarmanoid new behavior-controller sky_watch 2>&1) && exit 1
  Expect "$answer" "is there already"
  answer=$(swarmanoid new functions sky_watch 2>&1) && exit 1
  Expect "$answer" "is there already"
  answer=$(swarmanoid new entity compass 2>&1) && exit 1
  Expect "$answer" "is there already"
  answer=$(swarmanoid new lua with_rover 2>&1) && exit 1
  Expect "$answer" "is there already"
  answer=$(swarmanoid new behavior bt_stop 2>&1) && exit 1
  Expect "$answer" "swarmanoid new behavior-controller NAME"
  answer=$(swarmanoid new controller simulation 2>&1) && exit 1
  Expect "$answer" "choose another"
  answer=$(swarmanoid new behaviour x 2>&1) && exit 1
  Expect "$answer" "did you mean 'behavior'?"
  answer=$(../build.sh robots 2>&1) && exit 1
  Expect "$answer" "simulation, real_robot or all"

  echo "== all of it builds"
  cd "$directory"
  ./build.sh all >"$runs/build.txt" 2>&1 || { cat "$runs/build.txt"; exit 1; }

  echo "== for robots too: the controllers of all three have their drivers"
  local robot
  for robot in wall_follower:fb_0 sky_watch:eb_0 climber:hb; do
    swarmanoid_robot "experiments/${robot%:*}.xml" --controller controller --robot "${robot#*:}" \
      --controller-path real_robot_build/controllers --check >"$runs/robot.txt"
    Expect "$(cat "$runs/robot.txt")" "controller controller of library ${robot%:*}"
  done
  [ ! -e real_robot_build/simulation ]

  echo "== every experiment runs, as a cluster and in the user's own simulator alike"
  local experiment name cluster own status
  for experiment in experiments/*.xml; do
    name=$(basename "$experiment" .xml)
    swarmanoid check "$experiment" >/dev/null
    status=0
    cluster=$(swarmanoid run "$experiment" --ticks 60 --quiet --output "$runs/$name") || status=$?
    own=$(simulation_build/simulation "$experiment" --ticks 60 --quiet --output "$runs/$name-own") || [ $? -eq "$status" ]
    echo "$name: exit code $status, $(tail -n 1 <<<"$own")"
    # 60 ticks are too few for the goals of the functions.
    [ "$status" -eq "$([ "$name" = spreading ] || [ "$name" = prey_retrieval ] && echo 1 || echo 0)" ]
    [ -n "$(Hash "$cluster")" ]
    [ "$(Hash "$cluster")" = "$(Hash "$own")" ]
  done

  echo "== a visualisation of the user draws in the file, and attached"
  # Ten robots at most, those that share a place are one letter.
  awk '/^tick 0$/ { n = 0; seen = 1 } { n += gsub("f", "") } END { exit !(seen && n > 5 && n <= 10) }' "$runs/plan/plan.txt"
  swarmanoid run experiments/diffusion_10.xml --paused --quiet --no-visualisers --output "$runs/watched" &
  local watched=$!
  until swarmanoid list experiments | grep -q diffusion_10; do sleep 0.1; done
  swarmanoid attach simulation_build/renderers/libplan.so --help | grep -q -- '--columns'
  SWARMANOID_PLUGIN_PATH=simulation_build/renderers swarmanoid attach plan --columns 20 --every 1 --file attached.txt --output "$runs" &
  local watcher=$!
  until grep -qs '^[.f]*f[.f]*$' "$runs/attached.txt"; do sleep 0.1; done
  [ "$(sed -n 2p "$runs/attached.txt" | wc -c)" -eq 21 ]
  swarmanoid control stop
  wait "$watched" "$watcher"

  echo "== the engine of a run that goes on from a checkpoint"
  cluster=$(swarmanoid run experiments/gliding.xml --ticks 200 --quiet --output "$runs/glide" --checkpoint-every 100)
  own=$(simulation_build/simulation experiments/gliding.xml --ticks 200 --quiet --output "$runs/glide-on" --restore "$runs/glide/checkpoint-00000100")
  [ "$(Hash "$cluster")" = "$(Hash "$own")" ]
  grep -q '^tick,mean_distance_m$' "$runs/spreading/spreading.csv"
  awk '$1 == 11 && $3 == "fb_0" { near = ($4 - 2)^2 + ($5 - 2)^2 < 0.001 } END { exit !near }' "$runs/spreading/positions.txt"
  swarmanoid run experiments/spreading.xml --quiet --output "$runs/to_the_end"
  # The robots of each kind have moved: the footbots on, the handbot up.
  awk '$3 == "hb" { z = $6 } END { exit !(z > 0.4) }' "$runs/climber/climber.txt"
  awk '$2 == "Footbot" && $1 == 0 { x[$3] = $4; y[$3] = $5 } $2 == "Footbot" && $1 == 60 { d = (x[$3] - $4)^2 + (y[$3] - $5)^2; if (d > 0.01) n++ }
       END { exit !(n > 3) }' "$runs/wall_follower/wall_follower.txt"
  awk '$2 == "Rover" && $1 == 0 { x[$3] = $4; y[$3] = $5 } $2 == "Rover" && $1 == 60 { d = (x[$3] - $4)^2 + (y[$3] - $5)^2; if (d > 0.01) n++ }
       END { exit !(n > 3) }' "$runs/rover/rover.txt"
  awk '$2 == "Eyebot" && $1 == 0 { x[$3] = $4; y[$3] = $5 } $2 == "Eyebot" && $1 == 60 { d = (x[$3] - $4)^2 + (y[$3] - $5)^2; if (d > 0.01) n++ }
       END { exit !(n > 1) }' "$runs/sky_watch/sky_watch.txt"

  echo "== a simulator of the user's runs an experiment with many seeds"
  cat >simulation_main.cpp <<'END'
#include <cstdio>

#include "simulation.h"

using namespace swarmanoid;

int main()
{
  for (int seed = 1; seed <= 3; ++seed)
  {
    const auto experiment = ReadExperiment("experiments/diffusion_10.xml",
                                           {{"framework.seed", std::to_string(seed)}, {"framework.maxclock", "50"}});
    CSimulator simulator(*experiment, {.visualisations = false});
    std::uint64_t steps = 0;
    while (simulator.Step()) ++steps;
    std::printf("%llu steps, hash %016llx\n", static_cast<unsigned long long>(steps),
                static_cast<unsigned long long>(simulator.Finish().hash));
  }
}
END
  ./build.sh >"$runs/build.txt" 2>&1 || { cat "$runs/build.txt"; exit 1; }
  own=$(simulation_build/simulation)
  for seed in 1 2 3; do
    cluster=$(swarmanoid run experiments/diffusion_10.xml --ticks 50 --seed "$seed" --quiet --no-visualisers --output "$runs/seed-$seed")
    Expect "$(sed -n "${seed}p" <<<"$own")" "50 steps, $(Hash "$cluster")"
  done
  rm -rf "$runs"
}
