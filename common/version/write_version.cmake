# Writes OUTPUT, a source file with the version and the commit of SOURCE. The file is not touched if nothing changed.
set(REVISION "")
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --dirty --exclude=* --abbrev=12
    OUTPUT_VARIABLE REVISION OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#include "common/version/version.h"

namespace swarmanoid
{

const char* Version() { return "@VERSION@"; }
const char* GitRevision() { return "@REVISION@"; }

}  // namespace swarmanoid
]])
