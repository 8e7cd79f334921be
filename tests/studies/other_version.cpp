// Loaded before the programs' own libraries, it makes them another release.
namespace swarmanoid
{

const char* Version() { return "0.0.7"; }
const char* GitRevision() { return "other"; }

}  // namespace swarmanoid
