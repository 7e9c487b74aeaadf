// The number of threads of the tool.
#ifndef CONVERT_CASE_THREAD_LIMIT_H
#define CONVERT_CASE_THREAD_LIMIT_H

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

#include <cstddef>
#include <memory>

// While an object of this class exists, at most so many threads work; 0 stands for no limit.
class Thread_limit
{
public:
#ifdef CGAL_LINKED_WITH_TBB
  explicit Thread_limit(std::size_t number_of_threads)
  {
    if(number_of_threads > 0)
      m_control = std::make_unique<tbb::global_control>(
        tbb::global_control::max_allowed_parallelism, number_of_threads);
  }

private:
  std::unique_ptr<tbb::global_control> m_control;
#else
  explicit Thread_limit(std::size_t) {}
#endif
};

#endif // CONVERT_CASE_THREAD_LIMIT_H
