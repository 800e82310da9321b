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

// Drags a handle over FRAMES frames of three iterations, as test_page.mjs does in WebAssembly,
// natively with one thread. Prints the milliseconds of each frame, then the last energy.
// usage: frames MESH.off SELECTION FRAMES

#include "../../Array_deformation.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

int main(int argc, char* argv[])
{
  if(argc != 4)
    return 2;
  std::ifstream mesh(argv[1]), statuses(argv[2]);
  std::string off;
  std::size_t n, m, edges;
  mesh >> off >> n >> m >> edges;
  std::vector<double> points(3 * n);
  std::vector<std::int32_t> faces(3 * m), handle, held;
  for(double& x : points)
    mesh >> x;
  for(std::size_t f = 0; f < m; ++f)
    mesh >> edges >> faces[3 * f] >> faces[3 * f + 1] >> faces[3 * f + 2];
  for(std::size_t v = 0; v < n; ++v)
  {
    int status = 1;
    statuses >> status;
    if(status != 1)
      held.push_back(static_cast<std::int32_t>(v));
    if(status == 2)
      handle.push_back(static_cast<std::int32_t>(v));
  }
  const auto session = CGAL::ARAP::bindings::make_array_deformation(
    {points.data(), n, 3}, {faces.data(), m, 3}, false, "safe_cotangent");
  session->set_options({{"threads", "1"}});
  session->insert_handles({held.data(), held.size()});
  double energy = 0;
  for(int frame = 0; frame < std::atoi(argv[3]); ++frame)
  {
    const auto start = std::chrono::steady_clock::now();
    const double x = 0.3 * std::sin(frame / 10.);
    const double matrix[12] = {1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0.3};
    session->transform({handle.data(), handle.size()}, {matrix, 3, 4}, true);
    energy = session->deform(3, 0, {}).final_energy();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    std::printf("%.3f\n", time.count());
  }
  std::printf("%.17g\n", energy);
}
