// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// CGAL's constrained Delaunay triangulation as this room uses it: exact predicates, constraints
/// may cross, and what vertices and faces carry is the user's.
///
/// The program is built with NDEBUG, which would switch off CGAL's own checks; with them an input
/// that CGAL cannot handle raises CGAL::Failure_exception and is counted, not undefined.
#pragma once

#define CGAL_DEBUG 1

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <variant>

namespace sunload {

using PlanKernel = CGAL::Exact_predicates_inexact_constructions_kernel;

template <class VertexInfo, class FaceInfo = std::monostate>
using ConstrainedDelaunay = CGAL::Constrained_Delaunay_triangulation_2<
    PlanKernel,
    CGAL::Triangulation_data_structure_2<
        CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, PlanKernel>,
        CGAL::Constrained_triangulation_face_base_2<
            PlanKernel, CGAL::Triangulation_face_base_with_info_2<FaceInfo, PlanKernel>>>,
    CGAL::Exact_predicates_tag>;

}  // namespace sunload
