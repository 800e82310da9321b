#include <CGAL/ARAP_deformation.h>
#include <CGAL/ARAP_deformation/Simplex_soup_domain.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

namespace ARAP = CGAL::ARAP;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Vector = Eigen::Vector3d;

template <std::size_t N>
struct Model
{
  std::string name;
  std::vector<Point> points;
  std::vector<std::array<int, N>> simplices;
};

template <std::size_t N>
void keep_largest_component(Model<N>& m)
{
  std::vector<int> parent(m.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int v) { while(parent[v] != v) v = parent[v] = parent[parent[v]]; return v; };
  for(const auto& s : m.simplices)
    for(std::size_t k = 1; k < N; ++k)
      parent[find(s[k])] = find(s[0]);
  std::vector<int> count(m.points.size(), 0), index(m.points.size(), -1);
  for(std::size_t v = 0; v < parent.size(); ++v)
    ++count[find(int(v))];
  const int root = int(std::max_element(count.begin(), count.end()) - count.begin());
  std::vector<Point> points;
  for(std::size_t v = 0; v < parent.size(); ++v)
    if(find(int(v)) == root)
    {
      index[v] = int(points.size());
      points.push_back(m.points[v]);
    }
  std::vector<std::array<int, N>> simplices;
  for(auto s : m.simplices)
    if(find(s[0]) == root)
    {
      for(auto& v : s)
        v = index[v];
      simplices.push_back(s);
    }
  m.points.swap(points);
  m.simplices.swap(simplices);
}

bool read_off(const std::string& file, Model<3>& m)
{
  std::ifstream in(file);
  std::string word, text, line;
  while(std::getline(in, line))
    text += line.substr(0, line.find('#')) + ' ';
  std::istringstream s(text);
  s >> word;
  std::size_t nv = 0, nf = 0, ne = 0;
  if(word != "OFF" || !(s >> nv >> nf >> ne))
    return false;
  for(std::size_t k = 0; k < nv; ++k)
  {
    double x, y, z;
    if(!(s >> x >> y >> z))
      return false;
    m.points.emplace_back(x, y, z);
  }
  for(std::size_t k = 0; k < nf; ++k)
  {
    int n, a, b, c;
    if(!(s >> n >> a >> b >> c) || n != 3)
      return false;
    m.simplices.push_back({a, b, c});
  }
  keep_largest_component(m);
  return true;
}

template <typename F>
Model<3> sheet(const std::string& name, int nu, int nv, bool wrap, const F& f)
{
  Model<3> m{name, {}, {}};
  const int columns = wrap ? nu : nu + 1;
  for(int i = 0; i < columns; ++i)
    for(int j = 0; j <= nv; ++j)
    {
      const Vector p = f(double(i) / nu, double(j) / nv);
      m.points.emplace_back(p.x(), p.y(), p.z());
    }
  const auto at = [&](int i, int j) { return (i % columns) * (nv + 1) + j; };
  for(int i = 0; i < nu; ++i)
    for(int j = 0; j < nv; ++j)
    {
      const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if((i + j) % 2 == 0) { m.simplices.push_back({a, b, c}); m.simplices.push_back({a, c, d}); }
      else { m.simplices.push_back({a, b, d}); m.simplices.push_back({b, c, d}); }
    }
  return m;
}

Model<4> block(const std::string& name, int n, int m, int k, double h)
{
  Model<4> b{name, {}, {}};
  const auto at = [&](int x, int y, int z) { return (x * (m + 1) + y) * (k + 1) + z; };
  for(int x = 0; x <= n; ++x) for(int y = 0; y <= m; ++y) for(int z = 0; z <= k; ++z)
    b.points.emplace_back(h * x, h * y, h * z);
  const int order[6][3] = {{0,1,2},{0,2,1},{1,0,2},{1,2,0},{2,0,1},{2,1,0}};
  for(int x = 0; x < n; ++x) for(int y = 0; y < m; ++y) for(int z = 0; z < k; ++z)
    for(const auto& o : order)
    {
      int p[3] = {x, y, z};
      std::array<int, 4> t;
      t[0] = at(p[0], p[1], p[2]);
      for(int s = 0; s < 3; ++s) { ++p[o[s]]; t[std::size_t(s + 1)] = at(p[0], p[1], p[2]); }
      b.simplices.push_back(t);
    }
  return b;
}

Vector vector(const Point& p) { return {p.x(), p.y(), p.z()}; }

// a smooth deterministic displacement
Vector wave(const Vector& p, int seed)
{
  Vector sum(0, 0, 0);
  for(int k = 0; k < 6; ++k)
  {
    const double a = 1.7 * (k + 1) + seed;
    const Vector direction(std::cos(3 * a), std::sin(5 * a), std::cos(7 * a + 1));
    const double phase = 12 * Vector(std::sin(a), std::cos(2 * a), std::sin(3 * a + 2)).dot(p);
    sum += std::sin(phase + a) * direction;
  }
  return sum / 6;
}

const char* const scheme_names[] = {"spokes", "rims", "elements"};
const char* const pose_names[] = {"bend", "twist", "push", "turn", "mid"};

template <std::size_t N>
void measure(const Model<N>& m, bool is_reference, const std::string& only)
{
  using Domain = ARAP::Simplex_soup_domain<int(N) - 1, std::vector<Point>, std::vector<std::array<int, N>>>;
  Eigen::AlignedBox3d box;
  for(const Point& p : m.points)
    box.extend(vector(p));
  int axis;
  box.sizes().maxCoeff(&axis);
  const double diagonal = box.diagonal().norm();
  const std::size_t n = m.points.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return m.points[a][axis] < m.points[b][axis]; });
  const std::size_t count = (std::max)(n / 20, std::size_t(3));
  for(int pose = 0; pose < 5; ++pose)
    for(int scheme = 0; scheme < 3; ++scheme)
    {
      if(!only.empty() && only != std::string(pose_names[pose]) + "/" + scheme_names[scheme])
        continue;
      std::vector<Point> points = m.points;
      CGAL::ARAP_deformation<Domain> d(Domain(points, m.simplices));
      ARAP::Options options;
      options.cells = scheme == 0 ? ARAP::Cell_scheme::spokes()
                    : scheme == 1 ? ARAP::Cell_scheme::spokes_and_rims() : ARAP::Cell_scheme::elements();
      if(!d.set_options(options)) continue;
      for(std::size_t k = count; k < n; ++k)
        d.insert_roi_vertex(order[k]);
      const Vector e = Vector::Unit(axis), u = Vector::Unit((axis + 1) % 3);
      Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
      const double length = box.sizes()[axis];
      const Eigen::Translation3d to(box.center()), from(-box.center());
      switch(pose)
      {
      case 0: motion = to * Eigen::AngleAxisd(1.2, u) * from; break;
      case 1: motion = to * Eigen::AngleAxisd(std::acos(-1.0) * 0.75, e) * from; break;
      case 2: motion = Eigen::Translation3d(-0.3 * length * e); break;
      case 3: motion = Eigen::Translation3d(0.2 * length * u) * to * Eigen::AngleAxisd(1.5, Vector(1, 2, 0.5).normalized()) * from; break;
      default: motion = Eigen::Translation3d(0.25 * length * u + 0.1 * length * e);
      }
      for(std::size_t k = 0; k < n; ++k)
        if(pose == 4 ? (k >= n / 2 && k < n / 2 + 1) || k >= n - count : k >= n - count)
        {
          const std::size_t v = order[k];
          const Vector p = k < n - count ? Vector(vector(m.points[v]) + 0.15 * diagonal * u)
                                         : Vector(motion * vector(m.points[v]));
          d.insert_control_vertex(v, Point(p.x(), p.y(), p.z()));
        }
      if(!d.preprocess()) continue;
      double lowest = 1e300;
      const auto continued = [&](double before, int iterations) { // to the own minimum
        double own = before;
        for(int round = 0; round < 2; ++round)
        {
          const ARAP::Report r = d.deform(iterations, 1e-7);
          if(!r) break;
          own = (std::min)(own, r.final_energy());
          for(std::size_t k = count; k < n - count; ++k)
          {
            const Vector w = 2e-3 * diagonal * wave((vector(points[order[k]]) - box.center()) / diagonal, round);
            if(pose != 4 || k != n / 2)
              points[order[k]] = Point(points[order[k]].x() + w.x(), points[order[k]].y() + w.y(), points[order[k]].z() + w.z());
          }
        }
        return own;
      };
      const auto targets = [&] {
        d.reset();
        for(std::size_t k = 0; k < n; ++k)
          if(pose == 4 ? (k >= n / 2 && k < n / 2 + 1) || k >= n - count : k >= n - count)
          {
            const std::size_t v = order[k];
            const Vector p = k < n - count ? Vector(vector(m.points[v]) + 0.15 * diagonal * u)
                                           : Vector(motion * vector(m.points[v]));
            (void)d.set_target_position(v, Point(p.x(), p.y(), p.z()));
          }
      };
      struct Run { double tolerance; ARAP::Report report; double own; std::string end; };
      std::vector<Run> runs;
      for(double tolerance : {1e-2, 1e-3})
      {
        targets();
        ARAP::Report r = d.deform(1000, tolerance);
        double own = r ? r.final_energy() : 0;
        if(is_reference && r)
          own = continued(own, 1000);
        lowest = (std::min)(lowest, own);
        runs.push_back({tolerance, r, own,
#ifdef ENDS
          ARAP::to_string(r.end)
#else
          "-"
#endif
          });
      }
      for(const Run& r : runs)
      {
        std::printf("%s\t%zu\t%s\t%s\t%g\t%s\t%u\t%.4f\t%.10g\t%.10g\t%.10g\t%.3g\t%s\n", m.name.c_str(), n,
                    pose_names[pose], scheme_names[scheme], r.tolerance, ARAP::to_string(r.report.status),
                    r.report.iterations, r.report.seconds.total, r.report ? r.report.final_energy() : 0.0,
                    r.own, lowest, r.report.estimated_relative_gap, r.end.c_str());
      }
      std::fflush(stdout);
    }
}

int main(int argc, char** argv)
{
  const bool is_reference = argc < 2 || std::string(argv[1]) != "fast";
  const std::string wanted = argc > 2 ? argv[2] : "", only = argc > 3 ? argv[3] : "";
  const std::string folder = std::string(CGAL_DATA_DIR) + "/meshes/";
  const double pi = std::acos(-1.0);
  const auto is_wanted = [&](const std::string& name) { return wanted.empty() || wanted == name; };
  for(const char* name : {"blade.off", "cactus.off", "elephant.off", "dino.off", "hand.off", "femur.off",
                          "knot1.off", "bones.off", "pig.off", "mushroom.off", "triceratops.off",
                          "camel.off", "sphere.off", "pipe.off", "mannequin-devil.off", "head.off",
                          "anchor_dense.off", "bear.off", "man.off", "lion-head.off", "turbine.off",
                          "handle.off", "joint.off", "cow.off", "rotor.off", "horizons.off", "homer.off",
                          "fandisk.off", "cylinder.off", "nefertiti.off"})
  {
    Model<3> m{name, {}, {}};
    if(is_wanted(name) && read_off(folder + name, m) && m.points.size() > 60 && m.points.size() < 12000)
      measure(m, is_reference, only);
  }
  if(is_wanted("strip"))
    measure(sheet("strip", 60, 12, false, [](double u, double v) { return Vector(5 * u, v, 0); }), is_reference, only);
  if(is_wanted("plate"))
    measure(sheet("plate", 40, 40, false, [](double u, double v) { return Vector(u, v, 0); }), is_reference, only);
  if(is_wanted("tube"))
    measure(sheet("tube", 40, 60, true, [=](double u, double v) { return Vector(std::cos(2 * pi * u), std::sin(2 * pi * u), 10 * v); }), is_reference, only);
  if(is_wanted("gutter"))
    measure(sheet("gutter", 20, 80, false, [=](double u, double v) { return Vector(std::cos(pi * u), std::sin(pi * u), 10 * v); }), is_reference, only);
  if(is_wanted("tet-bar"))
    measure(block("tet-bar", 40, 6, 6, 0.1), is_reference, only);
  if(is_wanted("tet-plate"))
    measure(block("tet-plate", 24, 24, 2, 0.1), is_reference, only);
  if(is_wanted("tet-cube"))
    measure(block("tet-cube", 12, 12, 12, 0.1), is_reference, only);
}
