// Copyright (c) 2026  The ARAP_deformation authors.
// All rights reserved.
//
// This file is part of CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later OR LicenseRef-Commercial
//
// Author(s)     : The ARAP_deformation authors

#ifndef CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_DEFAULT_DOMAIN_H
#define CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_DEFAULT_DOMAIN_H

#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Face_graph_domain.h>
#include <CGAL/ARAP_deformation/internal/domain/No_domain.h>
#include <CGAL/ARAP_deformation/internal/is_valid.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace ARAP {

template <typename Triangulation>
class Triangulation_domain;

template <typename MeshComplex>
Triangulation_domain<typename MeshComplex::Triangulation>
make_complex_domain(MeshComplex& complex);

template <typename LinearCellComplex>
class Linear_cell_complex_domain;

namespace internal {

// the members by which each kind of shape is known
template <typename T>
using Types_of_domain = std::void_t<typename T::Point, typename T::vertex_descriptor,
                                    typename T::simplex_descriptor, decltype(T::dimension)>;
template <typename T>
using Types_of_mesh_complex = std::void_t<typename T::Triangulation, typename T::Subdomain_index,
                                          typename T::Cells_in_complex_iterator>;
template <typename T>
using Types_of_triangulation = std::void_t<typename T::Geom_traits, typename T::Cell_handle,
                                           typename T::Finite_cells_iterator>;
template <typename T>
using Types_of_linear_cell_complex = std::void_t<typename T::Vertex_attribute,
                                                 decltype(T::ambient_dimension)>;

template <typename T>
constexpr bool is_domain = is_valid<Types_of_domain, T>;

template <typename T>
using Covering_sheets_of = typename T::Covering_sheets; // of a periodic triangulation

template <typename T>
using Begin_of = decltype(std::begin(std::declval<T&>()));

template <typename T> // of a combinatorial map, but not of a generalized one
using Call_beta = decltype(std::declval<T&>().beta(std::declval<T&>().create_dart(), 1));

// Whether a mesh is a linear cell complex that is not a FaceGraph: its dimension is 3, its map is
// generalized, or its faces have no attributes. (CGAL defines graph_traits for the first and the
// last case, but they do not work.)
template <typename Mesh>
constexpr bool is_complex_without_graph()
{
  if constexpr(is_valid<Types_of_linear_cell_complex, Mesh>)
    return Mesh::dimension == 3 || !is_valid<Call_beta, Mesh> ||
           std::is_same_v<typename Mesh::template Attribute_type<2>::type, CGAL::Void>;
  else
    return false;
}

template <typename T>
using Size_of = std::integral_constant<std::size_t, sizeof(T)>; // of a class that is defined

// the domain if it may be used, No_domain if not
template <bool is_accepted, typename Domain>
struct Domain_if { using type = Domain; };
template <typename Domain>
struct Domain_if<false, Domain> { using type = No_domain; };

// The default domain of a mesh in ARAP_deformation and arap_deform(). Domains of volumes have
// separate headers, so that programs that deform only surfaces do not compile them.
template <typename Mesh, typename = void>
struct Default_domain
{
  // boost::graph_traits cannot tell whether a mesh is a FaceGraph: it does not compile if not
  static_assert(!is_valid<Begin_of, Mesh>,
                "a range is not a mesh: to deform ranges of points and simplices, construct their "
                "domain, CGAL::ARAP::Simplex_soup_domain");
  using type = typename Domain_if<!is_valid<Begin_of, Mesh>, Face_graph_domain<Mesh>>::type;
};

template <typename Domain>
struct Default_domain<Domain, std::enable_if_t<is_domain<Domain>>>
{
  using type = Domain;
};

template <typename Mesh>
struct Default_domain<Mesh, std::enable_if_t<is_valid<Types_of_triangulation, Mesh>>>
{
  static constexpr bool is_periodic = is_valid<Covering_sheets_of, Mesh>;
  static_assert(!is_periodic, "periodic triangulations cannot be deformed");
  static constexpr bool is_included = is_valid<Size_of, Triangulation_domain<Mesh>>;
  static_assert(is_included, "to deform a triangulation, "
                             "#include <CGAL/ARAP_deformation/Triangulation_domain.h>");
  using type = typename Domain_if<is_included && !is_periodic, Triangulation_domain<Mesh>>::type;
};

template <typename Mesh>
struct Default_domain<Mesh, std::enable_if_t<is_valid<Types_of_mesh_complex, Mesh>>>
  : Default_domain<typename Mesh::Triangulation>
{};

template <typename Mesh>
struct Default_domain<Mesh, std::enable_if_t<is_complex_without_graph<Mesh>()>>
{
  static constexpr bool is_included = is_valid<Size_of, Linear_cell_complex_domain<Mesh>>;
  using type = typename Domain_if<is_included, Linear_cell_complex_domain<Mesh>>::type;
  static_assert(is_included,
                "to deform this linear cell complex, #include "
                "<CGAL/ARAP_deformation/Linear_cell_complex_domain.h>");
};

template <typename Domain, typename Mesh>
Domain make_domain(Mesh& mesh)
{
  if constexpr(is_valid<Types_of_mesh_complex, Mesh> && !std::is_same_v<Domain, No_domain>)
    return make_complex_domain(mesh);
  else
    return Domain(mesh);
}

// Calls `f`, which only reads, with a domain, or with the default domain of a mesh.
template <typename Shape, typename Function>
decltype(auto) with_domain(const Shape& shape, const Function& f)
{
  if constexpr(is_domain<Shape>)
    return f(shape);
  else // domains refer to meshes that can be written
    return f(make_domain<typename Default_domain<Shape>::type>(const_cast<Shape&>(shape)));
}

} // namespace internal

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_DEFAULT_DOMAIN_H
