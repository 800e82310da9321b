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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_SCENE_H
#define CGAL_ARAP_DEFORMATION_DEMO_SCENE_H

// Pictures of triangulated shapes in the style of the figures of Sorkine and Alexa 2007, drawn by
// the ray tracer POV-Ray, which needs neither a display nor a library.

#if defined(__unix__) || defined(__APPLE__)
#include <sys/wait.h>
#endif

#include <CGAL/Bbox_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/number_type_config.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <ostream>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace CGAL::ARAP::demo {

using Vector = CGAL::Simple_cartesian<double>::Vector_3;
using Points = std::vector<std::array<double, 3>>;

// One shape of a picture. The selection has a status per vertex, as in .sel files: 0 fixed (drawn
// red), 1 free (pale), 2 handle (yellow). Without a selection all vertices are free.
struct Panel
{
  Points points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> selection;
  std::string caption;
  std::vector<std::array<int, 2>> lines = {}; // thin and pale, from point to point
  std::vector<double> values = {}; // if given, a number from 0 (pale) to 1 (dark red) per vertex
};

// The view of all panels of a picture: from the same side and at the same scale.
struct View
{
  Vector from{0.4, -1, 0.3}; // direction from the shape to the eye
  Vector up{0, 0, 1};        // also the normal of the ground
  int width = 480;           // of one panel, in pixels
  int height = 640;
  bool show_edges = false;   // draw the edges of the triangles as thin lines
  std::optional<CGAL::Bbox_3> box = {}; // what each panel shows; by default its own points
};

// A view of the broad side of the shape, slightly from the right and above. Up is the longest axis
// if it is distinctly longer, the normal if the shape is flat, and otherwise the y axis.
inline View default_view(const Points& points)
{
  CGAL::Bbox_3 box;
  for(const auto& [x, y, z] : points)
    box += CGAL::Bbox_3(x, y, z, x, y, z);
  const std::array<double, 3> size{box.x_span(), box.y_span(), box.z_span()};
  std::array<int, 3> axes{0, 1, 2}; // from the shortest to the longest
  std::sort(axes.begin(), axes.end(), [&](int a, int b) { return size[a] < size[b]; });

  const bool is_long = size[axes[2]] > 1.25 * size[axes[1]];
  const bool is_flat = !is_long && size[axes[0]] < 0.25 * size[axes[1]];
  const int up = is_long ? axes[2] : is_flat ? axes[0] : 1;
  const int front = up == axes[0] ? axes[1] : axes[0];

  std::array<double, 3> from, upwards{0, 0, 0};
  from.fill(0.45);
  from[front] = front == 1 ? -1 : 1; // so that the remaining axis points to the right
  from[up] = is_flat ? 0.8 : 0.3;
  upwards[up] = 1;

  View view;
  view.from = Vector(from[0], from[1], from[2]);
  view.up = Vector(upwards[0], upwards[1], upwards[2]);
  if(!is_long)
    view.width = view.height;
  return view;
}

// A view from elsewhere: from a direction, or from an azimuth and an elevation in degrees; the
// azimuth is that of a right-handed system whose last axis is upwards, so from x to y if that is z.
inline View turned(View view, const std::vector<double>& from)
{
  const int up = view.up.x() != 0 ? 0 : view.up.y() != 0 ? 1 : 2;
  std::array<double, 3> direction;
  if(from.size() == 2)
  {
    const double azimuth = from[0] * CGAL_PI / 180, elevation = from[1] * CGAL_PI / 180;
    direction[(up + 1) % 3] = std::cos(azimuth) * std::cos(elevation);
    direction[(up + 2) % 3] = std::sin(azimuth) * std::cos(elevation);
    direction[up] = std::sin(elevation);
  }
  else
  {
    double largest = 0;
    for(double coordinate : from)
      largest = (std::max)(largest, std::abs(coordinate));
    std::transform(from.begin(), from.end(), direction.begin(),
                   [largest](double coordinate) { return coordinate / largest; });
  }
  view.from = Vector(direction[0], direction[1], direction[2]);
  if(CGAL::cross_product(view.up, view.from) == Vector(0, 0, 0)) // along the old one
    view.up = Vector(up == 2, up == 0, up == 1);
  return view;
}

namespace internal {

inline Vector unit(const Vector& v) { return v / std::sqrt(v.squared_length()); }

// Vectors and lists in the syntax of POV-Ray.
struct Pov { const Vector& vector; };

inline std::ostream& operator<<(std::ostream& out, const Pov& p)
{
  return out << '<' << p.vector.x() << ',' << p.vector.y() << ',' << p.vector.z() << '>';
}

template <typename Range, typename Write_item>
void write_list(std::ostream& out, const char* name, const Range& range, Write_item write_item)
{
  out << name << " { " << range.size();
  for(const auto& item : range)
    write_item(item, out << ",\n");
  out << " }\n";
}

// the normals of a picture: those of the vertices, and others; and which one each corner has
struct Normals
{
  std::vector<Vector> vectors;
  std::vector<std::array<int, 3>> of_corners;
};

// Those of the triangles at a corner, weighted by area, without those beyond a sharp edge: what
// turns away from the eye with its normal would be black.
inline Normals smooth_normals(const std::vector<std::array<int, 3>>& triangles,
                              const std::vector<Vector>& points)
{
  const double sharp = std::cos(70 * CGAL_PI / 180);
  std::vector<Vector> flat;                     // of the triangles
  std::vector<std::vector<int>> at(points.size()); // the triangles at each vertex
  for(const auto& t : triangles)
  {
    for(int v : t)
      at[v].push_back(static_cast<int>(flat.size()));
    flat.push_back(CGAL::cross_product(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
  }
  Normals result{std::vector<Vector>(points.size(), Vector(0, 0, 0)), triangles};
  for(std::size_t i = 0; i < triangles.size(); ++i)
    for(int& corner : result.of_corners[i])
    {
      Vector sum(0, 0, 0);
      bool has_all = true;
      for(int other : at[corner])
      {
        const bool is_smooth = flat[i] * flat[other] >= sharp * std::sqrt(
          flat[i].squared_length() * flat[other].squared_length());
        has_all = has_all && is_smooth;
        sum += is_smooth * flat[other];
      }
      if(has_all)
        result.vectors[corner] = sum;
      else
      {
        corner = static_cast<int>(result.vectors.size());
        result.vectors.push_back(sum);
      }
    }
  for(Vector& n : result.vectors) // POV-Ray needs a normal even where there is none
    n = n.squared_length() > 0 ? unit(n) : Vector(0, 0, -1);
  return result;
}

// The triangles with their normals. Each corner has the texture of its vertex, and POV-Ray blends.
// Fixed vertices and handles without a triangle of one color are drawn as balls.
inline void write_surface(std::ostream& out, const Panel& panel, const std::vector<Vector>& points)
{
  const std::vector<int>& selection = panel.selection;
  const Normals normals = smooth_normals(panel.triangles, points);
  std::vector<bool> is_shown(points.size(), false);
  for(const auto& [a, b, c] : panel.triangles)
    if(selection[a] == selection[b] && selection[b] == selection[c])
      is_shown[a] = is_shown[b] = is_shown[c] = true;

  const auto write_vector = [](const Vector& v, std::ostream& list) { list << Pov{v}; };
  out << "mesh2 {\n";
  write_list(out, "vertex_vectors", points, write_vector);
  write_list(out, "normal_vectors", normals.vectors, write_vector);
  const int shades = 100;
  const auto texture = [&](int v) {
    return panel.values.empty() ? selection[v] : static_cast<int>(panel.values[v] * shades + 0.5);
  };
  if(panel.values.empty())
    out << "texture_list { 3, texture { Fixed } texture { Free } texture { Handle } }\n";
  else
  {
    out << "texture_list { " << shades + 1;
    for(int shade = 0; shade <= shades; ++shade)
      out << ",\ntexture { Shade(" << static_cast<double>(shade) / shades << ") }";
    out << " }\n";
  }
  const auto write_triple = [](const std::array<int, 3>& t, std::ostream& list) {
    list << '<' << t[0] << ',' << t[1] << ',' << t[2] << '>';
  };
  write_list(out, "face_indices", panel.triangles, [&](const auto& t, std::ostream& list) {
    write_triple(t, list);
    for(int v : t)
      list << ',' << texture(v);
  });
  write_list(out, "normal_indices", normals.of_corners, write_triple);
  out << "}\n";
  for(std::size_t v = 0; v < points.size(); ++v)
    if(selection[v] != 1 && !is_shown[v] && panel.values.empty())
      out << "sphere { " << Pov{points[v]} << ", Ball texture { "
          << (selection[v] == 0 ? "Fixed" : "Handle") << " } }\n";
}

// `texture` is the name of a texture.
template <typename Lines>
void write_lines(std::ostream& out, const Lines& lines, const std::vector<Vector>& points,
                 const char* texture)
{
  for(const auto& [a, b] : lines)
    if(points[a] != points[b]) // POV-Ray rejects cylinders without length
      out << "cylinder { " << Pov{points[a]} << ", " << Pov{points[b]} << ", Line_radius texture { "
          << texture << " } no_shadow }\n";
}

inline std::set<std::pair<int, int>> edges(const std::vector<std::array<int, 3>>& triangles)
{
  std::set<std::pair<int, int>> result;
  for(const auto& t : triangles)
    for(int i = 0; i < 3; ++i)
      result.insert(std::minmax({t[i], t[(i + 1) % 3]}));
  return result;
}

// The text with a backslash before each of the special characters.
inline std::string escaped(const std::string& text, const std::string& special)
{
  std::string result;
  for(char c : text) {
    if(special.find(c) != std::string::npos)
      result += '\\';
    result += c;
  }
  return result;
}

// The common part of all scenes. It follows the declarations of Width, Height and Ground_height, in
// pixels, and of Ground, the normal of the ground. The ground has its own light, straight above, so
// that soft shadows stay below each shape; without shadow it is bright enough to be white.
inline constexpr const char* stage = R"(
#declare Far = 20 * max(Width, Height);
#declare Soft = Far / 3;
#declare Ball = 0.012 * Height;
#declare Paint = finish { ambient 0 emission 0.03 diffuse 0.8 specular 0.12 roughness 0.05 }
#declare Fixed = texture { pigment { srgb <0.82, 0.14, 0.12> } finish { Paint } }
#declare Free = texture { pigment { srgb <0.80, 0.84, 0.90> } finish { Paint } }
#declare Handle = texture { pigment { srgb <0.98, 0.80, 0.10> } finish { Paint } }
#declare Shades = color_map { [0 srgb <0.93, 0.94, 0.96>] [0.25 srgb <0.99, 0.85, 0.45>]
  [0.5 srgb <0.96, 0.55, 0.20>] [0.75 srgb <0.80, 0.15, 0.15>] [1 srgb <0.30, 0, 0.10>] }
#macro Shade(X)
  pigment { function { X } color_map { Shades } } finish { Paint }
#end
#declare Line_radius = 0.5;
#declare Line = texture { pigment { srgb <0.18, 0.20, 0.26> } finish { emission 1 diffuse 0 } }
#declare Pale_line = texture { pigment { srgb <0.50, 0.58, 0.70> } finish { emission 1 diffuse 0 } }
#macro Caption(Text, X, Size)
  #local Letters = text { internal 2 Text 0.01, 0 }
  object { Letters
    translate -x * (min_extent(Letters) + max_extent(Letters)).x / 2
    scale Size
    translate <X, Size - Height / 2, -Far / 2>
    texture { Line } no_shadow }
#end
background { rgb 1 }
camera { orthographic location -z * Far direction z right x * Width up y * Height }
light_source { Far * vnormalize(<-0.6, 0.9, -1>) srgb 1
  area_light x * Soft, y * Soft, 5, 5 adaptive 1 jitter circular orient }
light_source { Far * vnormalize(<1, 0.1, -0.6>) srgb 0.45 shadowless }
light_source { Far * vnormalize(<0.1, 0.2, -1>) srgb 0.55 shadowless }
#ifdef (Ground)
  light_group {
    light_source { Far * Ground rgb 1
      area_light x * Soft, z * Soft, 9, 9 adaptive 1 jitter circular orient }
    disc { y * Ground_height / Ground.y, Ground, Far / 10
      pigment { rgb 1 } finish { ambient 0 emission 0.3 diffuse 0.73 } }
    global_lights off
  }
#end
)";

// A new folder, removed with its contents at destruction.
struct Temporary_folder
{
  std::filesystem::path path;

  Temporary_folder()
  {
    std::error_code error;
    const auto parent = std::filesystem::temp_directory_path(error);
    if(error)
      throw std::runtime_error("there is no folder for temporary files: " + error.message() +
                               "; TMPDIR tells where it is");
    do
      path = std::filesystem::absolute(parent) /
             ("arap_scene_" + std::to_string(std::random_device()()));
    while(!std::filesystem::create_directory(path)); // false if it exists
  }
  Temporary_folder(const Temporary_folder&) = delete;
  ~Temporary_folder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

// Runs a program in the folder, where its files and messages go, and returns whether it succeeded.
// Its exit code is `interrupted` if the user has interrupted it. No name chosen by a user reaches
// the shell, and the name of the folder is quoted.
inline bool run_program(const Temporary_folder& folder, const std::string& call, int interrupted)
{
  const std::string path = escaped(folder.path.generic_string(), "\\\"$`");
  const int status =
    std::system(("cd \"" + path + "\" || exit 1; " + call + " > messages 2>&1").c_str());
#if defined(__unix__) || defined(__APPLE__)
  // meanwhile this program ignores an interrupt from the keyboard, which ends the other one, or the
  // shell
  if(status == -1)
    return false;
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if(code == interrupted || code == 128 + SIGINT)
    throw std::runtime_error("interrupted");
#else
  static_cast<void>(interrupted);
#endif
  return status == 0;
}

// POV-Ray's exit code for an interrupt
inline bool run_povray(const Temporary_folder& folder, const std::string& arguments)
{
  return run_program(folder, "povray " + arguments, 2);
}

// The messages of POV-Ray after its last headline, which tell why it stopped.
inline std::string last_messages(const std::filesystem::path& file)
{
  std::ifstream in(file);
  std::string result;
  for(std::string word; in >> word;)
    result = word.find("====") == 0 ? "" : result + ' ' + word;
  return result;
}

} // namespace internal

// Writes the panels in a row as a scene for POV-Ray, with a pixel as the unit. Captions should be
// plain ASCII: the fonts of POV-Ray have little else.
inline void write_scene(std::ostream& out, std::vector<Panel> panels, const View& view)
{
  // The axes of the viewer. POV-Ray's are left-handed: x to the right, y up, z away from the eye.
  const Vector right = internal::unit(CGAL::cross_product(view.up, view.from));
  const Vector up = internal::unit(CGAL::cross_product(view.from, right));
  const Vector away = -internal::unit(view.from);
  const auto eye = [&](const Vector& v) { return Vector(right * v, up * v, away * v); };

  std::vector<std::vector<Vector>> seen(panels.size());
  std::vector<CGAL::Bbox_3> boxes(panels.size());
  CGAL::Bbox_3 all;
  double widest = 0;
  bool has_captions = false;
  for(std::size_t k = 0; k < panels.size(); ++k) {
    panels[k].selection.resize(panels[k].points.size(), 1);
    for(const auto& [x, y, z] : panels[k].points) {
      seen[k].push_back(eye(Vector(x, y, z)));
      boxes[k] += (CGAL::ORIGIN + seen[k].back()).bbox();
    }
    for(int corner = 0; corner < 8 && view.box; ++corner) {
      const auto end = [&](int axis) {
        return corner >> axis & 1 ? view.box->max(axis) : view.box->min(axis);
      };
      const auto place = (CGAL::ORIGIN + eye(Vector(end(0), end(1), end(2)))).bbox();
      boxes[k] = corner == 0 ? place : boxes[k] + place;
    }
    all += boxes[k];
    widest = (std::max)(widest, boxes[k].x_span());
    has_captions = has_captions || !panels[k].caption.empty();
  }

  // Each panel is centered in its slot from left to right, but all stand on the same ground.
  const double width = double(view.width) * panels.size();
  const double legible = 16; // pixels: thin letters vanish in less
  const double letters = has_captions ? (std::max)(0.04 * view.height, legible) : 0;
  const double margin = 0.06 * (std::min)(view.width, view.height);
  const double scale = (std::min)((view.width - 2 * margin) / widest,
                                  (view.height - 2 * margin - 2 * letters) / all.y_span());
  const Vector ground = eye(internal::unit(view.up));
  double ground_height = (std::numeric_limits<double>::max)();
  const auto slot = [&](std::size_t k) { return (k + 0.5) * view.width - width / 2; };
  for(std::size_t k = 0; k < panels.size(); ++k) {
    const Vector middle((boxes[k].xmin() + boxes[k].xmax()) / 2, (all.ymin() + all.ymax()) / 2,
                        (all.zmin() + all.zmax()) / 2);
    for(Vector& p : seen[k]) {
      p = Vector(slot(k), letters, 0) + scale * (p - middle);
      ground_height = (std::min)(ground_height, ground * p);
    }
  }

  out << "#version 3.7;\n"
      << "global_settings { assumed_gamma 1 }\n"
      << "#declare Width = " << width << ";\n"
      << "#declare Height = " << view.height << ";\n";
  if(ground.z() < 0) // seen from below, the ground would hide everything
    out << "#declare Ground = " << internal::Pov{ground} << ";\n"
        << "#declare Ground_height = " << ground_height - 0.5 << ";\n"; // just under the shape
  out << internal::stage;
  for(std::size_t k = 0; k < panels.size(); ++k) {
    internal::write_surface(out, panels[k], seen[k]);
    if(view.show_edges)
      internal::write_lines(out, internal::edges(panels[k].triangles), seen[k], "Line");
    internal::write_lines(out, panels[k].lines, seen[k], "Pale_line");
    if(!panels[k].caption.empty())
      out << "Caption(\"" << internal::escaped(panels[k].caption, "\\\"") << "\", " << slot(k)
          << ", " << letters << ")\n";
  }
}

// Throws a std::runtime_error if pictures cannot be drawn here, whatever they show.
inline void check_renderer()
{
  const internal::Temporary_folder folder;
  if(!internal::run_povray(folder, "--version"))
    throw std::runtime_error("pictures need POV-Ray, but its program povray was not found");
}

namespace internal {

// Draws the panels in a row as a file of the folder. The format is one of POV-Ray: N is PNG, P PPM.
inline void draw(const Temporary_folder& folder, const std::vector<Panel>& panels, const View& view,
                 const std::string& picture, char format)
{
  for(const Panel& panel : panels)
    for(const auto& [x, y, z] : panel.points)
      if(!std::isfinite(x + y + z))
        throw std::runtime_error("a shape whose coordinates are not finite cannot be drawn");
  std::ofstream scene(folder.path / "scene.pov");
  write_scene(scene, panels, view);
  scene.close();
  if(!scene)
    throw std::runtime_error("the scene of the picture could not be written to " +
                             folder.path.string());
  const std::string width = std::to_string(view.width * panels.size());
  if(!run_povray(folder, "+Iscene.pov +O" + picture + " +F" + format + " +W" + width + " +H" +
                           std::to_string(view.height) + " +A0.15 +AM2 +R2 -D -V -P"))
    throw std::runtime_error("POV-Ray could not draw the picture:" +
                             last_messages(folder.path / "messages"));
}

} // namespace internal

// Draws the panels in a row and writes them to a stream as PNG. Throws a std::runtime_error if that
// fails.
inline void render(const std::vector<Panel>& panels, const View& view, std::ostream& out)
{
  const internal::Temporary_folder folder;
  internal::draw(folder, panels, view, "picture.png", 'N');
  out << std::ifstream(folder.path / "picture.png", std::ios::binary).rdbuf();
}

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_SCENE_H
