// write_experiment_reference FOLDER: writes experiment_reference.md, which the repository keeps in docs/.
#include <cstdio>
#include <fstream>
#include <string>

#include "common/experiment/reference.h"

namespace
{

bool Write(const std::string& path, const std::string& text)
{
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) std::fprintf(stderr, "%s cannot be written\n", path.c_str());
  return static_cast<bool>(file);
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::fprintf(stderr, "usage: write_experiment_reference FOLDER\n");
    return 2;
  }
  const std::string folder = argv[1];
  return Write(folder + "/experiment_reference.md", swarmanoid::ExperimentReference()) ? 0 : 1;
}
