/* Kilobots count the hops to the one with number 0, and show them by their colour. */
#include <kilolib.h>
#include <stdint.h>
#include <stdio.h>

typedef struct
{
  uint8_t hops;
  int16_t nearest;
} debug_info_t;

#include <debug.h>

static uint8_t hops = 255;
static int16_t nearest = 1000; /* mm */
static int sent = 0;
static message_t own;

static void receive(message_t* message, distance_measurement_t* distance)
{
  if (message->type == 1) /* of the overhead controller */
  {
    set_color(RGB(3, 3, 3));
    debug_print("told %d\n", message->data[8]);
    return;
  }
  if (estimate_distance(distance) < nearest) nearest = estimate_distance(distance);
  if (kilo_uid != 0 && message->data[0] < hops - 1) hops = message->data[0] + 1;
}

static message_t* next(void)
{
  own.type = NORMAL;
  own.data[0] = hops;
  own.crc = message_crc(&own);
  return &own;
}

static void success(void) { ++sent; }

static void setup(void)
{
  if (kilo_uid == 0) hops = 0;
  set_motors(0, 0);
}

static void loop(void)
{
  set_color(hops == 255 ? RGB(0, 0, 0) : RGB(hops & 3, 1, 0));
  debug_info_set(hops, hops);
  debug_info_set(nearest, nearest);
  if (kilo_ticks == 93) debug_print("sent %d hops %d nearest %d\n", sent, hops, nearest);
}

int main()
{
  kilo_init();
  debug_info_create();
  kilo_message_rx = receive;
  kilo_message_tx = next;
  kilo_message_tx_success = success;
  kilo_start(setup, loop);
  debug_info_destroy();
  return 0;
}
