// Lets the program gmsh, if it is installed, mesh a STEP file.
#ifndef CHECK_STEP_GMSH_H
#define CHECK_STEP_GMSH_H

#include <cstddef>
#include <cstdio>
#include <fstream>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

// the elements that are counted, with the numbers that gmsh gives them
enum class Gmsh_element { TRIANGLE = 2, TETRAHEDRON = 4 };

// Returns the number of elements of one kind in a file of gmsh, format 2.
inline std::size_t count_elements(const std::string& filename, Gmsh_element element)
{
  std::ifstream in(filename);
  std::string word;
  while(in >> word && word != "$Elements") {}
  std::size_t n = 0, result = 0;
  in >> n;
  for(std::size_t i = 0; i < n && in; ++i)
  {
    std::size_t number;
    int type = 0;
    in >> number >> type;
    std::getline(in, word);
    result += (type == static_cast<int>(element));
  }
  return result;
}

// Meshes solids with tetrahedra, or surfaces with triangles. Returns their number; 0 if it fails, does
// not end in time, or gmsh is missing.
inline std::size_t mesh_with_gmsh(const std::string& step_file, Gmsh_element element,
                                  unsigned int seconds)
{
  const char* dimension = element == Gmsh_element::TETRAHEDRON ? "-3" : "-2";
  const std::string mesh_file = "check_step_" + std::to_string(getpid()) + ".msh";
  const pid_t child = fork();
  if(child == 0)
  {
    alarm(seconds);
    execlp("gmsh", "gmsh", dimension, "-v", "0", "-format", "msh2", "-o", mesh_file.c_str(),
           step_file.c_str(), static_cast<char*>(nullptr));
    _exit(1);
  }
  int status = 1;
  if(child > 0)
    waitpid(child, &status, 0);
  const std::size_t result = (status == 0) ? count_elements(mesh_file, element) : 0;
  std::remove(mesh_file.c_str());
  return result;
}

#endif // CHECK_STEP_GMSH_H
