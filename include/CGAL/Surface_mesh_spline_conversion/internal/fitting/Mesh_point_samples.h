// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_MESH_POINT_SAMPLES_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_MESH_POINT_SAMPLES_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/for_each_index.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// Finds, for each vertex and each middle of an edge of the mesh, the error sample whose point of the
// target is nearest to it, of those in the faces around it. A point where the target differs from
// the mesh has none.
template <typename Samples, typename Target>
class Mesh_point_samples
{
  typedef std::size_t size_type;

public:
  Mesh_point_samples(const Samples& samples, const Target& target)
    : m_samples(samples), m_target(target)
  {}

  // returns the numbers of the samples, or `Samples::none`
  std::vector<size_type> operator()() const
  {
    return completed(std::vector<size_type>(m_target.number_of_mesh_points(), Samples::none));
  }

  // does the same, when `nearest` are those of the previous samples: one that still exists can only
  // give way to one on a new patch
  std::vector<size_type> operator()(const Samples& previous,
                                    const std::vector<size_type>& nearest) const
  {
    std::vector<size_type> patches(previous.number_of_patches(), Samples::none);
    for(size_type p = 0; p < m_samples.number_of_patches(); ++p)
      if(!is_new(p))
        patches[m_samples.previous_patch(p)] = p;
    std::vector<size_type> result(nearest.size(), Samples::none);
    for(size_type i = 0; i < nearest.size(); ++i)
      if(nearest[i] != Samples::none)
      {
        const size_type old = previous.error_place(nearest[i]).patch;
        if(patches[old] != Samples::none)
          result[i] = nearest[i] - previous.first_error_sample(old)
                      + m_samples.first_error_sample(patches[old]);
      }
    return completed(std::move(result));
  }

private:
  bool is_new(size_type patch) const { return m_samples.previous_patch(patch) == Samples::none; }

  // `known`: samples that are nearest on patches that are not new
  std::vector<size_type> completed(std::vector<size_type> known) const
  {
    std::vector<size_type> result = known;
    std::vector<double> distances(known.size(), (std::numeric_limits<double>::infinity)());
    for(size_type v = 0; v < known.size(); ++v)
      if(known[v] != Samples::none)
        distances[v] = squared_distance(v, known[v]);
    const std::vector<char> is_open = faces_without_sample(known);
    for(size_type p = 0; p < m_samples.number_of_patches(); ++p)
      for_each_face(p, [&](size_type face, size_type i)
      {
        if(is_new(p) || is_open[face])
          for(size_type point : m_target.points_of_mesh_face(face))
            if(point != Samples::none && (is_new(p) || known[point] == Samples::none))
              choose_nearer(point, i, result, distances);
      });
    for_each_index(result.size(), [&](size_type v)
    {
      if(result[v] != Samples::none && !is_on_mesh(result[v]))
        result[v] = Samples::none;
    });
    return result;
  }

  // returns which faces of the mesh have a point without known sample
  std::vector<char> faces_without_sample(const std::vector<size_type>& known) const
  {
    std::vector<char> result(m_target.number_of_mesh_faces(), false);
    for(size_type f = 0; f < result.size(); ++f)
      for(size_type point : m_target.points_of_mesh_face(f))
        if(point != Samples::none && known[point] == Samples::none)
          result[f] = true;
    return result;
  }

  void choose_nearer(size_type point, size_type sample, std::vector<size_type>& samples,
                     std::vector<double>& distances) const
  {
    const double d = squared_distance(point, sample);
    if(d >= distances[point])
      return;
    samples[point] = sample;
    distances[point] = d;
  }

  // calls `visit(face, i)` for the samples of a patch and the faces of the mesh there
  template <typename Visitor>
  void for_each_face(size_type patch, const Visitor& visit) const
  {
    for(size_type i = m_samples.first_error_sample(patch);
        i < m_samples.first_error_sample(patch + 1); ++i)
      if(m_samples.mesh_face(i) != m_target.number_of_mesh_faces())
        visit(m_samples.mesh_face(i), i);
  }

  double squared_distance(size_type point, size_type sample) const
  {
    return (to_eigen(m_target.mesh_point(point)) - m_samples.target(sample)).squaredNorm();
  }

  bool is_on_mesh(size_type sample) const
  {
    const typename Samples::Place at = m_samples.error_place(sample);
    return m_target.is_on_mesh(at.quad, at.u, at.v);
  }

  const Samples& m_samples;
  const Target& m_target;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_MESH_POINT_SAMPLES_H
