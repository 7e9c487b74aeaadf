// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_RUN_IN_CHILD_PROCESS_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_RUN_IN_CHILD_PROCESS_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <string>

#include <signal.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

/// how a child process ended
enum class Child_end
{
  NORMAL,     ///< the result has arrived
  CRASHED,    ///< by a signal, an exception, or an exit
  TIMED_OUT,
  NOT_STARTED ///< the system has no process or pipe left
};

inline bool write_all(int file, const std::string& bytes)
{
  for(std::size_t sent = 0; sent < bytes.size();)
  {
    const ssize_t n = ::write(file, bytes.data() + sent, bytes.size() - sent);
    if(n < 0 && errno != EINTR)
      return false;
    sent += (n < 0) ? 0 : std::size_t(n);
  }
  return true;
}

inline std::string read_all(int file)
{
  std::string result;
  std::array<char, 4096> buffer;
  for(;;)
  {
    const ssize_t n = ::read(file, buffer.data(), buffer.size());
    if(n == 0 || (n < 0 && errno != EINTR))
      return result;
    result.append(buffer.data(), n < 0 ? 0 : std::size_t(n));
  }
}

/// Runs a function in a copy of this process, so that a crash or an endless loop loses its result
/// only. It needs a POSIX system.
/// \param function returns the bytes that are sent back; threads of this process do not exist for
///         it
/// \param seconds the limit of time; signals of the function's own alarm clock would end it
inline Child_end run_in_child_process(const std::function<std::string()>& function,
                                      unsigned int seconds, std::string& result)
{
  result.clear();
  std::array<int, 2> ends;
  if(::pipe(ends.data()) != 0)
    return Child_end::NOT_STARTED;
  const pid_t child = ::fork();
  if(child == 0)
  {
    ::close(ends[0]);
    ::signal(SIGALRM, SIG_DFL);
    ::alarm(seconds);
    bool is_sent = false;
    try
    {
      is_sent = write_all(ends[1], function());
    }
    catch(...) // whatever it is, it ends here
    {}
    ::_exit(is_sent ? EXIT_SUCCESS : EXIT_FAILURE); // buffers of streams belong to the parent
  }
  ::close(ends[1]);
  if(child > 0)
    result = read_all(ends[0]);
  ::close(ends[0]);
  if(child < 0)
    return Child_end::NOT_STARTED;
  int status = 0;
  while(::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  if(WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS)
    return Child_end::NORMAL;
  result.clear();
  return (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) ? Child_end::TIMED_OUT
                                                              : Child_end::CRASHED;
}

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_OPEN_CASCADE_RUN_IN_CHILD_PROCESS_H
