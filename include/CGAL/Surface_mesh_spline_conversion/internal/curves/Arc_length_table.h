// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_ARC_LENGTH_TABLE_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_ARC_LENGTH_TABLE_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {
namespace internal {

// The points and weights of Gauss-Legendre quadrature on [-1,1] that are not mirror images.
template <typename FT>
struct Gauss_legendre_rule
{
  static constexpr int number_of_points = 15;
  static constexpr int number_of_pairs = 7;

  static constexpr FT positive_point[number_of_pairs]
    = {FT(0.20119409399743452230), FT(0.39415134707756336990), FT(0.57097217260853884754),
       FT(0.72441773136017004742), FT(0.84820658341042721620), FT(0.93727339240070590431),
       FT(0.98799251802048542849)};
  static constexpr FT pair_weight[number_of_pairs]
    = {FT(0.19843148532711157646), FT(0.18616100001556221103), FT(0.16626920581699393355),
       FT(0.13957067792615431445), FT(0.10715922046717193501), FT(0.07036604748810812471),
       FT(0.03075324199611726835)};
  static constexpr FT middle_weight = FT(0.20257824192556127288);

  // calls f(point, weight) for all points.
  template <typename Function>
  static void for_each_point(const Function& f)
  {
    f(FT(0), middle_weight);
    for(int i = 0; i < number_of_pairs; ++i)
    {
      f(-positive_point[i], pair_weight[i]);
      f(positive_point[i], pair_weight[i]);
    }
  }
};

// Calls f(k, P_k(x), integral of P_k from -1 to x) for the Legendre polynomials P_k, k < last <= n.
template <int n, typename FT>
class Legendre_polynomials
{
public:
  template <typename Function>
  static void for_each(const FT& x, int last, const Function& f)
  {
    FT previous(-1), current(1); // P_{-1} = -1 makes the formula of the integral fit P_0, too
    for(int k = 0; k < last; ++k)
    {
      const FT next = factors[k].of_x * x * current - factors[k].of_previous * previous;
      f(k, current, factors[k].of_integral * (next - previous));
      previous = current;
      current = next;
    }
  }

private:
  // of the recurrence (k+1) P_{k+1} = (2k+1) x P_k - k P_{k-1} and the integral
  // (P_{k+1} - P_{k-1}) / (2k+1)
  struct Factors
  {
    FT of_x, of_previous, of_integral;
  };

  static constexpr std::array<Factors, n> make_factors()
  {
    std::array<Factors, n> result{};
    for(int k = 0; k < n; ++k)
      result[k] = Factors{FT(2 * k + 1) / FT(k + 1), FT(k) / FT(k + 1), FT(1) / FT(2 * k + 1)};
    return result;
  }

  static constexpr std::array<Factors, n> factors = make_factors();
};

// The arc length along a sequence of curve segments and its inverse.
//
// The segments are bisected until the speed |C'| is, to rounding, a polynomial on every piece. The
// table keeps these polynomials (in Legendre form, from a Gauss quadrature), so that arc length and
// inverse cost no evaluation of a curve and are inverse to each other. A knot at which the speed is
// not smooth only makes the pieces shorter next to it.
template <typename FT>
class Arc_length_table
{
public:
  typedef std::size_t size_type;

  struct Position
  {
    size_type edge;
    FT parameter;
  };

  // appends the segment of a curve with parameters from first to second, whose speed at t is
  // speed(t). Returns false if the speed is not finite or vanishes everywhere.
  template <typename Speed>
  bool append_edge(const Speed& speed, const FT& first, const FT& second)
  {
    const size_type number_of_old_pieces = m_pieces.size();
    const Piece whole = make_piece(speed, first, second);
    // Each piece may contribute this much to the error of the segment: some hundred roundings.
    const FT relative_tolerance(1e-13);
    const FT tolerance = relative_tolerance * whole.length;
    if(!std::isfinite(whole.length) || !(whole.length > FT(0))
       || !refine(speed, whole, tolerance, number_of_old_pieces, 0))
    {
      m_pieces.resize(number_of_old_pieces);
      return false;
    }
    FT begin = length();
    for(size_type i = number_of_old_pieces; i < m_pieces.size(); ++i)
    {
      m_pieces[i].begin = begin;
      m_pieces[i].edge = number_of_edges();
      begin += m_pieces[i].length;
    }
    m_edge_begin.push_back(begin);
    m_first_piece.push_back(m_pieces.size());
    return true;
  }

  size_type number_of_edges() const { return m_edge_begin.size() - 1; }

  FT length() const { return m_edge_begin.back(); }

  // returns the arc length at the begin of `edge`, or the whole length for the number of edges.
  FT arc_length(size_type edge) const { return m_edge_begin[edge]; }

  // returns the arc length at the parameter t of `edge`.
  FT arc_length(size_type edge, const FT& t) const
  {
    const auto first = m_pieces.begin() + static_cast<std::ptrdiff_t>(m_first_piece[edge]);
    const auto last = m_pieces.begin() + static_cast<std::ptrdiff_t>(m_first_piece[edge + 1]);
    const bool is_ascending = first->first < first->second;
    auto piece = std::upper_bound(first, last, t, [&](const FT& value, const Piece& p)
      { return is_ascending ? value < p.first : value > p.first; });
    if(piece != first)
      --piece;
    const FT x = FT(2) * (t - piece->first) / (piece->second - piece->first) - FT(1);
    const FT x_inside = (std::max)(FT(-1), (std::min)(FT(1), x));
    return piece->begin + length_and_speed(*piece, x_inside).first;
  }

  // returns the place at the arc length s, which is clamped to [0, length()]. At the begin of an
  // edge it is exactly the first parameter of that edge.
  Position locate(const FT& s) const
  {
    CGAL_precondition(!m_pieces.empty());
    auto piece = std::upper_bound(m_pieces.begin(), m_pieces.end(), s,
                                  [](const FT& value, const Piece& p) { return value < p.begin; });
    if(piece != m_pieces.begin())
      --piece;
    const FT x = inverse(*piece, s - piece->begin);
    // measured from the nearer end, so that the ends are met exactly
    const FT half_width = (piece->second - piece->first) / FT(2);
    const FT t = (x < FT(0)) ? piece->first + (x + FT(1)) * half_width
                             : piece->second - (FT(1) - x) * half_width;
    return Position{piece->edge, t};
  }

private:
  typedef Gauss_legendre_rule<FT> Rule;
  static constexpr int number_of_coefficients = Rule::number_of_points;
  typedef Legendre_polynomials<number_of_coefficients, FT> Polynomials;

  // Bisection stops at this depth (a kink of the speed is then located to rounding) or when an edge
  // has that many pieces (the speed is noise).
  static constexpr int maximum_depth = 48;
  static constexpr size_type maximum_number_of_pieces = 1000;

  struct Piece
  {
    FT begin;         // arc length where the piece begins
    FT length;
    FT first, second; // parameters at the ends
    size_type edge;
    std::array<FT, number_of_coefficients> speed; // ds/dx in Legendre form, x in [-1,1]
    int number_of_terms;                          // those after them are rounding only
  };

  template <typename Speed>
  static Piece make_piece(const Speed& speed, const FT& first, const FT& second)
  {
    Piece piece;
    piece.begin = FT(0);
    piece.edge = 0;
    piece.first = first;
    piece.second = second;
    piece.speed.fill(FT(0));
    const FT middle = (first + second) / FT(2), half_width = (second - first) / FT(2);
    Rule::for_each_point([&](const FT& x, const FT& weight)
    {
      const FT value = std::abs(half_width) * speed(middle + x * half_width);
      Polynomials::for_each(x, number_of_coefficients, [&](int k, const FT& p, const FT&)
        { piece.speed[k] += FT(2 * k + 1) / FT(2) * weight * value * p; });
    });
    piece.length = FT(2) * piece.speed[0];
    const FT relative_rounding(1e-14); // of a coefficient
    piece.number_of_terms = number_of_coefficients;
    while(piece.number_of_terms > 1
          && std::abs(piece.speed[piece.number_of_terms - 1]) <= relative_rounding * piece.speed[0])
      --piece.number_of_terms;
    return piece;
  }

  // stores the piece if it is accurate, else its halves.
  template <typename Speed>
  bool refine(const Speed& speed, const Piece& piece, const FT& tolerance,
              size_type first_piece_of_edge, int depth)
  {
    const FT middle = (piece.first + piece.second) / FT(2);
    const Piece left = make_piece(speed, piece.first, middle);
    const Piece right = make_piece(speed, middle, piece.second);
    if(!std::isfinite(left.length) || !std::isfinite(right.length))
      return false;
    const FT difference = std::abs(piece.length - left.length - right.length);
    const bool is_accurate = truncation(piece) <= tolerance && difference <= tolerance;
    if(is_accurate || depth == maximum_depth
       || m_pieces.size() - first_piece_of_edge >= maximum_number_of_pieces)
    {
      m_pieces.push_back(piece);
      return true;
    }
    return refine(speed, left, tolerance, first_piece_of_edge, depth + 1)
           && refine(speed, right, tolerance, first_piece_of_edge, depth + 1);
  }

  // estimates what the speed polynomial leaves out by its highest coefficients; three, because
  // those of one parity may vanish by symmetry.
  static FT truncation(const Piece& piece)
  {
    FT sum(0);
    for(int k = number_of_coefficients - 3; k < number_of_coefficients; ++k)
      sum += std::abs(piece.speed[k]);
    return sum / FT(number_of_coefficients);
  }

  // returns the arc length from the begin of the piece to x, and its derivative.
  static std::pair<FT, FT> length_and_speed(const Piece& piece, const FT& x)
  {
    std::pair<FT, FT> result(FT(0), FT(0));
    Polynomials::for_each(x, piece.number_of_terms, [&](int k, const FT& p, const FT& integral)
    {
      result.first += piece.speed[k] * integral;
      result.second += piece.speed[k] * p;
    });
    return result;
  }

  // solves "arc length from the begin of the piece to x" = s by Newton's method; a step that leaves
  // the bracket is replaced by a bisection.
  static FT inverse(const Piece& piece, const FT& s)
  {
    if(!(s > FT(0)))
      return FT(-1);
    if(!(s < piece.length))
      return FT(1);
    const int maximum_number_of_steps = 100;
    const FT small_step(1e-9); // the error after a Newton step is about its square
    FT low(-1), high(1), x = FT(2) * s / piece.length - FT(1);
    for(int i = 0; i < maximum_number_of_steps; ++i)
    {
      const std::pair<FT, FT> value = length_and_speed(piece, x);
      (value.first < s ? low : high) = x;
      const FT next = x - (value.first - s) / value.second;
      if(low <= next && next <= high)
      {
        const FT step = std::abs(next - x);
        x = next;
        if(step <= small_step)
          break;
      }
      else
        x = (low + high) / FT(2);
    }
    return x;
  }

  std::vector<Piece> m_pieces;
  std::vector<FT> m_edge_begin = {FT(0)};
  std::vector<size_type> m_first_piece = {0};
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_INTERNAL_CURVES_ARC_LENGTH_TABLE_H
