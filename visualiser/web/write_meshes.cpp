// write_meshes FILE writes the models of all renderers for the page. The build runs it.
#include <cstdio>
#include <fstream>

#include "visualiser/scene/meshes_json.h"

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::fputs("usage: write_meshes FILE\n", stderr);
    return 2;
  }
  std::ofstream file(argv[1], std::ios::binary);
  file << swarmanoid::MeshesAsJson();
  return file.flush().good() ? 0 : 1;
}
