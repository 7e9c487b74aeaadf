// Bicubic splines on the unit square: uniform ones, and truncated hierarchical ones (Giannelli,
// Juettler, Speleers 2012). A plain reference that is written for comparison, not for speed.
#ifndef QUALITY_HIERARCHICAL_SPLINES_H
#define QUALITY_HIERARCHICAL_SPLINES_H

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Hierarchical {

typedef Eigen::SparseMatrix<double, Eigen::RowMajor> Matrix;
typedef Eigen::Triplet<double> Triplet;

// samples on a grid of m by m points of the unit square, row by row
struct Samples
{
  Samples(int m, Eigen::VectorXd z) : size(m), values(std::move(z)) {}

  double coordinate(int i) const { return double(i) / (size - 1); }

  int size;
  Eigen::VectorXd values;
};

// The cubic B-splines on [0,1] with n equal spans and fourfold knots at the ends: n + 3 functions.
class Uniform_basis
{
public:
  explicit Uniform_basis(int n) : m_n(n) {}

  int number_of_spans() const { return m_n; }
  int size() const { return m_n + 3; }

  int span(double x) const { return (std::min)(int(x * m_n), m_n - 1); }

  // the values at x of the functions span, ..., span + 3
  std::array<double, 4> values(int span, double x) const
  {
    std::array<double, 4> n = {{1, 0, 0, 0}};
    for(int degree = 1; degree <= 3; ++degree)
    {
      double saved = 0;
      for(int r = 0; r < degree; ++r)
      {
        const double right = knot(span + 4 + r), left = knot(span + 4 + r - degree);
        const double term = n[r] / (right - left);
        n[r] = saved + (right - x) * term;
        saved = (x - left) * term;
      }
      n[degree] = saved;
    }
    return n;
  }

  // the functions in terms of those with twice as many spans: entry (fine, coarse), by blossoms
  Matrix refinement() const
  {
    const Uniform_basis fine(2 * m_n);
    std::vector<Triplet> entries;
    for(int j = 0; j < fine.size(); ++j)
    {
      const double a[3] = {fine.knot(j + 1), fine.knot(j + 2), fine.knot(j + 3)};
      const int s = span((a[0] + a[2]) / 2); // a span that contains all three, up to its ends
      for(int i = 0; i < 4; ++i)
      {
        const double value = blossom(s, i, a);
        if(value != 0)
          entries.emplace_back(j, s + i, value);
      }
    }
    Matrix result(fine.size(), size());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

private:
  // knots 0 to n + 6; knot 3 is 0, knot n + 3 is 1
  double knot(int i) const { return double((std::max)(0, (std::min)(m_n, i - 3))) / m_n; }

  // the blossom at `a` of the polynomial of function `s + i` on span `s`
  double blossom(int s, int i, const double* a) const
  {
    std::array<double, 4> c = {{0, 0, 0, 0}};
    c[i] = 1;
    for(int level = 1; level <= 3; ++level)
      for(int k = 3; k >= level; --k)
      {
        const double left = knot(s + k), right = knot(s + k + 4 - level);
        const double t = (a[level - 1] - left) / (right - left);
        c[k] = (1 - t) * c[k - 1] + t * c[k];
      }
    return c[3];
  }

  int m_n;
};

// the error of the least-squares fit of uniform splines with n by n spans
inline double error_of_uniform_splines(const Samples& samples, int n)
{
  const Uniform_basis basis(n);
  std::vector<Triplet> entries;
  for(int i = 0; i < samples.size; ++i)
  {
    const double x = samples.coordinate(i);
    const int span = basis.span(x);
    const std::array<double, 4> values = basis.values(span, x);
    for(int k = 0; k < 4; ++k)
      entries.emplace_back(i, span + k, values[k]);
  }
  Matrix b(samples.size, basis.size());
  b.setFromTriplets(entries.begin(), entries.end());
  const Eigen::MatrixXd dense(b);
  const auto solver = (dense.transpose() * dense).eval().ldlt();
  const Eigen::Map<const Eigen::MatrixXd> z(samples.values.data(), samples.size, samples.size);
  const Eigen::MatrixXd half = solver.solve(dense.transpose() * z);
  const Eigen::MatrixXd c = solver.solve((half * dense).transpose());
  return (dense * c.transpose() * dense.transpose() - z).cwiseAbs().maxCoeff();
}

// The mesh of cells of a hierarchy: level l has n 2^l by n 2^l cells, of which some are refined.
class Cells
{
public:
  explicit Cells(int n) : m_n(n) { m_is_refined.push_back(grid(0)); }

  int number_of_levels() const { return int(m_is_refined.size()); }
  int size(int level) const { return m_n << level; }

  // is the cell part of the domain of level + 1?
  bool is_refined(int level, int i, int j) const
  {
    return m_is_refined[std::size_t(level)][std::size_t(j) * std::size_t(size(level))
                                            + std::size_t(i)] != 0;
  }

  // is the cell part of the domain of its level?
  bool is_in_domain(int level, int i, int j) const
  {
    return level == 0 || is_refined(level - 1, i / 2, j / 2);
  }

  bool is_leaf(int level, int i, int j) const
  {
    return is_in_domain(level, i, j) && !is_refined(level, i, j);
  }

  // refines a cell, and before it the coarser ones that contain it
  void refine(int level, int i, int j)
  {
    if(i < 0 || j < 0 || i >= size(level) || j >= size(level) || is_refined(level, i, j))
      return;
    if(!is_in_domain(level, i, j))
      refine(level - 1, i / 2, j / 2);
    m_is_refined[std::size_t(level)][std::size_t(j) * std::size_t(size(level)) + std::size_t(i)]
      = 1;
    if(level + 1 == number_of_levels())
      m_is_refined.push_back(grid(level + 1));
  }

private:
  std::vector<char> grid(int level) const
  {
    return std::vector<char>(std::size_t(size(level)) * std::size_t(size(level)), 0);
  }

  int m_n;
  std::vector<std::vector<char> > m_is_refined;
};

// The truncated hierarchical B-splines on cells, as combinations of the B-splines of each level.
class Basis
{
public:
  explicit Basis(const Cells& cells) : m_cells(cells)
  {
    for(int level = 0; level < cells.number_of_levels(); ++level)
      add_level(level);
  }

  std::size_t size() const { return m_size; }

  // calls `visit(cell)` for each leaf that contains samples
  template <typename Visitor>
  void for_each_cell(const Samples& samples, const Visitor& visit) const
  {
    for(int level = 0; level < m_cells.number_of_levels(); ++level)
      for(int j = 0; j < m_cells.size(level); ++j)
        for(int i = 0; i < m_cells.size(level); ++i)
          if(m_cells.is_leaf(level, i, j))
          {
            const Cell cell = make_cell(samples, level, i, j);
            if(cell.u.rows() > 0 && cell.v.rows() > 0)
              visit(cell);
          }
  }

  // A leaf with the samples inside. The values of the 16 B-splines of its level at sample (a,b) are
  // u(a,k) v(b,l), and function `functions[f]` is their combination with column f of
  // `coefficients`.
  struct Cell
  {
    int level, i, j;
    int first_sample[2];
    Eigen::MatrixXd u, v;             // a row per sample
    std::vector<int> functions;
    Eigen::MatrixXd coefficients;     // row 4 l + k

    // the combination of the B-splines, entry (k,l), for the coefficients of all functions
    Eigen::Matrix4d local(const Eigen::VectorXd& x) const
    {
      Eigen::VectorXd y(functions.size());
      for(std::size_t f = 0; f < functions.size(); ++f)
        y[Eigen::Index(f)] = x[functions[f]];
      const Eigen::VectorXd c = coefficients * y;
      return Eigen::Map<const Eigen::Matrix4d>(c.data());
    }

    // the samples of the cell, entry (a,b)
    Eigen::MatrixXd heights(const Samples& samples) const
    {
      Eigen::MatrixXd result(u.rows(), v.rows());
      for(Eigen::Index b = 0; b < v.rows(); ++b)
        for(Eigen::Index a = 0; a < u.rows(); ++a)
          result(a, b) = samples.values[(first_sample[1] + b) * samples.size + first_sample[0] + a];
      return result;
    }
  };

private:
  // truncates the functions of the coarser levels, and adds those of this level whose support lies
  // in the domain of the level, but not in that of the next
  void add_level(int level)
  {
    const Uniform_basis basis(m_cells.size(level));
    const int n = basis.size();
    std::vector<Triplet> entries;
    if(level > 0)
    {
      const Matrix coarse = refined(level - 1);
      for(int k = 0; k < coarse.outerSize(); ++k)
        if(!is_supported(level, k % n, k / n, true))
          for(Matrix::InnerIterator it(coarse, k); it; ++it)
            entries.emplace_back(k, it.col(), it.value());
    }
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < n; ++i)
        if(is_supported(level, i, j, true) && !is_supported(level, i, j, false))
          entries.emplace_back(j * n + i, int(m_size++), 1.);
    m_coefficients.emplace_back(n * n, 0);
    m_entries.push_back(std::move(entries));
    rebuild();
  }

  // is the support of function (i,j) in the domain of its level, or else of the next one?
  bool is_supported(int level, int i, int j, bool in_own_domain) const
  {
    const int last = m_cells.size(level) - 1;
    for(int b = (std::max)(0, j - 3); b <= (std::min)(last, j); ++b)
      for(int a = (std::max)(0, i - 3); a <= (std::min)(last, i); ++a)
        if(!(in_own_domain ? m_cells.is_in_domain(level, a, b) : m_cells.is_refined(level, a, b)))
          return false;
    return true;
  }

  // the functions so far in terms of the B-splines of the next level
  Matrix refined(int level) const
  {
    const Matrix r = Uniform_basis(m_cells.size(level)).refinement();
    const int n = int(r.cols()), m = int(r.rows());
    std::vector<Triplet> entries;
    for(int j = 0; j < m; ++j)
      for(Matrix::InnerIterator b(r, j); b; ++b)
        for(int i = 0; i < m; ++i)
          for(Matrix::InnerIterator a(r, i); a; ++a)
            entries.emplace_back(j * m + i, int(b.col()) * n + int(a.col()),
                                 a.value() * b.value());
    Matrix product(m * m, n * n);
    product.setFromTriplets(entries.begin(), entries.end());
    return product * m_coefficients[std::size_t(level)];
  }

  // all matrices have a column per function
  void rebuild()
  {
    for(std::size_t level = 0; level < m_coefficients.size(); ++level)
    {
      Matrix matrix(m_coefficients[level].rows(), Eigen::Index(m_size));
      matrix.setFromTriplets(m_entries[level].begin(), m_entries[level].end());
      m_coefficients[level].swap(matrix);
    }
  }

  // the samples x with index / n <= x < (index + 1) / n, or to the end for the last cell
  static Eigen::MatrixXd values_at_samples(const Samples& samples, const Uniform_basis& basis,
                                           int index, int& first)
  {
    const int n = basis.number_of_spans(), intervals = samples.size - 1;
    first = (index * intervals + n - 1) / n;
    const int last = index + 1 == n ? samples.size : ((index + 1) * intervals + n - 1) / n;
    Eigen::MatrixXd result((std::max)(0, last - first), 4);
    for(int i = first; i < last; ++i)
    {
      const std::array<double, 4> values = basis.values(index, samples.coordinate(i));
      for(int k = 0; k < 4; ++k)
        result(i - first, k) = values[std::size_t(k)];
    }
    return result;
  }

  Cell make_cell(const Samples& samples, int level, int i, int j) const
  {
    const Uniform_basis basis(m_cells.size(level));
    const Matrix& coefficients = m_coefficients[std::size_t(level)];
    Cell cell;
    cell.level = level;
    cell.i = i;
    cell.j = j;
    cell.u = values_at_samples(samples, basis, i, cell.first_sample[0]);
    cell.v = values_at_samples(samples, basis, j, cell.first_sample[1]);
    for(int l = 0; l < 4; ++l)
      for(int k = 0; k < 4; ++k)
        for(Matrix::InnerIterator it(coefficients, (j + l) * basis.size() + i + k); it; ++it)
          cell.functions.push_back(int(it.col()));
    std::sort(cell.functions.begin(), cell.functions.end());
    cell.functions.erase(std::unique(cell.functions.begin(), cell.functions.end()),
                         cell.functions.end());
    cell.coefficients = Eigen::MatrixXd::Zero(16, Eigen::Index(cell.functions.size()));
    for(int l = 0; l < 4; ++l)
      for(int k = 0; k < 4; ++k)
        for(Matrix::InnerIterator it(coefficients, (j + l) * basis.size() + i + k); it; ++it)
        {
          const auto f = std::lower_bound(cell.functions.begin(), cell.functions.end(),
                                          int(it.col())) - cell.functions.begin();
          cell.coefficients(4 * l + k, f) = it.value();
        }
    return cell;
  }

  const Cells& m_cells;
  std::size_t m_size = 0;
  std::vector<std::vector<Triplet> > m_entries;
  std::vector<Matrix> m_coefficients;
};

// solves for the least-squares fit of the samples
inline Eigen::VectorXd solve(const Basis& basis, const Samples& samples)
{
  std::vector<Triplet> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(Eigen::Index(basis.size()));
  basis.for_each_cell(samples, [&](const Basis::Cell& cell)
  {
    const Eigen::Matrix4d gu = cell.u.transpose() * cell.u, gv = cell.v.transpose() * cell.v;
    Eigen::Matrix<double, 16, 16> gram;
    for(int l = 0; l < 4; ++l)
      for(int m = 0; m < 4; ++m)
        gram.block<4, 4>(4 * l, 4 * m) = gv(l, m) * gu;
    const Eigen::Matrix4d moments = cell.u.transpose() * cell.heights(samples) * cell.v;
    const Eigen::VectorXd b
      = cell.coefficients.transpose()
        * Eigen::Map<const Eigen::Matrix<double, 16, 1> >(moments.data());
    const Eigen::MatrixXd a = cell.coefficients.transpose() * gram * cell.coefficients;
    for(std::size_t f = 0; f < cell.functions.size(); ++f)
    {
      right[cell.functions[f]] += b[Eigen::Index(f)];
      for(std::size_t g = 0; g < cell.functions.size(); ++g)
        entries.emplace_back(cell.functions[f], cell.functions[g],
                             a(Eigen::Index(f), Eigen::Index(g)));
    }
  });
  Matrix normal(right.size(), right.size());
  normal.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(1e-12);
  solver.compute(normal);
  return solver.solve(right);
}

struct Result
{
  std::size_t functions = 0;
  int iterations = 0;
  double error = 0, largest_sum_error = 0;
};

// The cells that are refined because of a cell that misses the tolerance: so many that a function
// of the next level covers the sample with the largest error, or all cells around it.
enum class Marking { QUARTER, RING };

// a cell that misses the tolerance, and the half of it, in both directions, with the largest error
struct Marked_cell
{
  int level, i, j;
  bool is_right, is_upper;
};

inline void refine(const Marked_cell& cell, Marking marking, Cells& cells)
{
  const bool is_ring = marking == Marking::RING;
  for(int b = (is_ring || !cell.is_upper) ? -1 : 0; b <= ((is_ring || cell.is_upper) ? 1 : 0); ++b)
    for(int a = (is_ring || !cell.is_right) ? -1 : 0; a <= ((is_ring || cell.is_right) ? 1 : 0);
        ++a)
      cells.refine(cell.level, cell.i + a, cell.j + b);
}

// Fits the samples and refines the cells that miss the tolerance until it is met, or cells would
// hold less than a sample.
inline Result fit(const Samples& samples, int n, double tolerance, Marking marking)
{
  Cells cells(n);
  Result result;
  for(result.iterations = 1; ; ++result.iterations)
  {
    const Basis basis(cells);
    result.functions = basis.size();
    const Eigen::VectorXd x = solve(basis, samples), ones = Eigen::VectorXd::Ones(x.size());
    std::vector<Marked_cell> marked;
    result.error = 0;
    basis.for_each_cell(samples, [&](const Basis::Cell& cell)
    {
      Eigen::Index a = 0, b = 0;
      const double error = (cell.u * cell.local(x) * cell.v.transpose() - cell.heights(samples))
                             .cwiseAbs().maxCoeff(&a, &b);
      result.error = (std::max)(result.error, error);
      if(error >= tolerance && cells.size(cell.level + 1) < samples.size)
        marked.push_back({cell.level, cell.i, cell.j, 2 * a >= cell.u.rows(),
                          2 * b >= cell.v.rows()});
      result.largest_sum_error
        = (std::max)(result.largest_sum_error,
                     (cell.local(ones) - Eigen::Matrix4d::Ones()).cwiseAbs().maxCoeff());
    });
    if(marked.empty())
      return result;
    for(const Marked_cell& cell : marked)
      refine(cell, marking, cells);
  }
}

} // namespace Hierarchical

#endif // QUALITY_HIERARCHICAL_SPLINES_H
