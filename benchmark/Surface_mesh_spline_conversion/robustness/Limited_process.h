// Runs a function in a process of its own, with limits of time and memory.
#ifndef ROBUSTNESS_LIMITED_PROCESS_H
#define ROBUSTNESS_LIMITED_PROCESS_H

#include <CGAL/Surface_mesh_spline_conversion/internal/keep_freed_memory.h>

#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <new>
#include <string>
#include <utility>
#include <vector>

// What a process reports: names and JSON values, in the order in which they were written.
class Record
{
public:
  void set(const std::string& name, const std::string& json)
  {
    for(auto& member : m_members)
      if(member.first == name)
      {
        member.second = json;
        return;
      }
    m_members.emplace_back(name, json);
  }

  // the JSON value, or nothing
  std::string get(const std::string& name) const
  {
    for(const auto& member : m_members)
      if(member.first == name)
        return member.second;
    return std::string();
  }

  // a string without its quotes
  std::string text(const std::string& name) const
  {
    const std::string json = get(name);
    return json.size() < 2 || json[0] != '"' ? json : json.substr(1, json.size() - 2);
  }

  double number(const std::string& name) const { return std::strtod(get(name).c_str(), nullptr); }

  const std::vector<std::pair<std::string, std::string> >& members() const { return m_members; }

private:
  std::vector<std::pair<std::string, std::string> > m_members;
};

// processor time of this process, or of those that it has waited for, in seconds
inline double processor_time(int who = RUSAGE_SELF)
{
  rusage usage;
  getrusage(who, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Ends this process when it uses more than `seconds` of processor time from now on.
inline void limit_processor_time(double seconds)
{
  rlimit limit;
  getrlimit(RLIMIT_CPU, &limit);
  limit.rlim_cur = static_cast<rlim_t>(std::ceil(processor_time() + seconds));
  setrlimit(RLIMIT_CPU, &limit);
}

inline void limit_memory(std::size_t bytes)
{
  rlimit limit;
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = bytes;
  setrlimit(RLIMIT_AS, &limit);
}

// The other end of `run_process()`: writes members of the record from within the process.
class Reporter
{
public:
  explicit Reporter(int pipe_end) : m_pipe(pipe_end) {}

  void operator()(const std::string& name, const std::string& json)
  {
    const std::string line = name + " " + json + "\n";
    for(std::size_t sent = 0; sent < line.size();)
    {
      const ssize_t n = write(m_pipe, line.data() + sent, line.size() - sent);
      if(n <= 0)
        return;
      sent += static_cast<std::size_t>(n);
    }
  }

private:
  int m_pipe;
};

// Reads lines `name value` until the other end is closed or the time is over; returns `false` then.
inline bool read_record(int pipe_end, double seconds, Record& record)
{
  typedef std::chrono::steady_clock Clock;
  const Clock::time_point end
    = Clock::now() + std::chrono::milliseconds(static_cast<long long>(1000 * seconds));
  std::string text;
  bool is_closed = false;
  while(!is_closed && Clock::now() < end)
  {
    pollfd event = {pipe_end, POLLIN, 0};
    const int slice_in_milliseconds = 200;
    if(poll(&event, 1, slice_in_milliseconds) <= 0)
      continue;
    char buffer[4096];
    const ssize_t n = read(pipe_end, buffer, sizeof buffer);
    is_closed = n <= 0;
    text.append(buffer, n > 0 ? static_cast<std::size_t>(n) : 0);
  }
  for(std::size_t begin = 0, line_end; (line_end = text.find('\n', begin)) != std::string::npos;
      begin = line_end + 1)
  {
    const std::size_t space = text.find(' ', begin);
    record.set(text.substr(begin, space - begin), text.substr(space + 1, line_end - space - 1));
  }
  return is_closed;
}

// Runs `task` in a process of its own and returns what it reports. `outcome` says how it ended:
// "done", "timeout", "out of memory", or the name of the signal.
// `wall_seconds`: a limit of the elapsed time, for processes that wait for ever
inline Record run_process(const std::function<void(Reporter&)>& task, double wall_seconds,
                          std::string& outcome)
{
  Record record;
  int ends[2];
  if(pipe(ends) != 0)
  {
    outcome = "no pipe";
    return record;
  }
  std::fflush(nullptr);
  const pid_t child = fork();
  if(child == 0)
  {
    close(ends[0]);
    CGAL::Surface_mesh_spline_conversion::internal::keep_freed_memory();
    Reporter reporter(ends[1]);
    int status = EXIT_SUCCESS;
    try
    {
      task(reporter);
    }
    catch(const std::bad_alloc&)
    {
      reporter("ended", "\"out of memory\"");
    }
    catch(const std::exception&)
    {
      status = EXIT_FAILURE;
    }
    _exit(status);
  }
  close(ends[1]);
  const bool is_closed = read_record(ends[0], wall_seconds, record);
  close(ends[0]);
  if(!is_closed)
    kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  if(!is_closed || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
    outcome = "timeout";
  else if(WIFSIGNALED(status))
    outcome = std::string("signal ") + strsignal(WTERMSIG(status));
  else if(WEXITSTATUS(status) != 0)
    outcome = "exception";
  else
    outcome = record.text("ended").empty() ? "done" : record.text("ended");
  return record;
}

#endif // ROBUSTNESS_LIMITED_PROCESS_H
