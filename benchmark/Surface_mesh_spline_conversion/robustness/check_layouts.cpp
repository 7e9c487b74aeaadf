// The robustness driver of the map stage: computes quad layouts of many inputs at many sizes, each
// in a process of its own with limits of time and memory, and has them judged by a checker that
// shares no code with the package. Run it with --help for the options.

#include "layout_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace {

const char* const usage =
  "usage: check_layouts INPUT... --quad-size H[,H...] [options]\n"
  "INPUT is a mesh file (OFF, PLY, OBJ, STL), the folder of a case, or a folder of these.\n"
  "  --quad-size H,...  edge lengths of the quads\n"
  "  --relative         the sizes are relative to the diameter of the enclosing sphere\n"
  "  --layout DIR       write the layouts as DIR/<input>-<H>.obj\n"
  "  --pictures DIR     draw the layouts as DIR/<input>-<H>.png\n"
  "  --json FILE        write all figures\n"
  "  --seconds S        limit of the processor time of a run; by default 10 s, and 10 s more for\n"
  "                     each 10000 triangles and each 10000 quads\n"
  "  --memory M         limit of the memory of a run in megabytes (default: 4096)\n"
  "  --generate N       add N generated inputs\n"
  "  --seed S           number of the first generated input (default: 1)\n"
  "exit status: 0 all layouts are valid, 1 some are not, 2 bad arguments\n";

struct Options
{
  std::vector<std::string> inputs;
  std::vector<std::string> sizes; // as they were written: they are part of file names
  std::string json_file;
  std::size_t memory_in_megabytes = 4096;
  std::size_t generated = 0, seed = 1;
  Run_options run;
  bool asks_for_help = false;
};

std::vector<std::string> split(const std::string& list)
{
  std::vector<std::string> parts;
  std::istringstream in(list);
  for(std::string part; std::getline(in, part, ',');)
    parts.push_back(part);
  return parts;
}

// Reads the command line; returns what is wrong with it, or nothing.
std::string parse(const std::vector<std::string>& arguments, Options& options)
{
  for(std::size_t i = 0; i < arguments.size(); ++i)
  {
    const std::string& argument = arguments[i];
    if(argument == "--help")
      options.asks_for_help = true;
    else if(argument == "--relative")
      options.run.is_relative = true;
    else if(argument.substr(0, 2) != "--")
      options.inputs.push_back(argument);
    else
    {
      if(i + 1 == arguments.size())
        return argument + " needs a value";
      const std::string& value = arguments[++i];
      if(argument == "--quad-size")
        options.sizes = split(value);
      else if(argument == "--layout")
        options.run.layout_folder = value;
      else if(argument == "--pictures")
        options.run.picture_folder = value;
      else if(argument == "--json")
        options.json_file = value;
      else if(argument == "--seconds")
        options.run.seconds = std::strtod(value.c_str(), nullptr);
      else if(argument == "--memory")
        options.memory_in_megabytes = std::strtoul(value.c_str(), nullptr, 10);
      else if(argument == "--generate")
        options.generated = std::strtoul(value.c_str(), nullptr, 10);
      else if(argument == "--seed")
        options.seed = std::strtoul(value.c_str(), nullptr, 10);
      else
        return "unknown option " + argument;
    }
  }
  for(const std::string& size : options.sizes)
    if(!(std::strtod(size.c_str(), nullptr) > 0))
      return "'" + size + "' is no size";
  if(options.asks_for_help)
    return std::string();
  if(options.inputs.empty() && options.generated == 0)
    return "there is no input";
  return options.sizes.empty() ? "--quad-size is missing" : std::string();
}

struct Input
{
  std::string name;
  std::function<Mesh_defect(Case&)> make;
};

std::vector<Input> collect_inputs(const Options& options)
{
  std::vector<Input> inputs;
  for(const std::string& path : options.inputs)
    for(const std::string& file : find_inputs(path))
      inputs.push_back({input_name(file), [file](Case& input) { return read_input(file, input); }});
  for(std::size_t i = 0; i < options.generated; ++i)
  {
    const std::size_t seed = options.seed + i;
    inputs.push_back({generated_name(seed), [seed](Case& input)
      { return generate_input(seed, input); }});
  }
  return inputs;
}

enum Verdict { VALID, INVALID, REFUSED };

Verdict verdict(const Record& record)
{
  if(!record.get("error").empty())
    return REFUSED;
  return record.get("outcome") == "\"done\"" && record.get("defects") == "\"\"" ? VALID : INVALID;
}

// what went wrong, or nothing
std::string reason(const Record& record)
{
  for(const char* const key : {"error", "failure", "defects"})
    if(record.text(key).size() > 0)
      return std::string(key) + ": " + record.text(key)
             + (record.text("message").empty() || std::string(key) == "defects"
                  ? "" : " [" + record.text("message") + "]");
  return record.text("outcome") == "done" ? "" : record.text("outcome");
}

// the times of the stages with short names, in parentheses
std::string stage_times(const Record& record)
{
  std::string result;
  const std::string stages = record.get("stages"); // "name": seconds, ...
  for(std::size_t begin, end = 0; (begin = stages.find('"', end)) != std::string::npos;)
  {
    end = stages.find('"', begin + 1);
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, " %.2f",
                  std::strtod(stages.c_str() + end + 2, nullptr));
    result += (result.empty() ? "" : ", ") + stages.substr(begin + 1, end - begin - 1) + seconds;
    ++end;
  }
  return "(" + result + ")";
}

void print_line(const std::string& name, const Record& record)
{
  const char* const words[] = {"valid", "INVALID", "refused"};
  std::printf("%-28s %-7s", name.c_str(), words[verdict(record)]);
  if(!record.get("seconds").empty())
    std::printf(" %6.2f s %s", record.number("seconds"), stage_times(record).c_str());
  if(!record.get("quads").empty())
    std::printf(" %6.0f quads (x %.2f, at least %.0f, %.0f with valences 3 to 5), %3.0f EP, "
                "sj %.2f/%.2f, angle %.0f/%.0f, size %.2f/%.2f/%.2f, stretch %.2f/%.1f, "
                "%.0f inverted, rung: %s",
                record.number("quads"), record.number("relative_count"),
                record.number("least_quads"), record.number("least_quads_with_low_valences"),
                record.number("extraordinary_points"),
                record.number("min_scaled_jacobian"), record.number("mean_scaled_jacobian"),
                record.number("mean_angle_deviation"), record.number("max_angle_deviation"),
                record.number("min_size_ratio"),
                record.number("mean_size_ratio"), record.number("max_size_ratio"),
                record.number("mean_singular_value_ratio"),
                record.number("max_singular_value_ratio"), record.number("inverted"),
                record.text("rung").c_str());
  if(!reason(record).empty())
    std::printf(" %s", reason(record).c_str());
  std::printf("\n");
  std::fflush(stdout);
}

struct Summary
{
  std::size_t runs = 0, valid = 0, refused = 0, fallback = 0, timeouts = 0;
  double worst_ratio = 0, worst_jacobian = 1;
  std::string slowest, ugliest;

  void add(const std::string& name, const Record& record)
  {
    ++runs;
    valid += verdict(record) == VALID ? 1 : 0;
    refused += verdict(record) == REFUSED ? 1 : 0;
    // the layout of last resort, which needs no map
    fallback += record.text("rung").find("divided triangles") == 0 ? 1 : 0;
    timeouts += record.text("outcome") == "timeout" ? 1 : 0;
    const double ratio = record.number("seconds") / record.number("allowed_seconds");
    if(ratio > worst_ratio)
    {
      worst_ratio = ratio;
      slowest = name;
    }
    if(!record.get("quads").empty() && record.number("min_scaled_jacobian") < worst_jacobian)
    {
      worst_jacobian = record.number("min_scaled_jacobian");
      ugliest = name;
    }
  }

  void print() const
  {
    std::printf("%zu runs: %zu valid, %zu invalid, %zu refused, %zu fallback, %zu timeouts; "
                "slowest %s (%.0f %% of its limit); smallest scaled Jacobian %.2f in %s\n",
                runs, valid, runs - valid - refused, refused, fallback, timeouts, slowest.c_str(),
                100 * worst_ratio, worst_jacobian, ugliest.c_str());
  }
};

Record run(const Input& input, const std::string& size, const Options& options)
{
  const std::string name = input.name + "-" + size;
  const auto task = [&](Reporter& report)
  {
    limit_memory(options.memory_in_megabytes << 20);
    run_layout(input.make, std::strtod(size.c_str(), nullptr), name, options.run, report);
  };
  const double wall_seconds = 3600;
  std::string outcome;
  const Record reported = run_process(task, wall_seconds, outcome);
  Record record;
  record.set("input", json(input.name));
  record.set("quad_size", size);
  record.set("outcome", json(outcome));
  for(const auto& member : reported.members())
    record.set(member.first, member.second);
  return record;
}

} // namespace

int main(int argc, char* argv[])
{
  Options options;
  const std::string error = parse(std::vector<std::string>(argv + 1, argv + argc), options);
  if(!error.empty() || options.asks_for_help)
  {
    std::fprintf(stderr, "%s%s%s", error.c_str(), error.empty() ? "" : "\n", usage);
    return error.empty() ? EXIT_SUCCESS : 2;
  }
  for(const std::string& folder : {options.run.layout_folder, options.run.picture_folder})
    if(!folder.empty())
      std::filesystem::create_directories(folder);
  std::vector<Record> records;
  Summary summary;
  for(const Input& input : collect_inputs(options))
    for(const std::string& size : options.sizes)
    {
      records.push_back(run(input, size, options));
      print_line(input.name + "-" + size, records.back());
      summary.add(input.name + "-" + size, records.back());
    }
  summary.print();
  if(!options.json_file.empty())
    write_json(options.json_file, records);
  return summary.valid == summary.runs ? EXIT_SUCCESS : EXIT_FAILURE;
}
