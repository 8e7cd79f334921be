/* The C interface of Kilobots. A behaviour is a program that includes this header and links
 * argos3plugin_simulator_kilolib. Each robot runs a process of it (docs/argos3.md). */
#pragma once

#include <stdint.h>

#include "message.h"
#include "message_crc.h"

/* A colour of set_color, with two bits for each channel. */
#define RGB(r, g, b) (((r)&3) | (((g)&3) << 2) | (((b)&3) << 4))
#define RED(c) ((c)&3)
#define GREEN(c) (((c) >> 2) & 3)
#define BLUE(c) (((c) >> 4) & 3)
#define TICKS_PER_SEC 31
/* The messages that a robot receives in a step at most. */
#define KILOBOT_MAX_RX 4

/* The library has main(), which calls that of the behaviour. */
#define main __kilobot_main

#ifdef __cplusplus
extern "C"
{
#endif

  typedef struct
  {
    int16_t low_gain;  /* 0 */
    int16_t high_gain; /* distance of the sender, mm */
  } distance_measurement_t;

  typedef void (*message_rx_t)(message_t* message, distance_measurement_t* distance);
  typedef message_t* (*message_tx_t)(void);
  typedef void (*message_tx_success_t)(void);

  /* The id of the robot in the experiment file. */
  extern char* kilo_str_id;
  /* The clock: 31 ticks a second. */
  extern uint32_t kilo_ticks;
  /* The time between two messages, ms. */
  extern uint16_t kilo_tx_period;
  /* The first number in the id of the robot, 0 if it has none. */
  extern uint16_t kilo_uid;
  /* Powers of motors for set_motors. */
  extern uint8_t kilo_turn_left;
  extern uint8_t kilo_turn_right;
  extern uint8_t kilo_straight_left;
  extern uint8_t kilo_straight_right;

  /* Called for each received message, before loop(). */
  extern message_rx_t kilo_message_rx;
  /* Returns the message to send, or NULL. It is called once in kilo_tx_period. */
  extern message_tx_t kilo_message_tx;
  /* Called in the step after a message was sent. */
  extern message_tx_success_t kilo_message_tx_success;

  /* Returns the distance of a sender, mm. */
  uint8_t estimate_distance(const distance_measurement_t* distance);
  /* Waits for steps of the simulation. A time below the length of a step is no wait. */
  void delay(uint16_t ms);
  uint8_t rand_hard(void);
  uint8_t rand_soft(void);
  /* Seeds rand_soft. */
  void rand_seed(uint8_t seed);
  /* Returns the brightness, 0 to 1024. */
  int16_t get_ambientlight(void);
  /* Voltage and temperature are 0, as in ARGoS3. */
  int16_t get_voltage(void);
  int16_t get_temperature(void);
  /* Sets the power of the motors, 0 to 255. 255 is 6 cm/s. */
  void set_motors(uint8_t left, uint8_t right);
  void spinup_motors(void);
  void set_color(uint8_t color);
  void kilo_init(void);
  /* Calls setup() once, and loop() in each step until the run ends. It does not return. */
  void kilo_start(void (*setup)(void), void (*loop)(void));

  /* The simulator and a behaviour exchange these messages. */
  typedef struct
  {
    message_t tx_message;
    uint8_t tx_state; /* 0: none, 1: wants to send, 2: sent */
    message_t rx_message[KILOBOT_MAX_RX];
    distance_measurement_t rx_distance[KILOBOT_MAX_RX];
    uint8_t rx_state; /* number of received messages */
    int16_t ambientlight;
    int16_t voltage;
    int16_t temperature;
    uint8_t left_motor;
    uint8_t right_motor;
    uint8_t color;
  } kilobot_state_t;

#ifdef __cplusplus
}
#endif
