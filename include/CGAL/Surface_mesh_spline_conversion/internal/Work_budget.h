// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_WORK_BUDGET_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_WORK_BUDGET_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <limits>
#include <memory>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// A limit of the work for results that could also be less good. Work is counted and not measured by
// a clock: the result does not depend on the speed and the load of the machine. A unit takes about
// a microsecond on one core of 2026. Copies and shares of a budget count together, in one thread.
class Work_budget
{
public:
  // without a limit
  Work_budget() : Work_budget(std::numeric_limits<double>::infinity()) {}

  explicit Work_budget(double limit) : m_spent(std::make_shared<double>(0)), m_limit(limit) {}

  void spend(double work) const { *m_spent += work; }

  double spent() const { return *m_spent; }

  // what is left, negative if too much has been spent
  double rest() const { return m_limit - *m_spent; }

  bool is_used_up() const { return !(rest() > 0); }

  // a part of what is left
  Work_budget share(double part) const
  {
    Work_budget result = *this;
    result.m_limit = *m_spent + part * rest();
    return result;
  }

private:
  std::shared_ptr<double> m_spent;
  double m_limit;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_WORK_BUDGET_H
