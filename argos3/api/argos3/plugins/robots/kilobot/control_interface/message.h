/* A message between Kilobots. */
#pragma once

#include <stdint.h>

/* Values up to 127 are free for users. */
typedef enum
{
  NORMAL = 0
} message_type_t;

typedef struct
{
  uint8_t data[9];
  uint8_t type;
  uint16_t crc; /* is not checked */
} message_t;
