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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_GLTF_FILE_H
#define CGAL_ARAP_DEFORMATION_DEMO_GLTF_FILE_H

#include "Corner_rotation.h"
#include "Gltf.h"
#include "Output_file.h"
#include "arguments.h"
#include "mesh_panel.h"
#include "read_mesh.h"
#include "shape_files.h"

#include <CGAL/ARAP_deformation/Face_graph_domain.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

// The triangles of a .gltf or .glb file as one surface in the coordinates of the scene. Vertices
// that differ only in their attributes, such as texture coordinates, are one vertex of the surface.
class Gltf_file
{
public:
  using Domain = Face_graph_domain<Mesh>;

  static constexpr const char* simplices = "faces";

  Gltf_file(const std::string& file, const std::string&)
    : m_gltf(file), m_folder(std::filesystem::absolute(file).parent_path())
  {
    try
    {
      m_images = m_gltf.names_of_files("images");
      m_gltf.check_required_extensions();
      for(std::size_t node : roots())
        read_node(node, Eigen::Affine3d::Identity(), 0);
    }
    catch(const Gltf::Json::exception& error)
    {
      throw Gltf::unreadable(file, error);
    }
    catch(const std::runtime_error& error)
    {
      throw std::runtime_error(file + ": " + error.what());
    }
    internal::build_mesh(file, m_rest_points, m_faces, m_mesh, m_numbers);
    check_mesh(file, m_mesh);
  }

  const Mesh& mesh() const { return m_mesh; }
  std::size_t number_of_vertices() const { return m_mesh.number_of_vertices(); }
  std::size_t number_of_simplices() const { return m_mesh.number_of_faces(); }
  Domain domain() { return Domain(m_mesh); }
  bool writes_skin(const std::string&) const { return false; }

  void check_output(const std::string& file, const std::string& format,
                    const std::vector<std::string>& other_outputs)
  {
    for(const auto& inputs : {m_gltf.names_of_files("buffers"), m_images})
      for(const std::string& input : inputs)
        for(const std::string& output : other_outputs)
          if(is_same_file(output, (m_folder / input).string()))
            throw Usage_error("the file " + output + " is a part of the input");
    check_format(file, format, m_mesh);
    if(!is_gltf_format(format))
      return;
    if(const std::string what = shared(); !what.empty())
      throw std::runtime_error(file + ": " + what + ", too, which is not in the scene");
    if(m_shared_directions)
      throw std::runtime_error(file + ": the accessor " + std::to_string(*m_shared_directions) +
                               " has the normals or tangents of two sets of positions, which "
                               "would turn apart");
    std::error_code error;
    if(std::filesystem::equivalent(internal::location(file).parent_path(), m_folder, error))
      return;
    m_gltf.embed_buffers(); // their files are not beside the output
    m_are_images_left = !m_images.empty();
  }

  std::set<std::string> dropped(const std::string& format) const
  {
    if(!is_gltf_format(format))
      return {"all but points and faces"};
    if(m_are_images_left)
      return {"images, which stay in the folder of the input"};
    return {};
  }

  void set_property(const std::string& name, const std::vector<double>& values)
  {
    set_vertex_property(m_mesh, name, values);
  }

  void write(Output_file& output, const std::string& format, const Skin&) const
  {
    if(!is_gltf_format(format))
      return write_mesh(output, m_mesh, format);
    output.write([&](std::ostream& out) {
      Gltf gltf = m_gltf;
      move_vertices(gltf);
      gltf.write(out, format == ".glb");
    });
  }

private:
  // The vertices of a primitive, and their corners in the faces.
  struct Piece
  {
    Eigen::Affine3d to_scene;
    std::vector<Mesh::Vertex_index> vertices;
    std::vector<std::vector<std::size_t>> faces;
    std::set<std::size_t> tangents; // their accessors
  };

  // the place of positions, normals or tangents
  using Place = std::tuple<std::size_t, std::size_t, std::size_t, std::size_t>;
  static Place place(const Gltf::Array& a) { return {a.buffer, a.begin, a.stride, a.size}; }

  static Eigen::Vector3d vector(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }
  static std::array<double, 3> coordinates(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

  static Eigen::Affine3d transform(const Gltf::Json& node)
  {
    Eigen::Affine3d result = Eigen::Affine3d::Identity();
    if(node.contains("matrix")) // column by column, as in Eigen
    {
      const auto m = node["matrix"].get<std::array<double, 16>>();
      result.matrix() = Eigen::Map<const Eigen::Matrix4d>(m.data());
      return result;
    }
    const auto t = node.value("translation", std::array<double, 3>{0, 0, 0});
    const auto r = node.value("rotation", std::array<double, 4>{0, 0, 0, 1});
    const auto s = node.value("scale", std::array<double, 3>{1, 1, 1});
    result.translate(Eigen::Vector3d(t[0], t[1], t[2]));
    result.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized());
    result.scale(Eigen::Vector3d(s[0], s[1], s[2]));
    return result;
  }

  // The first nodes of the scene; without a scene, those that are no child.
  std::vector<std::size_t> roots() const
  {
    const Gltf::Json& json = m_gltf.json;
    std::vector<std::size_t> result;
    if(json.contains("scenes"))
    {
      const Gltf::Json& scene = json["scenes"].at(Gltf::whole(json, "scene", 0));
      for(const auto& node : Gltf::list(scene, "nodes"))
        result.push_back(Gltf::whole(node));
      return result;
    }
    const Gltf::Json& nodes = Gltf::list(json, "nodes");
    std::set<std::size_t> children;
    for(const auto& node : nodes)
      for(const auto& child : Gltf::list(node, "children"))
        children.insert(Gltf::whole(child));
    for(std::size_t node = 0; node < nodes.size(); ++node)
      if(children.count(node) == 0)
        result.push_back(node);
    return result;
  }

  void read_node(std::size_t index, const Eigen::Affine3d& parent, int depth)
  {
    if(!m_nodes.insert(index).second)
      throw std::runtime_error("the node " + std::to_string(index) + " occurs twice");
    if(depth > 1000)
      throw std::runtime_error("nests nodes more than 1000 deep");
    const Gltf::Json& node = m_gltf.json.at("nodes").at(index);
    const Eigen::Affine3d to_scene = parent * transform(node);
    if(node.contains("mesh"))
    {
      const std::size_t mesh = Gltf::whole(node["mesh"]);
      if(node.contains("skin"))
        throw std::runtime_error("the node " + std::to_string(index) + " has a skin; only rigid "
                                 "nodes can be deformed");
      Gltf::refuse_extension(node, "EXT_mesh_gpu_instancing", "a node that is repeated");
      if(!m_meshes.insert(mesh).second)
        throw std::runtime_error("the mesh " + std::to_string(mesh) + " is used by two nodes");
      if(!(std::abs(to_scene.linear().determinant()) > 0))
        throw std::runtime_error("the node " + std::to_string(index) + " is flattened");
      for(const auto& primitive : m_gltf.json.at("meshes").at(mesh).at("primitives"))
        read_primitive(primitive, to_scene);
    }
    for(const auto& child : Gltf::list(node, "children"))
      read_node(Gltf::whole(child), to_scene, depth + 1);
  }

  void read_primitive(const Gltf::Json& primitive, const Eigen::Affine3d& to_scene)
  {
    const std::size_t triangles = 4;
    if(Gltf::whole(primitive, "mode", triangles) != triangles)
      throw std::runtime_error("has a primitive that is no list of triangles");
    Gltf::refuse_extension(primitive, "KHR_draco_mesh_compression",
                           "triangles that are compressed");
    if(primitive.contains("targets"))
      throw std::runtime_error("has morph targets, which a deformation would make wrong");
    const Gltf::Json& attributes = primitive.at("attributes");
    if(!attributes.contains("POSITION"))
      throw std::runtime_error("has a primitive without positions");
    std::pair<std::size_t, std::optional<std::size_t>> accessors(
      Gltf::whole(attributes.at("POSITION")), {});
    if(attributes.contains("NORMAL"))
      accessors.second = Gltf::whole(attributes["NORMAL"]);
    std::optional<std::size_t> tangents;
    if(attributes.contains("TANGENT"))
      tangents = Gltf::whole(attributes["TANGENT"]);
    accessors.first = first_alias(accessors.first, "POSITION");
    if(accessors.second)
      accessors.second = first_alias(*accessors.second, "NORMAL");
    if(tangents)
      tangents = first_alias(*tangents, "TANGENT");
    const Gltf::Array positions = m_gltf.array(accessors.first, "VEC3");
    const auto same = m_pieces.lower_bound({accessors.first, std::nullopt}); // with any normals
    if(same != m_pieces.end() && same->first.first == accessors.first &&
       same->second.to_scene.matrix() != to_scene.matrix())
      throw std::runtime_error("the accessor " + std::to_string(accessors.first) + " has the "
                               "positions of two nodes in different places");
    for(const auto& directions : {accessors.second, tangents})
      if(directions &&
         m_positions_of.emplace(*directions, accessors.first).first->second != accessors.first)
        m_shared_directions = directions;
    Piece& piece = m_pieces[accessors];
    if(tangents)
      piece.tangents.insert(*tangents);
    if(piece.vertices.empty())
    {
      piece.to_scene = to_scene;
      piece.faces.resize(positions.size);
      for(std::size_t i = 0; i < positions.size; ++i)
      {
        const auto p = m_gltf.vector(positions, i);
        piece.vertices.push_back(vertex(coordinates(to_scene * Eigen::Vector3d(p[0], p[1], p[2]))));
      }
    }
    std::optional<Gltf::Array> corners;
    if(primitive.contains("indices"))
      corners = m_gltf.array(Gltf::whole(primitive["indices"]), "SCALAR");
    if(corners && !Gltf::is_index(corners->component))
      throw std::runtime_error("has indices that are no unsigned integers");
    const std::size_t size = corners ? corners->size : positions.size;
    if(size % 3 != 0)
      throw std::runtime_error("has a list of triangles whose last one is incomplete");
    for(std::size_t i = 0; i < size; i += 3, ++m_number_of_triangles)
    {
      std::array<std::size_t, 3> t;
      for(std::size_t k = 0; k < 3; ++k)
      {
        t[k] = corners ? m_gltf.corner(*corners, i + k) : i + k;
        if(t[k] >= piece.vertices.size())
          throw std::runtime_error("a triangle has a vertex that does not exist");
      }
      if(to_scene.linear().determinant() < 0) // a mirror image: glTF turns its triangles over
        std::swap(t[1], t[2]);
      const std::vector<std::size_t> face = {piece.vertices[t[0]], piece.vertices[t[1]],
                                             piece.vertices[t[2]]};
      if(face[0] == face[1] || face[1] == face[2] || face[2] == face[0])
        continue; // without area
      for(std::size_t k : t)
        piece.faces[k].push_back(m_faces.size());
      m_faces.push_back(face);
      m_numbers.push_back(m_number_of_triangles);
    }
  }

  // What would move with the scene, but is not in it; empty if there is nothing.
  std::string shared() const
  {
    const Gltf::Json &nodes = m_gltf.json.at("nodes"), &meshes = m_gltf.json.at("meshes"),
                     &accessors = m_gltf.json.at("accessors");
    std::set<Place> moved;
    for(const auto& [use_and_place, aliases] : m_aliases)
      moved.insert(use_and_place.second);
    const auto shared_by_node = [&](std::size_t node) -> std::string {
      if(m_nodes.count(node) > 0 || !nodes[node].contains("mesh"))
        return {};
      const std::size_t mesh = Gltf::whole(nodes[node]["mesh"]);
      return m_meshes.count(mesh) == 0 ? "" : "the mesh " + std::to_string(mesh) +
                                                " is used by the node " + std::to_string(node);
    };
    const auto shared_by_mesh = [&](std::size_t mesh) -> std::string {
      if(m_meshes.count(mesh) == 0)
        for(const auto& primitive : meshes[mesh].at("primitives"))
          for(const auto& accessor : primitive.at("attributes"))
            if(const std::size_t k = Gltf::whole(accessor);
               moved.count(place(m_gltf.array(k, accessors.at(k).at("type")))) > 0)
              return "the accessor " + std::to_string(k) + " is used by the mesh " +
                     std::to_string(mesh);
      return {};
    };
    std::string result;
    const auto look = [&](const auto& shared_by, std::size_t size) {
      for(std::size_t k = 0; k < size && result.empty(); ++k)
        try
        {
          result = shared_by(k);
        }
        catch(const std::exception&)
        {
          // what is not read may have what cannot be
        }
    };
    look(shared_by_node, nodes.size());
    look(shared_by_mesh, meshes.size());
    return result;
  }

  // the first accessor of this use that has the same elements, which are moved once
  std::size_t first_alias(std::size_t accessor, const std::string& use)
  {
    const Gltf::Array a = m_gltf.array(accessor, use == "TANGENT" ? "VEC4" : "VEC3");
    if(a.component != Gltf::FLOAT)
      throw std::runtime_error("has positions, normals or tangents that are quantized");
    std::vector<std::size_t>& aliases = m_aliases[{use, place(a)}];
    if(std::find(aliases.begin(), aliases.end(), accessor) == aliases.end())
      aliases.push_back(accessor);
    return aliases[0];
  }

  void move_vertices(Gltf& gltf) const
  {
    for(const auto& [accessors, piece] : m_pieces)
    {
      const Gltf::Array positions = gltf.array(accessors.first, "VEC3");
      for(std::size_t i = 0; i < piece.vertices.size(); ++i)
        if(const Mesh::Vertex_index v = piece.vertices[i]; m_mesh.point(v) != m_rest_points[v])
          gltf.set_vector(positions, i, coordinates(piece.to_scene.inverse() *
                                                    vector(m_mesh.point(v))));
      const Eigen::Matrix3d m = piece.to_scene.linear();
      if(accessors.second) // they are mapped by the cofactors
        turn(gltf, gltf.array(*accessors.second, "VEC3"), m.inverse().transpose(), piece);
      for(std::size_t tangents : piece.tangents)
        turn(gltf, gltf.array(tangents, "VEC4"), m, piece);
    }
    for(const auto& [moved, aliases] : m_aliases)
      for(std::size_t accessor : aliases)
        if(moved.first == "POSITION" || gltf.has_bounds(accessor)) // others need not
          gltf.update_bounds(accessor);
  }

  Mesh::Vertex_index vertex(const std::array<double, 3>& p)
  {
    for(double coordinate : p)
      if(!std::isfinite(coordinate))
        throw std::runtime_error("has a position that is infinite or not a number");
    const auto [place, is_new] = m_vertices.emplace(p, m_rest_points.size());
    if(is_new)
      m_rest_points.emplace_back(p[0], p[1], p[2]);
    return Mesh::Vertex_index(static_cast<Mesh::size_type>(place->second));
  }

  // Each vector turns with its corners.
  void turn(Gltf& gltf, const Gltf::Array& vectors, const Eigen::Matrix3d& to_scene,
            const Piece& piece) const
  {
    const Eigen::Matrix3d from_scene = to_scene.inverse();
    for(std::size_t i = 0; i < piece.vertices.size() && i < vectors.size; ++i)
    {
      Corner_rotation rotation(m_mesh, m_rest_points);
      for(std::size_t face : piece.faces[i])
        rotation.insert(Mesh::Face_index(static_cast<Mesh::size_type>(face)), piece.vertices[i]);
      if(!rotation.has_moved())
        continue;
      const auto v = m_gltf.vector(vectors, i);
      const Eigen::Vector3d in_scene = to_scene * Eigen::Vector3d(v[0], v[1], v[2]);
      const auto turned = rotation({in_scene[0], in_scene[1], in_scene[2]});
      gltf.set_vector(vectors, i, coordinates(
        (from_scene * Eigen::Vector3d(turned.x(), turned.y(), turned.z())).normalized()));
    }
  }

  Gltf m_gltf;
  std::filesystem::path m_folder;
  std::vector<std::string> m_images; // in files of their own
  bool m_are_images_left = false;
  std::set<std::size_t> m_nodes, m_meshes; // that were read
  // the accessors of each use and place
  std::map<std::pair<std::string, Place>, std::vector<std::size_t>> m_aliases;
  std::map<std::array<double, 3>, std::size_t> m_vertices;
  std::map<std::size_t, std::size_t> m_positions_of; // for an accessor of normals or tangents
  std::optional<std::size_t> m_shared_directions;    // one of several positions
  // for the accessors of its positions and normals
  std::map<std::pair<std::size_t, std::optional<std::size_t>>, Piece> m_pieces;
  internal::Polygons m_faces;
  std::vector<std::size_t> m_numbers; // of the faces, among all triangles that are read
  std::size_t m_number_of_triangles = 0;
  std::vector<Kernel::Point_3> m_rest_points;
  Mesh m_mesh; // deformed
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_GLTF_FILE_H
