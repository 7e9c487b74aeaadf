#ifndef GRAPH_MESH_H
#define GRAPH_MESH_H

#include <cstddef>
#include <vector>

// the graph of a function over the square [0,size]^2, in cells x cells cells of two triangles
template <typename Mesh, typename Function>
Mesh graph_mesh(double size, int cells, const Function& z)
{
  Mesh mesh;
  std::vector<typename Mesh::Vertex_index> v;
  for(int j = 0; j <= cells; ++j)
    for(int i = 0; i <= cells; ++i)
    {
      const double x = size * i / cells, y = size * j / cells;
      v.push_back(mesh.add_vertex(typename Mesh::Point(x, y, z(x, y))));
    }
  for(int j = 0; j < cells; ++j)
    for(int i = 0; i < cells; ++i)
    {
      const std::size_t k = std::size_t(j * (cells + 1) + i), row = std::size_t(cells + 1);
      mesh.add_face(v[k], v[k + 1], v[k + row + 1]);
      mesh.add_face(v[k], v[k + row + 1], v[k + row]);
    }
  return mesh;
}

#endif // GRAPH_MESH_H
