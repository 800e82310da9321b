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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_GLTF_H
#define CGAL_ARAP_DEFORMATION_DEMO_GLTF_H

// The containers of glTF 2.0: .gltf, a JSON text, and .glb, with the first buffer behind it.

#include "Unwritable.h"
#include "base64.h"
#include "shape_files.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

namespace CGAL::ARAP::demo {

class Gltf
{
public:
  using Json = nlohmann::ordered_json;

  // the component types and targets of the format
  enum { BYTE = 5120, BYTE_INDEX = 5121, SHORT = 5122, SHORT_INDEX = 5123, INDEX = 5125,
         FLOAT = 5126 };
  enum { VERTICES = 34962, CORNERS = 34963 };

  // the place of an accessor in a buffer
  struct Array
  {
    std::size_t buffer, begin, stride, size;
    int component;
  };

  Json json;
  std::vector<std::string> buffers; // in bytes

  // One buffer, and nothing in it.
  Gltf() : json{{"asset", {{"version", "2.0"}, {"generator", "arap_deform"}}}}, buffers(1),
           m_is_inside(1, true)
  {
    json["buffers"].push_back(Json::object());
  }

  // Throws a std::runtime_error if the file cannot be read.
  explicit Gltf(const std::string& file)
  {
    try
    {
      read(file);
    }
    catch(const Json::exception& error)
    {
      throw unreadable(file, error);
    }
  }

  // what to throw for a file that the JSON library finds fault with
  static std::runtime_error unreadable(const std::string& file, const Json::exception& error)
  {
    // after the name of the exception in brackets, and without the word that was read last, which
    // may be a whole buffer
    std::string why = error.what();
    why = why.substr(why.find(']') + 1);
    return std::runtime_error(file + ": is no glTF that can be read:" +
                              printable(why.substr(0, why.find("; last read:"))));
  }

  static bool is_index(int component)
  {
    return component == BYTE_INDEX || component == SHORT_INDEX || component == INDEX;
  }

  // An index or a size, which may be written as 4.0 or 4e0. Throws a Json::exception if it is a
  // fraction, negative, or too large.
  static std::size_t whole(const Json& number)
  {
    constexpr double largest = 9007199254740992; // up to which a double is exact
    const bool is_whole = number.is_number_float()
                            ? number <= largest && std::trunc(number.get<double>()) == number
                            : number.is_number_integer();
    return is_whole && number >= 0 ? number.get<std::size_t>()
                                   : number.get_ref<const Json::number_unsigned_t&>();
  }
  static std::size_t whole(const Json& object, const char* key, std::size_t otherwise)
  {
    return object.contains(key) ? whole(object[key]) : otherwise;
  }

  // the list of an object under this key, which may be missing
  static const Json& list(const Json& object, const char* key)
  {
    static const Json none = Json::array();
    return object.is_object() && !object.contains(key) ? none : object.at(key);
  }

  static void refuse_extension(const Json& object, const char* extension, const char* what)
  {
    if(object.contains("extensions") && object["extensions"].contains(extension))
      throw std::runtime_error(std::string("has ") + what + " by " + extension);
  }

  // the names of the files beside this one that hold its parts: "buffers" or "images"
  std::vector<std::string> names_of_files(const char* parts) const
  {
    std::vector<std::string> names;
    for(const Json& part : list(json, parts))
      if(part.contains("uri") && part["uri"].get_ref<const std::string&>().rfind("data:", 0) != 0)
        names.push_back(decoded(part["uri"]));
    return names;
  }

  // Throws if a reader needs an extension for more than how the surface looks.
  void check_required_extensions() const
  {
    for(const Json& required : list(json, "extensionsRequired"))
    {
      const auto& name = required.get_ref<const std::string&>();
      const auto contains = [&name](const char* part) {
        return name.find(part) != std::string::npos;
      };
      if(!contains("_materials_") && !contains("_texture_") && !contains("_lights_") &&
         name != "KHR_mesh_quantization")
        throw std::runtime_error("needs the extension " + in_quotes(name) + ", which is not "
                                 "supported");
    }
  }

  // Throws if the accessor is not in a buffer, or needs what is not supported.
  Array array(std::size_t index, const std::string& type) const
  {
    const Json& accessor = json.at("accessors").at(index);
    if(accessor.at("type") != type || accessor.contains("sparse") ||
       !accessor.contains("bufferView"))
      throw std::runtime_error("has an accessor that is sparse, compressed, or not of the type " +
                               type);
    const Json& view = json.at("bufferViews").at(whole(accessor["bufferView"]));
    for(const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
      refuse_extension(view, extension, "arrays that are compressed");
    Array result;
    result.component = static_cast<int>(whole(accessor.at("componentType")));
    const std::size_t bytes = bytes_of(result.component) * number_of_components(type);
    result.buffer = whole(view.at("buffer"));
    if(result.buffer >= buffers.size())
      throw std::runtime_error("has an accessor in a buffer that does not exist");
    result.begin = whole(view, "byteOffset", 0) + whole(accessor, "byteOffset", 0);
    result.stride = whole(view, "byteStride", bytes);
    result.size = whole(accessor.at("count"));
    const double end = double(result.begin) + double(result.stride) * (double(result.size) - 1) +
                       double(bytes);
    if(!(double(result.size) <= end && end <= double(buffers[result.buffer].size())))
      throw std::runtime_error("has an accessor that does not fit into its buffer");
    return result;
  }

  std::array<double, 3> vector(const Array& array, std::size_t i) const
  {
    return {component(array, i, 0), component(array, i, 1), component(array, i, 2)};
  }

  void set_vector(const Array& array, std::size_t i, const std::array<double, 3>& v)
  {
    const std::array<float, 3> value{to_float(v[0]), to_float(v[1]), to_float(v[2])};
    std::memcpy(buffers[array.buffer].data() + array.begin + i * array.stride, value.data(),
                sizeof(value));
    m_is_inside[array.buffer] = true;
  }

  std::size_t corner(const Array& array, std::size_t i) const
  {
    std::uint32_t value = 0;
    std::memcpy(&value, buffers[array.buffer].data() + array.begin + i * array.stride,
                bytes_of(array.component));
    return value;
  }

  // Writes the bounds of an accessor of vectors.
  void update_bounds(std::size_t index)
  {
    Json& accessor = json["accessors"][index];
    const std::string type = accessor["type"];
    const Array a = array(index, type);
    Json low = Json::array(), high = Json::array();
    for(std::size_t k = 0; k < number_of_components(type) && a.size > 0; ++k)
    {
      float least = component(a, 0, k), most = least;
      for(std::size_t i = 0; i < a.size; ++i)
      {
        least = (std::min)(least, component(a, i, k));
        most = (std::max)(most, component(a, i, k));
      }
      low.push_back(least);
      high.push_back(most);
    }
    accessor["min"] = low;
    accessor["max"] = high;
  }

  bool has_bounds(std::size_t index) const
  {
    const Json& accessor = json.at("accessors").at(index);
    return accessor.contains("min") || accessor.contains("max");
  }

  // Appends numbers to the first buffer as an accessor, and returns its index.
  template <typename Value>
  std::size_t append(const std::vector<Value>& values, const std::string& type, int target = 0)
  {
    Json view = {{"buffer", 0}, {"byteOffset", buffers[0].size()},
                 {"byteLength", values.size() * sizeof(Value)}};
    if(target != 0)
      view["target"] = target;
    buffers[0].append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
    json["bufferViews"].push_back(view);
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", std::is_same_v<Value, float> ? FLOAT : INDEX},
                                 {"count", values.size() / number_of_components(type)},
                                 {"type", type}});
    const std::size_t index = json["accessors"].size() - 1;
    if(type == "VEC3")
      update_bounds(index);
    return index;
  }

  // Puts all buffers into what is written.
  void embed_buffers() { std::fill(m_is_inside.begin(), m_is_inside.end(), true); }

  // Buffers in files of their own stay there if they are unchanged.
  void write(std::ostream& out, bool is_binary)
  {
    for(std::size_t k = 0; k < buffers.size(); ++k)
    {
      json["buffers"][k]["byteLength"] = buffers[k].size();
      if(!m_is_inside[k])
        continue;
      if(is_binary && k == 0)
        json["buffers"][k].erase("uri");
      else
        json["buffers"][k]["uri"] = data_uri + to_base64(buffers[k]);
    }
    if(!is_binary)
    {
      out << json.dump(1) << '\n';
      return;
    }
    std::string text = json.dump(), bytes;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const bool has_bytes = !buffers.empty() && m_is_inside[0];
    if(has_bytes)
      bytes = buffers[0];
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    const std::size_t size = 12 + 8 + text.size() + (has_bytes ? 8 + bytes.size() : 0);
    out << "glTF" << number(2) << number(size) << number(text.size()) << "JSON" << text;
    if(has_bytes)
      out << number(bytes.size()) << std::string("BIN\0", 4) << bytes;
  }

private:
  inline static const std::string data_uri = "data:application/octet-stream;base64,";

  static std::size_t bytes_of(int component)
  {
    return component == BYTE || component == BYTE_INDEX     ? 1
           : component == SHORT || component == SHORT_INDEX ? 2
                                                            : 4;
  }

  // a number of a vector
  float component(const Array& array, std::size_t i, std::size_t k) const
  {
    float value = 0;
    std::memcpy(&value,
                buffers[array.buffer].data() + array.begin + i * array.stride + k * sizeof(value),
                sizeof(value));
    return value;
  }

  static std::size_t number_of_components(const std::string& type)
  {
    return type == "VEC4" ? 4 : type == "VEC3" ? 3 : 1;
  }

  static std::string number(std::size_t value)
  {
    if(value > (std::numeric_limits<std::uint32_t>::max)())
      throw Unwritable("would have more than the 4 GB that a .glb file can have");
    const auto four_bytes = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&four_bytes), 4);
  }

  void read(const std::string& file)
  {
    std::string text = content_of(file), bytes;
    if(text.rfind("glTF", 0) == 0)
    {
      const auto size_at = [&text](std::size_t place) {
        std::uint32_t value = 0;
        if(place + 4 <= text.size())
          std::memcpy(&value, text.data() + place, 4);
        return std::size_t(value);
      };
      const std::size_t size = size_at(12), begin = 20 + size + 8;
      if(size_at(4) != 2 || size == 0 || 20 + size > text.size())
        throw std::runtime_error(file + ": is no .glb file of version 2, or ends too early");
      if(begin <= text.size())
        bytes = text.substr(begin, size_at(20 + size));
      text = text.substr(20, size);
    }
    if(depth_of(text) > 1000) // what copies and writes it calls itself for each
      throw std::runtime_error(file + ": nests lists and objects more than 1000 deep");
    json = Json::parse(text);
    for(const Json& buffer : list(json, "buffers"))
    {
      const std::size_t size = whole(buffer.at("byteLength"));
      const std::string uri = buffer.value("uri", "");
      const std::size_t comma = uri.find(";base64,");
      m_is_inside.push_back(uri.empty() || comma != std::string::npos);
      if(uri.empty()) // that of a .glb file
        buffers.push_back(bytes);
      else if(m_is_inside.back())
      {
        const auto decoded = from_base64(uri.substr(comma + 8));
        if(!decoded)
          throw std::runtime_error(file + ": has a buffer that is not in base64");
        buffers.push_back(*decoded);
      }
      else
        buffers.push_back(first_bytes(file, decoded(uri), size));
      if(buffers.back().size() < size)
        throw std::runtime_error(file + ": a buffer has less than its " + std::to_string(size) +
                                 " bytes, or its file is missing");
      buffers.back().resize(size);
    }
  }

  // How deep the lists and objects of a JSON text are nested. (A callback of the parser is told it,
  // but makes the parser take quadratic time.)
  static std::size_t depth_of(const std::string& text)
  {
    std::size_t depth = 0, greatest = 0;
    for(std::size_t i = 0; i < text.size(); ++i)
      if(text[i] == '[' || text[i] == '{')
        greatest = (std::max)(greatest, ++depth);
      else if(depth > 0 && (text[i] == ']' || text[i] == '}'))
        --depth;
      else if(text[i] == '"') // to the end of the string
        for(++i; i < text.size() && text[i] != '"'; ++i)
          i += text[i] == '\\';
    return greatest;
  }

  // A URI with its escapes decoded: %20 is a blank.
  static std::string decoded(const std::string& uri)
  {
    std::string result;
    for(std::size_t i = 0; i < uri.size(); ++i)
    {
      const std::string digits = uri[i] == '%' ? uri.substr(i + 1, 2) : "";
      const bool is_escape = digits.size() == 2 && std::all_of(
        digits.begin(), digits.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
      result += is_escape ? static_cast<char>(std::stoi(digits, nullptr, 16)) : uri[i];
      i += is_escape ? 2 : 0;
    }
    return result;
  }

  // The first bytes of a buffer beside a file; none if it does not have them.
  static std::string first_bytes(const std::string& file, const std::filesystem::path& name,
                                 std::size_t size)
  {
    if(name.has_root_path())
      throw std::runtime_error(file + ": has a buffer whose place is not relative to the file");
    const std::filesystem::path buffer = std::filesystem::path(file).parent_path() / name;
    std::error_code error; // a pipe or a device may have no end
    if(!std::filesystem::is_regular_file(buffer, error) ||
       std::filesystem::file_size(buffer, error) < size)
      return {};
    std::string bytes(size, '\0');
    if(!std::ifstream(buffer, std::ios::binary).read(bytes.data(), std::streamsize(size)))
      return {};
    return bytes;
  }

  std::vector<bool> m_is_inside; // of each buffer: not in a file of its own
};

// A scene of triangles; their positions are the first accessor.
inline Gltf make_gltf(const std::vector<std::array<double, 3>>& points,
                      const std::vector<std::array<int, 3>>& triangles)
{
  std::vector<float> positions;
  for(const auto& p : points)
    std::transform(p.begin(), p.end(), std::back_inserter(positions), to_float);
  std::vector<std::uint32_t> corners;
  for(const auto& t : triangles)
    corners.insert(corners.end(), t.begin(), t.end());
  Gltf gltf;
  gltf.append(positions, "VEC3", Gltf::VERTICES);
  gltf.append(corners, "SCALAR", Gltf::CORNERS);
  gltf.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
  gltf.json["nodes"] = {{{"mesh", 0}}};
  gltf.json["scenes"] = {{{"nodes", {0}}}};
  gltf.json["scene"] = 0;
  return gltf;
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_GLTF_H
