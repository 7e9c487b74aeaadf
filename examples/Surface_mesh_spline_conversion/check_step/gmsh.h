// Lets the program gmsh, if it is installed, mesh a STEP file with tetrahedra.
#ifndef CHECK_STEP_TETRAHEDRA_H
#define CHECK_STEP_TETRAHEDRA_H

#include <cstddef>
#include <cstdio>
#include <fstream>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

// Returns the number of tetrahedra in a file of gmsh, format 2.
inline std::size_t count_tetrahedra(const std::string& filename)
{
  const int tetrahedron = 4;
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
    result += (type == tetrahedron);
  }
  return result;
}

// Returns the number of tetrahedra; 0 if it fails, does not end in time, or gmsh is missing.
inline std::size_t mesh_with_gmsh(const std::string& step_file, unsigned int seconds)
{
  const std::string mesh_file = "check_step_" + std::to_string(getpid()) + ".msh";
  const pid_t child = fork();
  if(child == 0)
  {
    alarm(seconds);
    execlp("gmsh", "gmsh", "-3", "-v", "0", "-format", "msh2", "-o", mesh_file.c_str(),
           step_file.c_str(), static_cast<char*>(nullptr));
    _exit(1);
  }
  int status = 1;
  if(child > 0)
    waitpid(child, &status, 0);
  const std::size_t result = (status == 0) ? count_tetrahedra(mesh_file) : 0;
  std::remove(mesh_file.c_str());
  return result;
}

#endif // CHECK_STEP_TETRAHEDRA_H
