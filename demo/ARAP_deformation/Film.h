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
#include "Output_file.h"
#include "Scene.h"
#include "shape_files.h"

#ifdef CGAL_ARAP_DEMO_WITH_GIFLIB
#include <gif_lib.h>
#endif
#ifdef CGAL_ARAP_DEMO_WITH_TINYGLTF
#include <tiny_gltf.h>
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
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
    if(format == ".gltf" || format == ".glb")
    {
#ifndef CGAL_ARAP_DEMO_WITH_TINYGLTF
      refuse("this arap_deform was built without TinyGLTF (Debian: libtinygltf-dev)");
#endif
      return;
    }
    if(format == ".mp4" || format == ".webm")
    {
      const internal::Temporary_folder folder;
      if(internal::run_program(folder, "ffmpeg -version") != 0)
        refuse("needs the program ffmpeg, which was not found");
    }
    else if(format != ".gif")
      refuse("a film ends in .gif, .mp4, .webm, .gltf or .glb");
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
#ifdef CGAL_ARAP_DEMO_WITH_TINYGLTF
    if(m_format == ".gltf" || m_format == ".glb")
      return write_gltf(out);
#endif
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
    if(internal::run_program(folder, "ffmpeg -loglevel error -framerate " +
                                       std::to_string(frames_per_second) +
                                       " -i %04d.ppm -pix_fmt yuv420p film" + m_format) != 0)
      throw std::runtime_error("ffmpeg could not make the film:" +
                               internal::last_messages(folder.path / "messages"));
    out << std::ifstream(folder.path / ("film" + m_format), std::ios::binary).rdbuf();
  }

private:
  static constexpr int frames_per_second = 20;

  static std::string picture(std::size_t frame)
  {
    const std::string digits = std::to_string(frame);
    return std::string(4 - (std::min)(digits.size(), std::size_t(4)), '0') + digits + ".ppm";
  }

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
    std::array<std::vector<GifByteType>, 3> colours;
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
      for(auto& colour : colours)
        colour.resize(pixels);
      for(std::size_t i = 0; i < pixels; ++i)
        for(auto& colour : colours)
          colour[i] = static_cast<GifByteType>(in.get());
      int n = 256;
      ColorMapObject* const map = GifMakeMapObject(n, nullptr);
      GraphicsControlBlock block = {DISPOSE_DO_NOT, false, 100 / frames_per_second,
                                    NO_TRANSPARENT_COLOR};
      std::array<GifByteType, 4> extension;
      EGifGCBToExtension(&block, extension.data());
      is_written = in && map != nullptr &&
        GifQuantizeBuffer(width, height, &n, colours[0].data(), colours[1].data(),
                          colours[2].data(), indices.data(), map->Colors) != GIF_ERROR &&
        EGifPutExtension(gif, GRAPHICS_EXT_FUNC_CODE, 4, extension.data()) &&
        EGifPutImageDesc(gif, 0, 0, width, height, false, map);
      for(int y = 0; y < height && is_written; ++y)
        is_written = EGifPutLine(gif, indices.data() + std::size_t(y) * width, width);
      GifFreeMapObject(map);
    }
    require(EGifCloseFile(gif, &error) != GIF_ERROR && is_written);
  }
#endif

#ifdef CGAL_ARAP_DEMO_WITH_TINYGLTF
  // The shape at rest, a morph target for each frame, and an animation of their weights.
  void write_gltf(std::ostream& out) const
  {
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "arap_deform";
    model.buffers.resize(1);

    // Appends numbers to the buffer as an accessor, and returns its index.
    const auto append = [&model](const auto& values, int type, int width, int target) {
      using Value = typename std::decay_t<decltype(values)>::value_type;
      auto& data = model.buffers[0].data;
      tinygltf::BufferView view;
      view.buffer = 0;
      view.byteOffset = data.size();
      view.byteLength = values.size() * sizeof(Value);
      view.target = target;
      const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
      data.insert(data.end(), bytes, bytes + view.byteLength);
      tinygltf::Accessor accessor;
      accessor.bufferView = static_cast<int>(model.bufferViews.size());
      accessor.componentType = std::is_same_v<Value, float> ? TINYGLTF_COMPONENT_TYPE_FLOAT
                                                            : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
      accessor.type = type;
      accessor.count = values.size() / width;
      if(type == TINYGLTF_TYPE_VEC3 || target == 0) // glTF asks for the bounds of these
        for(int k = 0; k < width; ++k)
        {
          accessor.minValues.push_back(values[k]);
          accessor.maxValues.push_back(values[k]);
          for(std::size_t i = k; i < values.size(); i += width)
          {
            accessor.minValues[k] = (std::min)(accessor.minValues[k], double(values[i]));
            accessor.maxValues[k] = (std::max)(accessor.maxValues[k], double(values[i]));
          }
        }
      model.bufferViews.push_back(view);
      model.accessors.push_back(accessor);
      return static_cast<int>(model.accessors.size() - 1);
    };
    const auto append_points = [&](const Points& points, const Points* rest) {
      std::vector<float> values;
      for(std::size_t v = 0; v < points.size(); ++v)
        for(int k = 0; k < 3; ++k)
          values.push_back(static_cast<float>(points[v][k] - (rest ? (*rest)[v][k] : 0)));
      return append(values, TINYGLTF_TYPE_VEC3, 3, TINYGLTF_TARGET_ARRAY_BUFFER);
    };

    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    std::vector<std::uint32_t> corners;
    for(const auto& triangle : m_panel.triangles)
      corners.insert(corners.end(), triangle.begin(), triangle.end());
    primitive.indices = append(corners, TINYGLTF_TYPE_SCALAR, 1,
                               TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    primitive.attributes["POSITION"] = append_points(m_frames[0], nullptr);
    const std::size_t n = m_frames.size();
    std::vector<float> times, weights(n * (n - 1), 0.f);
    for(std::size_t frame = 0; frame < n; ++frame)
    {
      times.push_back(static_cast<float>(frame) / frames_per_second);
      if(frame == 0)
        continue;
      primitive.targets.push_back({{"POSITION", append_points(m_frames[frame], &m_frames[0])}});
      weights[frame * (n - 1) + frame - 1] = 1;
    }
    tinygltf::Mesh mesh;
    mesh.primitives.push_back(primitive);
    mesh.weights.assign(n - 1, 0.);
    model.meshes.push_back(mesh);
    tinygltf::Node node;
    node.mesh = 0;
    model.nodes.push_back(node);
    tinygltf::Scene scene;
    scene.nodes.push_back(0);
    model.scenes.push_back(scene);
    model.defaultScene = 0;

    tinygltf::Animation animation;
    tinygltf::AnimationSampler sampler;
    sampler.input = append(times, TINYGLTF_TYPE_SCALAR, 1, 0);
    sampler.output = append(weights, TINYGLTF_TYPE_SCALAR, 1, 0);
    sampler.interpolation = "LINEAR";
    animation.samplers.push_back(sampler);
    tinygltf::AnimationChannel channel;
    channel.sampler = 0;
    channel.target_node = 0;
    channel.target_path = "weights";
    animation.channels.push_back(channel);
    model.animations.push_back(animation);
    if(!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, true, m_format == ".glb"))
      out.setstate(std::ios::failbit);
  }
#endif

  std::string m_format;
  View m_view;
  CGAL::Bbox_3 m_box;
  Panel m_panel; // with the points of a frame
  std::vector<Points> m_frames;
};

} // namespace CGAL::ARAP::demo

#endif // CGAL_ARAP_DEFORMATION_DEMO_FILM_H
