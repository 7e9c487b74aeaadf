// Gradient and hessian of the distortion energy against differences of its values, also where
// singular values coincide or vanish; the hessian without its negative eigenvalues.

#include <CGAL/Surface_mesh_spline_conversion/internal/map/Distortion_energy.h>

#include <Eigen/Eigenvalues>

#include <cassert>
#include <iostream>
#include <random>

namespace {

using namespace CGAL::Surface_mesh_spline_conversion::internal;

Eigen::Matrix2d matrix(const Jacobian_gradient& J)
{
  Eigen::Matrix2d M;
  M << J[0], J[1], J[2], J[3];
  return M;
}

Jacobian_gradient gradient(const Distortion_energy& energy, const Jacobian_gradient& J)
{
  Jacobian_gradient g;
  Jacobian_hessian h;
  energy.derivatives(matrix(J), g, h);
  return g;
}

void check_derivatives(const Distortion_energy& energy, const Jacobian_gradient& J)
{
  const double step = 1e-5, accuracy = 1e-6;
  Jacobian_gradient g, difference;
  Jacobian_hessian h, expected;
  energy.derivatives(matrix(J), g, h);
  for(int i = 0; i < 4; ++i)
  {
    const Jacobian_gradient d = step * Jacobian_gradient::Unit(i);
    difference[i] = (energy.value(matrix(J + d)) - energy.value(matrix(J - d))) / (2 * step);
    expected.col(i) = (gradient(energy, J + d) - gradient(energy, J - d)) / (2 * step);
  }
  assert((difference - g).norm() <= accuracy * (1 + g.norm()));
  // without negative eigenvalues
  const Eigen::SelfAdjointEigenSolver<Jacobian_hessian> modes(
    (expected + expected.transpose()) / 2);
  expected = modes.eigenvectors() * modes.eigenvalues().cwiseMax(0).asDiagonal()
             * modes.eigenvectors().transpose();
  assert((expected - h).norm() <= accuracy * (1 + modes.eigenvalues().cwiseAbs().maxCoeff()));
}

} // namespace

int main()
{
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> number(-2, 2);
  int count = 0;
  for(int i = 0; i < 1000; ++i)
  {
    const Jacobian_gradient J(number(generator), number(generator), number(generator),
                              number(generator));
    const double d = matrix(J).determinant();
    if(d > 0.2)
      check_derivatives(Distortion_energy(0), J);
    check_derivatives(Distortion_energy(0.5), J);
    ++count;
  }
  // rotations and mirrored ones, multiples, a diagonal, and half a turn
  for(const Jacobian_gradient& J : {Jacobian_gradient(1, 0, 0, 1), Jacobian_gradient(0, -1, 1, 0),
                                    Jacobian_gradient(-1, 0, 0, -1), Jacobian_gradient(3, 0, 0, 3),
                                    Jacobian_gradient(2, 0, 0, 0.5),
                                    Jacobian_gradient(-2, 0, 0, -1)})
  {
    check_derivatives(Distortion_energy(0), J);
    ++count;
  }
  for(const Jacobian_gradient& J : {Jacobian_gradient(1, 0, 0, -1), Jacobian_gradient(0, 1, 1, 0),
                                    Jacobian_gradient(1, 2, 2, 4), Jacobian_gradient(0, 0, 0, 0)})
  {
    check_derivatives(Distortion_energy(0.5), J);
    ++count;
  }
  std::cout << count << " Jacobians" << std::endl;
  return 0;
}
