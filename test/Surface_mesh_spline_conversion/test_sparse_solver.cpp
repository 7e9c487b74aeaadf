// The factorisation of sparse matrices, real and complex, by the residual: random patterns, dense
// ones, blocks without connection, several matrices with one pattern, and indefinite or singular
// matrices. The same for diagonally dominant matrices that are symmetric in their pattern only.

#include <CGAL/Surface_mesh_spline_conversion/internal/Sparse_solver.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/Unpivoted_lu.h>

#include <Eigen/Dense>

#include <cassert>
#include <cmath>
#include <complex>
#include <iostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using CGAL::Surface_mesh_spline_conversion::internal::Sparse_solver;
using CGAL::Surface_mesh_spline_conversion::internal::Supernodal_cholesky;
using CGAL::Surface_mesh_spline_conversion::internal::Unpivoted_lu;

typedef std::complex<double> Complex;
typedef Eigen::SparseMatrix<double> Matrix;
typedef Eigen::SparseMatrix<Complex> Complex_matrix;
typedef std::vector<Eigen::Triplet<double> > Entries;

std::mt19937 generator(1);

double random_number() { return 2. * generator() / double(generator.max()) - 1; }

int random_index(int n) { return static_cast<int>(generator() % unsigned(n)); }

// the lower triangle, with the given numbers on the diagonal
Matrix make_matrix(int n, Entries entries, double diagonal)
{
  for(int i = 0; i < n; ++i)
    entries.emplace_back(i, i, diagonal + random_number());
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Entries random_entries(int n, int count)
{
  Entries entries;
  for(int k = 0; k < count; ++k)
  {
    const int i = random_index(n), j = random_index(n);
    if(i > j)
      entries.emplace_back(i, j, random_number());
  }
  return entries;
}

// the neighbours of a grid of m x m points with two unknowns each
Entries grid_entries(int m)
{
  Entries entries;
  const auto couple = [&entries](int p, int q)
  {
    for(int a = 0; a < 2; ++a)
      for(int b = 0; b < 2; ++b)
        entries.emplace_back(2 * q + a, 2 * p + b, random_number());
  };
  for(int i = 0; i < m; ++i)
    for(int j = 0; j < m; ++j)
    {
      entries.emplace_back(2 * (i * m + j) + 1, 2 * (i * m + j), random_number());
      if(i + 1 < m)
        couple(i * m + j, (i + 1) * m + j);
      if(j + 1 < m)
        couple(i * m + j, i * m + j + 1);
      if(i + 1 < m && j + 1 < m)
        couple(i * m + j, (i + 1) * m + j + 1);
    }
  return entries;
}

template <typename Scalar>
void check_solution(Sparse_solver<Scalar>& solver, const Eigen::SparseMatrix<Scalar>& lower)
{
  typedef Eigen::Matrix<Scalar, Eigen::Dynamic, 1> Vector;
  const Vector b = Vector::Random(lower.rows());
  const bool is_regular = solver.factorize(lower);
  assert(is_regular);
  const Vector x = solver.solve(b);
  assert(x == solver.solve(b));
  const Vector residual = lower.template selfadjointView<Eigen::Lower>() * x - b;
  assert(residual.norm() <= 1e-10 * b.norm());
}

// self-adjoint: each number below the diagonal is turned in the plane
Complex_matrix turned_at_random(const Matrix& lower)
{
  Complex_matrix result = lower.cast<Complex>();
  for(int j = 0; j < result.outerSize(); ++j)
    for(Complex_matrix::InnerIterator entry(result, j); entry; ++entry)
      if(entry.row() > j)
        entry.valueRef() *= std::polar(1., 4 * random_number());
  return result;
}

void test(const std::string& name, int n, const Entries& entries, double diagonal)
{
  Sparse_solver<double> solver;
  Sparse_solver<Complex> complex_solver, sharing_solver;
  for(int k = 0; k < 3; ++k)
  {
    Matrix lower = make_matrix(n, entries, diagonal);
    const Complex_matrix turned = turned_at_random(lower);
    if(k == 0)
    {
      solver.analyze(lower);
      complex_solver.analyze(turned);
      sharing_solver.analyze(turned, solver);
    }
    lower *= k + 1;
    check_solution(solver, lower);
    check_solution(complex_solver, turned);
    check_solution(sharing_solver, turned);
  }
  std::cout << name << ": " << n << " unknowns" << std::endl;
}

// the factorisation for definite matrices refuses, the solver does not
void test_indefinite()
{
  const Matrix lower = make_matrix(200, random_entries(200, 600), -30);
  Supernodal_cholesky<double> cholesky;
  cholesky.analyze(lower);
  assert(!cholesky.factorize(lower));
  Sparse_solver<double> solver;
  solver.analyze(lower);
  check_solution(solver, lower);
}

void test_singular()
{
  Matrix zero = make_matrix(5, Entries(), 1);
  zero *= 0;
  Sparse_solver<double> solver;
  solver.analyze(zero);
  assert(!solver.factorize(zero));
}

// with independent weights on both sides of the diagonal, whose entries are their sums
Matrix weighted_matrix(int n, const Entries& pattern)
{
  Entries entries;
  std::vector<double> sum(n, 1e-6);
  for(const auto& entry : pattern)
    for(const auto& p : {std::make_pair(entry.row(), entry.col()),
                         std::make_pair(entry.col(), entry.row())})
    {
      const double weight = std::exp(5 * random_number());
      sum[p.first] += weight;
      entries.emplace_back(p.first, p.second, -weight);
    }
  for(int i = 0; i < n; ++i)
    entries.emplace_back(i, i, sum[i]);
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void test_unpivoted_lu(int n, const Entries& pattern)
{
  const Matrix matrix = weighted_matrix(n, pattern);
  const Unpivoted_lu lu(matrix);
  assert(lu.is_regular());
  const Eigen::MatrixX2d wanted = Eigen::MatrixX2d::Random(n, 2), b = matrix * wanted;
  const Eigen::MatrixX2d residual = matrix * lu.solve(b) - b;
  assert(residual.norm() <= 1e-12 * b.norm() * n);
}

void test_unpivoted_lu()
{
  test_unpivoted_lu(1, Entries());
  test_unpivoted_lu(40, Entries());
  for(int n : {2, 20, 150, 600})
    test_unpivoted_lu(n, random_entries(n, 4 * n));
  test_unpivoted_lu(60, random_entries(60, 20000));
  test_unpivoted_lu(2 * 20 * 20, grid_entries(20));
  Matrix zero = make_matrix(5, Entries(), 1);
  zero *= 0;
  assert(!Unpivoted_lu(zero).is_regular());
}

} // namespace

int main()
{
  test("one unknown", 1, Entries(), 3);
  test("diagonal", 50, Entries(), 3);
  for(int n : {3, 20, 150, 600})
    test("random", n, random_entries(n, 4 * n), 40);
  test("dense", 60, random_entries(60, 20000), 600);
  test("grid", 2 * 60 * 60, grid_entries(60), 25);
  test_indefinite();
  test_singular();
  test_unpivoted_lu();
  return 0;
}
