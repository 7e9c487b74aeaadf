// Quantization of motorcycle graphs: the lengths solve the equations, give boundary loops enough
// sides, are accepted at any coarseness; and the oracle rejects lengths that merge singularities or
// let a boundary loop vanish, even if they solve all equations. With any limit of the work, the
// lengths are valid. Searches from both ends find the same walks as those from one.

#include "voxel_seamless_maps.h"

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Quantization.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/map/build_motorcycle_graph.h>

#include <iostream>
#include <limits>
#include <random>
#include <vector>

namespace SC = CGAL::Surface_mesh_spline_conversion;
using namespace Test;
using SC::internal::Quantization;
using SC::internal::Quantization_oracle;
using SC::internal::Motorcycle_graph;

namespace {

void check_lengths(const Motorcycle_graph& graph, const std::vector<int>& lengths, int smallest)
{
  auto size = [&](const std::vector<int>& side)
  {
    int sum = 0;
    for(int h : side)
      sum += lengths[h / 2];
    return sum;
  };
  for(const Motorcycle_graph::Rectangle& rectangle : graph.rectangles)
    for(int side = 0; side < 2; ++side)
      assert(size(rectangle.sides[side]) == size(rectangle.sides[side + 2]));
  for(int n : lengths)
    assert(n >= smallest);
  std::set<int> seen;
  for(int first = 0; first < static_cast<int>(graph.arcs.size()); ++first)
  {
    int sides = 0;
    if(!graph.arcs[first].is_on_boundary || seen.count(first))
      continue;
    for(int a = first; seen.insert(a).second;
        a = graph.nodes[graph.arcs[a].node[1]].slots.front() / 2)
      sides += lengths[a];
    assert(sides >= 4);
  }
}

int number_of_quads(const Motorcycle_graph& graph, const std::vector<int>& lengths)
{
  int quads = 0;
  for(const Motorcycle_graph::Rectangle& rectangle : graph.rectangles)
  {
    int w = 0, h = 0;
    for(int a : rectangle.sides[0])
      w += lengths[a / 2];
    for(int a : rectangle.sides[1])
      h += lengths[a / 2];
    quads += w * h;
  }
  return quads;
}

// Shrinks the arc to length zero, keeping all equations; `false` if this is impossible.
bool shrink(SC::internal::Length_network& network, int arc)
{
  network.set_lower_bounds(std::vector<int>(network.number_of_arcs(), 0));
  while(network.length(arc) > 0)
    if(!network.change(arc, -1))
      return false;
  network.commit();
  return true;
}

// An arc between two singularities must not vanish; returns the number of arcs tried.
int test_merging(const Motorcycle_graph& graph, const std::vector<int>& lengths)
{
  Quantization_oracle oracle(graph);
  int tried = 0;
  for(int a = 0; a < static_cast<int>(graph.arcs.size()); ++a)
  {
    const Motorcycle_graph::Arc& arc = graph.arcs[a];
    if(!graph.nodes[arc.node[0]].is_critical() || !graph.nodes[arc.node[1]].is_critical())
      continue;
    SC::internal::Length_network network(graph, Quantization::real_lengths(graph, 20));
    network.set_lengths(lengths);
    if(!shrink(network, a))
      continue;
    ++tried;
    assert(!oracle(network.lengths()));
  }
  return tried;
}

void test_limits_of_work(const Motorcycle_graph& graph, int fractional_bits)
{
  for(const double limit : {0., 10., 300.})
  {
    const SC::internal::Work_budget budget(limit);
    Quantization quantization(graph, fractional_bits, budget);
    const bool is_quantized = quantization.quantize_all_positive();
    assert(is_quantized);
    (void)is_quantized;
    check_lengths(graph, quantization.lengths(), 1);
    quantization.allow_zeros();
    check_lengths(graph, quantization.lengths(), 0);
    assert(Quantization_oracle(graph)(quantization.lengths()));
    assert(limit > 0 || budget.spent() == 0);
  }
}

void test_voxels()
{
  int number_of_maps = 0, merged = 0, fewer = 0;
  for(int seed = 0; seed < 300; ++seed)
  {
    std::mt19937 random(seed);
    Voxel_surface_options options;
    options.subdivision = 2;
    options.jitter = 1000;
    options.hole_probability = seed % 2 ? 0.2 : 0;
    // from five quads along the edge of a voxel down to a twentieth of a quad
    options.edge = std::int64_t(1) << (17 + seed % 6);
    options.edge += options.edge / 4 + 2;
    Seamless_map map;
    if(!make_voxel_map(random_voxels(1 + seed % 13, random), options, random, map))
      continue;
    ++number_of_maps;
    Motorcycle_graph graph;
    const char* failure = SC::internal::compute_motorcycle_graph(map, graph);
    assert(*failure == 0);
    (void)failure;
    Quantization quantization(graph, map.fractional_bits);
    const bool is_quantized = quantization.quantize_all_positive();
    assert(is_quantized);
    (void)is_quantized;
    check_lengths(graph, quantization.lengths(), 1);
    const int quads = number_of_quads(graph, quantization.lengths());
    merged += test_merging(graph, quantization.lengths());
    quantization.allow_zeros();
    check_lengths(graph, quantization.lengths(), 0);
    fewer += number_of_quads(graph, quantization.lengths()) < quads;
    assert(Quantization_oracle(graph)(quantization.lengths()));
    test_limits_of_work(graph, map.fractional_bits);
  }
  std::cout << number_of_maps << " voxel maps, " << merged << " merged singularities rejected, "
            << fewer << " layouts with fewer quads by zeros" << std::endl;
  assert(number_of_maps > 100 && merged > 100);
}

// A tube without singularities: all equations allow that its girth or its length is zero.
void test_collapsing_loops()
{
  const Seamless_map map = make_flat_map(12, 5, 1 << 14, 0, false, 14);
  Motorcycle_graph graph;
  const char* failure = SC::internal::compute_motorcycle_graph(map, graph);
  assert(*failure == 0);
  (void)failure;
  Quantization quantization(graph, map.fractional_bits);
  const bool is_quantized = quantization.quantize_all_positive();
  assert(is_quantized);
  (void)is_quantized;
  quantization.allow_zeros();
  assert(number_of_quads(graph, quantization.lengths()) == 60);
  Quantization_oracle oracle(graph);
  for(bool is_girth : {false, true})
  {
    std::vector<int> lengths = quantization.lengths();
    for(std::size_t a = 0; a < lengths.size(); ++a)
      if(graph.arcs[a].is_on_boundary == is_girth)
        lengths[a] = 0;
    assert(!oracle(lengths));
  }
  std::vector<int> lengths = quantization.lengths();
  ++lengths[0];
  assert(!oracle(lengths)); // opposite sides differ
}

// The double cover has twice as many arcs, each leaving one equation and entering another.
void test_double_cover()
{
  std::mt19937 random(3);
  Voxel_surface_options options;
  Seamless_map map;
  Motorcycle_graph graph;
  const bool is_manifold = make_voxel_map(random_voxels(1, random), options, random, map);
  assert(is_manifold && *SC::internal::compute_motorcycle_graph(map, graph) == 0);
  (void)is_manifold;
  const SC::internal::Length_network network(graph, Quantization::real_lengths(graph, 20));
  SC::internal::Length_network cover = network.double_cover();
  std::vector<int> start;
  for(int a = 0; a < cover.number_of_arcs(); ++a)
    start.push_back(1 + random() % 7);
  cover.set_lower_bounds(std::vector<int>(start.size(), 1));
  cover.set_lengths(start);
  const bool is_balanced = cover.balance();
  assert(is_balanced);
  (void)is_balanced;
  std::vector<int> sums;
  for(int a = 0; a < network.number_of_arcs(); ++a)
    sums.push_back(cover.length(2 * a) + cover.length(2 * a + 1));
  check_lengths(graph, sums, 2);
}

using SC::internal::Walk_search;

// a network without open ends, in which costs are often the same
Walk_search random_network(int equations, int arcs, std::mt19937& random)
{
  std::vector<std::vector<Walk_search::Step> > steps(2 * equations);
  for(int a = 0; a < arcs; ++a)
  {
    const int ends[2] = {int(random() % equations), int(random() % equations)};
    const int signs[2] = {random() % 2 ? 1 : -1, random() % 2 ? 1 : -1};
    for(int i = 0; i < 2; ++i)
      for(int need : {-1, 1})
      {
        const int amount = need * signs[i];
        const int next = 2 * ends[1 - i] + (-signs[1 - i] * amount > 0 ? 1 : 0);
        steps[2 * ends[i] + (need > 0 ? 1 : 0)].push_back(
          Walk_search::Step{Walk_search::Change{a, amount}, next});
      }
  }
  Walk_search search;
  search.set_steps(steps, arcs);
  for(int a = 0; a < arcs; ++a)
    for(int amount : {-1, 1})
      search.set_cost(Walk_search::Change{a, amount},
                      random() % 4 ? 0.1 * (1 + random() % 5)
                                   : std::numeric_limits<double>::infinity());
  return search;
}

void test_searches_from_both_ends()
{
  const int equations = 200, arcs = 400;
  int found = 0, missed = 0;
  std::size_t longest = 0;
  std::mt19937 random(1);
  for(int i = 0; i < 2000; ++i)
  {
    Walk_search search = random_network(equations, arcs, random);
    const int start = random() % (2 * equations), end = random() % (2 * equations);
    const int banned = random() % arcs;
    const auto is_end = [end](int state) { return state == end; };
    std::vector<Walk_search::Change> walk, same_walk;
    const bool has_walk = search(start, banned, is_end, std::vector<int>(), walk);
    const bool has_same_walk = search(start, banned, is_end, std::vector<int>(1, end), same_walk);
    assert(has_walk == has_same_walk);
    (has_walk ? found : missed) += 1;
    if(!has_walk)
      continue;
    longest = (std::max)(longest, walk.size());
    assert(walk.size() == same_walk.size());
    for(std::size_t k = 0; k < walk.size(); ++k)
      assert(walk[k].arc == same_walk[k].arc && walk[k].amount == same_walk[k].amount
             && walk[k].arc != banned);
  }
  assert(found > 500 && missed > 50 && longest > 5);
}

} // namespace

int main()
{
  test_voxels();
  test_collapsing_loops();
  test_double_cover();
  test_searches_from_both_ends();
  return 0;
}
