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

template <typename T, typename = void>
struct Is_domain : std::false_type {};
template <typename T>
struct Is_domain<T, std::void_t<typename T::Point, typename T::vertex_descriptor,
                                typename T::simplex_descriptor, decltype(T::dimension)>>
  : std::true_type {};

template <typename T, typename = void>
struct Is_mesh_complex : std::false_type {};
template <typename T>
struct Is_mesh_complex<T, std::void_t<typename T::Triangulation, typename T::Subdomain_index,
                                      typename T::Cells_in_complex_iterator>> : std::true_type {};

template <typename T, typename = void>
struct Is_triangulation : std::false_type {};
template <typename T>
struct Is_triangulation<T, std::void_t<typename T::Geom_traits, typename T::Cell_handle,
                                       typename T::Finite_cells_iterator>> : std::true_type {};

template <typename T, typename = void>
struct Is_linear_cell_complex : std::false_type {};
template <typename T>
struct Is_linear_cell_complex<T, std::void_t<typename T::Vertex_attribute,
                                             decltype(T::ambient_dimension)>> : std::true_type {};

template <typename T>
using Covering_sheets_of = typename T::Covering_sheets; // of a periodic triangulation

template <typename T>
using Begin_of = decltype(std::begin(std::declval<T&>()));

// only a linear cell complex over a combinatorial map has the member beta()
template <typename T, typename = void>
struct Is_generalized_map : std::true_type {};
template <typename T>
struct Is_generalized_map<T, std::void_t<
  decltype(std::declval<T&>().beta(std::declval<T&>().create_dart(), 1))>> : std::false_type {};

// Whether a mesh is a linear cell complex that is not a FaceGraph: its dimension is 3, its map is
// generalized, or its faces have no attributes. (CGAL defines graph_traits for the first and the
// last case, but they do not work.)
template <typename Mesh>
constexpr bool is_complex_without_graph()
{
  if constexpr(Is_linear_cell_complex<Mesh>::value)
    return Mesh::dimension == 3 || Is_generalized_map<Mesh>::value ||
           std::is_same_v<typename Mesh::template Attribute_type<2>::type, CGAL::Void>;
  else
    return false;
}

template <typename T, typename = void>
struct Is_complete : std::false_type {};
template <typename T>
struct Is_complete<T, std::void_t<decltype(sizeof(T))>> : std::true_type {};

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
struct Default_domain<Domain, std::enable_if_t<Is_domain<Domain>::value>>
{
  using type = Domain;
};

template <typename Mesh>
struct Default_domain<Mesh, std::enable_if_t<Is_triangulation<Mesh>::value>>
{
  static constexpr bool is_periodic = is_valid<Covering_sheets_of, Mesh>;
  static_assert(!is_periodic, "periodic triangulations cannot be deformed");
  static constexpr bool is_included = Is_complete<Triangulation_domain<Mesh>>::value;
  static_assert(is_included, "to deform a triangulation, "
                             "#include <CGAL/ARAP_deformation/Triangulation_domain.h>");
  using type = typename Domain_if<is_included && !is_periodic, Triangulation_domain<Mesh>>::type;
};

template <typename Mesh>
struct Default_domain<Mesh, std::enable_if_t<Is_mesh_complex<Mesh>::value>>
  : Default_domain<typename Mesh::Triangulation>
{};

template <typename Mesh>
struct Default_domain<Mesh, std::enable_if_t<is_complex_without_graph<Mesh>()>>
{
  static constexpr bool is_included = Is_complete<Linear_cell_complex_domain<Mesh>>::value;
  using type = typename Domain_if<is_included, Linear_cell_complex_domain<Mesh>>::type;
  static_assert(is_included,
                "to deform this linear cell complex, #include "
                "<CGAL/ARAP_deformation/Linear_cell_complex_domain.h>");
};

template <typename Domain, typename Mesh>
Domain make_domain(Mesh& mesh)
{
  if constexpr(Is_mesh_complex<Mesh>::value && !std::is_same_v<Domain, No_domain>)
    return make_complex_domain(mesh);
  else
    return Domain(mesh);
}

// Calls `f`, which only reads, with a domain, or with the default domain of a mesh.
template <typename Shape, typename Function>
decltype(auto) with_domain(const Shape& shape, const Function& f)
{
  if constexpr(Is_domain<Shape>::value)
    return f(shape);
  else // domains refer to meshes that can be written
    return f(make_domain<typename Default_domain<Shape>::type>(const_cast<Shape&>(shape)));
}

} // namespace internal

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_INTERNAL_DOMAIN_DEFAULT_DOMAIN_H
