// B-Reps without their organic part, and shells that replace it, with known volumes.
#ifndef BREP_MODELS_H
#define BREP_MODELS_H

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pln.hxx>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>
#include <vector>

typedef CGAL::Simple_cartesian<double> K;
typedef K::Point_3 Point_3;
typedef CGAL::Surface_mesh_spline_conversion::NURBS_shell_3<K> Shell;

// the face whose center of gravity is highest
inline TopoDS_Face highest_face(const TopoDS_Shape& shape)
{
  TopoDS_Face result;
  double height = -1e30;
  for(TopExp_Explorer x(shape, TopAbs_FACE); x.More(); x.Next())
  {
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(x.Current(), properties);
    if(properties.CentreOfMass().Z() > height)
    {
      height = properties.CentreOfMass().Z();
      result = TopoDS::Face(x.Current());
    }
  }
  return result;
}

// all faces of `shape` with the highest one replaced, or dropped if there is no replacement
inline TopoDS_Shape with_highest_face(const TopoDS_Shape& shape, const TopoDS_Face& replacement)
{
  const TopoDS_Face old = highest_face(shape);
  TopoDS_Compound result;
  BRep_Builder().MakeCompound(result);
  for(TopExp_Explorer x(shape, TopAbs_FACE); x.More(); x.Next())
    if(!x.Current().IsSame(old))
      BRep_Builder().Add(result, x.Current());
  if(!replacement.IsNull())
    BRep_Builder().Add(result, replacement);
  return result;
}

// A box of 100 x 60 x 40 mm whose top face has the window [20,80] x [15,45].
inline TopoDS_Shape box_with_window()
{
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(100, 60, 40).Shape();
  BRepBuilderAPI_MakeWire window;
  const std::array<gp_Pnt, 4> corners
    = {{gp_Pnt(20, 15, 40), gp_Pnt(20, 45, 40), gp_Pnt(80, 45, 40), gp_Pnt(80, 15, 40)}};
  for(std::size_t i = 0; i < 4; ++i)
    window.Add(BRepBuilderAPI_MakeEdge(corners[i], corners[(i + 1) % 4]).Edge());
  BRepBuilderAPI_MakeFace top(gp_Pln(gp_Pnt(0, 0, 40), gp_Dir(0, 0, 1)),
                              BRepTools::OuterWire(highest_face(box)));
  top.Add(window.Wire());
  return with_highest_face(box, top.Face());
}

// A cylinder of radius 20 mm and height 30 mm without its top face; the seam is at the angle 0.
inline TopoDS_Shape open_cylinder()
{
  return with_highest_face(BRepPrimAPI_MakeCylinder(20, 30).Shape(), TopoDS_Face());
}

// The Bezier coefficients of a cubic polynomial on an interval, by blossoming.
inline std::array<double, 4> bezier(const std::array<double, 4>& powers, double first, double last)
{
  std::array<double, 4> result;
  for(int i = 0; i < 4; ++i)
  {
    const double a = (i > 0) ? last : first, b = (i > 1) ? last : first, c = (i > 2) ? last : first;
    result[i] = powers[0] + powers[1] * (a + b + c) / 3 + powers[2] * (a * b + b * c + c * a) / 3
              + powers[3] * a * b * c;
  }
  return result;
}

// Makes a shell of bicubic Bezier patches on a grid. `points(i,j)` gives the control points of
// patch i, j, with u running fastest.
inline Shell grid_shell(std::size_t m, std::size_t n,
                        const std::function<std::vector<Point_3>(std::size_t, std::size_t)>& points)
{
  Shell shell;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> vertices;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> edges; // by their vertices
  const CGAL::Surface_mesh_spline_conversion::Knot_vector<double> knots(3, {0., 1.});
  for(std::size_t j = 0; j < n; ++j)
    for(std::size_t i = 0; i < m; ++i)
    {
      Shell::Face face;
      face.surface.knots[0] = face.surface.knots[1] = knots;
      face.surface.control_points = points(i, j);
      face.patch = j * m + i;
      face.is_extraordinary = false;
      const std::vector<Point_3>& p = face.surface.control_points;
      const std::array<std::array<int, 4>, 4> sides
        = {{{{0, 1, 2, 3}}, {{3, 7, 11, 15}}, {{15, 14, 13, 12}}, {{12, 8, 4, 0}}}};
      const std::array<std::pair<std::size_t, std::size_t>, 4> corners
        = {{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
      for(int side = 0; side < 4; ++side)
        if(!vertices.count(corners[side]))
          vertices[corners[side]] = shell.add_vertex(p[sides[side][0]]);
      for(int side = 0; side < 4; ++side)
      {
        const std::size_t source = vertices[corners[side]];
        const std::size_t target = vertices[corners[(side + 1) % 4]];
        if(edges.count({target, source}))
        {
          face.loop.push_back({edges[{target, source}], false});
          continue;
        }
        Shell::Edge edge;
        edge.source = source;
        edge.target = target;
        edge.curve.knots = knots;
        for(int k : sides[side])
          edge.curve.control_points.push_back(p[k]);
        edges[{source, target}] = shell.add_edge(edge);
        face.loop.push_back({edges[{source, target}], true});
      }
      shell.add_face(face);
    }
  return shell;
}

// A dome of the given height over the window, tangent to the plane at its corners, of m x n
// patches. Its boundary stays in the plane and bulges by up to about `gap` mm.
inline Shell window_dome(std::size_t m, std::size_t n, double height, double gap)
{
  const std::array<double, 4> identity = {{0, 1, 0, 0}};
  const std::array<double, 4> arch = {{0, 1, -1, 0}};          // s (1-s)
  const std::array<double, 4> bulge = {{0, 10, -30, 20}};      // 10 s (1-s) (1-2s)
  return grid_shell(m, n, [=](std::size_t i, std::size_t j)
  {
    const double s0 = double(i) / m, s1 = double(i + 1) / m;
    const double t0 = double(j) / n, t1 = double(j + 1) / n;
    const auto s = bezier(identity, s0, s1), t = bezier(identity, t0, t1);
    const auto arch_s = bezier(arch, s0, s1), arch_t = bezier(arch, t0, t1);
    const auto bulge_s = bezier(bulge, s0, s1), bulge_t = bezier(bulge, t0, t1);
    std::vector<Point_3> result;
    for(int l = 0; l < 4; ++l)
      for(int k = 0; k < 4; ++k)
        result.emplace_back(20 + 60 * s[k] + gap * bulge_t[l], 15 + 30 * t[l] + gap * bulge_s[k],
                            40 + 16 * height * arch_s[k] * arch_t[l]);
    return result;
  });
}

// the volume of the box with its window closed by this dome
inline double window_volume(double height, double gap)
{
  return 240000 + 800 * height - 16 * height * gap * gap / 9;
}

// A patch over the open cylinder whose sides are cubic approximations of quarters of the circle;
// corners are at 45, 135, ... degrees. The largest distance from the circle is 2.73e-4 radii.
inline Shell disk(double height)
{
  const double radius = 20, kappa = 4. / 3 * (std::sqrt(2.) - 1);
  const double c = radius * std::sqrt(0.5);
  // the lower side; the others by turns
  const std::array<Point_3, 4> side
    = {{Point_3(-c, -c, 30), Point_3(-c + kappa * c, -c - kappa * c, 30),
        Point_3(c - kappa * c, -c - kappa * c, 30), Point_3(c, -c, 30)}};
  const auto turned = [](const Point_3& p, int quarters)
  {
    Point_3 q = p;
    for(int i = 0; i < quarters; ++i)
      q = Point_3(-q.y(), q.x(), q.z());
    return q;
  };
  std::vector<Point_3> points(16);
  const std::array<std::array<int, 4>, 4> sides
    = {{{{0, 1, 2, 3}}, {{3, 7, 11, 15}}, {{15, 14, 13, 12}}, {{12, 8, 4, 0}}}};
  for(int i = 0; i < 4; ++i)
    for(int k = 0; k < 4; ++k)
      points[sides[i][k]] = turned(side[k], i);
  for(int i = 0; i < 4; ++i)
    points[std::array<int, 4>{{5, 6, 10, 9}}[i]] = turned(Point_3(-c / 2, -c / 2, 30 + height), i);
  return grid_shell(1, 1, [points](std::size_t, std::size_t) { return points; });
}

// A plane patch over the open cylinder whose sides are C1 cubic splines with a double knot between
// each two of `spans` arcs. Three sides follow the circle; in the first, inner control points are
// moved across the circle by up to `wave` mm.
inline Shell wavy_disk(int spans, double wave)
{
  const double radius = 20, angle = CGAL_PI / 2 / spans;
  const double handle = radius * 4 / 3 * std::tan(angle / 4);
  const int n = 2 * spans + 2;
  const auto boundary = [=](int side, int k)
  {
    const double at = CGAL_PI * (2 * side - 3) / 4 + (k / 2) * angle;
    const double along = (k == 0 || k == n - 1) ? 0 : (k % 2 == 1) ? handle : -handle;
    const bool is_moved = side == 0 && k > 1 && k < n - 2;
    const double r = radius + (is_moved ? wave * std::sin(double(k * k)) : 0);
    return Point_3(r * std::cos(at) - along * std::sin(at),
                   r * std::sin(at) + along * std::cos(at), 30);
  };
  std::vector<double> knots;
  for(int i = 0; i <= spans; ++i)
    knots.push_back(i);
  std::vector<int> multiplicities(spans + 1, 2);
  multiplicities.front() = multiplicities.back() = 4;
  Shell::Face face;
  face.surface.knots[0] = face.surface.knots[1]
    = CGAL::Surface_mesh_spline_conversion::Knot_vector<double>(3, knots, multiplicities);
  // inner control points by transfinite interpolation
  for(int j = 0; j < n; ++j)
    for(int i = 0; i < n; ++i)
    {
      const double s = double(i) / (n - 1), t = double(j) / (n - 1);
      const auto from_origin = [&](int side, int k) { return boundary(side, k) - CGAL::ORIGIN; };
      face.surface.control_points.push_back(
        CGAL::ORIGIN + (1 - t) * from_origin(0, i) + s * from_origin(1, j)
        + t * from_origin(2, n - 1 - i) + (1 - s) * from_origin(3, n - 1 - j)
        - (1 - s) * (1 - t) * from_origin(0, 0) - s * (1 - t) * from_origin(1, 0)
        - s * t * from_origin(2, 0) - (1 - s) * t * from_origin(3, 0));
    }
  Shell shell;
  for(int side = 0; side < 4; ++side)
    shell.add_vertex(boundary(side, 0));
  for(int side = 0; side < 4; ++side)
  {
    Shell::Edge edge;
    edge.source = side;
    edge.target = (side + 1) % 4;
    edge.curve.knots = face.surface.knots[0];
    for(int k = 0; k < n; ++k)
      edge.curve.control_points.push_back(boundary(side, k));
    face.loop.push_back({shell.add_edge(edge), true});
  }
  face.patch = 0;
  face.is_extraordinary = false;
  shell.add_face(face);
  return shell;
}

#endif // BREP_MODELS_H
