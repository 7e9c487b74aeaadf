// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_BOUNDARY_TANGENCY_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_BOUNDARY_TANGENCY_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/internal/named_parameters.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/patches/quad_sides.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/to_eigen.h>

#include <CGAL/number_type_config.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The unit normal of the face beyond the boundary, at the point of a chain that is closest to a
// given one, near a parameter of the target; the null vector where the surface need not be tangent
// to anything.
template <typename Target>
using Boundary_normals
  = std::function<Eigen::Vector3d(std::size_t, double, const typename Target::Point_3&)>;

// no face is beyond the boundary
template <typename Target>
Boundary_normals<Target> boundary_normals(const Target&, internal_np::Param_not_found)
{
  return Boundary_normals<Target>();
}

// the normals, given as those of curves
template <typename Target, typename Normal>
Boundary_normals<Target> boundary_normals(const Target& target, const Normal& normal)
{
  return [&target, normal](std::size_t chain, double x, const typename Target::Point_3& p)
  {
    typedef typename Target::FT FT;
    const auto& network = target.network();
    const auto foot = network.project(chain, p, target.arc_length(chain, FT(x)));
    const auto place = network.locate(chain, foot.arc_length);
    return to_eigen(normal(place.curve, place.parameter));
  };
}

// the same; an empty function gives no normals
template <typename Target, typename Vector_3, typename Curve_3, typename FT>
Boundary_normals<Target>
boundary_normals(const Target& target,
                 const std::function<Vector_3(const Curve_3&, const FT&)>& normal)
{
  typedef std::function<Vector_3(const Curve_3&, const FT&)> Normal;
  return normal ? boundary_normals<Target, Normal>(target, normal) : Boundary_normals<Target>();
}

// Makes the surface tangent to the faces beyond its boundary.
//
// With n the normal of the face and D the derivative of the surface inwards, this means n . D = 0
// along the boundary, which is linear in the control points of the second row, as those of the
// first row belong to the boundary curves. The second row is moved as little as possible such that
// the equation holds at as many places as it has control points: then it holds everywhere where n
// is constant, and up to the fourth power of the length of the patches where it turns. Where
// patches of different sizes meet, the equations at all samples, in the sense of least squares, are
// better: they follow. Then the second row is fixed, and the fit determines the rest.
//
// At a corner both curves determine the tangent plane. Where it is not that of the face, no smooth
// surface is tangent to the face; the equations begin behind the first patch then.
template <typename Surface, typename Target>
class Boundary_tangency
{
  typedef std::size_t size_type;
  typedef typename Target::FT FT;
  typedef typename Surface::Point_3 Point_3;
  typedef Eigen::SparseMatrix<double> Matrix;

public:
  Boundary_tangency(Surface& surface, const Target& target,
                    const Boundary_normals<Target>& normals)
    : m_surface(surface), m_target(target), m_normals(normals)
  {
    find_chains_at_corners();
  }

  // moves the control points, and marks them in `is_fixed`; fails if the system is singular
  bool operator()(std::vector<bool>& is_fixed)
  {
    std::vector<Equation> samples, chosen;
    std::vector<size_type> control_points;
    choose_equations(is_fixed, samples, chosen, control_points);
    if(chosen.empty())
      return true;
    if(!interpolate(chosen, control_points) || !approximate(samples, control_points))
      return false;
    for(size_type i : control_points)
      is_fixed[i] = true;
    return true;
  }

  // Measures the angles between the normals of the surface and the faces: returns the largest, in
  // degrees. Where it is noticeable, all patches along the chain are to be halved: the
  // approximation is good only if their lengths are regular.
  double measure(std::vector<typename Surface::Patch_split>& splits) const
  {
    double result = 0;
    splits.clear();
    for(size_type c = 0; c < m_target.number_of_chains(); ++c)
    {
      double largest = 0;
      std::vector<typename Surface::Patch_split> halves;
      for_each_sample(c, [&](const Sample& s)
      {
        const Eigen::Vector3d n = normal(s);
        largest = (std::max)(largest,
                             std::atan2(n.cross(s.normal).norm(), std::abs(n.dot(s.normal))));
        if(halves.empty() || halves.back().patch != s.patch)
          halves.push_back({s.patch, s.inwards[0] == 0, s.inwards[1] == 0});
      });
      if(largest > smallest_noticeable_angle)
        splits.insert(splits.end(), halves.begin(), halves.end());
      result = (std::max)(result, largest);
    }
    return result * 180 / CGAL_PI;
  }

  // returns the number of ends of chains where the surface cannot be tangent to the face
  size_type number_of_conflicts() const
  {
    size_type result = 0;
    for(size_type c = 0; c < m_target.number_of_chains(); ++c)
      for(bool at_end : {false, true})
        result += is_conflict(c, at_end) ? 1 : 0;
    return result;
  }

private:
  static constexpr int samples_per_patch = 24;

  // in radians
  static constexpr double smallest_noticeable_angle = 5e-7;

  // Sine of the angle between a face and the tangent of the other curve at a corner up to which
  // both count as compatible: curves are known to some parts in a million.
  static constexpr double largest_sine_at_corner = 1e-4;

  // A control point gets an equation where its share of the derivative is that large at least: that
  // of a cubic B-spline with equal intervals is two thirds.
  static constexpr double smallest_share = 1. / 3;

  // keeps equations apart that coincide but for rounding
  static constexpr double relative_regularization = 1e-13;
  static constexpr int number_of_interpolations = 2;

  // In units of the mean square of the residuals: each time, derivatives shrink by one part in so
  // many for the sake of residuals that cannot vanish.
  static constexpr double weight_of_movement = 100;
  static constexpr int number_of_approximations = 4;

  struct Sample
  {
    size_type patch;
    std::array<FT, 2> place;  // in the quad
    std::array<double, 2> inwards; // direction in the quad
    Eigen::Vector3d normal;   // of the face
  };

  struct Equation
  {
    Eigen::Vector3d normal; // divided by the speed inwards: residuals are sines of angles
    std::vector<std::pair<size_type, double> > terms;
  };

  template <typename Function>
  void for_each_sample(size_type chain, const Function& f) const
  {
    const auto sides = m_target.layout().chain_sides(chain);
    const bool skips_first = is_conflict(chain, false), skips_last = is_conflict(chain, true);
    for(size_type k = 0; k < sides.size(); ++k)
      for(double begin = 0, end; begin < 1; begin = end)
      {
        end = end_of_patch(sides[k], begin);
        if((skips_first && k == 0 && begin == 0)
           || (skips_last && k + 1 == sides.size() && end == 1))
          continue;
        for(int i = 0; i <= samples_per_patch; ++i)
        {
          const double t = begin + i * (end - begin) / samples_per_patch;
          Sample s = sample(sides[k], t, (begin + end) / 2);
          s.normal = m_normals(chain, double(k) + t,
                               m_surface.position(s.patch, s.place[0], s.place[1]));
          if(s.normal.squaredNorm() > 0)
            f(s);
        }
      }
  }

  // the parameter along a side of a quad at which the patch ends that begins at `begin`
  double end_of_patch(const std::pair<size_type, int>& side, double begin) const
  {
    constexpr double smallest_patch = 1. / (1 << 20);
    const auto uv = from_side<FT>(side.second, FT(begin + smallest_patch / 2), FT(0));
    const auto o = m_surface.patch_origin(m_surface.patch_at(side.first, uv[0], uv[1]));
    return CGAL::to_double((std::max)(to_side<FT>(side.second, o.u0, o.v0)[0],
                                      to_side<FT>(side.second, o.u1, o.v1)[0]));
  }

  Sample sample(const std::pair<size_type, int>& side, double t, double middle) const
  {
    const auto uv = from_side<FT>(side.second, FT(middle), FT(0));
    Sample s;
    s.patch = m_surface.patch_at(side.first, uv[0], uv[1]);
    s.place = from_side<FT>(side.second, FT(t), FT(0));
    const auto inner = from_side<FT>(side.second, FT(t), FT(1));
    for(size_type axis : {0, 1})
      s.inwards[axis] = CGAL::to_double(inner[axis] - s.place[axis]);
    return s;
  }

  Eigen::Vector3d normal(const Sample& s) const
  {
    const auto derivative = [&](int i, int j)
    { return to_eigen(m_surface.derivative(s.patch, s.place[0], s.place[1], i, j)); };
    return derivative(1, 0).cross(derivative(0, 1));
  }

  Equation equation(const Sample& s) const
  {
    std::vector<typename Surface::Basis_function> functions;
    m_surface.basis(s.patch, s.place[0], s.place[1], 1, functions);
    Equation result;
    Eigen::Vector3d derivative = Eigen::Vector3d::Zero();
    for(const auto& f : functions)
    {
      const double coefficient = s.inwards[0] * f.value[1] + s.inwards[1] * f.value[2];
      if(coefficient == 0)
        continue;
      result.terms.emplace_back(f.control_point, coefficient);
      derivative += coefficient * to_eigen(m_surface.control_point(f.control_point));
    }
    result.normal = s.normal / derivative.norm();
    return result;
  }

  // one for each free control point of the second row: where its share is the largest
  void choose_equations(const std::vector<bool>& is_fixed, std::vector<Equation>& samples,
                        std::vector<Equation>& chosen,
                        std::vector<size_type>& control_points) const
  {
    std::map<size_type, std::pair<double, Equation> > best;
    for(size_type c = 0; c < m_target.number_of_chains(); ++c)
      for_each_sample(c, [&](const Sample& s)
      {
        const Equation e = equation(s);
        samples.push_back(e);
        double sum = 0;
        for(const auto& term : e.terms)
          sum += (std::max)(term.second, 0.);
        for(const auto& term : e.terms)
          if(!is_fixed[term.first] && term.second / sum > best[term.first].first)
            best[term.first] = {term.second / sum, e};
      });
    for(const auto& entry : best)
    {
      control_points.push_back(entry.first);
      if(entry.second.first >= smallest_share)
        chosen.push_back(entry.second.second);
    }
  }

  // the matrix from the coordinates of control points to the residuals of equations
  static Matrix matrix(const std::vector<Equation>& equations,
                       const std::vector<size_type>& control_points)
  {
    std::map<size_type, int> column;
    for(size_type k = 0; k < control_points.size(); ++k)
      column[control_points[k]] = 3 * int(k);
    std::vector<Eigen::Triplet<double> > entries;
    for(size_type row = 0; row < equations.size(); ++row)
      for(const auto& term : equations[row].terms)
        for(int d = 0; column.count(term.first) > 0 && d < 3; ++d)
          entries.emplace_back(int(row), column[term.first] + d,
                               term.second * equations[row].normal[d]);
    Matrix result(Eigen::Index(equations.size()), 3 * Eigen::Index(control_points.size()));
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  // adds to the diagonal of a matrix in proportion to the largest entry there
  static Matrix regularized(Matrix m, double relative_weight)
  {
    const double largest = Eigen::VectorXd(m.diagonal()).maxCoeff();
    Matrix identity(m.rows(), m.rows());
    identity.setIdentity();
    m += relative_weight * largest * identity;
    return m;
  }

  bool move(const std::vector<size_type>& control_points, const Eigen::VectorXd& step)
  {
    if(!step.allFinite())
      return false;
    for(size_type k = 0; k < control_points.size(); ++k)
    {
      const Eigen::Vector3d p = to_eigen(m_surface.control_point(control_points[k]))
                              - step.segment<3>(3 * Eigen::Index(k));
      m_surface.set_control_point(control_points[k], Point_3(FT(p[0]), FT(p[1]), FT(p[2])));
    }
    return true;
  }

  // the solution of the equations that moves the control points least
  bool interpolate(const std::vector<Equation>& equations,
                   const std::vector<size_type>& control_points)
  {
    const Matrix system = matrix(equations, control_points);
    const Eigen::SimplicialLDLT<Matrix> solver(
      regularized(system * system.transpose(), relative_regularization));
    if(solver.info() != Eigen::Success)
      return false;
    for(int i = 0; i < number_of_interpolations; ++i)
    {
      const Eigen::VectorXd multipliers = solver.solve(residual(equations));
      if(!move(control_points, system.transpose() * multipliers))
        return false;
    }
    return true;
  }

  // The least-squares solution. Derivatives that vanish would satisfy all equations: the weight of
  // the movement is chosen such that it is not worth while to shrink them.
  bool approximate(const std::vector<Equation>& equations,
                   const std::vector<size_type>& control_points)
  {
    const Matrix system = matrix(equations, control_points);
    const Matrix products = system.transpose() * system;
    for(int i = 0; i < number_of_approximations; ++i)
    {
      const Eigen::VectorXd r = residual(equations);
      const double mean_square = r.squaredNorm() / double(r.size());
      const Eigen::SimplicialLDLT<Matrix> solver(
        regularized(products, relative_regularization + weight_of_movement * mean_square));
      if(solver.info() != Eigen::Success
         || !move(control_points, solver.solve(system.transpose() * r)))
        return false;
    }
    return true;
  }

  Eigen::VectorXd residual(const std::vector<Equation>& equations) const
  {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(Eigen::Index(equations.size()));
    for(size_type row = 0; row < equations.size(); ++row)
      for(const auto& term : equations[row].terms)
        result[Eigen::Index(row)] += term.second * equations[row].normal.dot(
          to_eigen(m_surface.control_point(term.first)));
    return result;
  }

  void find_chains_at_corners()
  {
    const auto& layout = m_target.layout();
    for(size_type c = 0; c < m_target.number_of_chains(); ++c)
    {
      const auto sides = layout.chain_sides(c);
      m_corners.push_back({{layout.vertex(sides.front().first, sides.front().second),
                            layout.vertex(sides.back().first, sides.back().second + 1)}});
      if(!layout.is_corner(m_corners.back()[0]))
        continue;
      m_chains_of_corner[m_corners.back()[0]][1] = c;
      m_chains_of_corner[m_corners.back()[1]][0] = c;
    }
  }

  // is the tangent plane at an end of a chain another one than that of the face?
  bool is_conflict(size_type chain, bool at_end) const
  {
    const auto corner = m_chains_of_corner.find(m_corners[chain][at_end ? 1 : 0]);
    if(corner == m_chains_of_corner.end())
      return false;
    const size_type other = corner->second[at_end ? 1 : 0]; // the next chain, or the one before
    const auto end = [this](size_type c, bool last)
    { return last ? double(m_target.number_of_sides(c)) : 0.; };
    const Eigen::Vector3d tangent
      = to_eigen(m_target.curve_derivative(other, FT(end(other, !at_end)), 1)).normalized();
    const double x = end(chain, at_end);
    const Eigen::Vector3d normal = m_normals(chain, x, m_target.curve_point(chain, FT(x)));
    return std::abs(normal.dot(tangent)) > largest_sine_at_corner;
  }

  Surface& m_surface;
  const Target& m_target;
  const Boundary_normals<Target>& m_normals;
  std::vector<std::array<size_type, 2> > m_corners; // where a chain begins and ends
  std::map<size_type, std::array<size_type, 2> > m_chains_of_corner; // ending, beginning
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_FITTING_BOUNDARY_TANGENCY_H
