// A process that does what a kernel may do: crash, loop for ever, throw, exit, or send a lot.
#include <CGAL/Surface_mesh_spline_conversion/internal/open_cascade/run_in_child_process.h>

#include <cassert>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <signal.h>

using CGAL::Surface_mesh_spline_conversion::internal::Child_end;
using CGAL::Surface_mesh_spline_conversion::internal::run_in_child_process;

int main()
{
  std::string bytes;
  Child_end end = run_in_child_process([] { return std::string("a\0b", 3); }, 60, bytes);
  assert(end == Child_end::NORMAL && bytes == std::string("a\0b", 3));

  const std::string large(5000000, 'x'); // more than a pipe holds
  end = run_in_child_process([&large] { return large; }, 60, bytes);
  assert(end == Child_end::NORMAL && bytes == large);

  int here = 1;
  end = run_in_child_process([&here] { here = 2; return std::string(); }, 60, bytes);
  assert(end == Child_end::NORMAL && bytes.empty() && here == 1);

  end = run_in_child_process([]() -> std::string { raise(SIGSEGV); return "lost"; }, 60, bytes);
  assert(end == Child_end::CRASHED && bytes.empty());
  end = run_in_child_process([]() -> std::string { throw std::runtime_error("lost"); }, 60, bytes);
  assert(end == Child_end::CRASHED && bytes.empty());
  end = run_in_child_process([]() -> std::string { std::_Exit(7); }, 60, bytes);
  assert(end == Child_end::CRASHED && bytes.empty());

  const auto start = std::chrono::steady_clock::now();
  end = run_in_child_process([]() -> std::string { for(volatile bool b = true; b;) {} return ""; },
                             1, bytes);
  assert(end == Child_end::TIMED_OUT && bytes.empty());
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  assert(time.count() > 0.9 && time.count() < 60);
  return 0;
}
