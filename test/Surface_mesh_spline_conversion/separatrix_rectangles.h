// The coarsest T-mesh of the separatrices of a quad layout, as a measure for numbers of faces.
#ifndef SEPARATRIX_RECTANGLES_H
#define SEPARATRIX_RECTANGLES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

// Traces lines along the edges of the quads from all extraordinary points inside, in all
// directions, and from given corners of quads along the side that begins there; all lines advance
// at the same speed and stop where they meet one that is there already, or the boundary.
class Separatrix_rectangles
{
  typedef std::pair<std::size_t, int> Side; // quad and side; also its first corner

public:
  typedef std::vector<std::array<Side, 4> > Neighbors; // by quad and side; `no_quad` at the boundary

  Separatrix_rectangles(const Neighbors& neighbors, std::size_t no_quad,
                        const std::vector<Side>& corners)
    : m_neighbors(neighbors), m_no_quad(no_quad), m_vertex(4 * neighbors.size())
  {
    std::iota(m_vertex.begin(), m_vertex.end(), std::size_t(0));
    for(std::size_t q = 0; q < m_neighbors.size(); ++q)
      for(int i = 0; i < 4; ++i)
        if(m_neighbors[q][i].first != m_no_quad)
        {
          const Side other = m_neighbors[q][i];
          join(4 * q + i, 4 * other.first + (other.second + 1) % 4);
          join(4 * q + (i + 1) % 4, 4 * other.first + other.second);
        }
    trace(starts(corners));
  }

  std::size_t number_of_rectangles() const
  {
    std::vector<char> is_done(m_neighbors.size(), false);
    std::size_t result = 0;
    for(std::size_t start = 0; start < m_neighbors.size(); ++start)
    {
      if(is_done[start])
        continue;
      ++result;
      std::vector<std::size_t> stack(1, start);
      is_done[start] = true;
      while(!stack.empty())
      {
        const std::size_t q = stack.back();
        stack.pop_back();
        for(int i = 0; i < 4; ++i)
        {
          const std::size_t other = m_neighbors[q][i].first;
          if(other == m_no_quad || is_done[other] || m_edges.count(edge(Side(q, i))))
            continue;
          is_done[other] = true;
          stack.push_back(other);
        }
      }
    }
    return result;
  }

private:
  std::size_t find(std::size_t v) const
  {
    while(m_vertex[v] != v)
      v = m_vertex[v];
    return v;
  }

  void join(std::size_t a, std::size_t b)
  {
    a = find(a);
    b = find(b);
    m_vertex[(std::max)(a, b)] = (std::min)(a, b);
  }

  std::size_t vertex(const Side& side) const { return find(4 * side.first + (side.second & 3)); }

  Side edge(const Side& side) const
  {
    const Side other = m_neighbors[side.first][side.second];
    return other.first == m_no_quad ? side : (std::min)(side, other);
  }

  std::vector<Side> starts(const std::vector<Side>& corners) const
  {
    std::vector<int> valence(m_vertex.size(), 0);
    std::vector<char> is_boundary(m_vertex.size(), false);
    for(std::size_t q = 0; q < m_neighbors.size(); ++q)
      for(int i = 0; i < 4; ++i)
      {
        ++valence[vertex(Side(q, i))];
        if(m_neighbors[q][i].first == m_no_quad)
          is_boundary[vertex(Side(q, i))] = is_boundary[vertex(Side(q, i + 1))] = true;
      }
    std::vector<Side> result = corners;
    for(std::size_t q = 0; q < m_neighbors.size(); ++q)
      for(int i = 0; i < 4; ++i)
        if(!is_boundary[vertex(Side(q, i))] && valence[vertex(Side(q, i))] != 4)
          result.push_back(Side(q, i));
    return result;
  }

  void trace(std::vector<Side> lines)
  {
    std::set<std::size_t> visited;
    for(const Side& line : lines)
      visited.insert(vertex(line));
    while(!lines.empty())
    {
      std::vector<Side> next;
      for(const Side& line : lines)
      {
        m_edges.insert(edge(line));
        const Side across = m_neighbors[line.first][(line.second + 1) & 3];
        if(visited.insert(vertex(Side(line.first, line.second + 1))).second
           && across.first != m_no_quad)
          next.push_back(Side(across.first, (across.second + 1) & 3));
      }
      lines.swap(next);
    }
  }

  Neighbors m_neighbors;
  std::size_t m_no_quad;
  std::vector<std::size_t> m_vertex; // union-find over the corners of quads
  std::set<Side> m_edges;
};

#endif // SEPARATRIX_RECTANGLES_H
