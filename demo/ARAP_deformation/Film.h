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

#ifndef CGAL_ARAP_DEFORMATION_DEMO_FILM_H
#define CGAL_ARAP_DEFORMATION_DEMO_FILM_H

// Films of a deformation: pictures by POV-Ray, put together by giflib or by the program ffmpeg, or
// one animated glTF, which needs no pictures.

#include "Delayed_interruption.h"
#include "Gltf.h"
#include "Output_file.h"
#include "Scene.h"
#include "Unwritable.h"
#include "arguments.h"
#include "shape_files.h"

#ifdef CGAL_ARAP_DEMO_WITH_GIFLIB
#include <gif_lib.h>
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL::ARAP::demo {

class Film
{
public:
  // Throws, with what is missing, if a film of this format cannot be made here.
  static void check(const std::string& file)
  {
    const std::string format = lower_case_extension(file);
    const auto refuse = [&file](const std::string& why) {
      throw std::runtime_error("--animation " + file + ": " + why);
    };
    if(is_gltf_format(format))
      return;
    if(format != ".gif" && format != ".mp4" && format != ".webm")
      throw Usage_error("--animation " + file + ": a film ends in .gif, .mp4, .webm, .gltf or "
                                                ".glb");
    if(format == ".mp4" || format == ".webm")
    {
      const internal::Temporary_folder folder;
      if(!run_ffmpeg(folder, "-version"))
        refuse("needs the program ffmpeg, which was not found");
    }
#ifndef CGAL_ARAP_DEMO_WITH_GIFLIB
    else
      refuse("this arap_deform was built without giflib (Debian: libgif-dev)");
#endif
    check_renderer();
  }

  Film(const std::string& file, const View& view) : m_format(lower_case_extension(file)),
                                                    m_view(view)
  {
    m_view.width = m_view.width * 3 / 4;
    m_view.height = m_view.height * 3 / 4;
  }

  void add_frame(Panel panel)
  {
    panel.caption.clear();
    for(const auto& [x, y, z] : panel.points)
      m_box += CGAL::Bbox_3(x, y, z, x, y, z);
    if(m_frames.empty())
      m_panel = panel;
    m_frames.push_back(std::move(panel.points));
  }

  void write(std::ostream& out)
  {
    if(is_gltf_format(m_format))
      return write_gltf(out);
    const internal::Temporary_folder folder;
    m_view.box = m_box;
    for(std::size_t frame = 0; frame < m_frames.size(); ++frame)
    {
      check_interrupted();
      m_panel.points = m_frames[frame];
      internal::draw(folder, {m_panel}, m_view, picture(frame), 'P');
    }
#ifdef CGAL_ARAP_DEMO_WITH_GIFLIB
    if(m_format == ".gif")
      return write_gif(folder, out);
#endif
    if(!run_ffmpeg(folder, "-loglevel error -framerate " + std::to_string(frames_per_second) +
                             " -i %04d.ppm -pix_fmt yuv420p film" + m_format))
      throw std::runtime_error("ffmpeg could not make the film:" +
                               internal::last_messages(folder.path / "messages"));
    out << std::ifstream(folder.path / ("film" + m_format), std::ios::binary).rdbuf();
  }

private:
  static constexpr int frames_per_second = 20;

  // its exit code for an interrupt is 255
  static bool run_ffmpeg(const internal::Temporary_folder& folder, const std::string& arguments)
  {
    return internal::run_program(folder, "ffmpeg " + arguments, 255);
  }

  static std::string picture(std::size_t frame) { return four_digits(frame) + ".ppm"; }

#ifdef CGAL_ARAP_DEMO_WITH_GIFLIB
  void write_gif(const internal::Temporary_folder& folder, std::ostream& out) const
  {
    const auto require = [](bool condition) {
      if(!condition)
        throw std::runtime_error("giflib could not make the film");
    };
    const auto write = [](GifFileType* gif, const GifByteType* bytes, int n) {
      static_cast<std::ostream*>(gif->UserData)->write(reinterpret_cast<const char*>(bytes), n);
      return n;
    };
    int error = 0;
    GifFileType* const gif = EGifOpen(&out, write, &error);
    require(gif != nullptr);
    const int width = m_view.width, height = m_view.height;
    EGifSetGifVersion(gif, true);
    bool is_written = EGifPutScreenDesc(gif, width, height, 8, 0, nullptr) != GIF_ERROR;
    // repeat for ever
    is_written = is_written && EGifPutExtensionLeader(gif, APPLICATION_EXT_FUNC_CODE) &&
                 EGifPutExtensionBlock(gif, 11, "NETSCAPE2.0") &&
                 EGifPutExtensionBlock(gif, 3, "\1\0\0") && EGifPutExtensionTrailer(gif);
    const std::size_t pixels = std::size_t(width) * height;
    std::array<std::vector<GifByteType>, 3> colors;
    std::vector<GifByteType> indices(pixels);
    for(std::size_t frame = 0; frame < m_frames.size() && is_written; ++frame)
    {
      std::ifstream in(folder.path / picture(frame), std::ios::binary);
      std::string word;
      for(int header = 0; header < 4 && in >> word;) // P6, width, height, 255
        if(word[0] == '#')
          std::getline(in, word);
        else
          ++header;
      in.get();
      for(auto& color : colors)
        color.resize(pixels);
      for(std::size_t i = 0; i < pixels; ++i)
        for(auto& color : colors)
          color[i] = static_cast<GifByteType>(in.get());
      int n = 256;
      ColorMapObject* const map = GifMakeMapObject(n, nullptr);
      GraphicsControlBlock block = {DISPOSE_DO_NOT, false, 100 / frames_per_second,
                                    NO_TRANSPARENT_COLOR};
      std::array<GifByteType, 4> extension;
      EGifGCBToExtension(&block, extension.data());
      is_written = in && map != nullptr &&
        GifQuantizeBuffer(width, height, &n, colors[0].data(), colors[1].data(),
                          colors[2].data(), indices.data(), map->Colors) != GIF_ERROR &&
        EGifPutExtension(gif, GRAPHICS_EXT_FUNC_CODE, 4, extension.data()) &&
        EGifPutImageDesc(gif, 0, 0, width, height, false, map);
      for(int y = 0; y < height && is_written; ++y)
        is_written = EGifPutLine(gif, indices.data() + std::size_t(y) * width, width);
      GifFreeMapObject(map);
    }
    require(EGifCloseFile(gif, &error) != GIF_ERROR && is_written);
  }
#endif

  // The shape at rest, a morph target for each frame, and an animation of their weights.
  void write_gltf(std::ostream& out) const
  {
    Gltf gltf = make_gltf(m_frames[0], m_panel.triangles);
    const std::size_t n = m_frames.size();
    std::vector<float> times(n, 0.f), weights(n * (n - 1), 0.f);
    Gltf::Json targets = Gltf::Json::array();
    for(std::size_t frame = 1; frame < n; ++frame)
    {
      std::vector<float> steps;
      for(std::size_t v = 0; v < m_frames[0].size(); ++v)
        for(int k = 0; k < 3; ++k)
          steps.push_back(to_float(m_frames[frame][v][k] - m_frames[0][v][k]));
      targets.push_back({{"POSITION", gltf.append(steps, "VEC3", Gltf::VERTICES)}});
      times[frame] = static_cast<float>(frame) / frames_per_second;
      weights[frame * (n - 1) + frame - 1] = 1;
    }
    Gltf::Json& json = gltf.json;
    json["meshes"][0]["primitives"][0]["targets"] = targets;
    json["meshes"][0]["weights"] = std::vector<double>(n - 1, 0.);
    const std::size_t input = gltf.append(times, "SCALAR"), output = gltf.append(weights, "SCALAR");
    json["accessors"][input]["min"] = {times.front()}; // of an input these are required
    json["accessors"][input]["max"] = {times.back()};
    Gltf::Json animation;
    animation["samplers"] = {{{"input", input}, {"output", output}}};
    animation["channels"] = {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}};
    json["animations"].push_back(animation);
    gltf.write(out, m_format == ".glb");
  }

  std::string m_format;
  View m_view;
  CGAL::Bbox_3 m_box;
  Panel m_panel; // with the points of a frame
  std::vector<Points> m_frames;
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_FILM_H
