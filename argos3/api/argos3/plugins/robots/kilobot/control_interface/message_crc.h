/* The checksum of a message. Messages are not corrupted here, so it is 0, as in ARGoS3. */
#pragma once

#include "message.h"

#ifdef __cplusplus
extern "C"
{
#endif

  uint16_t message_crc(const message_t* message);

#ifdef __cplusplus
}
#endif
