#include "argos3/converter/counted_bodies.h"

#include <fstream>
#include <limits>

namespace swarmanoid::argos3
{

void WriteMadeBodies(const MadeBodies& bodies, const std::string& folder)
{
  std::ofstream file(folder + "/" + kMadeBodiesFile);
  file.precision(std::numeric_limits<double>::max_digits10);
  for (const auto& [shape, count] : bodies)
    file << count << ' ' << shape.tag << ' ' << shape.movable << ' ' << shape.mass_kg << ' ' << shape.size.transpose()
         << '\n';
}

MadeBodies ReadMadeBodies(const std::string& folder)
{
  MadeBodies bodies;
  std::ifstream file(folder + "/" + kMadeBodiesFile);
  BodyShape shape;
  double x = 0, y = 0, z = 0;
  for (int count = 0; file >> count >> shape.tag >> shape.movable >> shape.mass_kg >> x >> y >> z;)
  {
    shape.size = {x, y, z};
    bodies[shape] = count;
  }
  return bodies;
}

}  // namespace swarmanoid::argos3
