<?xml version='1.0' encoding='UTF-8' standalone='yes' ?>
<tagfile>
  <compound kind="class"><name>FaceListGraph</name><filename>BGL/classFaceListGraph.html</filename></compound>
  <compound kind="class"><name>FaceGraph</name><filename>BGL/classFaceGraph.html</filename></compound>
  <compound kind="class"><name>HalfedgeGraph</name><filename>BGL/classHalfedgeGraph.html</filename></compound>
  <compound kind="class"><name>HalfedgeListGraph</name><filename>BGL/classHalfedgeListGraph.html</filename></compound>
  <compound kind="class"><name>MutableFaceGraph</name><filename>BGL/classMutableFaceGraph.html</filename></compound>
  <compound kind="class"><name>VertexListGraph</name><filename>BGL/classVertexListGraph.html</filename></compound>
  <compound kind="class"><name>EdgeListGraph</name><filename>BGL/classEdgeListGraph.html</filename></compound>
  <compound kind="class"><name>ReadablePropertyMap</name><filename>Property_map/classReadablePropertyMap.html</filename></compound>
  <compound kind="class"><name>WritablePropertyMap</name><filename>Property_map/classWritablePropertyMap.html</filename></compound>
  <compound kind="class"><name>ReadWritePropertyMap</name><filename>Property_map/classReadWritePropertyMap.html</filename></compound>
  <compound kind="class"><name>LvaluePropertyMap</name><filename>Property_map/classLvaluePropertyMap.html</filename></compound>
  <compound kind="class"><name>Kernel</name><filename>Kernel_23/classKernel.html</filename></compound>
  <compound kind="class"><name>FieldNumberType</name><filename>Algebraic_foundations/classFieldNumberType.html</filename></compound>
  <compound kind="class"><name>CopyConstructible</name><filename>STL_Extension/classCopyConstructible.html</filename></compound>
  <compound kind="class"><name>DefaultConstructible</name><filename>STL_Extension/classDefaultConstructible.html</filename></compound>
  <compound kind="class"><name>CGAL::Surface_mesh</name><filename>Surface_mesh/classCGAL_1_1Surface__mesh.html</filename></compound>
  <compound kind="class"><name>CGAL::Polyhedron_3</name><filename>Polyhedron/classCGAL_1_1Polyhedron__3.html</filename></compound>
  <compound kind="class"><name>CGAL::Simple_cartesian</name><filename>Kernel_23/structCGAL_1_1Simple__cartesian.html</filename></compound>
  <compound kind="page"><name>bgl_namedparameters</name><title>Named Parameters</title><filename>BGL/group__bgl__namedparameters.html</filename></compound>
  <compound kind="page"><name>PkgBGL</name><title>CGAL and the BGL</title><filename>Manual/packages.html#PkgBGL</filename></compound>
  <compound kind="page"><name>PkgSurfaceMesh</name><title>Surface Mesh</title><filename>Manual/packages.html#PkgSurfaceMesh</filename></compound>
  <compound kind="page"><name>PkgPolygonMeshProcessing</name><title>Polygon Mesh Processing</title><filename>Manual/packages.html#PkgPolygonMeshProcessing</filename></compound>
  <compound kind="page"><name>thirdpartyEigen</name><title>Eigen</title><filename>Manual/thirdparty.html#thirdpartyEigen</filename></compound>
  <compound kind="page"><name>licensesGPL</name><title>GPL</title><filename>Manual/license.html#licensesGPL</filename></compound>
</tagfile>
