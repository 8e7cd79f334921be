/* Values that a behaviour shows to loop functions (CCI_KilobotController::DebugInfoCreate). Define debug_info_t before
 * including this header. Without ARGOS_simulator_BUILD, which the library of behaviours sets, nothing happens. */
#pragma once

#ifdef ARGOS_simulator_BUILD

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

static debug_info_t* debug_info_shm;

static inline void debug_info_create(void)
{
  char name[256];
  snprintf(name, sizeof name, "/ARGoS_DEBUG_%ld_%s", (long)getppid(), kilo_str_id);
  const int file = shm_open(name, O_RDWR | O_CREAT, S_IRUSR | S_IWUSR);
  if (file < 0 || ftruncate(file, sizeof(debug_info_t)) != 0)
  {
    perror("the debug information of a Kilobot cannot be shared");
    exit(1);
  }
  debug_info_shm = (debug_info_t*)mmap(NULL, sizeof(debug_info_t), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (debug_info_shm == MAP_FAILED)
  {
    perror("the debug information of a Kilobot cannot be shared");
    exit(1);
  }
}

static inline void debug_info_destroy(void) { munmap(debug_info_shm, sizeof(debug_info_t)); }

#define debug_info_get(FIELD) (debug_info_shm->FIELD)
#define debug_info_set(FIELD, VALUE) debug_info_get(FIELD) = (VALUE)
#define debug_print(...) (fprintf(stderr, "[kb%u] ", kilo_uid), fprintf(stderr, __VA_ARGS__))

#else

static inline void debug_info_create(void) {}
static inline void debug_info_destroy(void) {}

#define debug_info_get(FIELD)
#define debug_info_set(FIELD, VALUE)
#define debug_print(...)

#endif
