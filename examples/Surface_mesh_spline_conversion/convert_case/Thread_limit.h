// The number of threads of the tool.
#ifndef CONVERT_CASE_THREAD_LIMIT_H
#define CONVERT_CASE_THREAD_LIMIT_H

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <algorithm>
#include <cstddef>
#include <memory>
#include <thread>

// While an object of this class exists, at most so many threads work; 0 stands for no limit.
class Thread_limit
{
public:
#ifdef CGAL_LINKED_WITH_TBB
  explicit Thread_limit(std::size_t number_of_threads)
  {
    // TBB reserves something for each thread that it may start
    const std::size_t most = (std::max)(1u, std::thread::hardware_concurrency());
    if(number_of_threads > 0)
      m_control = std::make_unique<tbb::global_control>(
        tbb::global_control::max_allowed_parallelism, (std::min)(number_of_threads, most));
  }

private:
  std::unique_ptr<tbb::global_control> m_control;
#else
  explicit Thread_limit(std::size_t) {}
#endif
};

#endif // CONVERT_CASE_THREAD_LIMIT_H
