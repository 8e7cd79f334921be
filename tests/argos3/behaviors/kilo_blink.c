/* A Kilobot drives along a curve, waits within its loop, and prints what it sees. */
#include <kilolib.h>
#include <stdio.h>
#include <stdlib.h>

static int rounds = 0;

static void setup(void)
{
  set_motors(51, 102);
  fprintf(stderr, "[%s] number %d light %d random %d\n", kilo_str_id, kilo_uid, get_ambientlight(), rand_soft());
}

static void loop(void)
{
  set_color(RGB(3, 0, 0));
  delay(500);
  fprintf(stderr, "[%s] round %d at %u light %d voltage %d\n", kilo_str_id, ++rounds, kilo_ticks, get_ambientlight(),
          get_voltage());
  set_color(RGB(0, 0, 3));
  delay(250);
  if (kilo_uid == 13 && rounds == 2) abort();
}

int main()
{
  kilo_init();
  kilo_start(setup, loop);
  return 0;
}
