// Copyright (c) 2026 the authors of the package Surface_mesh_spline_conversion.
// All rights reserved.
//
// This file is part of the package Surface_mesh_spline_conversion, which is being
// prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_STEP_H
#define CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_STEP_H

#include <CGAL/license/Surface_mesh_spline_conversion.h>

#include <CGAL/Surface_mesh_spline_conversion/NURBS_shell_3.h>
#include <CGAL/Surface_mesh_spline_conversion/internal/export/Text_buffer.h>

#include <CGAL/Kernel/global_functions.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_spline_conversion {

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

is what `CGAL::IO::write_STEP()` writes beside the shell. The defaults make equal shells give equal
files: there is no time stamp unless one is given.
*/
struct STEP_information
{
  std::string product = "surface";                   ///< name of the product
  std::string file = "";                             ///< name of the file, as written into it
  std::string author = "";                           ///< name of the author
  std::string organization = "";                     ///< name of the organization
  std::string time_stamp = "1970-01-01T00:00:00";    ///< ISO 8601
  std::string unit = "mm";                           ///< `"mm"`, `"cm"`, `"m"`, `"um"` or `"in"`
  double uncertainty = 1e-7;  ///< distance below which points are equal, in model units; positive
};

namespace internal {

/// Writes a shell as an ISO 10303-21 file of the application protocol 214: B-spline faces with
/// shared edges and vertices, without curves in parameter space (kernels compute them on reading).
template <typename K>
class STEP_writer
{
  typedef NURBS_shell_3<K> Shell;
  typedef typename K::Point_3 Point_3;
  typedef Knot_vector<typename K::FT> Knots;

public:
  STEP_writer(std::ostream& os, const Shell& shell, const STEP_information& information)
    : m_out(os), m_shell(shell), m_information(information)
  {}

  static bool is_unit(const std::string& unit)
  {
    return unit == "in" || si_units().count(unit) != 0;
  }

  void operator()()
  {
    write_header();
    write_product();
    write_context();
    write_vertices();
    write_edges();
    m_face.resize(m_shell.number_of_faces());
    for(std::size_t f = 0; f < m_shell.number_of_faces(); ++f)
      m_face[f] = write_face(m_shell.face(f));
    write_shells();
    m_out << "ENDSEC;\nEND-ISO-10303-21;\n";
  }

private:
  typedef std::size_t Id;

  // begins an entity
  Id entity(const char* text)
  {
    m_out << '#' << ++m_last << '=' << text;
    return m_last;
  }

  void write_header()
  {
    m_out << "ISO-10303-21;\nHEADER;\n"
          << "FILE_DESCRIPTION((" << quoted("T-NURCC surface as B-spline shells") << "),'2;1');\n"
          << "FILE_NAME(" << quoted(m_information.file) << ',' << quoted(m_information.time_stamp)
          << ",(" << quoted(m_information.author) << "),(" << quoted(m_information.organization)
          << "),'CGAL','Surface_mesh_spline_conversion','');\n"
          << "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n";
  }

  // a string of the exchange structure: apostrophes and backslashes are doubled, bytes that are not
  // printable ASCII replaced
  static std::string quoted(const std::string& text)
  {
    std::string result = "'";
    for(char c : text)
    {
      if(c == '\'' || c == '\\')
        result += c;
      result += (c >= ' ' && c <= '~') ? c : '?';
    }
    return result + "'";
  }

  void write_product()
  {
    const Id application = entity("APPLICATION_CONTEXT('automotive design');\n");
    entity("APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#");
    m_out << application << ");\n";
    const Id product_context = entity("PRODUCT_CONTEXT('',#");
    m_out << application << ",'mechanical');\n";
    const std::string name = quoted(m_information.product);
    const Id product = entity("PRODUCT(");
    m_out << name << ',' << name << ",'',(#" << product_context << "));\n";
    entity("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(#");
    m_out << product << "));\n";
    const Id formation = entity("PRODUCT_DEFINITION_FORMATION('','',#");
    m_out << product << ");\n";
    const Id context = entity("PRODUCT_DEFINITION_CONTEXT('part definition',#");
    m_out << application << ",'design');\n";
    const Id definition = entity("PRODUCT_DEFINITION('design','',#");
    m_out << formation << ",#" << context << ");\n";
    m_product_shape = entity("PRODUCT_DEFINITION_SHAPE('','',#");
    m_out << definition << ");\n";
  }

  void write_context()
  {
    const Id length = write_length_unit();
    const Id angle = entity("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n");
    const Id solid_angle = entity("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n");
    const Id uncertainty = entity("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(");
    m_out.real(m_information.uncertainty) << "),#" << length
      << ",'distance_accuracy_value','confusion accuracy');\n";
    m_context = entity("(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#");
    m_out << uncertainty << "))GLOBAL_UNIT_ASSIGNED_CONTEXT((#" << length << ",#" << angle << ",#"
          << solid_angle << "))REPRESENTATION_CONTEXT('',''));\n";
  }

  // the prefixes of units of length
  static std::map<std::string, const char*> si_units()
  {
    return {{"mm", ".MILLI."}, {"cm", ".CENTI."}, {"m", "$"}, {"um", ".MICRO."}};
  }

  Id write_length_unit()
  {
    const bool is_inch = (m_information.unit == "in");
    const Id length = entity("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(");
    m_out << si_units().at(is_inch ? "mm" : m_information.unit) << ",.METRE.));\n";
    if(!is_inch)
      return length;
    const Id measure = entity("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#");
    m_out << length << ");\n";
    const Id exponents = entity("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n");
    const Id inch = entity("(CONVERSION_BASED_UNIT('INCH',#");
    m_out << measure << ")LENGTH_UNIT()NAMED_UNIT(#" << exponents << "));\n";
    return inch;
  }

  Id write_point(const Point_3& p)
  {
    const Id id = entity("CARTESIAN_POINT('',(");
    m_out.real(CGAL::to_double(p.x())) << ',';
    m_out.real(CGAL::to_double(p.y())) << ',';
    m_out.real(CGAL::to_double(p.z())) << "));\n";
    return id;
  }

  void write_vertices()
  {
    for(std::size_t v = 0; v < m_shell.number_of_vertices(); ++v)
    {
      m_vertex_point.push_back(write_point(m_shell.point(v)));
      m_vertex.push_back(entity("VERTEX_POINT('',#"));
      m_out << m_vertex_point.back() << ");\n";
    }
  }

  void write_edges()
  {
    for(std::size_t e = 0; e < m_shell.number_of_edges(); ++e)
    {
      const typename Shell::Edge& edge = m_shell.edge(e);
      const std::vector<Point_3>& points = edge.curve.control_points;
      m_first_point.push_back(m_last + 1);
      std::vector<Id> ids(1, m_vertex_point[edge.source]);
      for(std::size_t i = 1; i + 1 < points.size(); ++i)
        ids.push_back(write_point(points[i]));
      ids.push_back(m_vertex_point[edge.target]);
      const Id curve = entity("B_SPLINE_CURVE_WITH_KNOTS('',");
      m_out << edge.curve.knots.degree() << ',';
      write_references(ids.begin(), ids.end());
      m_out << ",.UNSPECIFIED.,.F.,.F.,";
      write_multiplicities(edge.curve.knots);
      m_out << ',';
      write_knots(edge.curve.knots);
      m_out << ",.UNSPECIFIED.);\n";
      m_edge.push_back(entity("EDGE_CURVE('',#"));
      m_out << m_vertex[edge.source] << ",#" << m_vertex[edge.target] << ",#" << curve << ",.T.);\n";
    }
  }

  template <typename Iterator>
  void write_references(Iterator begin, Iterator end)
  {
    char separator = '(';
    for(; begin != end; ++begin)
    {
      m_out << separator << '#' << *begin;
      separator = ',';
    }
    m_out << ')';
  }

  void write_multiplicities(const Knots& knots)
  {
    char separator = '(';
    for(int m : knots.multiplicities())
    {
      m_out << separator << m;
      separator = ',';
    }
    m_out << ')';
  }

  void write_knots(const Knots& knots)
  {
    char separator = '(';
    for(const auto& t : knots.knots())
    {
      m_out << separator;
      m_out.real(CGAL::to_double(t));
      separator = ',';
    }
    m_out << ')';
  }

  // The points of a face. A sector of a cap and the edges on its sides have one row in common.
  std::vector<Id> write_control_points(const typename Shell::Face& face)
  {
    std::vector<Id> ids(face.surface.control_points.size(), 0);
    for(int side = 0; side < 4 && face.is_extraordinary; ++side)
      share_points(face.surface, side, (side == 3) ? face.loop.back() : face.loop[side], ids);
    for(std::size_t i = 0; i < ids.size(); ++i)
      if(ids[i] == 0)
        ids[i] = write_point(face.surface.control_points[i]);
    return ids;
  }

  // refers to the points of an edge on a side of a surface if they are the same
  void share_points(const B_spline_surface_3<K>& surface, int side,
                    const typename Shell::Oriented_edge& use, std::vector<Id>& ids) const
  {
    std::vector<std::size_t> indices = surface.indices_on_side(side);
    const std::vector<Point_3>& points = m_shell.edge(use.edge).curve.control_points;
    if(!use.is_forward)
      std::reverse(indices.begin(), indices.end());
    if(!std::equal(points.begin(), points.end(), indices.begin(), indices.end(),
                   [&surface](const Point_3& p, std::size_t i)
                   { return p == surface.control_points[i]; }))
      return;
    for(std::size_t i = 0; i < indices.size(); ++i)
      ids[indices[i]] = curve_point(use.edge, i);
  }

  Id curve_point(std::size_t e, std::size_t i) const
  {
    const typename Shell::Edge& edge = m_shell.edge(e);
    return (i == 0) ? m_vertex_point[edge.source]
         : (i + 1 == edge.curve.control_points.size()) ? m_vertex_point[edge.target]
         : m_first_point[e] + (i - 1);
  }

  Id write_surface(const typename Shell::Face& face)
  {
    const B_spline_surface_3<K>& surface = face.surface;
    const std::vector<Id> ids = write_control_points(face);
    const std::size_t nu = surface.knots[0].number_of_functions();
    const std::size_t nv = surface.knots[1].number_of_functions();
    const Id id = entity("B_SPLINE_SURFACE_WITH_KNOTS('',");
    m_out << surface.knots[0].degree() << ',' << surface.knots[1].degree() << ',';
    for(std::size_t i = 0; i < nu; ++i) // one list for each index in u
    {
      std::vector<Id> row;
      for(std::size_t j = 0; j < nv; ++j)
        row.push_back(ids[j * nu + i]);
      m_out << (i == 0 ? '(' : ',');
      write_references(row.begin(), row.end());
    }
    m_out << "),.UNSPECIFIED.,.F.,.F.,.F.,";
    for(int axis = 0; axis < 2; ++axis)
    {
      write_multiplicities(surface.knots[axis]);
      m_out << ',';
    }
    for(int axis = 0; axis < 2; ++axis)
    {
      write_knots(surface.knots[axis]);
      m_out << ',';
    }
    m_out << ".UNSPECIFIED.);\n";
    return id;
  }

  Id write_face(const typename Shell::Face& face)
  {
    const Id surface = write_surface(face);
    std::vector<Id> oriented;
    for(const auto& e : face.loop)
    {
      oriented.push_back(entity("ORIENTED_EDGE('',*,*,#"));
      m_out << m_edge[e.edge] << (e.is_forward ? ",.T.);\n" : ",.F.);\n");
    }
    const Id loop = entity("EDGE_LOOP('',");
    write_references(oriented.begin(), oriented.end());
    m_out << ");\n";
    const Id bound = entity("FACE_OUTER_BOUND('',#");
    m_out << loop << ",.T.);\n";
    const Id id = entity("ADVANCED_FACE('',(#");
    m_out << bound << "),#" << surface << ",.T.);\n";
    return id;
  }

  // Closed components whose faces look outwards are solids, all others surfaces.
  void write_shells()
  {
    std::vector<Id> solids, surfaces;
    for(const auto& component : m_shell.components())
    {
      std::vector<Id> faces;
      for(std::size_t f : component)
        faces.push_back(m_face[f]);
      const bool closed = is_closed(component);
      const Id shell = entity(closed ? "CLOSED_SHELL('',": "OPEN_SHELL('',");
      write_references(faces.begin(), faces.end());
      m_out << ");\n";
      if(closed && volume(component) > 0)
      {
        solids.push_back(entity("MANIFOLD_SOLID_BREP('',#"));
        m_out << shell << ");\n";
      }
      else
        surfaces.push_back(shell);
    }
    if(!solids.empty())
      write_representation("ADVANCED_BREP_SHAPE_REPRESENTATION('',", solids);
    if(!surfaces.empty())
    {
      std::vector<Id> models;
      for(Id shell : surfaces)
      {
        models.push_back(entity("SHELL_BASED_SURFACE_MODEL('',(#"));
        m_out << shell << "));\n";
      }
      write_representation("MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',", models);
    }
  }

  void write_representation(const char* kind, std::vector<Id> items)
  {
    const Id origin = entity("CARTESIAN_POINT('',(0.,0.,0.));\n");
    const Id z = entity("DIRECTION('',(0.,0.,1.));\n");
    const Id x = entity("DIRECTION('',(1.,0.,0.));\n");
    const Id placement = entity("AXIS2_PLACEMENT_3D('',#");
    m_out << origin << ",#" << z << ",#" << x << ");\n";
    items.insert(items.begin(), placement);
    const Id representation = entity(kind);
    write_references(items.begin(), items.end());
    m_out << ",#" << m_context << ");\n";
    entity("SHAPE_DEFINITION_REPRESENTATION(#");
    m_out << m_product_shape << ",#" << representation << ");\n";
  }

  bool is_closed(const std::vector<std::size_t>& component) const
  {
    for(std::size_t f : component)
      for(const auto& e : m_shell.face(f).loop)
        if(m_shell.is_border(e.edge))
          return false;
    return true;
  }

  // six times the volume inside the control nets, which has the sign of the volume
  double volume(const std::vector<std::size_t>& component) const
  {
    double sum = 0;
    for(std::size_t f : component)
    {
      const B_spline_surface_3<K>& s = m_shell.face(f).surface;
      const std::size_t nu = s.knots[0].number_of_functions();
      const std::size_t nv = s.knots[1].number_of_functions();
      for(std::size_t j = 0; j + 1 < nv; ++j)
        for(std::size_t i = 0; i + 1 < nu; ++i)
          sum += determinant(s.control_point(i, j), s.control_point(i + 1, j),
                             s.control_point(i + 1, j + 1))
               + determinant(s.control_point(i, j), s.control_point(i + 1, j + 1),
                             s.control_point(i, j + 1));
    }
    return sum;
  }

  static double determinant(const Point_3& p, const Point_3& q, const Point_3& r)
  {
    return CGAL::to_double(CGAL::determinant(p - CGAL::ORIGIN, q - CGAL::ORIGIN, r - CGAL::ORIGIN));
  }

  Text_buffer m_out;
  const Shell& m_shell;
  const STEP_information& m_information;
  Id m_last = 0;
  Id m_product_shape = 0;
  Id m_context = 0;
  std::vector<Id> m_vertex_point;
  std::vector<Id> m_vertex;
  std::vector<Id> m_edge;
  std::vector<Id> m_first_point; // of each edge, behind its source
  std::vector<Id> m_face;
};

} // namespace internal
} // namespace Surface_mesh_spline_conversion

namespace IO {

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

writes a shell to a stream in the STEP format (ISO 10303-21, application protocol 214).

Each connected component becomes one shell; a closed one with faces looking outwards becomes a
solid. Vertices and edges are shared, so that a reader needs no sewing; the sectors of a cap share
the control points of their edges. Coordinates are written with as many digits as are
needed to read back the same numbers.

\tparam K a model of `Kernel`
\param os the output stream
\param shell the shell
\param information header, unit and uncertainty
\return `true` if the unit is known, the uncertainty is a positive number, and the stream is still
        good
*/
template <typename K>
bool write_STEP(std::ostream& os, const Surface_mesh_spline_conversion::NURBS_shell_3<K>& shell,
                const Surface_mesh_spline_conversion::STEP_information& information
                  = Surface_mesh_spline_conversion::STEP_information())
{
  typedef Surface_mesh_spline_conversion::internal::STEP_writer<K> STEP_writer;
  if(!STEP_writer::is_unit(information.unit) || !(information.uncertainty > 0)
     || !std::isfinite(information.uncertainty))
    return false;
  STEP_writer(os, shell, information)();
  os.flush();
  return os.good();
}

/*!
\ingroup PkgSurfaceMeshSplineConversionIO

writes a shell to the file `filename`, as above.

\return `true` if the unit is known, the uncertainty is a positive number, and the file was written
*/
template <typename K>
bool write_STEP(const std::string& filename,
                const Surface_mesh_spline_conversion::NURBS_shell_3<K>& shell,
                const Surface_mesh_spline_conversion::STEP_information& information
                  = Surface_mesh_spline_conversion::STEP_information())
{
  std::ofstream os(filename, std::ios::binary);
  return os && write_STEP(os, shell, information);
}

} // namespace IO
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_SPLINE_CONVERSION_IO_STEP_H
