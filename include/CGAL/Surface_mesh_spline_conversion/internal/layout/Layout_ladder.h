// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_LAYOUT_LADDER_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_LAYOUT_LADDER_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/Conversion_report.h>
#include <CGAL/Surface_mesh_spline_conversion/Error_code.h>
#include <CGAL/Surface_mesh_spline_conversion/Quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_cross_field.h>
#include <CGAL/Surface_mesh_spline_conversion/compute_integer_grid_map.h>
#include <CGAL/Surface_mesh_spline_conversion/extract_quad_layout.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/Work_budget.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/inverted_quads.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/layout/lost_area.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/run_stage.h>

#include <CGAL/boost/graph/named_params_helper.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// `true` if a stage before the layout failed for reasons that need not be those of the input
inline bool has_no_map(Error_code code)
{
  return code == Error_code::NO_SEAMLESS_MAP || code == Error_code::NO_QUAD_LAYOUT
         || code == Error_code::SINGULAR_SYSTEM || code == Error_code::DEGENERATE_MESH;
}

// of singularities, see `Cross_field`; the second one where repairs have not helped
constexpr double smallest_spacing = 1. / 8, smallest_last_spacing = 1. / 32;

// One rung of the ladder of attempts to find a map on one mesh: see `Cross_field` for the spacing.
struct Map_attempt
{
  double spacing;
  int most_repairs;
};

// What to try after a first attempt with `field`. Quads larger than the features of the shape
// (handles, small loops, thin walls) would spread singularities over these: halving the spacing
// lets them stay where the shape wants them. It ends near the length of the edges of
// the mesh.
inline void append_attempts(const Cross_field& field, std::vector<Map_attempt>& attempts)
{
  if(field.size.size() != field.mesh.points.size() || field.size.empty())
    return;
  const double edges_per_spacing = 0.6;
  const double size = *std::min_element(field.size.begin(), field.size.end());
  const double edge = mean_edge_length(field.mesh);
  double spacing = attempts.front().spacing;
  const auto halve_spacing_until = [&](double smallest)
  {
    while(spacing > smallest && spacing * size / 2 >= edges_per_spacing * edge)
    {
      spacing /= 2;
      attempts.push_back(Map_attempt{spacing, 0});
    }
  };
  halve_spacing_until(smallest_spacing);
  attempts.push_back(Map_attempt{spacing, number_of_rungs});
  halve_spacing_until(smallest_last_spacing);
}

inline std::string describe(const Field_attempt& attempt, const Integer_grid_map& map)
{
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if(attempt.proxy_refinement > 1)
  {
    std::ostringstream refinement;
    refinement << std::setprecision(2) << attempt.proxy_refinement;
    add("edges of the proxy divided by " + refinement.str());
  }
  if(attempt.mesh == Field_attempt::Mesh::OTHER)
    add(map.proxy ? "a proxy" : "no proxy");
  if(attempt.gathers_singularities)
    add("singularities gathered on the mesh itself");
  if(attempt.joining_distance > 0)
    add("singularities joined");
  if(attempt.spacing < 1)
    add("spacing of singularities divided by " + std::to_string(std::lround(1 / attempt.spacing)));
  if(map.map.repairs > 0)
    add("repairs: " + std::to_string(map.map.repairs));
  if(!attempt.size_shares.empty())
    add("size of the quads around inverted ones divided by "
        + std::to_string(std::lround(1 / *std::min_element(attempt.size_shares.begin(),
                                                           attempt.size_shares.end()))));
  if(!map.is_resolved)
    add("rectangle composition: " + map.message);
  return text.empty() ? "none" : text;
}

// Field, map and quads, by the first attempt that succeeds. Where the projection from a proxy has
// folds, so would the inverse map: finer proxies are tried. Quads get better shapes, which takes
// time, only once there is no map with fewer. Inverted quads get smaller ones.
template <typename TriangleMesh, typename BoundaryCurveNetwork, typename GeomTraits,
          typename Visitor, typename NamedParameters>
class Layout_ladder
{
public:
  Layout_ladder(const TriangleMesh& tm, const BoundaryCurveNetwork& network,
                Quad_layout<GeomTraits>& layout, Conversion_report& report, Visitor& visitor,
                const NamedParameters& np)
    : m_tm(tm), m_network(network), m_layout(layout), m_report(report), m_visitor(visitor),
      m_np(np), m_message(report.message)
  {}

  Error_code run()
  {
    Error_code code = find_map();
    const bool is_crowded = code == Error_code::OK && has_crowded_map();
    if(is_crowded)
      code = replace_crowded_map();
    if(code == Error_code::OK)
      code = extract_layout();
    if(code == Error_code::OK)
      code = replace_inverted_quads();
    if(code == Error_code::OK)
      code = collapse_chords();
    if(code != Error_code::OK)
      return code;
    return is_crowded ? join_singularities_and_collapse_quads() : collapse_quads();
  }

private:
  enum class Purpose { FIRST_MAP, BETTER_MAP };

  Error_code find_map()
  {
    Error_code code = try_mesh(Field_attempt());
    const bool has_proxy = m_field.proxy != nullptr;
    const std::vector<Field_attempt> attempts = further_attempts();
    for(std::size_t i = 0; i < attempts.size() && can_look_for_map(code); ++i)
    {
      code = try_mesh(attempts[i]);
      // the mesh itself has taken its place: neither is there a finer proxy nor another choice
      if(has_proxy && !m_field.proxy && attempts[i].mesh == Field_attempt::Mesh::CHOSEN)
        break;
    }
    return can_look_for_map(code) ? gather_singularities() : code;
  }

  // Many corners beside thin parts of the shape may leave no room for single singularities, and a
  // proxy of such parts has few vertices. Smaller distances and repairs would part singularities.
  Error_code gather_singularities()
  {
    Field_attempt attempt;
    attempt.mesh = Field_attempt::Mesh::ITSELF;
    attempt.gathers_singularities = true;
    return try_once(attempt, 0, Purpose::FIRST_MAP);
  }

  // After a first attempt: finer proxies in place of a folded one, and the other mesh. The mesh
  // itself comes first where it has fewer faces than its proxy: finer ones cost more.
  std::vector<Field_attempt> further_attempts() const
  {
    std::vector<Field_attempt> attempts;
    // from the first on, twice the faces each time
    if(m_is_folded)
      for(double refinement : {2., std::sqrt(8.), 4.})
        attempts.push_back(Field_attempt{1, refinement, Field_attempt::Mesh::CHOSEN});
    attempts.push_back(Field_attempt{1, 1, Field_attempt::Mesh::OTHER});
    if(m_field.proxy
       && m_field.proxy->original->number_of_faces() < m_field.proxy->mesh.number_of_faces())
      std::rotate(attempts.begin(), attempts.end() - 1, attempts.end());
    return attempts;
  }

  Error_code try_mesh(Field_attempt on_mesh)
  {
    const int few_repairs = 1;
    std::vector<Map_attempt> attempts(1, Map_attempt{1, few_repairs});
    Error_code code = Error_code::NO_SEAMLESS_MAP;
    m_is_folded = false;
    on_mesh.known_proxy = std::make_shared<std::optional<std::shared_ptr<const Proxy_mesh> > >();
    for(std::size_t i = 0; i < attempts.size() && can_look_for_map(code) && !m_is_folded; ++i)
    {
      on_mesh.spacing = attempts[i].spacing;
      code = try_once(on_mesh, attempts[i].most_repairs, Purpose::FIRST_MAP);
      if(i == 0)
        append_attempts(m_field, attempts);
    }
    return code;
  }

  bool can_look_for_map(Error_code code) const
  {
    return has_no_map(code) && !m_budget.is_used_up();
  }

  Error_code try_once(const Field_attempt& attempt, int most_repairs, Purpose purpose)
  {
    m_report.message = m_message;
    const Error_code code = try_to_map(attempt, most_repairs, purpose);
    if(code == Error_code::OK)
    {
      m_report.map.fallback = describe(attempt, m_map);
      m_attempt = attempt;
      m_most_repairs = most_repairs;
    }
    else if(has_no_map(code) && !m_map.message.empty())
      m_report.message = m_map.message;
    return code;
  }

  Error_code extract_layout(Vertex_smoothing::Priority priority
                              = Vertex_smoothing::Priority::EVEN_MAP)
  {
    return run_stage("quad_layout", m_visitor, m_report, [&]()
    {
      const double share_of_smoothing = 0.5;
      set_mapped_layout(std::move(m_quads), m_map, m_tm, priority,
                        m_spare.share(share_of_smoothing), m_layout, m_np);
      return Error_code::OK;
    });
  }

  bool has_crowded_map() const
  {
    const double crowd = 2; // times the needed number of quads
    return double(number_of_quads()) > crowd * needed_number_of_quads();
  }

  // Between singularities that have been spread over the features of the shape, large quads may have
  // to pass the same place many times. The map with the fewest quads is taken.
  Error_code replace_crowded_map()
  {
    Error_code code = Error_code::OK;
    Field_attempt attempt = m_attempt;
    while(attempt.spacing > smallest_spacing && code == Error_code::OK && !m_spare.is_used_up())
    {
      attempt.spacing /= 2;
      const int number = number_of_quads();
      bool is_better = false;
      code = try_instead(attempt, is_better, [&]()
      {
        is_better = number_of_quads() < number;
        return Error_code::OK;
      });
      if(m_has_too_many_faces) // so would have the next one
        break;
    }
    return code;
  }

  // Many singularities of the shape need many quads, however large these should be. Those that are
  // closer to each other than a quad are joined. The layout with the fewest quads is taken, unless
  // some are inverted.
  Error_code join_singularities()
  {
    Error_code code = Error_code::OK;
    Field_attempt attempt = m_attempt;
    attempt.size_shares.clear();
    attempt.spacing = smallest_spacing;
    for(double distance : {0.25, 0.5, 0.75, 1.}) // in quad sizes
    {
      if(code != Error_code::OK || m_spare.is_used_up())
        break;
      attempt.joining_distance = distance;
      bool is_better = false;
      code = try_instead(attempt, is_better,
                         [&]() { return extract_layout_with_fewer_quads(is_better); });
    }
    return code;
  }

  // Singularities that are near each other, but not on common lines, need narrow quads between
  // these. Chords of such quads collapse where the quads have less than half of the wanted size in
  // the mean.
  Error_code collapse_chords()
  {
    const double share_of_collapses = 0.25;
    m_collapses = m_spare.share(share_of_collapses);
    if(double(m_layout.number_of_quads()) <= sufficient_number_of_quads()
       || m_collapses.is_used_up())
      return Error_code::OK;
    const Quad_layout<GeomTraits> layout = m_layout;
    bool is_better = false;
    Error_code code = find_quads(m_map, m_quads);
    if(code == Error_code::OK)
      code = extract_layout_with_fewer_quads(is_better);
    if(!is_better)
      m_layout = layout;
    return code;
  }

  // on the map with joined singularities, and then on that without
  Error_code join_singularities_and_collapse_quads()
  {
    const Integer_grid_map map = m_map;
    const Field_attempt attempt = m_attempt;
    Error_code code = join_singularities();
    const bool is_other_map = m_attempt.joining_distance > 0;
    if(code == Error_code::OK)
      code = collapse_quads();
    if(code != Error_code::OK || !is_other_map)
      return code;
    m_map = map;
    m_attempt = attempt;
    return collapse_quads();
  }

  // Where chords do not suffice, single quads collapse as well, from the quads of the map on. Which
  // ones these are depends on the number of rounds: some numbers are tried until there are few
  // enough quads.
  Error_code collapse_quads()
  {
    const double share_of_collapses = 0.5;
    m_collapses = m_spare.share(share_of_collapses);
    Error_code code = Error_code::OK;
    for(const int rounds : {3, 4, 2, 1})
      if(code == Error_code::OK && !m_collapses.is_used_up()
         && double(m_layout.number_of_quads()) > sufficient_number_of_quads())
        code = collapse_quads_in_rounds(rounds);
    return code;
  }

  // Replaces the layout if there are fewer quads then, none of them intolerable.
  Error_code collapse_quads_in_rounds(int rounds)
  {
    const Quad_layout<GeomTraits> layout = m_layout;
    Error_code code = find_quads(m_map, m_quads);
    if(code != Error_code::OK)
      return code;
    const std::vector<Collapse_sequence::Move> moves = m_quads.collapse_in_rounds(
      m_map, rounds, sufficient_number_of_quads(), m_collapses);
    if(moves.empty() || std::size_t(number_of_quads()) >= layout.number_of_quads())
      return Error_code::OK;
    const auto faces = mesh_face_corners();
    const Quad_limits limits = quad_limits(faces);
    code = extract_layout();
    if(code == Error_code::OK && are_tolerable(faces, limits))
      describe_collapse(moves);
    else
      m_layout = layout;
    return code;
  }

  // of half of the wanted size; below fifty, fewer quads are worth less than better shapes, and so
  // they are if more are wanted
  double sufficient_number_of_quads() const
  {
    const double few_quads = 49;
    return m_wanted_number_of_quads > few_quads
             ? std::numeric_limits<double>::infinity()
             : (std::max)(2 * m_wanted_number_of_quads, few_quads);
  }

  // The layout of the present map after collapses of chords, or else without them: better than the
  // present one if it has fewer quads, none of which are inverted.
  Error_code extract_layout_with_fewer_quads(bool& is_better)
  {
    const std::size_t number = m_layout.number_of_quads();
    const Mapped_quads quads = m_quads;
    Error_code code = extract_collapsed_layout(number, is_better);
    if(is_better || code != Error_code::OK
       || std::size_t(quads.quads().number_of_quads()) >= number)
      return code;
    m_quads = quads;
    code = extract_layout();
    is_better = inverted_quads(m_layout, mesh_face_corners()).empty();
    return code;
  }

  // Tries all chords that are found, half of them, and so on, until the collapse of these leaves
  // less than `number` quads, and has made none of them intolerable.
  Error_code extract_collapsed_layout(std::size_t number, bool& is_better)
  {
    is_better = false;
    const Mapped_quads quads = m_quads;
    std::vector<Collapse_sequence::Move> moves
      = quads.find_collapses(m_map, Collapse_sequence::Parts::CHORDS,
                             sufficient_number_of_quads(), m_collapses);
    if(moves.empty())
      return Error_code::OK;
    const auto faces = mesh_face_corners();
    const Quad_limits limits = quad_limits(faces);
    for(; !moves.empty() && !m_collapses.is_used_up()
          && std::size_t(moves.back().number_of_quads) < number; moves.resize(moves.size() / 2))
    {
      m_quads = quads;
      if(!m_quads.collapse(m_map, moves, m_collapses))
        continue;
      const Error_code code = extract_layout();
      is_better = code == Error_code::OK && are_tolerable(faces, limits);
      if(is_better)
        describe_collapse(moves);
      if(is_better || code != Error_code::OK)
        return code;
    }
    return Error_code::OK;
  }

  // after collapses: tolerable values, or those of the present layout
  struct Quad_limits
  {
    double shape;     // of the worst quad
    double lost_area; // see `lost_area()`
  };

  Quad_limits quad_limits(const std::vector<std::array<Eigen::Vector3d, 3> >& faces) const
  {
    const double tolerable_loss = 0.05;
    return Quad_limits{
      (std::min)(least_shape_of_flat_quads(m_layout, faces), Vertex_smoothing::tolerable_shape),
      (std::max)(lost_area(m_layout, faces), tolerable_loss)};
  }

  bool are_tolerable(const std::vector<std::array<Eigen::Vector3d, 3> >& faces,
                     const Quad_limits& limits) const
  {
    const double shape = least_shape_of_flat_quads(m_layout, faces);
    return shape > 0 && shape >= limits.shape && lost_area(m_layout, faces) <= limits.lost_area;
  }

  void describe_collapse(const std::vector<Collapse_sequence::Move>& moves)
  {
    int chords = 0, quads = 0;
    for(const Collapse_sequence::Move& move : moves)
      ++(move.steps.front().kind == Collapse_step::Kind::CHORD ? chords : quads);
    std::string& text = m_report.map.fallback;
    text = describe(m_attempt, m_map);
    text = (text == "none" ? "" : text + "; ") + "chords collapsed: " + std::to_string(chords)
           + (quads > 0 ? ", quads: " + std::to_string(quads) : "");
  }

  std::vector<std::array<Eigen::Vector3d, 3> > mesh_face_corners() const
  {
    return face_corners(m_tm, parameters::choose_parameter(
      parameters::get_parameter(m_np, internal_np::vertex_point),
      get_const_property_map(vertex_point, m_tm)));
  }

  int number_of_quads() const { return m_quads.quads().number_of_quads(); }

  // The surface may turn so much within a quad that the flat one is inverted, or a quad winds around
  // a thin part. Quads are made smaller there, on the same mesh, and where the smaller ones are
  // inverted in turn. The layout with the fewest inverted quads is kept.
  Error_code replace_inverted_quads()
  {
    const int most_attempts = 3;
    const auto faces = mesh_face_corners();
    std::vector<std::size_t> inverted = inverted_quads(m_layout, faces);
    if(inverted.empty())
      return Error_code::OK;
    const Integer_grid_map first_map = m_map;
    const std::string first_fallback = m_report.map.fallback;
    Field_attempt attempt = m_attempt;
    attempt.size_shares.assign(faces.size(), 1);
    std::size_t least_number = inverted.size();
    std::set<std::size_t> places = faces_below(inverted);
    bool is_first_map = true;
    Error_code code = Error_code::OK;
    for(int i = 0; i < most_attempts && code == Error_code::OK && least_number > 0
                   && !m_spare.is_used_up(); ++i)
    {
      for(const std::size_t f : places)
        attempt.size_shares[f] /= 2;
      bool is_better = false;
      code = try_instead(attempt, is_better, [&]()
      {
        const Error_code extraction_code = extract_layout();
        inverted = inverted_quads(m_layout, faces);
        places = faces_below(inverted);
        is_better = inverted.size() < least_number;
        least_number = (std::min)(least_number, inverted.size());
        return extraction_code;
      });
      is_first_map = is_first_map && !is_better;
      if(m_has_too_many_faces) // so would have the next one
        break;
    }
    const std::string fallback = m_report.map.fallback;
    if(code == Error_code::OK && least_number > 0 && !m_spare.is_used_up())
      code = favor_flat_quads(m_map, fallback, faces, least_number);
    if(code == Error_code::OK && least_number > 0 && !is_first_map && !m_spare.is_used_up())
      code = favor_flat_quads(first_map, first_fallback, faces, least_number);
    return code;
  }

  // Where smaller quads do not help, a map may be squeezed so that fewer flat quads are inverted.
  // `fallback`: of the map. `number_of_inverted`: of the present layout, and then of the better one
  Error_code favor_flat_quads(Integer_grid_map map, const std::string& fallback,
                              const std::vector<std::array<Eigen::Vector3d, 3> >& faces,
                              std::size_t& number_of_inverted)
  {
    Quad_layout<GeomTraits> layout = m_layout;
    std::swap(m_map, map);
    Error_code code = find_quads(m_map, m_quads);
    if(code == Error_code::OK)
      code = extract_layout(Vertex_smoothing::Priority::FLAT_QUADS);
    const std::size_t number
      = code == Error_code::OK ? inverted_quads(m_layout, faces).size() : number_of_inverted;
    if(number < number_of_inverted)
    {
      number_of_inverted = number;
      m_report.map.fallback = fallback;
      return code;
    }
    std::swap(m_map, map);
    m_layout = std::move(layout);
    return code;
  }

  // Looks for another map, and keeps the present one and its layout unless `judge()` says that the
  // other one is better.
  template <typename Judge>
  Error_code try_instead(const Field_attempt& attempt, bool& is_better, const Judge& judge)
  {
    Integer_grid_map map = m_map;
    Mapped_quads quads = m_quads;
    Quad_layout<GeomTraits> layout = m_layout;
    const std::string fallback = m_report.map.fallback;
    const Field_attempt before = m_attempt;
    Error_code code = try_once(attempt, m_most_repairs, Purpose::BETTER_MAP);
    is_better = false;
    if(code == Error_code::OK)
      code = judge();
    if(is_better || (code != Error_code::OK && !has_no_map(code)))
      return code;
    m_map = std::move(map);
    m_quads = std::move(quads);
    m_layout = std::move(layout);
    m_report.map.fallback = fallback;
    m_report.message = m_message;
    m_attempt = before;
    return Error_code::OK;
  }

  // in proportion to the size of the problem, but for small ones
  void set_budgets()
  {
    const double base = 11e6, elements = 10000, share_of_improvements = 0.75;
    m_budget = Work_budget(
      base * (1 + (double(num_faces(m_tm)) + needed_number_of_quads()) / elements));
    m_spare = m_budget.share(share_of_improvements);
    m_wanted_number_of_quads = wanted_number_of_quads();
  }

  // what quads of the wanted size need, and about four quads around each loop and each half handle
  double needed_number_of_quads() const
  {
    return wanted_number_of_quads() + 4 * (2 - m_field.mesh.euler_characteristic());
  }

  // of the wanted size
  double wanted_number_of_quads() const
  {
    const Working_mesh& mesh = m_field.mesh;
    double result = 0;
    for(int f = 0; f < mesh.number_of_faces(); ++f)
      for(const int v : mesh.triangles[f])
        result += mesh.normal(f).norm() / (6 * m_field.size[v] * m_field.size[v]);
    return result;
  }

  // the faces where some quads of the layout have samples
  std::set<std::size_t> faces_below(const std::vector<std::size_t>& quads) const
  {
    const int n = 4;
    std::set<std::size_t> faces;
    for(const std::size_t q : quads)
      for(int i = 0; i <= n; ++i)
        for(int j = 0; j <= n; ++j)
          faces.insert(m_layout.inverse_map()(q, i / double(n), j / double(n)).face);
    return faces;
  }

  Error_code try_to_map(const Field_attempt& attempt, int most_repairs, Purpose purpose)
  {
    m_map = Integer_grid_map();
    const Error_code code = run_stage("cross_field", m_visitor, m_report, [&]()
      { return compute_cross_field(m_tm, m_network, attempt, m_field, m_np); });
    if(code != Error_code::OK)
      return code;
    if(m_budget.spent() == 0)
      set_budgets();
    m_is_folded = m_field.proxy && m_field.proxy->is_folded;
    if(m_is_folded)
    {
      m_map.message = "the projection from the proxy to the mesh has folds";
      return Error_code::NO_QUAD_LAYOUT;
    }
    return run_stage("integer_grid_map", m_visitor, m_report, [&]()
    {
      const bool is_first = purpose == Purpose::FIRST_MAP;
      const double share_of_map = 0.75;
      const Work_budget budget = (is_first ? m_budget : m_spare).share(share_of_map);
      const double faces = m_field.mesh.number_of_faces(), spent = budget.spent();
      m_has_too_many_faces = !is_first && faces * m_work_per_face > budget.rest();
      if(m_has_too_many_faces)
        return Error_code::NO_QUAD_LAYOUT;
      const Error_code map_code
        = compute_integer_grid_map(m_field, most_repairs, budget, m_map);
      m_work_per_face = (budget.spent() - spent) / faces;
      if(map_code != Error_code::OK)
        return map_code;
      // what has not been finished is not better
      return is_first || !budget.is_used_up() ? find_quads(m_map, m_quads)
                                              : Error_code::NO_QUAD_LAYOUT;
    });
  }

  const TriangleMesh& m_tm;
  const BoundaryCurveNetwork& m_network;
  Quad_layout<GeomTraits>& m_layout;
  Conversion_report& m_report;
  Visitor& m_visitor;
  const NamedParameters& m_np;
  const std::string m_message; // of the report before
  Cross_field m_field;
  Integer_grid_map m_map;
  Mapped_quads m_quads;        // those of the map until they become the layout
  bool m_is_folded = false;    // the last proxy
  Field_attempt m_attempt;     // the last one that succeeded, and its repairs
  int m_most_repairs = 0;
  Work_budget m_budget;        // known with the first field
  Work_budget m_spare;         // the part of it within which layouts are made better
  Work_budget m_collapses;     // the part of that within which chords collapse
  double m_wanted_number_of_quads = 0; // by the first field
  double m_work_per_face = 0;  // of the last map
  bool m_has_too_many_faces = false; // the last field, for a better map within the budget
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_LAYOUT_LAYOUT_LADDER_H
