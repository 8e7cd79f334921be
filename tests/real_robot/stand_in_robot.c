/* A footbot in a square arena, without hardware: drives as it is told and publishes what its sensors would. Made with
   Cyclone DDS from idl/ros2, so that it shares no code of DDS with the drivers that it is there to test.

   stand_in_robot DOMAIN SECONDS [SILENT_AT SILENT_FOR]: prints, ten times a second,
   "time x y heading forward turn clearance commands blue_leds held nest", and ends. The scan is silent in the time
   given. A yellow prey stands at PREY, marked by a red laser; a held one is to be brought to NEST, where the laser is
   then. */
#include <dds/dds.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "geometry_msgs.h"
#include "sensor_msgs.h"
#include "stand_in_endpoints.h"
#include "std_msgs.h"

#define RAYS 72
#define BLOBS 3

static const double kPi = 3.14159265358979323846;
static const double kHalfArena = 1.0;      /* m from the middle to a wall */
static const double kRadius = 0.085036758; /* m, of the robot */
static const double kStep = 0.01;          /* s of simulated and real time */
static const double kWatchdog = 0.5;       /* s without command after which a real base stands */
static const double kPreyRadius = 0.05;    /* m */
static const double kNest[2] = {0.6, -0.6};

struct World
{
  double x, y, heading;
  double forward, turn;
  double clearance; /* smallest so far, body to wall */
  double since_command;
  unsigned commands;
  unsigned blue_leds;
  double gripper;
  double prey[2];
  bool held;
};

static void Move(struct World* world)
{
  world->since_command += kStep;
  if (world->since_command > kWatchdog) world->forward = world->turn = 0;
  world->heading += world->turn * kStep;
  world->x += world->forward * cos(world->heading) * kStep;
  world->y += world->forward * sin(world->heading) * kStep;
  const double wall = kHalfArena - fmax(fabs(world->x), fabs(world->y)) - kRadius;
  world->clearance = fmin(world->clearance, wall);

  const double dx = world->prey[0] - world->x;
  const double dy = world->prey[1] - world->y;
  const double ahead = dx * cos(world->heading) + dy * sin(world->heading);
  const double beside = dy * cos(world->heading) - dx * sin(world->heading);
  const double reach = kRadius + kPreyRadius;
  if (world->gripper < 0.5)
    world->held = false;
  else if (ahead > 0 && fabs(beside) < 0.05 && ahead < reach + 0.02)
    world->held = true;
  if (world->held || (hypot(dx, dy) < reach && ahead > 0))
  {
    world->prey[0] = world->x + reach * cos(world->heading);
    world->prey[1] = world->y + reach * sin(world->heading);
  }
}

/* From the middle of the robot along a direction to the nearer of walls and prey. */
static float RangeTo(const struct World* world, double direction)
{
  const double c = cos(world->heading + direction);
  const double s = sin(world->heading + direction);
  double range = fmin(c > 0   ? (kHalfArena - world->x) / c
                      : c < 0 ? (-kHalfArena - world->x) / c
                              : INFINITY,
                      s > 0   ? (kHalfArena - world->y) / s
                      : s < 0 ? (-kHalfArena - world->y) / s
                              : INFINITY);
  const double dx = world->prey[0] - world->x;
  const double dy = world->prey[1] - world->y;
  const double along = dx * c + dy * s;
  const double off2 = dx * dx + dy * dy - along * along;
  if (along > 0 && off2 < kPreyRadius * kPreyRadius)
    range = fmin(range, along - sqrt(kPreyRadius * kPreyRadius - off2));
  return (float)range;
}

static void Listen(struct World* world, dds_entity_t velocity, dds_entity_t leds, dds_entity_t gripper)
{
  void* sample = NULL;
  while ((sample = Next(velocity)) != NULL)
  {
    const geometry_msgs_msg_dds__Twist_* twist = sample;
    world->forward = twist->linear.x;
    world->turn = twist->angular.z;
    world->since_command = 0;
    ++world->commands;
    dds_return_loan(velocity, &sample, 1);
  }
  while ((sample = Next(leds)) != NULL)
  {
    const std_msgs_msg_dds__Float32MultiArray_* colours = sample;
    world->blue_leds = 0;
    if (colours->layout.dim._length == 2 && colours->layout.dim._buffer[0].size == 12 && colours->data._length == 36)
      for (unsigned led = 0; led < 12; ++led)
        if (colours->data._buffer[3 * led] == 0 && colours->data._buffer[3 * led + 2] == 1) ++world->blue_leds;
    dds_return_loan(leds, &sample, 1);
  }
  while ((sample = Next(gripper)) != NULL)
  {
    world->gripper = ((const std_msgs_msg_dds__Float64_*)sample)->data;
    dds_return_loan(gripper, &sample, 1);
  }
}

static void PublishScan(dds_entity_t writer, const struct World* world)
{
  float ranges[RAYS];
  sensor_msgs_msg_dds__LaserScan_ scan = {0};
  scan.header.frame_id = "base_link";
  scan.angle_min = (float)-kPi;
  scan.angle_increment = (float)(2 * kPi / RAYS);
  scan.angle_max = scan.angle_min + (RAYS - 1) * scan.angle_increment;
  scan.range_min = 0.05F;
  scan.range_max = 5;
  for (int ray = 0; ray < RAYS; ++ray)
    ranges[ray] = RangeTo(world, (double)scan.angle_min + ray * (double)scan.angle_increment);
  scan.ranges._buffer = ranges;
  scan.ranges._length = scan.ranges._maximum = RAYS;
  dds_write(writer, &scan);
}

/* What the camera sees, in the frame of the robot. */
static void PublishBlobs(dds_entity_t writer, const struct World* world)
{
  struct Point
  {
    float x, y, z;
    uint32_t rgb;
  } points[BLOBS];
  const double* laser = world->held ? kNest : world->prey;
  const struct
  {
    const double* place;
    uint32_t rgb;
  } blobs[BLOBS] = {{world->prey, 0xffff00}, {laser, 0xff0000}, {kNest, 0x00ff00}};
  for (int k = 0; k < BLOBS; ++k)
  {
    const double dx = blobs[k].place[0] - world->x;
    const double dy = blobs[k].place[1] - world->y;
    points[k].x = (float)(dx * cos(world->heading) + dy * sin(world->heading));
    points[k].y = (float)(dy * cos(world->heading) - dx * sin(world->heading));
    points[k].z = 0;
    points[k].rgb = blobs[k].rgb;
  }
  sensor_msgs_msg_dds__PointField_ fields[4] = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}, {"rgb", 12, 6, 1}};
  sensor_msgs_msg_dds__PointCloud2_ cloud = {0};
  cloud.header.frame_id = "base_link";
  cloud.height = 1;
  cloud.width = BLOBS;
  cloud.fields._buffer = fields;
  cloud.fields._length = cloud.fields._maximum = 4;
  cloud.point_step = sizeof(struct Point);
  cloud.row_step = sizeof(points);
  cloud.data._buffer = (uint8_t*)points;
  cloud.data._length = cloud.data._maximum = sizeof(points);
  cloud.is_dense = true;
  dds_write(writer, &cloud);
}

static void PublishGripper(dds_entity_t joints, dds_entity_t holding, const struct World* world)
{
  char* names[2] = {"gripper", "turret"};
  double positions[2] = {0.5 * (1 - world->gripper), 0};
  sensor_msgs_msg_dds__JointState_ state = {0};
  state.header.frame_id = "";
  state.name._buffer = names;
  state.name._length = state.name._maximum = 2;
  state.position._buffer = positions;
  state.position._length = state.position._maximum = 2;
  dds_write(joints, &state);
  const std_msgs_msg_dds__Bool_ held = {world->held};
  dds_write(holding, &held);
}

int main(int argc, char** argv)
{
  if (argc != 3 && argc != 5) return 2;
  const double seconds = atof(argv[2]);
  /* From the first command on: how long a robot takes to start is no part of the test. */
  const double silent_after = argc == 5 ? atof(argv[3]) : INFINITY;
  const double silent_for = argc == 5 ? atof(argv[4]) : 0;

  const dds_entity_t participant = Participant(atoi(argv[1]));
  const dds_entity_t velocity = MakeReader(participant, &geometry_msgs_msg_dds__Twist__desc, "rt/cmd_vel");
  const dds_entity_t leds = MakeReader(participant, &std_msgs_msg_dds__Float32MultiArray__desc, "rt/leds");
  const dds_entity_t gripper = MakeReader(participant, &std_msgs_msg_dds__Float64__desc, "rt/gripper/command");
  const dds_entity_t scan = MakeWriter(participant, &sensor_msgs_msg_dds__LaserScan__desc, "rt/scan");
  const dds_entity_t blobs = MakeWriter(participant, &sensor_msgs_msg_dds__PointCloud2__desc, "rt/blobs");
  const dds_entity_t joints = MakeWriter(participant, &sensor_msgs_msg_dds__JointState__desc, "rt/joint_states");
  const dds_entity_t holding = MakeWriter(participant, &std_msgs_msg_dds__Bool__desc, "rt/gripper/holding");
  if (velocity < 0 || leds < 0 || gripper < 0 || scan < 0 || blobs < 0 || joints < 0 || holding < 0)
  {
    fprintf(stderr, "cannot join domain %s\n", argv[1]);
    return 1;
  }

  struct World world = {.x = 0.4, .y = 0.2, .heading = 0.4, .clearance = 1, .prey = {0.2, 0.7}};
  const double start = Seconds();
  double silent_at = INFINITY;
  for (long step = 0; (double)step * kStep < seconds; ++step)
  {
    const double time = (double)step * kStep;
    Listen(&world, velocity, leds, gripper);
    if (world.commands > 0 && isinf(silent_at)) silent_at = time + silent_after;
    Move(&world);
    if (step % 5 == 0)
    {
      if (time < silent_at || time >= silent_at + silent_for) PublishScan(scan, &world);
      PublishBlobs(blobs, &world);
      PublishGripper(joints, holding, &world);
    }
    if (step % 10 == 0)
    {
      printf("%.2f %.4f %.4f %.4f %.4f %.4f %.4f %u %u %d %.4f\n", time, world.x, world.y, world.heading, world.forward,
             world.turn, world.clearance, world.commands, world.blue_leds, world.held ? 1 : 0,
             hypot(world.prey[0] - kNest[0], world.prey[1] - kNest[1]));
      fflush(stdout);
    }
    const double ahead = start + time + kStep - Seconds();
    if (ahead > 0) dds_sleepfor((dds_duration_t)(ahead * 1e9));
  }
  dds_delete(participant);
  return 0;
}
