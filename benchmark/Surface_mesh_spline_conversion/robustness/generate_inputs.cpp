// Writes meshes of the generator as OFF files.
// usage: generate_inputs FOLDER NUMBER [FIRST]

#include "Input_generator.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

int main(int argc, char* argv[])
{
  if(argc < 3)
  {
    std::fprintf(stderr, "usage: %s FOLDER NUMBER [FIRST]\n", argv[0]);
    return EXIT_FAILURE;
  }
  const std::string folder = argv[1];
  const std::size_t number = std::strtoul(argv[2], nullptr, 10);
  const std::size_t first = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 1;
  std::filesystem::create_directories(folder);
  for(std::size_t seed = first; seed < first + number; ++seed)
  {
    std::string description;
    const Check::Triangle_mesh mesh = Check::generate_mesh(seed, description);
    const std::string filename = folder + "/generated_" + std::to_string(seed) + ".off";
    if(!Check::write_OFF(filename, mesh))
    {
      std::fprintf(stderr, "%s cannot be written\n", filename.c_str());
      return EXIT_FAILURE;
    }
    std::printf("%s: %s\n", filename.c_str(), description.c_str());
  }
  return EXIT_SUCCESS;
}
